"""How the update of a child's front joins the front of its parent: by runs of rows."""

from integration.arrays import Floats, Ints
from nmm.compiled import compiled, place


@compiled
def runs(rows: Ints, local: Ints, c: int, start: Ints, shift: Ints) -> tuple[Ints, Ints]:
    """Runs of rows that stay neighbours in a front, none across its pivot block's end.

    Their starts, ended by the number of rows, and shifts: row ``i`` of one goes to ``i + shift``.
    ``start`` and ``shift`` are room for them.
    """
    count = 0
    for i in range(len(rows)):
        at = local[rows[i]]
        if i == 0 or at == c or at - i != shift[count - 1]:
            start[count], shift[count] = i, at - i
            count += 1
    start[count] = len(rows)
    return start[: count + 1], shift[:count]


@compiled
def collect_lower(
    panel: Floats, update: Floats, child: Floats, c: int, r: int, start: Ints, shift: Ints
) -> None:
    """Add the lower triangle of a child's update to panel and update of a front."""
    size = start[-1]
    for q in range(len(shift)):
        rows, moves = start[q:], shift[q:]
        for j in range(start[q], start[q + 1]):
            column = j + shift[q]
            if column < c:
                _add(panel, column * (c + r), child[j * size :], j, rows, moves)
            else:
                _add(update, (column - c) * r - c, child[j * size :], j, rows, moves)


@compiled
def collect_whole(
    panel: Floats,
    beside: Floats,
    update: Floats,
    child: Floats,
    c: int,
    r: int,
    start: Ints,
    shift: Ints,
) -> None:
    """Add a child's update to a front, what stands right of its pivots ``beside``."""
    inner, size = 0, start[-1]
    while inner < len(shift) and start[inner] + shift[inner] < c:
        inner += 1
    for q in range(inner):
        for j in range(start[q], start[q + 1]):
            _add(panel, (j + shift[q]) * (c + r), child[j * size :], start[0], start, shift)
    rows, moves = start[inner:], shift[inner:]
    for q in range(inner, len(shift)):
        for j in range(start[q], start[q + 1]):
            column = j + shift[q] - c
            _add(update, column * r - c, child[j * size :], start[inner], rows, moves)
            for p in range(inner):
                for i in range(start[p], start[p + 1]):
                    beside[place((i + shift[p]) * r + column)] += child[place(j * size + i)]


@compiled
def _add(into: Floats, base: int, column: Floats, begin: int, rows: Ints, moves: Ints) -> None:
    """Add a column from row ``begin`` on; a row of it that is not moved goes to ``base`` and on.

    ``begin`` is in the first of the runs that start at ``rows``, and move by ``moves``.
    """
    for p in range(len(moves)):
        a, b, off = max(begin, rows[p]), rows[p + 1], base + moves[p]
        given, taken = column[a:b], into[a + off : b + off]
        for i in range(len(given)):  # slices: plain enough for vector instructions
            taken[i] += given[i]
