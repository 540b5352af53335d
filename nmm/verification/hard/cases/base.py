"""What a class of hard cases is: generated scenes, each with an oracle that needs no answer."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar

from nmm.verification.base import Checks

Document = dict[str, Any]
"""A scene with its formulation as the tables of its file."""

Judge = Callable[[Document], Checks]


@dataclass(frozen=True)
class HardCase:
    """One generated scene and what must hold of it.

    Attributes
    ----------
    label
        What tells it from the others of its class; the same case has the same label on any day.
    scene
        Tables of the scene file, its formulation among them.
    judge
        Runs a scene of this kind and checks it; a reduced scene is judged by it as well.
    parts
        The parts it is run with, by kind ("enforcement", "integrator", "cover", ...).
    slow
        Whether it takes more than a second or two.
    """

    label: str
    scene: Document
    judge: Judge
    parts: Mapping[str, str] = field(default_factory=dict)
    slow: bool = False


class HardClass(ABC):
    """Base of the classes of hard cases.

    Attributes
    ----------
    name
        Its name in `nmm verify --hard NAME`.
    title
        What is hard about it, in words.
    oracle
        What is checked, in words.
    share
        Seeds it takes for each that is asked for: more where cases are cheap.
    listed
        Whether the page shows it case by case.
    """

    name: ClassVar[str]
    title: ClassVar[str]
    oracle: ClassVar[str]
    share: ClassVar[int] = 1
    listed: ClassVar[bool] = False

    @abstractmethod
    def cases(self, seed: int) -> Iterator[HardCase]:
        """Yield the cases of one seed, over every part to which they apply."""
