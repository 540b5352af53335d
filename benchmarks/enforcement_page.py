"""The page docs/enforcements.md from the records of enforcement.py, steps.py and settling_pile.py.

python benchmarks/enforcement_page.py
"""

import json
from pathlib import Path

import enforcement
import step_rows
from enforcement_summary import aims, choice, crowd, origins, short
from kinds import KINDS, USUAL
from records import RECORDS, read
from step_rows import StepRow

TEXT = """# Which enforcement of contact

Five enforcements solve one step of contact; all find Coulomb's cone without dilatancy. `penalty`
lets bodies press into one another by force over stiffness, here 1, 10 or 100 times Young's modulus
(E); `augmented`, `lagrange` and `cone` leave no gap within a tolerance; `barrier` keeps a distance.
*Open-close* is Shi's iteration on the same springs as `penalty` (`[contact.options]
iteration = "open_close"`).

## In short

{short}

{load}

## Which to choose

*Cost*: processor seconds of a whole step over those of the default, at the largest number of blocks
where both converged. *Converges to*: the largest number of blocks up to which every step did, and
how the next size ended. *Penetration* of blocks of half a metre, and *force error*: the worst on
walls and piles of [the contact solution alone](#the-contact-solution-alone).

{choice}

{advice}

## Whole steps beside the aims

Seconds of a whole step over the aim: 1 and less is met, **bold** is missed; where not every step
converged, the table says so. An aim is met by any enforcement that converges.

{aims}

## Whole steps

Search, assembly, contact, update and output of a run of 1 s with steps of 1 ms, its first steps
from rest under gravity (friction 0.6); the first {warm} are left out. *ms a step*: processor
milliseconds of one thread; in brackets where not every step converged, and then for a step's
length of motion. *Grows as*: since the next smaller size, at one state of the code. Phases are
parts of the wall-clock time. Steps beyond the budget of a row are left out, and it says so.

### Wall

Bricks in running bond on a held base, laid without gaps.

{wall}

### Pile

Voronoi cells of 1 m2 in a box open above, as deep as wide, that touch along whole edges.

{pile}

### Growth by phase

Exponents of processor seconds over blocks.

{phases}

### Before the first step

Processor seconds from a scene in memory to the first step, and its two parts by the clock:
geometry and covers (tessellation and checks of a pile among them), and effects (joints and sides
of contact).

{prepare}

## The contact solution alone

*Slope*: a block slides on 30 degrees where friction holds 20. *Supports*: a beam on two flat
supports, eight forces for six unknowns. *Wall*: bricks in running bond. *Pile*: Voronoi cells in a
box. Blocks of six unknowns start to fall under gravity and a lateral acceleration that grows by
0.05 m/s2 a step of 1 ms. *Force error*: of the resultants of contact on the blocks, relative,
against the same law solved to 1e-12 (springs) or 1e-10 (exact). *Gap error*: the deepest
penetration over the compliance of its contact times the largest force. Processor milliseconds of
one thread, medians over the steps after the first.

{alone}

## A pile that comes to rest

Loose cells fall together in a box (`benchmarks/settling_pile.py`). *Energy*: its largest rise,
over the work of the weight. *Motion*: kinetic energy left, over its largest.

{settling}

## How it was measured

```
python benchmarks/enforcement.py --page --budget SECONDS   # contact alone
python benchmarks/steps.py --page --budget SECONDS         # whole steps
python benchmarks/settling_pile.py --records docs/enforcements/settling_pile.jsonl ...
python benchmarks/enforcement_page.py                      # this page from the records, no more
```

Each row goes to [enforcement.jsonl](enforcements/enforcement.jsonl) or
[steps.jsonl](enforcements/steps.jsonl) as soon as it is measured, with its date, commit, load of
the machine, budget and seconds; `--blocks`, `--scenes` and `--enforcement` choose rows, `--resume`
passes over those that are there. On a machine with other work read ratios.

- Contact alone: {alone_origin}
- Whole steps: {steps_origin}
"""

ADVICE = """**Of the classical three, none is best everywhere.**

- **Penalty** is the most robust, and at 10 E the default. Springs share the load where contacts
  outnumber unknowns, and a pass costs a solve with a kept factor. Poor where gaps matter: it leaves
  penetrations of force over stiffness, and stiffer springs cost more passes. Shi's open-close
  iteration on the same springs factorises in every pass. With soft springs it settles on walls; on
  piles and with stiffer springs it cycles, which the verdict reports, and shorter steps do not help
  where blocks only touch.
- **Augmented Lagrangian** removes the penetration by rounds of multipliers. Poor where many
  contacts share few unknowns, as in walls: an error of forces that hardly stretches any contact
  dies slowly, so springs must grow from round to round, and a round then takes many factors.
- **Lagrange multipliers** are exact in a pass or two where contacts are fewer than unknowns. Poor
  on walls and piles: a brick has more contacts than unknowns, the matrix of the active set is
  singular, and the interior point of `cone` takes over after it was tried in vain. The sentence of
  the step says so.
- **Cone** takes an interior point that starts afresh in every step and needs 12 to 35
  factorisations on walls and piles, whatever the contacts do; a step that is solved again because
  its rows have turned takes none to six on walls. It is not the default: it costs five to thirty
  times the penalty's seconds. Friction can turn the way to a solution back on itself; it then
  starts from elsewhere, and with steep friction may not arrive, which the verdict says
  ([Limits](limits.md)).
- **Barrier** is smooth, and no gap passes its wall, half a width behind touching. Newton's method
  on unknowns and forces together takes a factorisation a step, few while a step is like the last;
  else an interior point finds most states first. Its errors are those of its width."""


ORDER = {name: at for at, name in enumerate((*enforcement.SCENES, *KINDS))}
"""Of scenes and of enforcements on the page."""


def write(records: Path) -> None:
    """Write the page from the records there are."""
    records.with_suffix(".md").write_text(page(records))


def page(records: Path) -> str:
    """Text of the page."""
    rows, steps = read(records / "enforcement.jsonl", enforcement.Row), step_rows_of(records)
    rows = sorted(_known(rows), key=lambda r: (r.size, ORDER[r.scene], ORDER[r.enforcement]))
    return TEXT.format(
        advice=ADVICE,
        choice=choice(rows, steps),
        aims=aims(steps),
        short=short(rows, steps),
        load=crowd([*rows, *steps]),
        warm=max((row.left_out for row in steps), default=0),
        wall=_scene(steps, "wall"),
        pile=_scene(steps, "pile"),
        phases=step_rows.phase_growth(steps, USUAL),
        prepare=step_rows.preparation(steps),
        alone=_with(enforcement.table(rows), enforcement.sentences(rows)),
        settling=settling(records / "settling_pile.jsonl"),
        alone_origin=origins(rows),
        steps_origin=origins(steps),
    )


def step_rows_of(records: Path) -> list[StepRow]:
    """Rows of whole steps by scene, enforcement and size."""
    steps = _known(read(records / "steps.jsonl", StepRow))
    return sorted(steps, key=lambda r: (ORDER[r.scene], ORDER[r.enforcement], r.size))


def _known(rows: list) -> list:
    """Rows of scenes and enforcements that there are."""
    return [row for row in rows if row.scene in ORDER and row.enforcement in ORDER]


def _scene(steps: list[StepRow], scene: str) -> str:
    rows = [row for row in steps if row.scene == scene]
    return _with(step_rows.table(rows), step_rows.sentences(rows))


def _with(table: str, points: str) -> str:
    return f"{table}\n\n{points}" if points else table


def settling(path: Path) -> str:
    """Table of piles that came to rest."""
    head = "| blocks | depth (m) | enforcement | Shi's factor | steps | ms | passes | s a step | "
    head += "how it ended | energy | motion | overlap | lost |"
    lines = [head, "|" + "---|" * 13]
    for text in path.read_text().splitlines() if path.exists() else []:
        r = json.loads(text)
        lines.append(
            f"| {r['blocks']} | {r['height']:.3g} | {r['enforcement']} {r['penalty']:g} E | "
            f"{r['kinetic_factor']:g} | {r['steps']} | {1e3 * r['step']:g} | "
            f"{r['passes_a_step']:.0f} | {r['seconds_a_step']:.2g} | {r['sentence']} | "
            f"{r['energy_rise']:.0e} | {r['kinetic_energy']:.0e} | {r['largest_overlap']:.0e} | "
            f"{r['lost']} |"
        )
    return "\n".join(lines)


if __name__ == "__main__":
    write(RECORDS)
