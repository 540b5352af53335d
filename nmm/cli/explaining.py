"""What `nmm explain` says of a scene: effects simulated and not, kind of run, sizes, cost."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from nmm.cli.terminal import console, in_shell, tell_next

if TYPE_CHECKING:
    from rich.table import Table

    from nmm.formulation import Formulation
    from nmm.scene import Scene
    from nmm.scene.stages import StageTable
    from nmm.stepping.simulation import Simulation


def told(place: Path, given: "Formulation | None", cost: bool) -> None:
    """Print what a scene simulates under a formulation, its own where none is ``given``."""
    import nmm
    from nmm.formulation import Formulation
    from nmm.model.manifolds.tips import tip_lines
    from nmm.stepping.prepare import prepare

    scene = nmm.read_scene(place)
    chosen = given or scene.formulation or Formulation()
    prepared = prepare(scene, chosen)
    manifold = prepared.stepper.model.manifold
    out = console()
    out.print(_effects(scene))
    for line in _sizes(scene, chosen, len(prepared.regions), len(manifold.elements)):
        out.print(line, highlight=False)
    for name, effect in prepared.stepper.plan.effects.items():
        if effect.about:
            out.print(f"{name}: {effect.about}", highlight=False, markup=False)
    for line in tip_lines(prepared.stepper.model):
        out.print(line, highlight=False, markup=False)
    out.print(f"unknowns: {manifold.n_unknowns:,}", highlight=False)
    for warning in prepared.identity().warnings:
        out.print(f"warning: {warning}", style="yellow", highlight=False, markup=False)
    out.print(str(prepared.storage), highlight=False)
    if cost:
        _tell_cost(prepared)
    tell_next(f"nmm run {in_shell(place)}")


def _effects(scene: "Scene") -> "Table":
    """Return the effects that are simulated, those that are not, and what would call for them."""
    from rich.markup import escape
    from rich.table import Table

    from nmm.model.called_for import CALLS

    made = Table(title=escape(scene.title), title_justify="left")
    made.add_column("simulated")
    made.add_column("called for by")
    named = {name: call.key for name, call in CALLS.items() if call.made_by(scene)}
    own = {name: f"[effects.{name}]: {table.type}" for name, table in scene.effects.items()}
    for name, key in (named | own).items():
        made.add_row(escape(name), escape(key))
    made.add_section()
    made.add_row("[bold]not simulated[/bold]", "[bold]would be called for by[/bold]")
    made.add_section()
    for name, call in CALLS.items():
        if name not in named:
            made.add_row(name, escape(call.key), style="dim")
    return made


def _steps(chosen: "Formulation") -> str:
    """Say how long steps are, or what chooses it."""
    table = chosen.integrator
    if table.fixed_step is not None:
        return f"step {table.fixed_step:g} s"
    from nmm.stepping.adaptive.control import ERROR

    return f"steps by an error of {table.error or ERROR:g} a cycle, of three solutions each"


def _sizes(scene: "Scene", chosen: "Formulation", blocks: int, elements: int) -> Iterator[str]:
    """Yield the lines that say what kind of run it is."""
    from nmm.geometry.tessellation.cover_types import named_functions

    dynamic = scene.inertia is not None
    kind = "dynamic" if dynamic else "quasi-static, over time" if scene.in_time else "static"
    yield f"run: {kind}, plane {scene.plane}"
    if dynamic:
        yield f"integrator: {chosen.integrator.type}, {_steps(chosen)}"
        if scene.contact is not None:
            yield from _rule_among_contacts(chosen)
        if scene.duration is not None:
            yield f"duration: {scene.duration:g} s"
    elif scene.in_time:
        span = "" if scene.duration is None else f"duration: {scene.duration:g} s, "
        yield f"{span}{_steps(chosen)}, no inertia"
    elif scene.loading is not None:
        yield f"loading: until {scene.loading.until}, increment {chosen.loading.increment:g}"
    if scene.strength_reduction is not None:
        asked = scene.strength_reduction
        bounds = f"factors {asked.lowest:g} to {asked.highest:g}, within {asked.tolerance:g}"
        yield f"strength reduction: {bounds}; a run each, some 10"
    if scene.stages:
        yield "stages: " + ", ".join(f"{one.name} ({_ends(one)})" for one in scene.stages)
    if scene.contact is not None:
        yield f"contact: {chosen.contact.enforcement}"
    yield f"cover: {chosen.cover.type}, {named_functions(chosen.cover)}"
    yield f"blocks: {blocks:,}"
    yield f"elements: {elements:,}"


def _ends(stage: "StageTable") -> str:
    """How a stage ends, and how much of what left is then released."""
    span = "to rest" if stage.duration is None else f"{stage.duration:g} s"
    return span if stage.release is None else f"{span}, {100 * stage.release:g} % released"


def _rule_among_contacts(chosen: "Formulation") -> Iterator[str]:
    """Yield what an integrator that carries accelerations does in a scene with contact."""
    from nmm.integrators.base import make_integrator

    rule = make_integrator(chosen.integrator)
    if rule.among_contacts is not rule:
        weight = rule.among_contacts.end_weight
        yield f"  with contact: carries no acceleration, forces act with {weight:.4g} of the end"


def _tell_cost(simulation: "Simulation") -> None:
    """Print what a compiled scene will cost on this machine."""
    from nmm.study.cost.run_size import size_of, steps_of
    from nmm.study.cost.stored_model import load_model

    model = load_model()
    if model is None:
        typer.echo("cost: not known on this machine; measure it once: nmm calibrate")
        return
    steps = steps_of(simulation)
    one, two = (model.seconds(size_of(simulation, n)) for n in (1.0, 2.0))
    size = size_of(simulation, steps or 1.0)
    if steps is None:
        text = f"{one:.2g} s and {two - one:.2g} s for each further step, failure decides how many"
    else:
        text = f"{model.seconds(size):.2g} s of {steps:,.0f} steps"
    typer.echo(f"cost: about {text}; {model.bytes(size) / 2**20:.0f} MiB more memory")
    if size.unknowns > 5 * model.largest[size.kind]:
        typer.echo(f"cost: fitted up to {model.largest[size.kind]:,} unknowns: read it as a guess")
