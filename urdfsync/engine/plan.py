"""The pipeline of one robot: inspect, generate, decide, stage. Writes nothing.

`build` writes this plan; a dry run, `status` and the hooks report it.
"""

from __future__ import annotations

import msgspec

from urdfsync.config import Config, RobotConfig
from urdfsync.dependencies.reads import Reads
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.decide.decision import decide_package
from urdfsync.engine.decide.settle import settle, with_choices
from urdfsync.engine.generation import generate_robot
from urdfsync.engine.inspect.inputs import inspect
from urdfsync.engine.inspect.united import with_git_merges
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Outlook
from urdfsync.engine.stage.writes import Plan, stage


def plan_robot(config: Config, robot: RobotConfig, options: BuildOptions, reads: Reads) -> Plan:
    """Decide which files one build of a robot writes. Raises UrdfsyncError for all faults.

    `reads` is the open list of all that the steps read.
    """
    inputs = inspect(config, robot, options)
    if inputs.source.is_missing:
        return Plan(Outlook(stale=inputs.source.stale), inputs.store.hashes())
    generation = generate_robot(inputs)
    inputs = with_git_merges(inputs, generation.package)
    decision = decide_package(inputs, generation)
    if options.choices:
        inputs = with_choices(inputs, settle(inputs, generation, decision))
        decision = decide_package(inputs, generation)
    plan = stage(inputs, generation, decision, reads)
    return _refused(robot, plan) if any(finding.code in robot.refuse for finding in plan.outlook.diagnostics) else plan


def _refused(robot: RobotConfig, plan: Plan) -> Plan:
    """Return a plan that writes nothing: the findings with a code in `refuse` are errors."""
    findings = list[Diagnostic]()
    for finding in plan.outlook.diagnostics:
        if finding.code in robot.refuse:
            hint = f"{finding.hint or 'correct the source'}; to accept it, take the code out of `refuse`"
            findings.append(msgspec.structs.replace(finding, severity=Severity.ERROR, hint=hint))
        elif finding.severity is not Severity.NOTE:  # notes tell what a build does
            findings.append(finding)
    outlook = Outlook(diagnostics=tuple(findings), changes=plan.outlook.changes)
    return Plan(outlook, plan.state, is_refused=True)
