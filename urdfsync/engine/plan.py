"""The pipeline of one robot: inspect, generate, decide, stage. Writes nothing.

What `build` writes, a dry run shows and a hook judges is one and the same plan.
"""

from __future__ import annotations

import msgspec

from urdfsync import dependencies, uptodate
from urdfsync.config import Config, RobotConfig
from urdfsync.engine import imports
from urdfsync.engine.actions import CONFLICTS
from urdfsync.engine.decide import decide_package
from urdfsync.engine.findings import find_all
from urdfsync.engine.generation import generate_robot
from urdfsync.engine.inputs import NO_MODEL, Inputs, inspect
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.package_files import FileState
from urdfsync.engine.stage import Plan, stage
from urdfsync.files import shown
from urdfsync.state import manifest
from urdfsync.state.record import RecordState


def plan_robot(config: Config, robot: RobotConfig, options: BuildOptions) -> Plan:
    """Decide which files one build of a robot writes. Raises UrdfsyncError for whatever is wrong."""
    begin = uptodate.read_clocks()
    inputs = inspect(config, robot, options)
    plan = _plan_if_current(inputs)
    if plan is None:
        dependencies.mark_incomplete()  # what is read from here on is not recorded as a dependency of the answer
        generation = generate_robot(inputs)
        names = None
        if generation.rewritten or (
            inputs.model and inputs.model.gone
        ):  # else no name goes; the parser takes a tenth of a small build to load
            from urdfsync.engine.dangling import DanglingNames

            names = DanglingNames(generation)
        decision = decide_package(inputs, generation, names)
        lost = names.find(decision.actions, decision.texts) if names else []
        plan = stage(generation, decision, find_all(generation, decision.actions, lost))
    _note_states(inputs, plan, begin)
    return plan


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
    if options.full or options.draw or options.choices or inputs.former_name or inputs.written:
        return None
    if state is None or state.model is None or not state.intact or inputs.parents.shared:
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
        found = inputs.dependencies(state.model.snapshot, {})
    except NO_MODEL:
        return None  # the recorded model is not the domain's
    if not imports.unchanged(found, recorded.dependencies, inputs.domain.converter):
        return None
    decision = decide_package(inputs, None)
    if any(action.writes or action.kind in CONFLICTS for action in decision.actions):
        return None
    if not {inputs.key(path) for path in state.model.bases} <= decision.files.keys():
        return None
    renewed = msgspec.structs.replace(recorded, files=decision.files, orders=decision.orders)
    writes = []
    if not options.dry and renewed != recorded:
        writes = list(store.changes(inputs.robot.name, manifest.dumps(renewed), None, None))
    left_out = imports.reminder(found, recorded.dependencies, shown(inputs.robot.source))
    return Plan(decision.actions, store.witness(), (), decision.shared, left_out, writes=tuple(writes))


def _note_states(inputs: Inputs, plan: Plan, begin: tuple[int, int]) -> None:
    """Let the cache keep what a plan that began at this moment saw of outputs and recorded state."""
    cache = inputs.options.cache
    if cache is None:
        return
    states = dict(inputs.files.states)
    for path, sha256 in plan.witness.items():  # of the recorded state, the bytes alone count
        states[str(path)] = None if sha256 is None else FileState(dependencies.NO_STAT, sha256, sha256)
    cache.note_states(inputs.robot.name, states, begin, lambda: uptodate.read_clock(inputs.store.folder))
