"""Seldom keys of what acts: fields, points held, damping, waves, forces as drawn."""

from typing import Any

from nmm.verification.hard.cases.base import Document
from nmm.verification.hard.generators.scenes.site import DENSITY, Site


def point_support(scene: Document, site: Site) -> Document:
    """Hold a corner of the top across."""
    return {"supports": [{"name": "corner", "point": site.top[0], "fix": [site.one_of("x", "y")]}]}


def held_block(scene: Document, site: Site) -> Document:
    """Hold a whole block."""
    if "stages" in scene or len(scene["blocks"]) < 2:
        return {}
    name = scene["blocks"][0]["name"]
    return {"supports": [{"name": "whole", "block": name, "fix": ["x", "y"]}]}


def moved_by_a_field(scene: Document, site: Site) -> Document:
    """Displace the right edge by an expression."""
    ways = [f"1e-4*{site.height:.6g}*t*y/{site.height:.6g}", f"-5e-5*{site.height:.6g}*t"]
    if site.moves:
        ways = [f"{way}/{8 * site.step:.6g}" for way in ways]
    table = {"name": "led", "segment": site.right, "fix": ["x", "y"], "field": ways}
    return {"supports": [table]}


def load_of_a_field(scene: Document, site: Site) -> Document:
    """Load the top by a traction that grows along it."""
    size = f"{site.stress:.6g}"
    ways = [f"0.3*{size}*x/{site.width:.6g}", f"-{size}*x/{site.width:.6g}"]
    return {"loads": [{"name": "uneven", "kind": "edge", "segment": site.top, "field": ways}]}


def pressed_all_round(scene: Document, site: Site) -> Document:
    """Press on the whole boundary of a block."""
    name = scene["blocks"][-1]["name"]
    table = {"name": "round", "kind": "pressure", "block": name, "pressure": site.stress}
    return {} if "stages" in scene else {"loads": [table]}


def stress_by_depth(scene: Document, site: Site) -> Document:
    """Give ground the stress of its weight."""
    if "initial_stresses" in scene:
        return {}
    weight = site.stress / site.height
    table = {"surface": site.height, "unit_weight": weight, "ratio": 0.4, "surcharge": weight}
    return {"initial_stresses": [{"block": "all", **table}]}


def ratios(scene: Document, site: Site) -> Document:
    """Damp by ratios at two frequencies."""
    if not site.moves:
        return {}
    low = 0.05 / site.step
    return {"damping": {"ratios": [0.05, 0.08], "frequencies": [0.1 * low, low]}}


def far_ground(scene: Document, site: Site) -> Document:
    """Let waves go into other ground, and one come in."""
    if not site.moves or "records" in scene or "viscous_boundaries" in scene:
        return {}
    speed = float((site.modulus / DENSITY) ** 0.5)
    values = [0.0, 1e-5 * speed, -1e-5 * speed, 0.0]
    record = {"values": values, "step": 2 * site.step, "quantity": "velocity", "start": site.step}
    edge: dict[str, Any] = {"name": "far", "segment": site.right, "incoming": {"x": "wave"}}
    edge |= {"density": 2200.0, "p_velocity": 1.2 * speed, "s_velocity": 0.7 * speed}
    return {"records": {"wave": record}, "viscous_boundaries": [edge]}


def free_columns(scene: Document, site: Site) -> Document:
    """Shake ground between columns that move as if it were endless."""
    if not site.moves or "records" in scene or "viscous_boundaries" in scene:
        return {}
    speed = 1e-5 * float((site.modulus / DENSITY) ** 0.5)
    samples = [[0.0, 0.0], [3 * site.step, speed], [8 * site.step, -speed]]
    foot: dict[str, Any] = {"name": "foot", "segment": scene["supports"][0]["segment"]}
    foot |= {"incoming": {"x": "wave"}}
    sides = [("west", site.left), ("east", site.right)]
    columns = [{"name": name, "segment": edge, "base": "foot"} for name, edge in sides]
    return {
        "records": {"wave": {"samples": samples, "quantity": "velocity"}},
        "viscous_boundaries": [foot],
        "free_fields": columns,
        "supports!": scene["supports"][1:],
    }


def held_back(scene: Document, site: Site) -> Document:
    """Pull bars and springs tight before they act, or let bars be cables with plates."""
    made: Document = {}
    force = 1e-6 * site.modulus * site.height
    if "bars" in scene:
        more = {"pretension": force, "carries": site.one_of("both", "tension"), "number": 0.5}
        more |= {"hardening_modulus": site.modulus, "ends": ["fixed", "fixed"]}
        bars = [{**one, **more} for one in scene["bars"]]
        if "bond" in bars[0]:
            bars[0]["bond"] = _bond(bars[0]["bond"], site)
            bars[0]["ends"] = [site.one_of("fixed", "free"), "fixed"]
        made["bars!"] = bars
    if "springs" in scene:
        made["springs!"] = [{**one, "force": force} for one in scene["springs"]]
    return made


def _bond(bond: Document, site: Site) -> Document:
    first, last = bond["slips"]
    stiff = bond["strength"] / first
    laws: dict[str, Document] = {
        "linear": {"stiffness": stiff},
        "plastic": {"stiffness": stiff, "strength": bond["strength"]},
        "bilinear": {**bond, "residual_strength": 0.3 * bond["strength"]},
        "model_code": {
            **{"strength": bond["strength"], "slips": [first, 2 * first, last]},
            **{"exponent": 0.4, "residual_strength": 0.3 * bond["strength"]},
        },
    }
    law = site.one_of(*laws)
    return {**laws[law], "law": law}
