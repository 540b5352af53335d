"""The effect: seepage through blocks, coupled one way: strain does not change the head."""

from nmm.water.pore_water import PoreWater


class Seepage(PoreWater):
    """Hydraulic head in pores of constant volume."""

    name = "seepage"
