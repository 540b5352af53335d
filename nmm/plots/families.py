"""Colours and markers that stand for one method in every figure that compares methods."""

from collections.abc import Sequence

DDA, MANIFOLD = "#1d4e89", "#c1121f"

SHADES = {
    "DDA": (DDA, "#4d9de0", "#0b7a75", "#6a4c93", "#2f3e63"),
    "elements": ("#222222", "#6e6e6e", "#a8a8a8"),
    "manifold": (MANIFOLD, "#e08e0b", "#7a1f3d", "#e4717a", "#8a5a2b", "#c77dba", "#9c8b00"),
}
"""Shades of each family, the first its own colour: blues for DDA, warm ones for the
manifold, greys for the finite elements of a yardstick."""


def colours(families: "list[str]") -> list[str]:
    """Return one colour for each entry, shades of its family in the order they come."""
    used = dict.fromkeys(SHADES, 0)
    found = []
    for family in families:
        shades = SHADES[family]
        found.append(shades[used[family] % len(shades)])
        used[family] += 1
    return found


METHODS = {
    "block 1": (DDA, "D"),
    "block 2": ("#4d9de0", "v"),
    "block 3": ("#0b7a75", "P"),
    "sub_blocks 1": ("#6a4c93", "X"),
    "triangles 0": ("#e4717a", "o"),
    "triangles 1": (MANIFOLD, "s"),
    "triangles 2": ("#7a1f3d", "^"),
    "quads 0": ("#e3b448", "o"),
    "quads 1": ("#e07b0b", "s"),
    "quads 2": ("#8a5a2b", "^"),
    "mls 0": ("#c77dba", "h"),
    "triangles 0 enriched": ("#b5a642", "<"),
    "triangles 1 enriched": ("#9c8b00", ">"),
    "skfem 1": ("#b0b0b0", "o"),
    "skfem 2": ("#7a7a7a", "s"),
    "skfem 3": ("#222222", "^"),
    "penalty": (DDA, "o"),
    "augmented": ("#4d9de0", "s"),
    "lagrange": ("#0b7a75", "^"),
    "cone": ("#6a4c93", "D"),
    "barrier": ("#00a5b5", "v"),
    "shi": (DDA, "o"),
    "newmark": ("#4d9de0", "s"),
    "generalized_alpha": ("#0b7a75", "^"),
}
"""Colour and marker of covers with their degree, of enforcements and of integrators; on meshes the
marker tells the degree that is spanned: circle 1, square 2, triangle 3."""

MARKERS = ("o", "s", "^", "D", "v", "P", "X", "<", ">", "h")


def styles(families: Sequence[str], methods: Sequence[str]) -> list[tuple[str, str]]:
    """Return colour and marker of each entry: those of its method, else a shade of its family."""
    shades = colours(list(families))
    found: list[tuple[str, str]] = []
    for number, method in enumerate(methods):
        own = METHODS.get(method)
        free = own is not None and own not in found
        fallback = (shades[number], MARKERS[number % len(MARKERS)])
        found.append(own if own is not None and free else fallback)
    return found
