"""The factor of safety, and what the summary of a run says of it."""

from dataclasses import dataclass, replace

from nmm.results.summary import Summary


@dataclass(frozen=True)
class Safety:
    """The factor of safety of a scene, bracketed.

    Attributes
    ----------
    holds, fails
        Largest factor with equilibrium and smallest without; None where there is none.
    shown
        Whether failing is shown to be the structure's and not the solver's.
    sentence
        What the run that fails says.
    runs
        How many factors were tried.
    bound
        Factor that no forces within strength allow (static theorem); None where none was found.
    """

    holds: float | None
    fails: float | None
    shown: bool
    sentence: str
    runs: int
    bound: float | None = None

    def told(self, summary: Summary) -> Summary:
        """Return the summary of the run at the factor that holds with what is known of others."""
        found = replace(summary, factor_of_safety=self.holds, factor_that_fails=self.fails)
        if self.holds is None:
            said = f"no factor of safety down to {self.fails:.6g}: {summary.sentence}"
            return replace(found, sentence=said)
        if self.fails is None:
            said = f"in equilibrium up to strength over {self.holds:.6g}, the highest factor tried"
            return replace(found, sentence=said)
        said = (
            f"factor of safety {self.holds:.6g}: in equilibrium with strength over it, not over "
            f"{self.fails:.6g} ({self.runs} runs): {self.sentence}"
        )
        if self.bound is not None and self.bound > self.fails:
            said += f"; the static theorem lets none be above {self.bound:.6g}"
        spoilt = summary.status == "converged" and not self.shown
        return replace(found, status="failed" if spoilt else summary.status, sentence=said)
