"""The exchangeable parts that scene and formulation name, made once before anything is built.

So a wrong name or option is reported with its line in the file, together with all others. A part
that is not named is a built-in one and is not imported for this.
"""

import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from nmm.errors import Fault, FormulationError, NmmError, SceneError

if TYPE_CHECKING:
    from pydantic import BaseModel

    from nmm.formulation import Formulation
    from nmm.scene.faults import Source
    from nmm.scene.model import Scene

# Keys that name a part or change it.
NAMING = (
    *("law", "type", "method", "functions", "degree", "enforcement", "fracture_energy", "options"),
    *("size", "angle", "shift", "enrichment", "max_passes"),
    *("yield_stress", "hardening_modulus", "cohesion", "friction_angle", "dilation_angle"),
    *("tensile_strength", "match"),
    *("viscosity", "delayed_modulus", "delayed_viscosity"),
    *("young_modulus_2", "shear_modulus", "axis_angle"),
    *("young_modulus_3", "poisson_ratio_13", "poisson_ratio_23"),
)


def check_parts(scene: "Scene", formulation: "Formulation") -> None:
    """Make every part that is named.

    Raises
    ------
    FormulationError
        All names that are not known and all options that are refused, one line each.
    """
    faults: list[Fault | str] = []
    for source, path, part, check in _named(scene, formulation):
        keys = [key for key in NAMING if key in part.model_fields_set]
        try:
            if keys:
                check(part)
        except NmmError as error:
            faults += [
                _placed(fault, source.place(*path, *_key_of(fault, part, keys)))
                for fault in error.faults
            ]
    faults += _of_effects(scene) + _of_outputs(scene)
    if faults:
        raise FormulationError(*faults)


def _of_effects(scene: "Scene") -> list[Fault | str]:
    """Return what is wrong with the tables of effects of one's own."""
    from nmm.model.effects_table import own_effect

    faults: list[Fault | str] = []
    for name in scene.effects:
        try:
            own_effect(scene, name)
        except SceneError as error:
            faults += error.faults
        except NmmError as error:
            place = scene.source.place("effects", name, "type")
            faults += [_placed(fault, place) for fault in error.faults]
    return faults


def _of_outputs(scene: "Scene") -> list[Fault | str]:
    """Return what is wrong with the quantities that ``[output]`` names."""
    from nmm.outputs.base import OUTPUTS

    faults: list[Fault | str] = []
    for number, name in enumerate(scene.output.quantities if scene.output else ()):
        try:
            OUTPUTS.make(name)
        except NmmError as error:
            place = scene.source.place("output", "quantities", number)
            faults += [_placed(fault, place) for fault in error.faults]
    return faults


def _key_of(fault: Fault | str, part: "BaseModel", keys: list[str]) -> list[str]:
    """Return the key whose value is at fault, the only one, or none where it may be any."""
    if isinstance(fault, Fault):
        if fault.place in part.model_fields_set:
            return [fault.place]
        for key in keys:
            if fault.value == f'"{getattr(part, key)}"':
                return [key]
        options = getattr(part, "options", {})
        for key in (fault.value, fault.place.rpartition(": ")[2]):
            if key in options:
                return ["options", key]
    elif (key := _before_colon(fault)) in part.model_fields_set:
        return [key]
    return keys if len(keys) == 1 else []


def _placed(fault: Fault | str, place: str) -> Fault | str:
    """Put the place in the file before a fault; what is said there already is not said twice."""
    if isinstance(fault, Fault) and place.endswith(fault.place):
        return replace(fault, place=place)
    rest = str(fault).partition(": ")[2]
    told = rest and place.endswith(f".{_before_colon(str(fault))}")
    return f"{place}: {rest if told else fault}"


def _before_colon(text: str) -> str:
    """Return the key that a text begins with, after its table: ``[cover] degree: ...``."""
    return re.sub(r"^\[[\w.]+\] ", "", text.partition(": ")[0])


def _named(
    scene: "Scene", formulation: "Formulation"
) -> "Iterator[tuple[Source, tuple[str, ...], BaseModel, Callable[[Any], object]]]":
    """Yield the tables of parts: file, key path, table, and what makes the part."""
    for name, material in scene.materials.items():
        yield scene.source, ("materials", name), material, _material
    for name, interface in scene.interfaces.items():
        yield scene.source, ("interfaces", name), interface, _interface
    for name, table in scene.splitting.items():
        yield scene.source, ("splitting", name), table, _strength
    if scene.loading is not None and scene.loading.control is not None:
        yield scene.source, ("loading", "control"), scene.loading.control, _control
    source = formulation.source
    yield source, ("cover",), formulation.cover, _cover
    yield source, ("contact",), formulation.contact, _enforcement
    yield source, ("supports",), formulation.supports, _imposition
    yield source, ("glue",), formulation.glue, _imposition
    yield source, ("integrator",), formulation.integrator, _integrator
    yield source, ("solver",), formulation.solver, _solver


def _material(part: Any) -> None:
    from nmm.model.build import material_law

    material_law(part)


def _interface(part: Any) -> None:
    from nmm.interfaces.from_scene import interface_law

    interface_law(part)


def _control(part: Any) -> None:
    from nmm.controls.base import CONTROLS

    CONTROLS.load(part.type).of(part)


def _cover(part: Any) -> None:
    from nmm.geometry.tessellation.cover_types import block_cover, functions_of
    from nmm.model.manifolds.several_meshes import net_class

    if part.degree is not None or functions_of(part).any_degree:
        from nmm.model.manifolds.covering import local_functions

        local_functions(part)
    blocks = block_cover(part)
    if blocks is None:
        net_class(part)
    elif not blocks.divides:
        for key in () if part.nets else ("size", "angle", "shift", "enrichment"):
            if getattr(part, key) != type(part).model_fields[key].default:
                remedy = f"remove {key}, or choose a net such as triangles"
                expected = f'no such key: type is "{part.type}", and blocks have no net'
                raise FormulationError(Fault(key, str(getattr(part, key)), expected, remedy))
        return
    if part.size is None:
        expected = f'the size of a cell in m, as type is "{part.type}"'
        raise FormulationError(Fault("size", "missing", expected, "add for example size = 0.1"))


def _enforcement(part: Any) -> None:
    from nmm.contact.enforcement.base import make_enforcement

    made = make_enforcement(part.enforcement, part.options)
    if "max_passes" in _changed(part) and not hasattr(made, "max_passes"):
        raise _unread(part, "max_passes", "enforcement")


def _imposition(part: Any) -> None:
    from nmm.constraints.imposition import IMPOSITIONS

    if part.method == "auto":
        return
    reads = IMPOSITIONS.load(part.method).reads
    given = _changed(part) - {"method", *part.ALWAYS_READ}
    unread = sorted(() if reads is None else given - reads)
    if unread:
        raise _unread(part, unread[0], "method")


def _changed(part: Any) -> set[str]:
    """Return the keys whose value is not that of default: files of a run name all of them."""
    known = type(part).model_fields
    return {key for key in part.model_fields_set if getattr(part, key) != known[key].default}


def _unread(part: Any, key: str, naming: str) -> FormulationError:
    """Return the refusal of a key that the part named by ``naming`` does not use."""
    name = getattr(part, naming)
    expected, remedy = f'no such key, as {naming} is "{name}"', f"remove {key}, or name another"
    return FormulationError(Fault(key, f"{getattr(part, key):g}", expected, f"{remedy} {naming}"))


def _integrator(part: Any) -> None:
    from nmm.integrators.base import make_integrator

    make_integrator(part)


def _solver(part: Any) -> None:
    from nmm.solvers.linear import make_solver

    make_solver(part.type, part.options)


def _strength(part: Any) -> object:
    from nmm.splitting.splitting import strength_of

    return strength_of(part)
