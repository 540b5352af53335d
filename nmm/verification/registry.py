"""Benchmarks by name."""

from nmm.registry import Registry
from nmm.verification.base import Case

_HOME = "nmm.verification.problems"

CASES = Registry[type[Case]](
    "benchmark",
    {
        "A1 displacements": f"{_HOME}.patch:HeldPatch",
        "A1 tractions": f"{_HOME}.patch:PulledPatch",
        "A1 meshless": f"{_HOME}.patch:MeshlessPatch",
        "A1 quadratic": f"{_HOME}.patch:QuadraticPatch",
        "A1 turn": f"{_HOME}.patch:RigidTurn",
        "A1 jump": f"{_HOME}.patch:Jump",
        "B1 friction": f"{_HOME}.incline:Threshold",
        "B1 cohesion": f"{_HOME}.incline:CohesiveThreshold",
        "B2": f"{_HOME}.incline:Sliding",
        "B4": f"{_HOME}.incline:Train",
        "B6": f"{_HOME}.toppling:Modes",
        "B7 rebound": f"{_HOME}.impact:Drop",
        "B7 energy": f"{_HOME}.impact:NoGain",
        "B8": f"{_HOME}.impact:Exchange",
        "B8 oblique": f"{_HOME}.impact:Oblique",
        "B12 stack": f"{_HOME}.stacks:Stack",
        "B12 column": f"{_HOME}.stacks:Column",
        "B12 overhang": f"{_HOME}.stacks:Overhang",
        "B13": f"{_HOME}.rotation:Projectile",
        "B14 spin": f"{_HOME}.rotation:Spin",
        "B14 classical": f"{_HOME}.rotation:LinearSpin",
        "B14 stress": f"{_HOME}.rotation:TurnedStress",
        "B15": f"{_HOME}.rocking:Rocking",
        "B18 column": f"{_HOME}.joints:JointedColumn",
        "B18 shear": f"{_HOME}.joints:DirectShear",
        "B25": f"{_HOME}.arches:ThreeHinges",
        "B26": f"{_HOME}.arches:Semicircle",
        "B27": f"{_HOME}.arches:ShakenArch",
        "B31 pull-off": f"{_HOME}.joints:PullOff",
        "B31 drop": f"{_HOME}.joints:BrittleDrop",
        "C3": f"{_HOME}.joints:Chain",
        "B10 cycle": f"{_HOME}.friction:CyclicShear",
        "B10 enforcement": f"{_HOME}.friction:ForcedCycle",
        "B10 cone": f"{_HOME}.friction:Cone",
        "C4": f"{_HOME}.friction:Strength",
        "B11 penetration": f"{_HOME}.enforcement:Penetration",
        "B11 rounds": f"{_HOME}.enforcement:Rounds",
        "D4": f"{_HOME}.enforcement:Groove",
        "B9 damping": f"{_HOME}.time_integration:SpringBlock",
        "B9 order": f"{_HOME}.time_integration:Order",
    },
)
