"""Tables in Markdown from the records of pytest-benchmark: a table a group, ratios to its first.

python benchmarks/page.py build/benchmarks.json
"""

import json
import sys
from pathlib import Path
from typing import Any

PAGE = """# Measured in one run

{machine}, Python {python}, commit {commit}. Processor seconds of one thread, the least of the
rounds; *ratio* is to the first row of a table.

{tables}"""


def page(records: dict[str, Any]) -> str:
    """Return the whole page."""
    machine = records["machine_info"]
    rows = records["benchmarks"]
    names = dict.fromkeys(row["group"] for row in rows)
    tables = [table(name, [row for row in rows if row["group"] == name]) for name in names]
    return PAGE.format(
        machine=machine["machine"],
        python=machine["python_version"],
        commit=records["commit_info"].get("id", "unknown")[:7],
        tables="\n\n".join(tables),
    )


def table(name: str, rows: list[dict[str, Any]]) -> str:
    """Return one group: what each row says of itself, its seconds and its ratio."""
    columns = [*rows[0]["extra_info"], "s", "ratio"]
    lines = [f"## {name}", "", f"| {' | '.join(columns)} |", "|" + "---|" * len(columns)]
    first = rows[0]["stats"]["min"]
    for row in rows:
        seconds = row["stats"]["min"]
        values = [*row["extra_info"].values(), seconds, seconds / first]
        lines.append(f"| {' | '.join(map(_text, values))} |")
    return "\n".join(lines)


def _text(value: Any) -> str:
    if value is None:
        return ""
    return f"{value:.3g}" if isinstance(value, float) else str(value)


if __name__ == "__main__":
    print(page(json.loads(Path(sys.argv[1]).read_text())))
