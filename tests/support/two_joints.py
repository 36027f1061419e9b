"""A robot with two joints to check, which the fixture `arm` of `tests/analysis/checks` builds, and its findings."""

from __future__ import annotations

from pathlib import Path

from support.urdfs import dynamics, joint, link, robot
from urdfsync.analysis.checks import compilers
from urdfsync.analysis.checks.results import CheckOptions, CheckResult
from urdfsync.analysis.checks.robot import check_robot, recall_check
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.project import config

LINKS = link("base", 3.0), link("arm", 2.0, rpy="0.1 0.2 0.3"), link("hand", 0.7)
JOINTS = (
    joint("shoulder", "revolute", "base", "arm", axis="0 1 0", rpy="0.4 0.5 0.6", inside=[dynamics(0.5, 0.2)]),
    joint("elbow", "continuous", "arm", "hand", axis="0 0 1", inside=[dynamics(0.1, 0.0)]),
)
ARM = robot(*LINKS, *JOINTS)


def rebuild() -> None:
    loaded = config.load(Path("urdfsync.toml").absolute())
    (result,) = build(loaded, loaded.robots, BuildOptions())
    assert not result.failed


def check(physics: bool = False, fresh: bool = False, curves: bool = False, tool: str = "rumoca") -> CheckResult:
    loaded = config.load(Path("urdfsync.toml").absolute())
    tools = compilers.choose(loaded, tool)
    options = CheckOptions(physics=physics, tools=tools, compilers=2, fresh=fresh, curves=curves)
    robot = loaded.robots[0]
    return recall_check(loaded, robot, options) or check_robot(loaded, robot, options)


def write(files: dict[str, str]) -> None:
    for path, text in files.items():
        (Path("modelica") / path).parent.mkdir(exist_ok=True, parents=True)
        (Path("modelica") / path).write_text(text)


def replace(file: Path, old: str, new: str) -> None:
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new))


def codes(result: CheckResult) -> list[str]:
    return [one.code for one in result.diagnostics if one.severity == "error"]


def lines(result: CheckResult) -> list[str]:
    """The findings as lines for people."""
    return [
        f"{one.file.removeprefix('modelica/')}:{one.line}: {one.severity}: {one.message}; {one.hint}"
        for one in result.diagnostics
    ]
