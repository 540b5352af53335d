"""Effects with one fault each are told, by the property that they break."""

import re

import numpy as np
import pytest
from scipy.sparse import csc_array

import nmm
from nmm.effects.base import Instant, StepForce
from nmm.effects.gravity import Gravity
from nmm.quantity import Quantity
from nmm.stepping.prepare import prepare
from nmm.testing import check_effect, check_effect_of
from nmm.testing.outputs import TWO_BLOCKS


class Idle(Gravity):
    """Weight whose work is twice its force times its way."""

    def work(self, before, after):
        return 2 * super().work(before, after)


class Lever(Gravity):
    """A spring to the ground with a matrix that is not the change of its force."""

    share = 1.0

    def force(self, state, end):
        return -1e3 * state.deformation

    def energy(self, state):
        return 1e3 * float(state.deformation @ state.deformation) / 2

    def work(self, before, after):
        return 0.0

    def matrix(self, state):
        return csc_array(self.share * 1e3 * np.eye(len(state.deformation)))


class Softer(Lever):
    share = 0.99


class Asymmetric(Lever):
    def matrix(self, state):
        return csc_array(super().matrix(state) + 10 * np.eye(len(state.deformation), k=1))


class Meddling(Lever):
    def energy(self, state):
        found = super().energy(state)
        state.deformation[0] += 1e-3
        return found


class Misplaced(Lever):
    def outputs(self, state):
        return {"load": Quantity("elements", np.zeros(7), "N")}


class Forgetful(Lever):
    """Stiffness that a checkpoint does not bring back."""

    def force(self, state, end):
        return self.share * super().force(state, end) + (1 - self.share)

    def carried(self):
        return {}

    def carry(self, carried):
        self.share = 0.5


class Cable(Lever):
    """A spring that pulls alone, slack or not as it was laid."""

    limited = True
    pays = 1.0

    def force(self, state, end):
        return -1e3 * np.maximum(state.deformation, 0.0)

    def energy(self, state):
        return self.pays * 5e2 * float(np.sum(np.maximum(state.deformation, 0.0) ** 2))


class Wasteful(Cable):
    """A cable that hides what it takes."""

    pays = 0.98


class Stiffening(Lever):
    """A spring of force ``k (u + u^3 / w^2)``, ``w`` half of the longest motion of the check."""

    way = 1e-4
    stores = 0.25

    def force(self, state, end):
        return -1e3 * state.deformation * (1 + (state.deformation / self.way) ** 2)

    def energy(self, state):
        u = state.deformation
        return 1e3 * float(np.sum(u**2 / 2 + self.stores * u**4 / self.way**2))

    def matrix(self, state):
        bent = 1 + 3 * (state.deformation / self.way) ** 2
        return csc_array(np.diag(1e3 * bent))

    def step_force(self, before, after, span):
        ends = (1 - span.weight, before), (span.weight, after)
        force = sum(share * self.force(one, Instant.of(one)) for share, one in ends)
        return StepForce(force, lambda: self.tangent * span.weight * self.matrix(after))

    tangent = 1.0


class Hasty(Stiffening):
    """One whose tangent through a step is a hundredth too stiff."""

    tangent = 1.01


class Misjudged(Stiffening):
    """One that stores a hundredth less where it bends."""

    stores = 0.2475


class Sponge(Lever):
    """A force that follows the motion the more, the longer the step; its matrix knows no step."""

    steady = False

    def force(self, state, end):
        return super().force(state, end) * (1 + (end.time - state.time))


EFFECTS = {
    "differs after carry(carried())": Forgetful,
    "work less the gain of energy": Idle,
    "and the loss, over the force": Wasteful,
    "over the force times the way: off": Misjudged,
    "change of the force with the motion": Softer,
    "motion against the matrix": Sponge,
    "through a step of": Hasty,
    "off from symmetric": Asymmetric,
    "7 rows, expected 2 on elements": Misplaced,
}


def built(kind):
    made = prepare(nmm.parse_scene(TWO_BLOCKS), nmm.Formulation())
    model = made.stepper.model
    return kind(model, np.array([0.0, -9.81])), model, made.start


@pytest.mark.parametrize("right", [Lever, Cable, Stiffening])
def test_a_right_spring_is_not_told(right):
    check_effect(*built(right))


@pytest.mark.parametrize("words", EFFECTS)
def test_a_wrong_effect_is_told(words):
    with pytest.raises(AssertionError, match=re.escape(words)):
        check_effect(*built(EFFECTS[words]))


def test_an_effect_that_changes_what_it_is_given_is_told():
    with pytest.raises(AssertionError, match=re.escape("a hook changed the deformation")):
        check_effect(*built(Meddling))


def test_an_effect_that_is_right_on_blocks_alone_is_told(tmp_path):
    (tmp_path / "local_rows.py").write_text(
        "import numpy as np\n"
        "from scipy.sparse import csc_array\n"
        "from nmm.assembly.places import at_point\n"
        "from nmm.effects.base import Effect\n"
        "class Local(Effect):\n"
        "    def __init__(self, rows):\n"
        "        self.rows = rows\n"
        "    @classmethod\n"
        "    def from_setup(cls, setup):\n"
        "        place = at_point(setup.model.manifold, np.array([0.5, 0.5]))\n"
        "        return cls(place.points.rows.values[:, 1])\n"
        "    def force(self, state, end):\n"
        "        return self.rows.sum(axis=0)\n"
        "    def work(self, before, after):\n"
        "        return float(self.force(after, None) @ (after.deformation - before.deformation))\n"
    )
    one = TWO_BLOCKS.partition('[[blocks]]\nname = "top"')[0]
    text = one + '[[supports]]\nname = "hold"\nblock = "floor"\nfix = ["x", "y"]\n'
    text += '[effects.local]\ntype = "local_rows:Local"\n'
    (tmp_path / "scene.toml").write_text(text)
    with pytest.raises(AssertionError, match=re.escape("force of shape")):
        check_effect_of(nmm.read_scene(tmp_path / "scene.toml"), "local", allow_code=["local_rows"])
