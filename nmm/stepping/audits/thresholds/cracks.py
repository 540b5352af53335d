"""Thresholds of blocks that split and of cracks that grow or begin."""

from nmm.stepping.audits.thresholds.base import Threshold

CRACKS: dict[str, Threshold] = {
    "kept_whole": Threshold(
        "largest share of its strength that a block uses where a run ends, and splits no more",
        1.1,
        None,
        "`[splitting]`",
    ),
    "split_energy": Threshold(
        "energy that cuts of blocks that split added or took, over the turnover",
        2e-2,
        0.5,
        "`[splitting]` in dynamics without `[fracture]` and `[[stages]]`",
    ),
    "growth_energy": Threshold(
        "energy that growth freed less what its toughness took, over the largest energy",
        1e-3,
        None,
        '`[fracture]` with `control = "toughness"`',
    ),
    "growth_projection": Threshold(
        "energy that laying functions anew about grown tips added or took, over the turnover",
        2e-2,
        0.5,
        "`[fracture]` in dynamics without `[[stages]]`",
    ),
    "unstable_ways": Threshold(
        "most independent ways in which what softens together gives way, one of which a control "
        "holds",
        1,
        None,
        "`[loading.control]`",
    ),
    "growth_swing": Threshold(
        "angle (rad) by which pieces of a crack turn one way and at once back",
        0.2,
        None,
        "`[fracture]`",
    ),
    "crowded_tips": Threshold(
        "one and a half cells over the distance of a tip from a crack beside it, or 0.6 cells over "
        "that from an edge",
        1.0,
        None,
        "`[fracture]`",
    ),
    "nucleation_length": Threshold(
        "largest stress over the strength of cracks that begin, where no line of the mean fits "
        "across what is pulled",
        0.999,
        None,
        "`[fracture.nucleation]`",
    ),
    "faces_overlap": Threshold(
        "overlap of the faces of a crack, over the largest distance between faces; or -K_I, over K "
        "of both modes, of a tip that grew",
        0.05,
        None,
        "cracks without `[contact]`",
    ),
}
