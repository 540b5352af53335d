"""The effect: water that seeps through blocks, one way: what pores gain by strain is left out."""

from nmm.water.pore_water import PoreWater


class Seepage(PoreWater):
    """Head of the water in pores whose room stays as it is."""

    name = "seepage"
