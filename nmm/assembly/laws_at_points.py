"""Laws at material points: what they answer to strain, and what they remember."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from integration.arrays import Bools, Floats, Ints
from nmm.errors import FormulationError
from nmm.materials.base import History, Law, Response

STRESS = "stress"
"""Stress (Q, 3) of the last accepted step, in body axes (Pa), beyond the initial stress."""
INITIAL = "initial_strain"
"""Elastic strain (Q, 3) of the initial stress; absent where there is none."""

SWELLING = "swelling"
"""Strain (Q, 1) alike in all three directions that is free of stress; absent where nothing heats.
That of the end of a step, which laws are asked for."""

SIZE = "cell_size"
"""Of the cell of a point (m), for laws that ask for it: no variable, it does not change."""


@dataclass(frozen=True)
class LawsAtPoints:
    """Laws that are not linear, and the points at which each is asked.

    Attributes
    ----------
    laws
        Laws that are not linear.
    law
        (Q,) the law of each point.
    elastic
        (Q, 3, 3) elastic stress from strain (Pa).
    plane
        "stress" or "strain".
    size
        (Q,) of the cells that points lie in (m); None where no law asks for it.
    """

    laws: tuple[Law, ...]
    law: Ints
    elastic: Floats
    plane: str
    size: Floats | None

    @property
    def softens(self) -> bool:
        """Whether a law softens in bands of a cell's width (crack band model)."""
        return any(law.sized for law in self.laws)

    def start(self) -> dict[str, Floats]:
        """Return the initial internal variables, (Q, h) by name.

        A law whose variable is narrower than another's of the same name uses its first columns.
        """
        found = {STRESS: np.zeros((len(self.law), 3))}
        for number, law in enumerate(self.laws):  # a handful of laws
            for name, value in law.variables(self.plane).items():
                if name in (STRESS, INITIAL, SWELLING):
                    raise FormulationError(
                        f'law {type(law).__name__}: variable "{name}": expected another name than '
                        f'"{STRESS}", "{INITIAL}" and "{SWELLING}", which the program keeps '
                        "itself: rename it"
                    )
                if np.ndim(value) != 1:
                    raise FormulationError(
                        f'law {type(law).__name__}: variable "{name}": shape {np.shape(value)}: '
                        "expected an array (h,), also of one number: np.array([value])"
                    )
                known = found.get(name, np.zeros((len(self.law), 0)))
                more = max(len(value) - known.shape[1], 0)
                found[name] = np.pad(known, ((0, 0), (0, more)))
                found[name][self.law == number, : len(value)] = value
        return found

    def prestressed(self, history: History, stress: Floats, across: Floats) -> dict[str, Floats]:
        """Return the history with an initial stress (Q, 3) of the points.

        Where a stress ``across`` (Q,) is given, what laws remember makes it; nan is none. Matter in
        which time passes remembers the stress as if it had come on in an instant.
        """
        strain = np.asarray(np.linalg.solve(self.elastic, stress[:, :, None]), dtype=float)[:, :, 0]
        found = {**history, INITIAL: strain}
        for number, law in enumerate(self.laws):  # a handful of laws
            own = self.law == number
            if "stress_zz" in law.variables(self.plane):
                elastic = stress[own] @ law.across_share(self.plane)
                found["stress_zz"] = found["stress_zz"].copy()
                found["stress_zz"][own, 0] = elastic
            at = np.flatnonzero(own & ~np.isnan(across))
            for name, value in law.under(strain[at], stress[at], across[at]).items():
                found[name] = found[name].copy()
                found[name][at, : value.shape[1]] = value
        return found if all(law.rests for law in self.laws) else self._loaded(found)

    def _loaded(self, history: dict[str, Floats]) -> dict[str, Floats]:
        """Return the history after the initial strain, of laws whose points do not rest."""
        for law, at in self._points:
            if law.rests:
                continue
            own = self._own(law, history, at)
            after = law.update(history[INITIAL][at], own, self.plane, 0.0).history
            for name, value in after.items():
                history[name] = history[name].copy()
                history[name][at, : value.shape[1]] = value
        return history

    @property
    def symmetric(self) -> bool:
        """Whether all tangents are."""
        return all(law.symmetric for law in self.laws)

    def response(self, strain: Floats, history: History, step: float) -> Response:
        """Return the response of all points to strain (Q, 3) at the end of a step (s).

        The stress is that beyond the initial stress, and part of the new history.
        """
        initial = history.get(INITIAL)
        whole = strain if initial is None else strain + initial
        answers = [
            law.update(whole[at], self._own(law, history, at), self.plane, step)
            for law, at in self._points
        ]
        stress, tangent, after = self._together(answers, history)
        if initial is not None:
            stress, after[INITIAL] = stress - self._initial(initial), initial
        after[STRESS] = stress
        return Response(stress, tangent, after)

    def _together(
        self, answers: Sequence[Response], history: History
    ) -> tuple[Floats, Floats, dict[str, Floats]]:
        """Return stress, tangents and variables of all points; ``history`` is that before."""
        if len(answers) == 1:
            stress, tangent, left = answers[0]
            after = {name: np.ascontiguousarray(value) for name, value in left.items()}
            return np.array(stress, dtype=float), np.asarray(tangent), {**history, **after}
        n = len(self.law)
        stress, tangent = np.empty((n, 3)), np.empty((n, 3, 3))
        # All but the stress, which is given anew.
        after = {name: history[name].copy() for name in history if name not in (INITIAL, STRESS)}
        for (_, at), (stress[at], tangent[at], left) in zip(self._points, answers, strict=True):
            for name, value in left.items():
                after[name][at, : value.shape[1]] = value
        return stress, tangent, after

    def at_rest(self, history: History) -> Response | None:
        """Return the response to a step without strain; None where laws must be evaluated."""
        if not all(law.rests for law in self.laws):
            return None
        return Response(history[STRESS], self.elastic, history)

    def at_once(self, strain: Floats, history: History, among: Bools) -> Floats:
        """Return the stress (Q, 3) at a strain (Q, 3) without time, of the points ``among`` (Q,).

        nan elsewhere, and of laws that a step without strain leaves as they are.
        """
        found = np.full(strain.shape, np.nan)
        for law, at in self._points:
            here = np.arange(len(strain))[at]
            here = here[among[here]]
            if len(here) and not law.rests:
                own = self._own(law, history, here)
                found[here] = law.update(strain[here], own, self.plane, 0.0).stress
        return found

    def energy_density(self, history: History) -> Floats:
        """Return what points store (Q,) in J/m3, all that of their initial stress with it."""
        whole = self.whole(history)
        density = np.zeros(len(whole))
        for law, at in self._points:
            density[at] = law.energy(whole[at], self._own(law, history, at), self.plane)
        return density

    def across(self, history: History) -> Floats:
        """Return the stress across the plane (Q,) of points, initial and thermal ones too (Pa)."""
        whole, found = self.whole(history), np.empty(len(self.law))
        for law, at in self._points:
            found[at] = law.stress_across(whole[at], self._own(law, history, at), self.plane)
        return found

    def whole(self, history: History) -> Floats:
        """Return the stress (Q, 3) of points, the initial one with it (Pa)."""
        if INITIAL not in history:
            return history[STRESS]
        return np.asarray(history[STRESS] + self._initial(history[INITIAL]))

    def pressing(self, history: History) -> Floats:
        """Return the sum (Q,) of the normal stresses, that across too (Pa)."""
        whole = self.whole(history)
        across = history.get("stress_zz", np.zeros((len(whole), 1)))
        return np.asarray(whole[:, 0] + whole[:, 1] + across[:, 0])

    def size_share(self, history: History) -> Floats:
        """Return `Law.size_share` (Q,) of points under what presses on them now."""
        found = np.zeros(len(self.law))
        for law, at in self._points:
            if law.sized and self.size is not None:
                found[at] = law.size_share(self.size[at], -self.pressing(history)[at] / 3)
        return found

    @cached_property
    def _points(self) -> list[tuple[Law, Ints | slice]]:
        """The laws and their points: of one law all of them, which copies nothing."""
        if len(self.laws) == 1:
            return [(self.laws[0], slice(None))]
        return [(law, np.flatnonzero(self.law == k)) for k, law in enumerate(self.laws)]

    def _own(self, law: Law, history: History, at: Ints | slice) -> dict[str, Floats]:
        """Return a copy of the variables of a law at its points."""
        widths = law.variables(self.plane)
        own = {name: np.array(history[name][at, : len(value)]) for name, value in widths.items()}
        if law.sized and self.size is not None:
            own[SIZE] = self.size[at, None]
        if law.swells and SWELLING in history:
            own[SWELLING] = history[SWELLING][at]
        return own

    def _initial(self, strain: Floats) -> Floats:
        return np.asarray(np.einsum("qij,qj->qi", self.elastic, strain))
