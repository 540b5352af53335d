"""The manifold of a cut mathematical cover."""

from collections.abc import Sequence

import numpy as np

from covers.approximation.dependence import dependent_functions
from covers.approximation.grouping import Grouping
from covers.approximation.manifold import Manifold
from covers.approximation.rigid_modes import LinearMotions
from covers.approximation.singular.carriers import Carriers
from covers.approximation.singular.enrichment import Enrichment
from covers.cutting.cut_cells import CutCells
from covers.local_functions.polynomials import Kinds, LocalFunctions
from covers.mathematical.base import Cover
from integration.arrays import Floats


def mesh_manifold(
    cover: Cover,
    cut: CutCells,
    functions: LocalFunctions | Kinds,
    enrichments: Sequence[Enrichment] = (),
) -> Manifold:
    """Return the manifold of a cut mathematical cover.

    Uncut cells of regular meshes are congruent and share their integrals. Elements and covers that
    are cut get coordinates fitted to the part that is left (`covers.approximation.whitening`), so
    that the conditioning does not depend on the cut.

    Parameters
    ----------
    cover, cut
        The mathematical cover, and the result of `covers.cutting.cut`.
    functions
        Local functions of all physical covers, or `Kinds` of each.
    enrichments
        Singular points, whose functions the covers about them carry too.
    """
    kinds = functions if isinstance(functions, Kinds) else _uniform(functions, cut.n_covers)
    grouping = Grouping.of(cover, cut, kinds, tuple(enrichments))
    n_unknowns = int(grouping.offset[-1])
    body_area, body_centroid = _bodies(cut)
    # Where all covers contain rigid motions, each represents them itself, as lumped mass needs.
    degrees = [item.degree for item in kinds.functions]
    lowest = min(degrees)
    by_nodes = cover.precision >= 1 and lowest == 0
    nodes = cover.patch_centre[cut.cover_patch] if by_nodes else None
    modes = (kinds, grouping.covers, n_unknowns, body_centroid, nodes)
    groups = tuple(grouping.groups())
    dependent = dependent_functions(
        cover, cut, kinds.functions, kinds.which, lambda: (groups, n_unknowns)
    )
    higher = kinds.each(lambda item: item.degree > 0)
    return Manifold(
        elements=cut.elements,
        element_body=cut.element_body,
        element_region=cut.element_region,
        groups=groups,
        cover_offset=grouping.offset,
        cover_patch=cut.cover_patch,
        cover_body=cut.cover_body,
        boundary=cut.boundary,
        motions=LinearMotions(*modes),
        body_centroid=body_centroid,
        body_area=body_area,
        dependent=dependent,
        dependent_covers=int(higher.sum()) if dependent else 0,
        reproduction=cover.precision + lowest,
        richest=cover.precision + max(degrees),
        fitted=int(grouping.fitted.sum()),
        mended=cover.mended,
        enriched=int((grouping.carriers.counts > 0).sum()),
        singular=_carried(enrichments, grouping.carriers),
    )


def _carried(enrichments: Sequence[Enrichment], found: Carriers) -> Floats:
    """Singular points (n, 2) whose functions covers carry."""
    places = np.array([item.point for item in enrichments]).reshape(-1, 2)
    return np.asarray(places[found.carried])


def _uniform(functions: LocalFunctions, n: int) -> Kinds:
    return Kinds((functions,), np.zeros(n, dtype=np.int64))


def _bodies(cut: CutCells) -> tuple[Floats, Floats]:
    area, centroid = cut.elements.areas, cut.elements.centroids
    total = np.bincount(cut.element_body, area, minlength=cut.n_bodies)
    first = [np.bincount(cut.element_body, area * c, minlength=cut.n_bodies) for c in centroid.T]
    return np.asarray(total), np.asarray(np.stack(first, axis=1) / total[:, None])
