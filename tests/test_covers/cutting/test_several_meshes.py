"""Bodies with nets of their own: the joined cut is what the cuts are, body by body."""

import sys
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np
import pytest

from covers.approximation.mesh_manifold import mesh_manifold
from covers.cutting.cut import cut
from covers.cutting.several_meshes import joined_cover, joined_cut
from covers.local_functions.polynomials import Monomials
from covers.mathematical.base import Cover
from covers.mathematical.quads import Quads
from covers.mathematical.triangles import Triangles
from integration.polygons import Polygons
from nmm.errors import FormulationError
from nmm.formulation import parse_formulation
from nmm.scene import parse_scene
from nmm.stepping.prepare import prepare
from nmm.trust import allowing
from nmm.verification import text

ME = Path(__file__).stem

BLOCKS = Polygons.from_vertices(
    [text.rectangle((x, y), (x + 1, y + 1)) for x, y in ((0, 0), (1, 0), (0, 1), (1, 1))]
)
MEMBERS = [np.array([1, 2]), np.array([0, 3])]


def joined(kind, degree=1):
    nets = [
        kind.regular([[0, 0], [2, 2]], 0.4, angle=0.2),
        kind.regular([[0, 0], [2, 2]], 0.27, shift=(0.3, 0.1)),
    ]
    cuts = [cut(net, BLOCKS.take(own)) for net, own in zip(nets, MEMBERS, strict=True)]
    cover, pieces = joined_cover(nets), joined_cut(nets, cuts, MEMBERS)
    return nets, cuts, pieces, mesh_manifold(cover, pieces, Monomials(degree))


@pytest.mark.parametrize("kind", [Triangles, Quads])
def test_every_block_is_one_body_in_its_place_with_the_elements_of_its_own_net(kind):
    _, cuts, pieces, manifold = joined(kind)
    assert manifold.body_area == pytest.approx([1] * 4, rel=1e-14)
    assert manifold.body_centroid == pytest.approx(
        np.array([(0.5, 0.5), (1.5, 0.5), (0.5, 1.5), (1.5, 1.5)]), rel=1e-14
    )
    assert np.array_equal(pieces.element_body, pieces.element_region)
    for own, part in zip(MEMBERS, cuts, strict=True):
        for local, body in enumerate(own):
            count = (part.element_body == local).sum()
            assert (pieces.element_body == body).sum() == count


@pytest.mark.parametrize("kind", [Triangles, Quads])
@pytest.mark.parametrize("degree", [0, 1, 2])
def test_each_body_has_the_fields_of_its_own_net(kind, degree):
    nets, cuts, _, manifold = joined(kind, degree)
    first = 0
    for net, part in zip(nets, cuts, strict=True):
        alone = mesh_manifold(net, part, Monomials(degree))
        count = np.arange(len(part.elements))
        where = part.elements.centroids
        there, here = manifold.rows(first + count, where), alone.rows(count, where)
        # The same functions in the same order, but for the number of the first unknown.
        width = here.values.shape[2]
        assert there.values[:, :, :width] == pytest.approx(here.values, abs=1e-12)
        assert np.ptp((there.unknowns[:, :width] - here.unknowns)[here.values.any(axis=1)]) == 0
        first += len(count)
    assert manifold.n_unknowns == sum(
        mesh_manifold(net, part, Monomials(degree)).n_unknowns
        for net, part in zip(nets, cuts, strict=True)
    )


def test_edges_follow_each_other_around_each_body():
    _, _, _, manifold = joined(Triangles)
    edges = manifold.boundary
    assert edges.end == pytest.approx(edges.start[edges.next], abs=1e-14)
    assert np.array_equal(edges.next[edges.previous], np.arange(len(edges)))
    around = np.bincount(edges.body, np.hypot(*(edges.end - edges.start).T))
    assert around == pytest.approx([4] * 4, rel=1e-14)


def test_nets_of_different_kinds_are_refused():
    box = [[0, 0], [2, 2]]
    with pytest.raises(ValueError, match="one kind expected"):
        joined_cover([Triangles.regular(box, 0.4), Quads.regular(box, 0.4)])


SCENE = text.scene(
    'plane = "stress"\n',
    [
        text.material("rock"),
        text.box("low", (0, 0), (1, 1)),
        text.box("top", (0, 1), (1, 1)),
        text.fixed_block("low"),
        text.fixed_block("top"),
    ],
)


def elements(cover):
    ready = prepare(parse_scene(SCENE), parse_formulation(f"[cover]\nsize = 0.5\n{cover}"))
    return np.bincount(ready.stepper.model.manifold.element_body)


def test_a_formulation_gives_a_block_a_finer_net():
    common = elements('type = "quads"\n')
    found = elements('type = "quads"\n[[cover.nets]]\nblock = "top"\nsize = 0.1\n')
    assert common == pytest.approx([4, 4])
    assert found == pytest.approx([4, 100])


@dataclass(frozen=True, eq=False)
class Hats(Cover):
    """Hat functions over triangles, which tell of no polynomials."""

    precision = 1

    @classmethod
    def regular(cls, bounds, size, *, angle=0.0, shift=(0.0, 0.0)):
        """Lay the cells and patches of `Triangles`."""
        laid = Triangles.regular(bounds, size, angle=angle, shift=shift)
        return cls(**{item.name: getattr(laid, item.name) for item in fields(Cover)})

    def evaluate(self, cells, points):
        """Return shares of areas, and the slopes of these."""
        corner = self.vertices[self.cell_vertices[cells]]
        slopes = np.linalg.inv(np.concatenate([np.ones((len(cells), 3, 1)), corner], axis=2))
        weights = np.einsum("mi,mij->mj", np.column_stack([np.ones(len(points)), points]), slopes)
        return weights, np.swapaxes(slopes[:, 1:], 1, 2)


class Settling(Hats):
    """The same, whose patches depend on the material."""

    def settled(self, cut, again):
        """Return what there is."""
        return self, cut


@pytest.fixture(name="allowed")
def _allowed(monkeypatch):
    monkeypatch.setitem(sys.modules, ME, sys.modules[__name__])
    with allowing(ME):
        yield


def test_blocks_have_nets_of_ones_own_cover(allowed):
    net = '[[cover.nets]]\nblock = "top"\nsize = 0.1\n'
    found = elements(f'type = "{ME}:Hats"\n{net}')
    assert np.array_equal(found, elements(f'type = "triangles"\n{net}'))


def test_blocks_have_no_nets_of_ones_own_cover_that_depends_on_the_material(allowed):
    with pytest.raises(FormulationError, match="triangles or quads expected"):
        elements(f'type = "{ME}:Settling"\n[[cover.nets]]\nblock = "top"\n')


@pytest.mark.parametrize(
    ("cover", "words"),
    [
        ('type = "quads"\n[[cover.nets]]\nblock = "tip"\n', "no block of this name"),
        ('type = "block"\n[[cover.nets]]\nblock = "top"\n', "its own cover"),
        ('type = "mls"\n[[cover.nets]]\nblock = "top"\n', "triangles or quads expected"),
    ],
)
def test_nets_that_cannot_be_are_refused(cover, words):
    with pytest.raises(FormulationError, match=words):
        elements(cover)
