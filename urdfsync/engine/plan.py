"""The pipeline of one robot: inspect, generate, decide, stage. Writes nothing.

What `build` writes, a dry run shows and a hook judges is one and the same plan.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import msgspec

from urdfsync import dependencies, profiling, uptodate
from urdfsync.config import Config, RobotConfig, shown
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.diff.changes import Changes
from urdfsync.domain import Target
from urdfsync.engine import imports, orphans, outdated
from urdfsync.engine.actions import Actions
from urdfsync.engine.conflicts import Conflict
from urdfsync.engine.decide import Decision, DesiredPackage, SharedFile, decide_package
from urdfsync.engine.generation import Generation, generate_robot
from urdfsync.engine.inputs import NO_MODEL, Inputs, inspect
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.package_files import FileState
from urdfsync.engine.rules import DesiredFile
from urdfsync.engine.stage import draw, stage, stage_bases
from urdfsync.state import manifest, repair
from urdfsync.state.record import RecordState
from urdfsync.state.store import Witness
from urdfsync.state.transaction import Change


class Plan(msgspec.Struct, frozen=True):
    """What one build of a robot does."""

    actions: Actions
    witness: Witness
    """Hashes of the recorded state that the plan rests on."""
    conflicts: tuple[Conflict, ...] = ()
    shared: tuple[SharedFile, ...] = ()
    """What to do with files around the package."""
    writes: tuple[Change, ...] = ()
    """The files to write, the manifest last; none in a dry run, unless it compares the recorded state."""
    emptied: tuple[Path, ...] = ()
    """The folders that are empty then, innermost first."""
    bases: Mapping[str, str] = {}
    """Texts to keep as bases that are not kept yet, by their hashes."""
    mentioned: frozenset[str] | None = None
    """Hashes of all bases that the manifest mentions then; None if others may be needed as well."""
    is_noted: bool = True
    """Whether a build in this checkout noted the package's folder."""
    former_folder: str = ""
    """Key of the package's folder in the last build, if it has another one now."""
    former_name: str | None = None
    """The name that the robot had in the last build, if it has another one now."""
    diagnostics: tuple[Diagnostic, ...] = ()
    drawing: Path | None = None
    """Path of the main model's diagram."""
    changes: Changes | None = None
    """What is new in the model."""


def plan_robot(config: Config, robot: RobotConfig, options: BuildOptions) -> Plan:
    """Decide which files one build of a robot writes. Raises UrdfsyncError for whatever is wrong."""
    begin = uptodate.read_clocks()
    with profiling.stage("looking"):
        inputs = inspect(config, robot, options)
        plan = _plan_if_current(inputs)
    if plan is None:
        dependencies.mark_incomplete()  # what is read from here on is not recorded as a dependency of the answer
        plan = _plan_generation(inputs, generate_robot(inputs))
    _note_states(inputs, plan, begin)
    return plan


@profiling.stage("looking")
def plan_if_current(config: Config, robot: RobotConfig, options: BuildOptions) -> Plan | None:
    """Return the plan if nothing is to be generated or written, without parsing the source; None otherwise."""
    begin = uptodate.read_clocks()
    inputs = inspect(config, robot, options)
    plan = _plan_if_current(inputs)
    if plan is not None:
        _note_states(inputs, plan, begin)
    return plan


def _plan_if_current(inputs: Inputs) -> Plan | None:
    """Return the plan if the last build's result is still wanted, and on disk; None otherwise."""
    state, options, store = inputs.state, inputs.options, inputs.store
    if options.full or options.draw or options.choices or inputs.former_name:
        return None
    if state is None or state.model is None or not state.intact or inputs.parents.created:
        return None
    recorded = state.manifest
    if msgspec.structs.replace(recorded, names={}, dependencies={}, orders={}, files={}) != inputs.heading(
        recorded.source.snapshot
    ):
        return None
    if any(r.state in (RecordState.CONFLICT, RecordState.WAITING) for r in recorded.files.values()):
        return None
    if not options.dry and not store.has_bases(inputs.robot.name):
        return None  # in a clone, the bases are stored while they can still be rendered
    try:
        dependencies = inputs.dependencies(state.model.snapshot, {})
    except NO_MODEL:
        return None  # the recorded model is not the domain's
    if not imports.unchanged(dependencies, recorded.dependencies, inputs.domain.converter):
        return None
    as_recorded = {
        key: DesiredFile(record.role, record.owner, record.base)
        for key, record in recorded.files.items()
        if record.base is not None and record.state is not RecordState.ORPHAN
    }
    decision = decide_package(inputs, recorded, DesiredPackage(as_recorded, recorded.orders), None)
    if decision.has_work or not {inputs.key(path) for path in state.model.bases} <= decision.files.keys():
        return None
    writes: tuple[Change, ...] = ()
    if not options.dry:
        renewed = msgspec.structs.replace(recorded, files=decision.files, orders=decision.orders)
        writes = (
            tuple(store.changes(inputs.robot.name, manifest.dumps(renewed), None, None)) if renewed != recorded else ()
        )
    left_out = imports.reminder(dependencies, recorded.dependencies, shown(inputs.robot.source))
    return Plan(
        decision.actions,
        store.witness(),
        shared=decision.shared,
        writes=writes,
        is_noted=options.dry or _is_noted(inputs),
        diagnostics=left_out,
    )


def _is_noted(inputs: Inputs) -> bool:
    """Return whether a build in this checkout noted the package's folder."""
    return inputs.folder in inputs.store.written_folders(inputs.robot.name)


def _plan_generation(inputs: Inputs, generation: Generation) -> Plan:
    moves = generation.renamed_files()
    desired = DesiredPackage(generation.desired_files(), generation.desired_orders(), moves)
    hashes = {key: file.hash for key, file in desired.files.items()} if inputs.recovered else {}
    decision = decide_package(inputs, inputs.rebuilt_manifest(hashes), desired, generation)
    changes = generation.changes_since_complete
    plan = Plan(
        decision.actions,
        inputs.store.witness(),
        decision.conflicts,
        decision.shared,
        diagnostics=_diagnostics(inputs, generation, decision),
        changes=changes if changes and (changes.changes or changes.generator) else None,
    )
    if inputs.options.dry and not inputs.options.compares_state:
        return plan
    writes, emptied = stage(inputs, generation, decision)
    bases, mentioned = stage_bases(inputs, generation, decision)
    drawing = None
    if (picture := draw(inputs, generation)) is not None:
        drawing = inputs.store.drawing(inputs.robot.name, picture)[0]
    witness = inputs.store.witness()
    return msgspec.structs.replace(
        plan,
        witness=witness,
        writes=tuple(writes),
        emptied=tuple(emptied),
        bases=bases,
        mentioned=mentioned,
        is_noted=_is_noted(inputs),
        former_folder=inputs.old_folder if inputs.old_folder != inputs.folder else "",
        former_name=inputs.former_name,
        drawing=drawing,
    )


def _diagnostics(inputs: Inputs, generation: Generation, decision: Decision) -> tuple[Diagnostic, ...]:
    found = [*generation.diagnostics, *generation.imported.diagnostics, *inputs.parents.diagnostics]
    place = shown(inputs.config.file), inputs.robot.lines[""]
    if inputs.former_name:
        found.append(orphans.renamed_robot(inputs.former_name, inputs.robot.name, *place))
    if inputs.recovered:
        found.append(repair.repaired(inputs.recovered, inputs.robot.name, shown(inputs.store.folder)))
    if inputs.recorded and inputs.old_folder != inputs.folder:
        is_own, actions = inputs.old_folder in inputs.own_folders, decision.actions
        found += orphans.left_behind(inputs.files, inputs.recorded, is_own, actions, inputs.folder, *place)
    found += _uses_of_lost_names(inputs, generation, decision)
    found += _lost_connectors(inputs, generation)
    found += outdated.findings(inputs, decision.actions)
    return tuple(sorted(found, key=lambda diagnostic: (diagnostic.file, diagnostic.line)))


def _uses_of_lost_names(inputs: Inputs, generation: Generation, decision: Decision) -> list[Diagnostic]:
    """Return warnings about texts of the user's that use names which the package loses."""
    recorded = inputs.recorded
    if recorded is None or not generation.replaced:
        return []
    target = Target(recorded.package, recorded.class_)
    gone = sorted(generation.replaced.keys() - generation.package.artifacts.keys())
    options = {path: inputs.domain.option_for(path, target, inputs.robot.options) for path in gone}
    left_out = {path: option for path, option in options.items() if option}
    texts = generation.dangling.users_texts(decision.actions, decision.texts)
    found = generation.dangling.left_out(texts, left_out) if left_out else []
    return found + (
        generation.dangling.warnings(texts, generation.lost_names) if texts and generation.lost_names else []
    )


def _lost_connectors(inputs: Inputs, generation: Generation) -> list[Diagnostic]:
    """Return notes on what users may have connected to, and what has another name now, or none."""
    complete, changes, robot = inputs.last_complete, generation.changes_since_complete, inputs.robot
    if complete is None or changes is None or not (changes.is_structural or changes.generator):
        return []
    notes = []
    for one in inputs.domain.interface(complete, generation.now, changes.renames, robot.target, robot.options):
        element, connector = one.path
        if one.old is not None:
            now = f"is now `{one.new}`" if one.new else "is gone"
            message = f"{element}: its {connector} `{one.old}` {now}"
            place = shown(robot.source), generation.lines.get(element, 0)
            notes.append(Diagnostic(Severity.NOTE, "connector-changed", message, *place, hint=one.hint))
    return notes


def _note_states(inputs: Inputs, plan: Plan, begin: tuple[int, int]) -> None:
    """Let the cache keep what a plan that began at this moment saw of outputs and recorded state."""
    cache = inputs.options.cache
    if cache is None:
        return
    states = dict(inputs.files.states)
    for path, sha256 in plan.witness.items():  # of the recorded state, the bytes alone count
        states[str(path)] = None if sha256 is None else FileState(dependencies.NO_STAT, sha256, sha256)
    cache.note_states(inputs.robot.name, states, begin, lambda: uptodate.read_clock(inputs.store.folder))
