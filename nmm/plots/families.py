"""Colours that stand for DDA and the manifold method in every figure that compares them."""

DDA, MANIFOLD = "#1d4e89", "#c1121f"

SHADES = {
    "DDA": (DDA, "#4d9de0", "#0b7a75", "#6a4c93", "#2f3e63"),
    "manifold": (MANIFOLD, "#e08e0b", "#7a1f3d", "#e4717a", "#8a5a2b", "#c77dba", "#9c8b00"),
}
"""Shades of each family, the first its own colour: blues for DDA, warm ones for the manifold."""


def colours(families: "list[str]") -> list[str]:
    """Return one colour for each entry, shades of its family in the order they come."""
    used = dict.fromkeys(SHADES, 0)
    found = []
    for family in families:
        shades = SHADES[family]
        found.append(shades[used[family] % len(shades)])
        used[family] += 1
    return found
