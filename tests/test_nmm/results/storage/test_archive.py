import io
import zipfile

import numpy as np
import pytest

from nmm.capacity import limited
from nmm.errors import DamageError
from nmm.results.frame import Frame
from nmm.results.storage import files
from nmm.results.storage.archive import from_file, to_bytes

BLOCKS, VERTICES, CONTACTS = 200, 5, 1000


@pytest.fixture
def pile():
    """A frame of numbers without order but for what repeats: lengths, states, normals of edges."""
    rng = np.random.default_rng(3)
    points = rng.normal(size=(BLOCKS * VERTICES, 2))
    angle = rng.uniform(0, 2 * np.pi, CONTACTS // 2).repeat(2)
    normal = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return Frame(
        3, 0.3, 1.0, "dynamic", points, 1e-3 * points, rng.normal(size=points.shape),
        rng.normal(size=(BLOCKS, 3)), rng.normal(size=(CONTACTS, 2)), normal, np.ones(CONTACTS),
        rng.normal(size=(CONTACTS, 2)), rng.normal(size=CONTACTS), rng.integers(0, 4, CONTACTS),
    )  # fmt: skip


def same(one, other):
    return all(np.array_equal(getattr(one, name), getattr(other, name)) for name in vars(one))


def test_a_packed_frame_reads_back_to_the_last_bit(tmp_path, pile):
    files.write_frame(tmp_path / "frame.npz", pile)
    assert same(files.read_frame(tmp_path / "frame.npz"), pile)


def test_a_frame_of_an_earlier_version_that_is_not_packed_is_read(tmp_path, pile):
    arrays = {name: value for name, value in vars(pile).items() if name != "fields"}
    files.write_arrays(tmp_path / "frame.npz", arrays)
    assert same(files.read_frame(tmp_path / "frame.npz"), pile)


def test_what_repeats_takes_no_room_in_a_frame(tmp_path, pile):
    """Lengths and states vanish, equal normals are kept once: 72 bytes a contact become 48."""
    files.write_frame(tmp_path / "frame.npz", pile)
    whole = 8 * (6 * BLOCKS * VERTICES + 3 * BLOCKS + 9 * CONTACTS)
    size = (tmp_path / "frame.npz").stat().st_size
    assert size < whole - 20 * CONTACTS


def test_numpy_reads_packed_arrays_too():
    given = {"a": np.arange(5.0), "b": np.array("text")}
    with np.load(io.BytesIO(to_bytes(given, packed=True))) as found:
        assert np.array_equal(found["a"], given["a"])
        assert found["b"] == "text"


def test_what_would_unfold_to_more_than_memory_is_refused(tmp_path):
    path = tmp_path / "frame.npz"
    path.write_bytes(to_bytes({"a": np.zeros(200_000)}, packed=True))
    assert path.stat().st_size < 10_000
    with limited(1e6), pytest.raises(DamageError, match="unfolds to 1600128 bytes, more than"):
        files.read_arrays(path)


def test_no_more_is_unfolded_than_the_table_of_contents_says(tmp_path):
    """A member of a megabyte that claims to be of 300 bytes is read no further, and told."""
    path, true, claimed = tmp_path / "frame.npz", (1_000_128).to_bytes(4, "little"), 300
    content = to_bytes({"a": np.zeros(125_000)}, packed=True)
    assert content.count(true) == 2  # before the member and in the table
    path.write_bytes(content.replace(true, claimed.to_bytes(4, "little")))
    with pytest.raises(DamageError, match="damaged"):
        files.read_arrays(path)


def test_another_packing_is_refused(tmp_path):
    with zipfile.ZipFile(tmp_path / "frame.npz", "w", zipfile.ZIP_BZIP2) as archive:
        archive.writestr("a.npy", b"")
    with pytest.raises(ValueError, match="packed in a way that none knows"):
        from_file(tmp_path / "frame.npz")
