"""Plans one robot: finds out whether there is anything to do, and if so has it worked out. Writes nothing.

What `build` writes, a dry run shows and a check judges is one and the same plan.
"""

from __future__ import annotations

import msgspec

from urdfsync import looking, profiling
from urdfsync.config import Config, RobotConfig, shown
from urdfsync.plan import CONFLICTS, State, Wanted
from urdfsync.planning import imports
from urdfsync.planning.decide import Aim, Decision, decide
from urdfsync.planning.situation import NO_MODEL, Request, Situation
from urdfsync.planning.work import Work
from urdfsync.stamping import stamp, trust
from urdfsync.state import manifest
from urdfsync.state.manifest import Manifest


def plan(config: Config, robot: RobotConfig, request: Request) -> Work:
    """What there is to do for a robot, from what is on disk at this moment.

    Raises UrdfsyncError for whatever is wrong.
    """
    begin = stamp.now()
    with profiling.stage("looking"):
        situation = Situation(config, robot, request)
        work = _if_unchanged(situation)
    if work is None:
        looking.beyond()  # what is read and rendered now is not taken down
        from urdfsync.planning.renewal import Renewal

        work = Renewal(situation).work()
    _remember(situation, work, begin)
    return work


@profiling.staged("looking")
def plan_if_unchanged(config: Config, robot: RobotConfig, request: Request) -> Work | None:
    """The same if that takes no reading and rendering, else None."""
    begin = stamp.now()
    situation = Situation(config, robot, request)
    work = _if_unchanged(situation)
    if work is not None:
        _remember(situation, work, begin)
    return work


def _remember(situation: Situation, work: Work, begin: tuple[int, int]) -> None:
    """Let the memory have what a plan that began at this moment saw of outputs and recorded state."""
    if situation.request.memory:
        seen = dict(situation.disk.hashed)
        for path, own in work.witness.items():
            seen[str(path)] = None if own is None else (looking.NO_FACTS, own, own)  # of the state, bytes alone count
        memory, name = situation.request.memory, situation.robot.name
        memory.note_look(name, seen, begin, lambda: trust.clock(situation.store.folder))


def _if_unchanged(situation: Situation) -> Work | None:
    """The work if the recorded state still holds and no file needs to be written; None if it has to be redone.

    Nothing that reads sources or renders templates is imported on this way.
    """
    state, request, store = situation.state, situation.request, situation.store
    again = request.full or request.draw or request.choices or situation.former
    if state is None or state.model is None or not state.intact or again:
        return None
    recorded = state.manifest
    if situation.heading(recorded.source.snapshot) != _heading_of(recorded) or situation.parents.created:
        return None
    if any(record.state in (State.CONFLICT, State.WAITING) for record in recorded.special.values()):
        return None
    if not request.dry and not store.has_bases(situation.robot.name):
        return None  # a clone: what its files are merged with is rendered while that is possible
    try:
        dependencies = situation.dependencies(state.model.snapshot, {})
    except NO_MODEL:
        return None  # the recorded snapshot is not the domain's: the source is read again
    if not imports.unchanged(dependencies, recorded.dependencies, situation.domain.converter):
        return None
    decision = _kept(situation, recorded)
    if decision is None or not {situation.key(path) for path in state.model.bases} <= decision.files.keys():
        return None
    renewed = msgspec.structs.replace(recorded, files=decision.files, orders=decision.orders)
    left_out = imports.reminder(dependencies, recorded.dependencies, shown(situation.robot.source))
    writes = () if request.dry else tuple(store.changes(situation.robot.name, manifest.dumps(renewed), None, None))
    return Work(decision, store.witness(), writes, diagnostics=left_out)


def _kept(situation: Situation, recorded: Manifest) -> Decision | None:
    """The decision if what the manifest records is what is wanted; None if that leaves something to write."""
    wanted = {
        key: Wanted(record.role, record.owner, record.base)
        for key, record in recorded.special.items()
        if record.base is not None and record.state is not State.ORPHAN
    }
    aim = Aim(wanted, recorded.orders, situation.parents, situation.folder, recorded.plain)
    decision = decide(situation.disk, recorded, aim, None)
    return None if any(a.writes or a.kind in CONFLICTS for a in decision.actions.decided) else decision


def _heading_of(recorded: Manifest) -> Manifest:
    return msgspec.structs.replace(recorded, names={}, dependencies={}, orders={}, files={})
