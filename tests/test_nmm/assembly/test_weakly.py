"""Methods handed on without their object."""

import pytest

from nmm.assembly.weakly import weakly


class Weight:
    def of(self, mass: float) -> float:
        return 9.81 * mass


def test_a_method_handed_on_does_what_it_did_while_its_object_is_there() -> None:
    weight = Weight()
    assert weakly(weight.of)(2.0) == 9.81 * 2.0


def test_a_method_that_outlives_its_object_says_what_to_keep() -> None:
    handed_on = weakly(Weight().of)
    with pytest.raises(ReferenceError, match="Weight.of is asked of an effect that is gone"):
        handed_on(2.0)
