"""The pipeline of one robot: inspect, generate, decide, stage. Writes nothing.

`build` writes this plan; a dry run, `status` and the hooks report it.
"""

from __future__ import annotations

from urdfsync.common.dependencies.reads import Reads
from urdfsync.engine.decide.decision import Decision
from urdfsync.engine.decide.differences import compare_with_last
from urdfsync.engine.decide.settle import settle, with_choices
from urdfsync.engine.decide.steps import decide_package
from urdfsync.engine.generation import Generation, generate_robot
from urdfsync.engine.inspect.inputs import Inputs, inspect
from urdfsync.engine.inspect.united import with_git_merges
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Outlook
from urdfsync.engine.stage.writes import Plan, stage
from urdfsync.project.config import Config, RobotConfig


def plan_robot(config: Config, robot: RobotConfig, options: BuildOptions, reads: Reads) -> Plan:
    """Decide which files one build of a robot writes. Raises UrdfsyncError for all faults.

    `reads` is the open list of all that the steps read.
    """
    inputs = inspect(config, robot, options)
    if inputs.source.is_missing:
        return Plan(Outlook(stale=inputs.source.stale), inputs.store.hashes())
    generation = generate_robot(inputs)
    inputs, decision = decide_robot(inputs, generation)
    return stage(inputs, generation, decision, reads)


def decide_robot(inputs: Inputs, generation: Generation) -> tuple[Inputs, Decision]:
    """Decide on every file, as git and the user's choices leave them. Returns the inputs with their contents."""
    inputs = as_git_left_it(inputs, generation)
    decision = decide_package(inputs, generation)
    if inputs.options.choices or inputs.options.adopts:
        inputs = with_choices(inputs, settle(inputs, generation, decision))
        decision = decide_package(inputs, generation)
    return inputs, decision


def as_git_left_it(inputs: Inputs, generation: Generation) -> Inputs:
    """Return the inputs, in which unmerged files have the texts that both branches meant."""
    ids = compare_with_last(inputs, generation).ids if inputs.unmerged else {}
    return with_git_merges(inputs, generation.package, ids)
