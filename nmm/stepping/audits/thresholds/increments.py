"""Thresholds of increments in which friction slides, bonds break, matter flows or loads change."""

from nmm.stepping.audits.thresholds.base import Threshold

INCREMENTS: dict[str, Threshold] = {
    "increments": Threshold(
        "ten over the number of increments in which friction slid or bonds broke",
        1.0,
        None,
        "`[loading]` up to a factor, with contact",
    ),
    "history_missed": Threshold(
        "last change of a history in load factors over the last of these, or first step over that "
        "of one in seconds",
        1 + 1e-9,
        None,
        "statics with transient heat or water, without stages",
    ),
    "first_increment": Threshold(
        "what friction took in the first increment, over the turnover",
        1e-3,
        None,
        "statics with contact and initial stress",
    ),
    "softening_under_pressure": Threshold(
        "size of a cell in which friction falls over the largest under its pressure, about",
        1.0,
        None,
        "`mohr_coulomb` and `drucker_prager` with `softening_energy`",
    ),
    "softening_across_cells": Threshold(
        "mean angle (rad) of bands of flow from the nearest edges of their cells",
        0.15,
        None,
        "matter with `softening_energy`",
    ),
    "ellipticity": Threshold(
        "least determinant of an acoustic tensor where matter flows, below zero, over the elastic "
        "one in the mean over all angles",
        1e-6,
        None,
        "matter that yields, without `softening_energy`",
    ),
    "not_audited": Threshold(
        "1 where audits could not be made of the last state, as no forces of a part exist there",
        0.5,
        0.5,
        "all",
    ),
}
