"""The page docs/enforcements.md from the records of enforcement.py and steps.py.

python benchmarks/enforcement_page.py
"""

import json
import platform
from pathlib import Path

import enforcement
import numpy as np
import scipy
import steps

TEXT = """# Which enforcement of contact

Five enforcements solve one step of contact; all find Coulomb's cone without dilatancy. `penalty`
lets bodies press into one another by force over stiffness; `augmented`, `lagrange` and `cone`
leave no gap within a tolerance (1e-7 of what the largest force would press in); `barrier` keeps a
distance. *Open-close* is Shi's iteration on the same springs as `penalty` (`[contact.options]
iteration = "open_close"`).

{advice}

## The contact solution alone

`python benchmarks/enforcement.py --page` writes this table and [its
records](enforcements/enforcement.json). *Slope*: a block slides on 30 degrees where friction
holds 20. *Supports*: a beam on two flat supports, eight forces for six unknowns. *Wall*: bricks
in running bond. *Pile*: Voronoi cells in a box. Blocks of six unknowns start to fall under
gravity and a lateral acceleration that grows by 0.05 m/s2 a step of 1 ms. *Force error*: of the
resultants of contact on the blocks, against the same law solved to 1e-12 (springs) or 1e-10
(exact). *Gap error*: the deepest penetration over the compliance of its contact times the largest
force. Processor milliseconds of one thread, medians over the steps after the first, on a machine
with other work: read ratios.

{enforcement}

## Whole steps of a wall

`python benchmarks/steps.py --page` writes this table and [its records](enforcements/steps.json):
search, assembly, contact, update and output of a wall of bricks on a held base, steps of 1 ms,
the first three left out.

{steps}

{versions}
"""

ADVICE = """**Of the classical three, none is best everywhere.**

- **Penalty** is the quickest and the most robust, and the default at 10 E. Springs share the load
  where contacts outnumber unknowns, and a pass costs a solve with a kept factor. Poor where gaps
  matter: it leaves penetrations of force over stiffness, and ten times stiffer springs cost two to
  four times the passes. Shi's open-close iteration on the same springs is poor on walls and piles:
  it cycles, which the verdict reports, and factorises in every pass.
- **Augmented Lagrangian** removes the penetration by rounds of multipliers. Poor where many
  contacts share few unknowns, as in walls: an error of forces that hardly stretches any contact
  dies slowly, so springs must grow from round to round, and a round then takes many factors.
- **Lagrange multipliers** are exact in a pass or two where contacts are fewer than unknowns. Poor
  on walls and piles: a brick has more contacts than unknowns, the matrix of the active set is
  singular, and the rounds of `cone` take over after it was tried in vain. The sentence of the
  step says so.
- **Cone** starts with two rounds, asks the interior point where they are not near, and finishes
  with stiffer rounds, so every step of the table converges. It is not the default: on walls it
  costs over ten times the penalty's seconds, and exact forces are hardly determined. Answers that
  obey every condition to 1e-7 differ by up to 4e-3 in the resultants on a wall of 100 bricks with
  friction, and by 4e-6 without. So much force error an exact enforcement can show.
- **Barrier** is smooth, and no gap passes its wall, half a width behind touching; every step of the
  table converges. It takes a factorisation every Newton step, a hundred on the pile, and its errors
  are those of its width."""


def read(records: Path, name: str, kind: type) -> list:
    """Rows of a record; none where there is no record."""
    path = records / f"{name}.json"
    return [kind(**item) for item in json.loads(path.read_text())] if path.exists() else []


def write(records: Path) -> None:
    """Write the page from the records there are."""
    found = {
        "enforcement": enforcement.table(read(records, "enforcement", enforcement.Row)),
        "steps": steps.table(read(records, "steps", steps.Cost)),
    }
    versions = (
        f"{platform.machine()}, Python {platform.python_version()}, numpy {np.__version__}, "
        f"scipy {scipy.__version__}."
    )
    text = TEXT.format(advice=ADVICE, versions=versions, **found)
    records.with_suffix(".md").write_text(text)


if __name__ == "__main__":
    write(enforcement.RECORDS)
