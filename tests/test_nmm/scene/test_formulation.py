"""Formulations: defaults, own parts, faults."""

from pathlib import Path

import pytest

from nmm.errors import FormulationError
from nmm.formulation import Formulation, formulation_hash, parse_formulation, read_formulation
from nmm.geometry.tessellation.cover_types import named_functions


def test_nothing_named_means_classical_blocks() -> None:
    formulation = parse_formulation("")
    assert formulation == Formulation()
    assert formulation.cover.type == "block"
    assert named_functions(formulation.cover) == "rigid_strain"
    assert formulation.integrator.step == 1e-3


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ('[cover]\ntyp = "block"', ("f.toml:2: cover.typ", 'did you mean "type"')),
        ('[cover]\ntype = "my block"', (":2: cover.type", "module:Name")),
        ('[integrator]\nstep = "1 mm"', (":2: integrator.step", "dimension", '"10 ms"')),
        ("[integrator]\nkinetic_factor = 1.1", (":2:", "1.1", "[0, 1]")),
        ('[contact]\njoint_points = "middle"', (":2:", '"corners" or "gauss"')),
        ("[contact]\nnormal_penalty = 0", (":2:", "> 0")),
        ("[loading]\ntolerance = 1.0", (":2:", "[1e-9, 1)")),
        ('[rotation]\nupdate = "none"', (":2:", '"exact"')),
    ],
)
def test_a_bad_value_is_one_line_with_place_and_remedy(text: str, parts: tuple[str, ...]) -> None:
    with pytest.raises(FormulationError) as caught:
        parse_formulation(text, "f.toml")
    assert len(caught.value.faults) == 1
    assert all(part in str(caught.value) for part in parts), caught.value


def test_the_hash_ignores_units_and_sees_options(tmp_path: Path) -> None:
    path = tmp_path / "f.toml"
    path.write_text('[integrator]\nstep = "1 ms"')
    assert formulation_hash(read_formulation(path)) == formulation_hash(Formulation())
    other = parse_formulation("[integrator.options]\nbeta = 0.25")
    assert formulation_hash(other) != formulation_hash(Formulation())


@pytest.mark.parametrize(
    ("option", "said"),
    [
        ({"max_passes": 1.5}, 'enforcement "penalty": max_passes: 1.5: expected a whole number'),
        ({"max_passes": True}, "max_passes: true: expected a whole number"),
        ({"tolerance": "1e-9"}, 'tolerance: "1e-9": expected a number'),
        ({"iteration": 1}, "iteration: 1: expected a text"),
        ({"max_pases": 3}, 'max_pases: expected one of .*: did you mean "max_passes"?'),
    ],
)
def test_an_option_of_another_type_or_name_is_refused(option: dict[str, object], said: str) -> None:
    from nmm.contact.enforcement.base import make_enforcement

    with pytest.raises(FormulationError, match=said):
        make_enforcement("penalty", option)
    assert make_enforcement("penalty", {"tolerance": 1}) is not None  # 1 is a number as 1.0 is
