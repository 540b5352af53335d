"""Write the tables of ``docs/audits.md`` anew from the code: ``python docs/audit_page.py``."""

import re
from pathlib import Path

from nmm.stepping.audits.table import markdown
from nmm.stepping.drive.verdict import EXIT_CODES, MEANT

PAGE = Path(__file__).parent / "audits.md"


def ends() -> str:
    """Return the table of the ends of runs."""
    rows = [f"| `{code}` | {EXIT_CODES[code]} | {text} |" for code, text in MEANT.items()]
    return "\n".join(["| status | exit code | meaning |", "|---|---|---|", *rows])


def renewed(text: str) -> str:
    """Return the page with its tables as the code has them."""
    for name, table in (("ends", ends()), ("audits", markdown())):
        marks = rf"(<!-- {name} -->\n).*?(<!-- /{name} -->)"
        text = re.sub(marks, lambda found, t=table: f"{found[1]}{t}\n{found[2]}", text, flags=re.S)
    return text


if __name__ == "__main__":
    PAGE.write_text(renewed(PAGE.read_text()))
