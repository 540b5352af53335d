"""The cost model of this machine as a file in the user's cache."""

import json
import os
from dataclasses import asdict
from pathlib import Path
from typing import Any

from nmm.study.cost.cost_model import Coefficients, CostModel

FILE = "cost_model.json"


def save_model(model: CostModel, folder: Path | None = None) -> Path:
    """Write the model where `load_model` finds it."""
    path = (folder or _cache_folder()) / FILE
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(asdict(model), indent=2) + "\n", encoding="utf-8")
    return path


def load_model(folder: Path | None = None) -> CostModel | None:
    """Return the model of this machine; None when it was never fitted."""
    try:
        return _read((folder or _cache_folder()).joinpath(FILE).read_text(encoding="utf-8"))
    except (OSError, ValueError, TypeError, KeyError):
        return None


def _read(text: str) -> CostModel:
    values: dict[str, Any] = json.loads(text)
    values["coefficients"] = {
        kind: Coefficients(**{name: tuple(many) for name, many in of.items()})
        for kind, of in values["coefficients"].items()
    }
    return CostModel(**values)


def _cache_folder() -> Path:
    base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base) / "nmm"
