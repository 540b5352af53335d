"""What in a scene calls for an effect."""

import re

from nmm.model.called_for import CALLS
from nmm.model.effects_table import EFFECTS, GLUE
from nmm.scene.model import Scene
from nmm.scene.tables.bars import BarTable


def test_every_effect_but_glue_is_called_for_by_a_table_of_scenes():
    assert set(CALLS) == set(EFFECTS.table) - {GLUE}
    tables = set(Scene.model_fields)
    for name, call in CALLS.items():
        first, *rest = re.findall(r"\[+([a-z_]+)\.?([a-zA-Z_]*)\]+", call.key)
        assert first[0] in tables, name
        assert all(table in tables for table, _ in rest), name
    assert "dowel" in BarTable.model_fields
