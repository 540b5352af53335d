"""Evaluation of expressions of x, y and t in floating-point numbers."""

import ast
from typing import Any

import numpy as np

from integration.arrays import Floats
from nmm.scene.tables.loading.expressions import CONSTANTS, FUNCTIONS, Expression

_NUMPY = {
    **{name: getattr(np, name) for name in FUNCTIONS if hasattr(np, name)},
    **{"asin": np.arcsin, "acos": np.arccos, "atan": np.arctan, "atan2": np.arctan2},
    **{"min": np.minimum, "max": np.maximum},
}
_BINARY: dict[type[ast.operator], Any] = {
    **{ast.Add: np.add, ast.Sub: np.subtract, ast.Mult: np.multiply},
    **{ast.Div: np.divide, ast.Pow: np.power},
}
_COMPARED: dict[type[ast.cmpop], Any] = {
    **{ast.Lt: np.less, ast.LtE: np.less_equal, ast.Gt: np.greater, ast.GtE: np.greater_equal},
}


def evaluated(expression: Expression, points: Floats, time: float) -> Floats:
    """Return the values (m,) at points (m, 2) (m) and a time (s); they may be infinite or nan."""
    known = {"x": points[:, 0], "y": points[:, 1], "t": np.float64(time), **CONSTANTS}
    with np.errstate(all="ignore"):
        return np.broadcast_to(_value(expression.tree, known), len(points)).astype(float)


def _value(node: ast.expr, known: dict[str, Any]) -> Any:
    """Value of a syntax tree, which was checked when it was read."""
    match node:
        case ast.Constant(value=int() | float() as number):
            return np.float64(number)
        case ast.Name():
            return known[node.id]
        case ast.UnaryOp():
            inner = _value(node.operand, known)
            return -inner if isinstance(node.op, ast.USub) else inner
        case ast.BinOp():
            sides = _value(node.left, known), _value(node.right, known)
            return _BINARY[type(node.op)](*sides)
        case ast.Compare():
            sides = _value(node.left, known), _value(node.comparators[0], known)
            return _COMPARED[type(node.ops[0])](*sides).astype(float)
        case ast.Call(func=ast.Name(id=name)):
            return _NUMPY[name](*(_value(one, known) for one in node.args))
    raise TypeError(ast.unparse(node))
