"""The page of the manual that shows the hard matrix: every class, every part, every miss."""

import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from nmm.verification.hard.running.registry import HARD
from nmm.verification.hard.running.running import Finding

HEAD = """# Hard cases

Generated scenes over every cover, enforcement, integrator, glue, support method and solver that
the registries hold, with oracles that need no answer. Made by `nmm verify --hard {how}`; a small
share runs in `make test`, more in `make verify`. What misses is listed with its figures, and
nothing is left out: what misses here is not to be relied on.

- `nmm verify --hard --list` names the classes; `nmm verify --hard CLASS --first 100 --seeds 20`
  runs others, `--part NAME` those with a part, `--slow` the larger ones too.
- `--out FOLDER` takes the scene of each case that misses, and the smallest one found that still
  does; `--out NAME.md` takes this page; `--out NAME.jsonl` adds a record of each case, and
  `nmm verify --hard *.jsonl --out NAME.md` makes this page of records that were made in pieces.
- A part that joins a registry joins the matrix. A class is one module and one line in
  `nmm.verification.hard.running.registry`.

A case passes when every quantity is within its tolerance. *Refused* ones end in an error in words
before they run, which is right where a part cannot do what is asked; *crashed* ones end in a
traceback. `scenes` and `keys` hold runs to what they claim: those whose solver *gave up* (`failed`)
pass, which may be wrong; their share is to be looked at. Energy is kinetic, strain, contact and
support energy less the work of loads, in the turnover (the largest of them); overlap is the part of
the smaller body that lies in another, by shapely.
"""


def write_page(findings: Sequence[Finding], path: Path, how: str) -> Path:
    """Write the page; ``how`` are the arguments that made the findings."""
    tables = (_classes(findings), listed(findings), _parts(findings), _misses(findings))
    parts = [HEAD.format(how=how), *filter(None, tables)]
    path.write_text("\n".join(parts))
    return path


def _classes(findings: Sequence[Finding]) -> str:
    lines = ["## Classes", ""]
    lines.append("| class | what | oracle | cases | passed | gave up | refused | crashed |")
    lines.append("|---|---|---|---|---|---|---|---|")
    for name, found in _by(findings, lambda one: [one.group]).items():
        kind = HARD.load(name)
        lines.append(f"| `{name}` | {kind.title} | {kind.oracle} | {_counts(found)} |")
    lines += [f"| all | | | {_counts(findings)} |", ""]
    return "\n".join(lines)


def _counts(found: Sequence[Finding]) -> str:
    passed = sum(one.passed for one in found)
    gave_up = sum(bool(one.gave_up) for one in found)
    refused = sum(bool(one.fault) and not one.crashed for one in found)
    crashed = sum(one.crashed for one in found)
    return f"{len(found)} | {passed} | {gave_up} | {refused} | {crashed}"


def listed(findings: Sequence[Finding]) -> str:
    """Return the cases of classes that are shown one by one, with every figure."""
    lines: list[str] = []
    shown = [one for one in findings if HARD.load(one.group).listed]
    for group, found in _by(shown, lambda one: [one.group]).items():
        names = list(dict.fromkeys(name for one in found for name in one.checks))
        lines += [f"## Every case of `{group}`", "", "| case | " + " | ".join(names) + " |"]
        lines += ["|---" * (len(names) + 1) + "|"]
        for one in found:
            cells = [_cell(one, name) for name in names]
            lines.append(f"| {_short(one.case.label)} | " + " | ".join(cells) + " |")
        lines.append("")
    return "\n".join(lines)


def _cell(finding: Finding, name: str) -> str:
    """Return what was computed, bold where it misses; a statement as yes or no."""
    check = finding.checks.get(name)
    if check is None:
        return _short(finding.fault)
    statement = check.reference == 1.0 and check.computed in (0.0, 1.0)
    shown = ("no", "yes")[int(check.computed)] if statement else f"{check.computed:.1e}"
    return shown if check.passed else f"**{shown}**"


def _parts(findings: Sequence[Finding]) -> str:
    """Return one table a kind of part: passed of all, by class."""
    lines = ["## Parts", "", "Passed of all, by class."]
    kinds = sorted({kind for one in findings for kind in one.case.parts})
    for kind in kinds:
        having = [one for one in findings if kind in one.case.parts]
        names = list(dict.fromkeys(one.case.parts[kind] for one in having))
        groups = list(dict.fromkeys(one.group for one in having))
        lines += ["", f"| {kind} | " + " | ".join(groups) + " |", "|---" * (len(groups) + 1) + "|"]
        for name in names:
            row = [
                [one for one in having if one.case.parts[kind] == name and one.group == group]
                for group in groups
            ]
            cells = (f"{sum(one.passed for one in c)}/{len(c)}" if c else "" for c in row)
            lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return "\n".join([*lines, ""])


def _misses(findings: Sequence[Finding]) -> str:
    """Return a table of what misses: by class and quantity, how often, the worst and where."""
    lines = ["## What misses", ""]
    if all(one.passed for one in findings):
        return "\n".join([*lines, "Nothing.", ""])
    lines += [
        "| class | quantity | cases | worst | allowed | worst case |",
        "|---|---|---|---|---|---|",
    ]
    for group, found in _by(findings, lambda one: [one.group]).items():
        for name, missing in _by(found, lambda one: one.missed).items():
            worst = max(missing, key=lambda one: _excess(one.checks[name].error))
            check = worst.checks[name]
            told = f"{check.shown}, right {check.wanted}"
            if name == "converged":
                told = f"does not end: {_short(check.reason)}"
            allowed = f"{check.tolerance:.0e}" if check.tolerance else ""
            where = _short(worst.case.label)
            lines.append(f"| `{group}` | {name} | {len(missing)} | {told} | {allowed} | {where} |")
        for fault, same in _by(found, lambda one: [_short(one.fault)] if one.fault else []).items():
            word = "crashed" if same[0].crashed else "refused"
            where = _short(same[0].case.label)
            lines.append(f"| `{group}` | {word} | {len(same)} | {fault} | | {where} |")
    return "\n".join([*lines, ""])


def _by(
    findings: Iterable[Finding], keys: Callable[[Finding], list[str]]
) -> dict[str, list[Finding]]:
    made: dict[str, list[Finding]] = defaultdict(list)
    for one in findings:
        for key in keys(one):
            made[key].append(one)
    return made


def _excess(error: float) -> float:
    return error if error == error else float("inf")


def _short(words: str) -> str:
    """One line without the line of a generated file, nor what would end a cell of a table."""
    return re.sub(r"^hard case:\d+: ", "", " ".join(words.split())).replace("|", "/")[:110]
