"""Fixed-point iteration on what interface laws remember, within a step.

Each solution uses a fixed history, and gives the history that it should have used. Under
softening of slope ``h`` against a structure of stiffness ``S`` the changes shrink by ``h / S`` an
iteration: they vanish as long as the structure is stable, and acceleration makes that quick.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from integration.arrays import Bools, Floats
from integration.contraction import some
from nmm.contact.laws.contact_laws import AT_ENDS, ContactLaws
from nmm.contact.laws.tension_compression import AsymmetricSprings
from nmm.contact.points.contact_points import ContactPoints
from nmm.contact.problem.coulomb import shear_bound
from nmm.contact.problem.step_problem import StepAnswer, StepProblem, Verdict
from nmm.frozen import MadeOnce, with_parts
from nmm.interfaces.base import InterfaceLaw
from nmm.interfaces.history import History
from nmm.interfaces.passage import Passage
from nmm.solvers.anderson import FixedPoint

MOST = 200
"""Solutions after which a step is given up."""
UNCHANGED, BY_ROUNDING = 1e-9, 1e-7
"""Relative change of an internal variable that counts as none; the second one where changes shrink
no more, because functions depend on one another and rounding is large."""
LASTING, SHRUNK = 50, 0.5
"""Changes shrink no more where so many solutions leave more than this share of the least before."""
AT_LIMIT = 1e-6
"""Shear forces within this share of their limit are at it: rounding of a solution."""


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
        if not self._laws.hold(self.start):
            return np.zeros(len(self.start), dtype=bool)
        whole = self.start.tied
        return self.start.bonded & ~whole & np.isfinite(self.before.limits.tension)

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
        following = np.split(self._iteration.next(point, target), ends[:-1])
        history = dict(now)
        for (name, at), values in zip(self._index.items(), following, strict=True):
            least = self.start.history[name][at] if columns[name].grows else -np.inf
            history[name] = now[name].copy()
            history[name][at] = np.clip(size[name] * values, least, columns[name].most)
        self.contacts = replace(self.contacts, history=history)
        self.response = self._laws.response(self.contacts, self.springs[0])

    def loss(self, answer: StepAnswer, sliding: Floats, static: bool) -> float:
        """Energy (J) that friction and softening took in the step.

        Bonds that soften took what their law says. Elsewhere the force of a step in time acts all
        through it. In statics loads grow within a step: what slides from its start does so against
        the mean of the limits at both ends, what slides later against that at the end. The work of
        dilation against pressure is not lost.
        """
        rubbed = np.abs(answer.shear_force * sliding)
        if self._laws.evolving:
            lifted = self.response.rise - self.before.rise
            rubbed += np.where(self.start.bonded, 0.0, answer.normal_force * lifted)
        if static:
            rubbed *= self._mean_share(answer)
        soft = self.softening
        if not some(soft):
            return float(rubbed.sum())
        taken = (area @ law.dissipated(way) for law, area, way in self._softened(answer))
        return float(rubbed[~soft].sum() + sum(taken))

    def beyond_means(self, answer: StepAnswer) -> float:
        """Energy (J) that softening took in the step beyond what mean forces of both ends say."""
        if not some(self.softening):
            return 0.0
        beyond = (
            area @ (law.dissipated(way) - law.dissipated_by_means(way))
            for law, area, way in self._softened(answer)
        )
        return float(sum(beyond))

    def _softened(self, answer: StepAnswer) -> Iterator[tuple[InterfaceLaw, Floats, Passage]]:
        """Yield each law with the areas of its bonds that soften, and what these went through."""
        soft = self.softening
        ended = {name: getattr(answer, name)[soft] for name in AT_ENDS}
        after = replace(self.contacts.take(soft), **ended)
        return self._laws.passages(self.start.take(soft), after)

    def _mean_share(self, answer: StepAnswer) -> Floats:
        """Mean shear force (m,) of a step of statics over that at its end, where contacts slide."""
        start, end = self.start, np.abs(answer.shear_force)
        bound = shear_bound(start.normal_force, start.normal_force != 0, self.before.limits)
        from_start = np.abs(start.shear_force) >= (1 - AT_LIMIT) * bound
        mean = (bound + end) / 2
        return np.divide(mean, end, out=np.ones_like(end), where=from_start & (end > 0))


def slid_under_load(problem: StepProblem, answer: StepAnswer, softening: Bools) -> Floats:
    """Inelastic slip (m,) of the contacts under load; zero where no force acts.

    Of a ``softening`` (m,) bond all slip counts: one that is exhausted in the step slid while it
    held, and would otherwise be whole again.
    """
    loaded = softening | (answer.normal_force != 0) | (answer.shear_force != 0)
    return np.where(loaded, problem.slips(answer.increment) - answer.slip, 0.0)
