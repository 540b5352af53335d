"""Fixed-point iteration on what interface laws remember, within a step.

Each solution uses a fixed history, and gives the history that it should have used. Under
softening of slope ``h`` against a structure of stiffness ``S`` the changes shrink by ``h / S`` an
iteration: they vanish as long as the structure is stable, and acceleration makes that quick. Where
``h > S`` they grow, and the bond gives way, to an answer at which the structure is stable again.
"""

from dataclasses import replace

import numpy as np

from integration.arrays import Bools, Floats
from nmm.contact.laws.contact_laws import ContactLaws
from nmm.contact.laws.losses import ContactLosses, softening
from nmm.contact.laws.tension_compression import AsymmetricSprings
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.problem.step_problem import StepAnswer, StepProblem, Verdict
from nmm.frozen import MadeOnce, with_parts
from nmm.interfaces.history import History
from nmm.solvers.anderson import FixedPoint

MOST = 200
"""Solutions after which a step is given up."""
UNCHANGED, BY_ROUNDING = 1e-9, 1e-7
"""Relative change of an internal variable that counts as none; the second one where changes shrink
no more, because functions depend on one another and rounding is large."""
LASTING, SHRUNK = 50, 0.5
"""Changes shrink no more where so many solutions leave more than this share of the least before."""
RETURNED = 4
"""Returns to the start of the step after which bonds are taken to give way by themselves."""


class HistoryIteration:
    """History of the contacts of one step, solution by solution.

    Attributes
    ----------
    start, contacts
        The contacts at the start of the step, and with the history of this solution.
    springs
        Normal and shear stiffness (m,) of whole bonds (N/m), and which are a law's own.
    before, response
        Response of the laws under the history at the start, and under that of this solution.
    done
        Whether the last answer agrees with the history it was found with.
    """

    def __init__(self, laws: ContactLaws, start: ContactPoints) -> None:
        self._laws = laws
        self.start = self.contacts = start
        self.springs = laws.springs(start)
        self.before = self.response = laws.response(start, self.springs[0])
        self.done = False
        self._changes: list[float] = []
        self._returned = 0
        self._iteration = FixedPoint()
        self._index = {
            name: np.flatnonzero(
                laws.remembering(name)[start.interface]
                & ~(column.grows & (start.history[name] >= column.most))
            )
            for name, column in laws.evolving.items()
        }

    @MadeOnce
    def softening(self) -> Bools:
        """Which contacts are bonds that lose their strength in the course of solutions."""
        return softening(self._laws, self.start, self.before.limits)

    @property
    def asymmetric(self) -> AsymmetricSprings | None:
        """Bonds that are softer open than pressed; None without any."""
        if not self._laws.hold(self.start):
            return None
        share = self.before.open_share
        index = np.flatnonzero(self.start.bonded & (share < 1 - 1e-9))
        return AsymmetricSprings(index, share[index]) if len(index) else None

    def settled(self, answer: StepAnswer, sliding: Floats) -> Verdict | None:
        """Register a solution; return a verdict where the iteration has failed."""
        image = self._laws.evolved(self.start, answer.gap, sliding, self.springs[0])
        change, size = self._change(answer, image)
        self._changes.append(change)
        stays = self._stays
        self.done = change <= (BY_ROUNDING if stays else UNCHANGED)
        if self.done:
            self.contacts = with_parts(self.contacts, history=image)
            return None
        if stays or len(self._changes) == MOST:
            sentence = (
                f"what interface laws remember still changed by {change:.1e} after "
                f"{len(self._changes)} solutions of the step; shorten the step or the load "
                "increment"
            )
            return Verdict(False, "passes", sentence)
        self._follow(image, size)
        return None

    @property
    def _stays(self) -> bool:
        """Whether the last solutions made no progress."""
        last, before = self._changes[-LASTING:], self._changes[:-LASTING]
        return bool(before) and min(last) > SHRUNK * min(before)

    def _change(self, answer: StepAnswer, image: History) -> tuple[float, dict[str, float]]:
        """Largest relative change of an internal variable, and the sizes that it is relative to."""
        now, size, change = self.contacts.history, dict[str, float](), 0.0
        for name, column in self._laws.evolving.items():
            lengths = (answer.gap, image[name])
            largest = max(float(np.abs(one).max(initial=0.0)) for one in lengths)
            size[name] = (largest or 1.0) if column.metres else 1.0
            at = self._index[name]
            off = np.abs(image[name][at] - now[name][at]).max(initial=0.0) / size[name]
            change = max(change, float(off))
        return change, size

    def _follow(self, image: History, size: dict[str, float]) -> None:
        """Choose the history of the next solution."""
        columns, now = self._laws.evolving, self.contacts.history
        point, target = (
            np.concatenate([one[name][at] / size[name] for name, at in self._index.items()])
            for one in (now, image)
        )
        ends = np.cumsum([len(at) for at in self._index.values()])
        chosen = self._iteration.next(point, target)
        if self._gives_way(chosen, target, size):
            self._iteration, chosen = FixedPoint(), target
        following = np.split(chosen, ends[:-1])
        history = dict(now)
        for (name, at), values in zip(self._index.items(), following, strict=True):
            history[name] = now[name].copy()
            most = columns[name].most
            history[name][at] = np.clip(size[name] * values, self._least[name], most)
        self.contacts = replace(self.contacts, history=history)
        self.response = self._laws.response(self.contacts, self.springs[0])

    @MadeOnce
    def _least(self) -> dict[str, Floats]:
        """Return the least values of internal variables: of those that grow, at the start."""
        return {
            name: self.start.history[name][at]
            if self._laws.evolving[name].grows
            else np.full(len(at), -np.inf)
            for name, at in self._index.items()
        }

    def _gives_way(self, chosen: Floats, target: Floats, size: dict[str, float]) -> bool:
        """Whether the answer that acceleration aims at lies before the start of the step.

        A bond that loses its force faster than the structure unloads has changes that grow, and an
        answer only behind it, at less than it has lost: it gives way as far as its own changes
        lead, to where they shrink again or all of it is lost.
        """
        least = np.concatenate([self._least[name] / size[name] for name in self._index])
        behind = (chosen < least) & (target > least + UNCHANGED)
        self._returned += bool(behind.any())
        return self._returned > RETURNED and bool(behind.any())

    def losses(self, answer: StepAnswer, sliding: Floats) -> ContactLosses:
        """Return what contacts went through in the step."""
        responses = self.before, self.response
        return ContactLosses(
            self._laws, self.start, self.contacts, responses, self.softening, answer, sliding
        )


def slid_under_load(
    problem: StepProblem, answer: StepAnswer, softening: Bools, before: Floats
) -> Floats:
    """Inelastic slip (m,) of the contacts under load; zero where no force acts.

    Of a ``softening`` (m,) bond all slip counts: one that is exhausted in the step slid while it
    held, and would otherwise be whole again. What slid ``before`` (m,) in a step that is corrected
    was counted then.
    """
    loaded = softening | (answer.normal_force != 0) | (answer.shear_force != 0)
    return np.where(loaded, problem.slips(answer.increment) - answer.slip - before, 0.0)
