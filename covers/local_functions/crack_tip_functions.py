"""Crack-tip functions: the two displacement fields with stresses of order 1/sqrt(r)."""

from covers.local_functions.singular_functions import SingularFunctions


def crack_tip_functions(kappa: float, length: float) -> SingularFunctions:
    """Return the vector fields of opening and sliding at a straight crack (Williams 1957).

    The bisector points ahead of the crack. Two unknowns for each cover take the place of the eight
    of four scalar branch functions times two components.
    """
    return SingularFunctions((0.5, 0.5), (1 / 3, -1.0), (True, False), kappa, length)
