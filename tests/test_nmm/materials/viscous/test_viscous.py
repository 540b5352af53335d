"""Matter that creeps: springs and dashpots against their closed forms, for steps of any length."""

import numpy as np
import pytest

from nmm.errors import FormulationError
from nmm.materials.viscous.laws import Burgers, Kelvin, Maxwell, StandardSolid
from nmm.testing.laws.materials import check_law, start_of

NU = 0.25
ELASTIC, SOFT = (2 * 10e9 * (1 + NU), NU), (2 * 5e9 * (1 + NU), NU)
LAWS = {
    "maxwell": Maxwell(*ELASTIC, 1e15),
    "kelvin": Kelvin(*SOFT, 2e14),
    "standard solid": StandardSolid(*ELASTIC, 5e9, 2e14),
    "burgers": Burgers(*ELASTIC, 1e15, 5e9, 2e14),
}
# Shear strain under 1 MPa after 1e4, 1e5 and 1e6 s, by inverse Laplace transform.
CREEP = {
    "maxwell": (1.1e-4, 2e-4, 1.1e-3),
    "kelvin": (4.423984339e-5, 1.835830003e-4, 2e-4),
    "standard solid": (1.442398434e-4, 2.835830003e-4, 3e-4),
    "burgers": (1.542398434e-4, 3.835830003e-4, 1.3e-3),
}
TAU = 4e4  # of Kelvin's spring and dashpot (s)


def crept(law, stresses, step, plane="strain"):
    """Shear strains (k,) under shear stresses (k,), the first at once, then a step (s) each."""
    history, strain, found = start_of(law, plane, 1), 0.0, []
    for number, stress in enumerate(stresses):
        time = step if number else 0.0
        answer = law.update(np.array([[0, 0, strain]]), history, plane, time)
        strain += (stress - answer.stress[0, 2]) / answer.tangent[0, 2, 2]
        history = law.update(np.array([[0, 0, strain]]), history, plane, time).history
        found.append(strain)
    return np.array(found)


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("step", [1.0, 3e4, 1e7])
def test_laws_of_creep_keep_what_every_law_must(name, step):
    check_law(LAWS[name], step=step, strains=(1e-3,))


@pytest.mark.parametrize("plane", ["strain", "stress"])
@pytest.mark.parametrize("name", LAWS)
def test_creep_in_shear_is_that_of_springs_and_dashpots(name, plane):
    for time, expected in zip((1e4, 1e5), CREEP[name], strict=False):
        steps = round(time / (TAU / 100))
        found = crept(LAWS[name], [1e6] * (steps + 1), TAU / 100, plane)
        # Second order in the step; Kelvin's start, an instant, counts as a millionth of its time.
        assert found[-1] == pytest.approx(expected, rel=1e-4)


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("ratio", 10.0 ** np.arange(-6, 7))
def test_creep_is_monotone_and_stable_for_any_step(name, ratio):
    step = ratio * TAU
    found = crept(LAWS[name], [1e6] * 30, step)
    assert (np.diff(found) >= -1e-12 * found[-1]).all()
    time = 29 * step
    delayed = (1 - np.exp(-time / TAU)) / 5e9
    exact = {"maxwell": 1e-10 + time / 1e15, "kelvin": delayed, "standard solid": 1e-10 + delayed}
    exact["burgers"] = exact["standard solid"] + time / 1e15
    assert found[-1] <= exact[name] * 1e6 * (1 + 1e-9) + 1e-6 * 2e-4
    if ratio <= 1e-2 or ratio >= 1e4:  # second order; limits in between
        assert found[-1] == pytest.approx(exact[name] * 1e6, rel=1e-3, abs=1e-9)


def test_burgers_relaxes_as_its_two_times_say():
    # 1e-4 of strain held: Pa after 1e4, 1e5, 1e6 s by inverse Laplace transform; one step is exact.
    expected = {1e4: 587904.03, 1e5: 205250.76, 1e6: 13166.324}
    law, strain = LAWS["burgers"], np.array([[0, 0, 1e-4]])
    for time, stress in expected.items():
        for steps in (1, 7):
            history = law.update(strain, start_of(law, "strain", 1), "strain", 0.0).history
            for _ in range(steps):
                answer = law.update(strain, history, "strain", time / steps)
                history = answer.history
            assert answer.stress[0, 2] == pytest.approx(stress, rel=1e-7)


def test_burgers_recovers_what_was_delayed():
    # The load is off after 1e5 s; 1.012369725e-4 is left after 3e5 s.
    step = 500.0
    loads = [1e6] * 201 + [0.0] * 400
    # A step that ends without load begins with it: the load falls over half a step's mean.
    assert crept(LAWS["burgers"], loads, step)[-1] == pytest.approx(1.012369725e-4, rel=5e-3)
    history, law, strain, time = start_of(LAWS["burgers"], "strain", 1), LAWS["burgers"], 0.0, 0.0
    for stress, length, count in ((1e6, 0.0, 1), (1e6, step, 200), (0.0, 0.0, 1), (0.0, step, 400)):
        for _ in range(count):
            answer = law.update(np.array([[0, 0, strain]]), history, "strain", length)
            strain += (stress - answer.stress[0, 2]) / answer.tangent[0, 2, 2]
            history = law.update(np.array([[0, 0, strain]]), history, "strain", length).history
            time += length
    assert time == 3e5
    assert strain == pytest.approx(1.012369725e-4, rel=1e-4)


def test_nothing_stresses_the_plane_of_plane_stress_across():
    random = np.random.default_rng(2)
    for law in LAWS.values():
        history = start_of(law, "stress", 50)
        for _ in range(3):
            answer = law.update(1e-3 * random.normal(size=(50, 3)), history, "stress", 2e4)
            history = answer.history
            assert np.abs(history["stress_zz"]).max() < 1e-12 * np.abs(answer.stress).max()


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: Maxwell(*ELASTIC, 0.0), "viscosity: 0.0"),
        (lambda: StandardSolid(*ELASTIC, -1.0, 1.0), "delayed_modulus: -1.0"),
        (lambda: Burgers(*ELASTIC, 1.0, 1.0, 0.0), "delayed_viscosity: 0.0"),
    ],
)
def test_constants_that_make_no_sense_are_refused(make, said):
    with pytest.raises(FormulationError, match=said):
        make()


@pytest.mark.parametrize("name", LAWS)
def test_a_material_of_no_block_is_asked_for_no_point(name):
    """As any law is whose material stands in the file and lies nowhere."""
    law = LAWS[name]
    history = {key: np.empty((0, len(value))) for key, value in law.variables("strain").items()}
    answer = law.update(np.empty((0, 3)), history, "strain", 1.0)
    assert answer.stress.shape == (0, 3)
    assert {key: value.shape for key, value in answer.history.items()} == {
        key: value.shape for key, value in history.items()
    }
