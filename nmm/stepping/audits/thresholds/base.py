"""When an audit speaks."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Threshold:
    """When an audit speaks.

    Attributes
    ----------
    what
        The number that is measured.
    warns
        Beyond this there is a warning.
    fails
        Beyond this a run that was solved counts as "unbalanced"; None where an audit only warns.
    where
        Runs that are audited.
    """

    what: str
    warns: float
    fails: float | None
    where: str
