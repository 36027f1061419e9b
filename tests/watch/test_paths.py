"""Which paths matter to a robot, and where their changes are looked for."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

import pytest
from support.networks import configure

from urdfsync import cli, config
from urdfsync.engine.result import Exit
from urdfsync.watch.paths import RobotPaths, WatchedPaths, find_robot_paths, find_watched_paths


def ladder(project: Path) -> RobotPaths:
    loaded = config.load(project / "urdfsync.toml")
    return find_robot_paths(loaded, loaded.robots[0], ())


def names(project: Path, paths: Iterable[str]) -> set[str]:
    return {os.path.relpath(path, project) for path in paths}


def seen(project: Path, source: str, output: str = "modelica") -> WatchedPaths:
    """Where a configuration in this folder has its robot `arm` watched that was never built."""
    text = f'[robots.arm]\nsource = "{source}"\npackage = "Arm"\noutput = "{output}"\n'
    loaded = config.parse(text, project / "urdfsync.toml", "urdfsync.toml")
    paths = RobotPaths(frozenset([str(loaded.file), str(loaded.robots[0].source)]), frozenset())
    return find_watched_paths(loaded, {"arm": paths})


def test_a_dependency_may_turn_up_wherever_it_is_looked_for(project: Path) -> None:
    configure('package_paths = ["one", "two"]\n')
    assert cli.main(["build", "--quiet"]) == 0
    found = names(project, ladder(project).inputs)
    assert found == {"urdfsync.toml", "ladder.json", "step.csv"}, "what comes later does not matter"
    (project / "step.csv").unlink()
    assert {"step.csv", "one/step.csv", "two/step.csv"} <= names(project, ladder(project).inputs)


def test_a_state_that_can_not_be_read_is_still_watched(project: Path) -> None:
    assert cli.main(["build", "--quiet"]) == 0
    (project / ".urdfsync/robots/ladder.state").write_text("<<<<<<<")
    assert ".urdfsync/robots/ladder.state" in names(project, ladder(project).outputs)
    assert cli.main(["build", "--quiet"]) == Exit.ERROR, "it is not taken for no state"
    assert cli.main(["build", "--quiet", "--full"]) == Exit.IN_STEP


def test_parents_and_templates_matter(project: Path) -> None:
    (project / "urdfsync.toml").write_text(
        '[robots.ladder]\nsource = "ladder.json"\npackage = "Plant.Ladder"\ndomain = "rcnetwork"\ntemplates = "own"\n'
    )
    (project / "own/sub").mkdir(parents=True)
    found = ladder(project)
    assert {"modelica/Plant/package.mo", "modelica/Plant/package.order"} <= names(project, found.outputs)
    watched = find_watched_paths(config.load(project / "urdfsync.toml"), {"ladder": found})
    assert watched.robots_for(str(project / "own/sub/x.jinja")) == {"ladder"}


def test_elsewhere_folders_are_watched_up_to_the_nearest_common_one(tmp_path: Path) -> None:
    project, cad = tmp_path / "a/project", tmp_path / "cad/export"
    project.mkdir(parents=True)
    cad.mkdir(parents=True)
    (cad / "arm.urdf").write_text("")
    found = seen(project, str(cad / "arm.urdf"))
    assert found.folders == {str(folder) for folder in (project, tmp_path, tmp_path / "cad", cad)}
    assert found.robots_for(str(tmp_path / "a")) == set()


@pytest.mark.parametrize("root", ["/", "/project"])
def test_the_root_is_never_watched(root: str) -> None:
    found = seen(Path(root), "/etc/hostname", "/usr")
    assert "/" not in found.folders
    assert "/" not in found.by_path


def test_links_without_end(tmp_path: Path) -> None:
    (tmp_path / "loop").symlink_to("loop/loop")
    found = seen(tmp_path, "loop/arm.urdf")
    assert found.robots_for(str(tmp_path / "loop")) == {"arm"}
