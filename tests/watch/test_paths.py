"""In which folders changes of what robots depend on are looked for."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.networks import configure, run

from urdfsync.common.dependencies.facts import MODELICA, NAMES, PATH, Entry
from urdfsync.project import config
from urdfsync.watch.paths import WatchedFolders, find_watched_folders


def seen(project: Path, source: str, *entries: Entry, output: str = "modelica") -> WatchedFolders:
    """The folders that are watched for a configuration in this one with a robot `arm`."""
    text = f'[robots.arm]\nsource = "{source}"\npackage = "Arm"\noutput = "{output}"\n'
    loaded = config.parse(text, project / "urdfsync.toml", "urdfsync.toml")
    paths = str(loaded.file), str(loaded.robots[0].source)
    return find_watched_folders(loaded, [*((PATH, path) for path in paths), *entries])


def test_what_is_read_or_missing_or_listed_is_watched(project: Path) -> None:
    """Outputs of which not even the folder is there show in the folder above."""
    configure('package_paths = ["one", "gone"]\ntemplates = "own"\n')
    (project / "own/sub").mkdir(parents=True)
    (project / "one").mkdir()
    (project / "step.csv").unlink()
    loaded = config.load(project / "urdfsync.toml")
    found = find_watched_folders(loaded, run(dry=True).reads)
    assert found.singles == {str(project / name) for name in ("", "one", "own", "own/sub")}
    found = find_watched_folders(loaded, run().reads)
    assert found.trees == {str(project / "modelica/Ladder")}
    assert {str(project / ".urdfsync" / name) for name in ("", "robots", "bases/ladder")} <= found.singles


def test_elsewhere_folders_are_watched_up_to_the_nearest_common_one(tmp_path: Path) -> None:
    project, cad = tmp_path / "a/project", tmp_path / "cad/export"
    project.mkdir(parents=True)
    cad.mkdir(parents=True)
    (cad / "arm.urdf").write_text("")
    found = seen(project, str(cad / "arm.urdf"), (PATH, str(tmp_path / "arm.yaml")), (NAMES, "/usr"))
    assert found.singles == {str(folder) for folder in (project, tmp_path, tmp_path / "cad", cad)}


def test_many_folders_are_watched_by_the_one_around_them(tmp_path: Path) -> None:
    """Each that is watched alone takes two threads."""
    folders = [tmp_path / f"models/{number}" for number in range(20)]
    for folder in folders:
        folder.mkdir(parents=True)
    found = seen(tmp_path, "arm.urdf", *((MODELICA, str(folder)) for folder in folders))
    assert not found.singles
    assert found.trees == {str(tmp_path)}


@pytest.mark.parametrize("root", ["/", "/project"])
def test_the_root_is_never_watched(root: str) -> None:
    found = seen(Path(root), "/etc/hostname", (PATH, "/arm.mo"), output="/usr")
    assert "/" not in found.singles | found.trees


def test_links_without_end(tmp_path: Path) -> None:
    (tmp_path / "loop").symlink_to("loop/loop")
    found = seen(tmp_path, "loop/arm.urdf")
    assert found.singles == {str(tmp_path)}
