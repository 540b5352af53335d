"""Arrays by name as the bytes of an .npz, packed or not, and back.

Packed means deflated without loss, as `numpy.load` reads it too: coordinates, velocities and forces
keep most of their bytes, while lengths and states of contacts, which repeat, nearly vanish. Laid
side by side by weight before (shuffled) bytes pack no better.
"""

import io
import zipfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from nmm.capacity import limit
from nmm.plain_file import plain

KINDS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
"""How arrays may be stored."""


def to_bytes(arrays: Mapping[str, npt.ArrayLike], packed: bool) -> bytes:
    """Return an .npz of the arrays; the same arrays give the same bytes."""
    buffer = io.BytesIO()
    kind = KINDS[packed]
    with zipfile.ZipFile(buffer, "w", kind) as archive:
        for name, array in arrays.items():
            content = io.BytesIO()
            np.lib.format.write_array(content, np.asanyarray(array), allow_pickle=False)
            member = zipfile.ZipInfo(f"{name}.npy")  # of one time, whenever it is written
            archive.writestr(member, content.getvalue(), kind)
    return buffer.getvalue()


def from_file(path: Path) -> dict[str, npt.NDArray[Any]]:
    """Read the arrays of an .npz; no objects, and nothing that does not fit into memory.

    Raises
    ------
    ValueError
        When it is packed in another way, or unfolds to more than a run may take. Members never
        unfold to more than their table of contents says.
    """
    with zipfile.ZipFile(plain(path)) as archive:
        members = archive.infolist()
        if any(member.compress_type not in KINDS for member in members):
            raise ValueError("an array in it is packed in a way that none knows")
        if (size := sum(member.file_size for member in members)) > limit():
            raise ValueError(f"it unfolds to {size} bytes, more than there is memory")
        return {
            member.filename.removesuffix(".npy"): np.lib.format.read_array(
                io.BytesIO(archive.read(member)), allow_pickle=False
            )
            for member in members
        }
