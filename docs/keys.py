"""Write the pages of the keys of scene and formulation files from the models that read them.

``python docs/keys.py`` writes ``docs/scene.md`` and ``docs/formulation.md`` anew; a test compares.
"""

import inspect
import json
import math
import re
from collections.abc import Iterator
from dataclasses import MISSING, fields, is_dataclass
from pathlib import Path
from typing import Any, get_args

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from nmm.formulation import Formulation
from nmm.registry import Registry
from nmm.scene import Scene

HERE = Path(__file__).parent

SCENE = """# Scene files

A scene says what happens. It is a TOML file; `nmm new NAME` writes a commented one, and
`nmm check` tells every fault by line. Numbers are SI, angles radians; a text with a unit, such as
`"27.5 GPa"` or `"30 deg"`, is converted. An effect whose table is not there does not act. A place
is a point, a segment or a block; the name of a tessellation, or of a block that joints cut, means
all its pieces, `beam.12` one of them, and "all" all blocks.

An edge load acts on the boundary along its segment, a point load at its point, a body load on the
whole block, or on all. `history` holds pairs of time and factor; in statics `[loading]` scales
loads and supports with a displacement, and their time is the load factor, while that of heat and
water that are stored is in s. Interfaces act by `between`, a pair of materials or "any".
"""
FORMULATION = """# Formulation files

A formulation says how a scene is approximated. It is a file of its own, named by
`nmm run SCENE --formulation FILE`, or the table `[formulation]` of a scene, where the tables below
are `[formulation.cover]` and so on; a file replaces all of it. Nothing in it must be given.
"""
PARTS = """## Options of built-in parts

`options` of `[contact]`, `[integrator]` and `[solver]` are those of the part that is named.
Options of covers and sub-blocks stand on the pages [Manifold covers](covers.md) and
[Joints](joints.md).

| part | named | options, with their defaults |
|---|---|---|"""


def page(head: str, model: type[BaseModel], left_out: frozenset[str] = frozenset()) -> str:
    """Return the page of a model: its own keys, then a section for each table."""
    return "\n".join([head.strip(), *_rows(model), *_sections(model, left_out)]) + "\n"


def _sections(model: type[BaseModel], left_out: frozenset[str] = frozenset()) -> Iterator[str]:
    for key, info in _tables(model):
        inner, name = _model(info.annotation), _table(info)
        if inner is None or key in left_out:
            continue
        yield f"\n## {name}\n"
        yield inspect.cleandoc(inner.__doc__ or "")
        yield from _rows(inner)
        yield from _sections(inner)


def _rows(model: type[BaseModel]) -> Iterator[str]:
    """Yield the table of the keys that are no tables themselves."""
    tables = {key for key, _ in _tables(model)}
    plain = {name: one for name, one in model.model_fields.items() if name not in tables}
    if not plain:
        return
    plain |= {"options": plain.pop("options")} if "options" in plain else {}
    yield "\n| key | value | default | for example |"
    yield "|---|---|---|---|"
    for name, info in plain.items():
        yield f"| `{name}` | {info.description} | {_default(info)} | {_example(info)} |"


def _tables(model: type[BaseModel]) -> list[tuple[str, FieldInfo]]:
    return [(k, one) for k, one in model.model_fields.items() if _model(one.annotation)]


def _table(info: FieldInfo) -> str:
    found = re.search(r"\[+[\w.]+\]+", info.description or "")
    assert found is not None, info
    return found[0]


def _model(annotation: Any) -> type[BaseModel] | None:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    return next((found for item in get_args(annotation) if (found := _model(item))), None)


def _default(info: FieldInfo) -> str:
    if info.is_required():
        return "must be given"
    if info.default in (None, (), {}, ""):
        return ""
    return f"`{json.dumps(info.default)}`"


def _example(info: FieldInfo) -> str:
    return f"`{json.dumps(info.examples[0])}`" if info.examples else ""


def parts() -> str:
    """Return the table of the options of enforcements, integrators and solvers."""
    from nmm.contact.enforcement.base import ENFORCEMENTS
    from nmm.integrators.base import INTEGRATORS
    from nmm.solvers.linear import SOLVERS

    rows = [PARTS]
    kinds: list[tuple[str, Registry[Any]]] = [
        ("[contact] enforcement", ENFORCEMENTS),
        ("[integrator] type", INTEGRATORS),
        ("[solver] type", SOLVERS),
    ]
    for place, registry in kinds:
        for name in registry.table:
            options = [
                f"`{one.name}`" + ("" if one.default is None else f" {json.dumps(one.default)}")
                for one in fields(registry.load(name))
                if one.init and one.name != "kinetic_factor" and one.default is not MISSING
            ]
            rows.append(f"| `{place}` | `{name}` | {', '.join(options)} |")
    return "\n".join(rows) + "\n"


STEERING = """
## Options of iterations

Numbers that steer how enforcements search; they change what a step costs and whether its answer is
found, not what is accepted. They are tables within the options of an enforcement,

```toml
[contact.options.iterations.interior]
boundary = 0.99
```

and say what they do in `nmm/contact/iteration/options`.

| table | options, with their defaults |
|---|---|"""


def steering() -> str:
    """Return the table of the options of iterations."""
    from nmm.contact.iteration.options import IterationOptions

    rows = [STEERING]
    for table in fields(IterationOptions):
        values = vars(getattr(IterationOptions(), table.name))
        said = [f"`{name}` {_value(value)}" for name, value in values.items()]
        rows.append(f"| `[contact.options.iterations.{table.name}]` | {', '.join(said)} |")
    return "\n".join(rows) + "\n"


def _value(value: object) -> str:
    if not is_dataclass(value):
        return json.dumps(value)
    inner = (f"{name} = {json.dumps(one)}" for name, one in vars(value).items() if one != math.inf)
    return "{ " + ", ".join(inner) + " }"


def pages() -> dict[str, str]:
    """Return the pages by file name."""
    return {
        "scene.md": page(SCENE, Scene, frozenset({"formulation"})),
        "formulation.md": page(FORMULATION, Formulation) + "\n" + parts() + steering(),
    }


if __name__ == "__main__":
    for name, text in pages().items():
        (HERE / name).write_text(text, encoding="utf-8")
        print(HERE / name)
