"""The mark of a run folder: the version of its layout, and what its texts add up to."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field

from nmm.errors import StorageError

FORMAT = 2
"""Version of the layout that this version writes, and the latest that it reads: since the second
frames are packed."""

KIND = "nmm run"


@dataclass(frozen=True)
class RunMark:
    """What `run.json` holds.

    Attributes
    ----------
    kind
        "nmm run".
    format
        Version of the layout of the folder.
    sha256
        Of each text beside it as it was written, hexadecimal.
    """

    kind: str = KIND
    format: int = FORMAT
    sha256: Mapping[str, str] = field(default_factory=dict)

    @classmethod
    def of(cls, texts: Mapping[str, str]) -> "RunMark":
        """Return the mark of a folder with these texts, by the names of their files."""
        return cls(sha256={name: _sum(text) for name, text in texts.items()})

    def differs(self, name: str, text: str) -> bool:
        """Return whether a text is another one than was written."""
        return self.sha256.get(name, _sum(text)) != _sum(text)

    def to_json(self) -> str:
        """Return the mark as JSON text."""
        return json.dumps(asdict(self), indent=2) + "\n"

    @classmethod
    def from_json(cls, text: str) -> "RunMark":
        """Read a mark back.

        Raises
        ------
        StorageError
            When the text is no mark. Of a later version all but the version is left out.
        """
        try:
            found = json.loads(text)
        except (ValueError, RecursionError):
            found = None
        if not isinstance(found, dict) or found.get("kind") != KIND:
            raise StorageError(f"run.json: damaged: expected the mark of a run ({KIND!r})")
        version, sums = found.get("format"), found.get("sha256", {})
        if not isinstance(version, int) or isinstance(version, bool) or version < 1:
            raise StorageError(f"run.json: format {version!r}: expected a whole number from 1")
        if version > FORMAT or not isinstance(sums, dict):
            return cls(format=version)
        return cls(format=version, sha256={str(name): str(value) for name, value in sums.items()})


def _sum(text: str) -> str:
    return hashlib.sha256(text.encode()).hexdigest()
