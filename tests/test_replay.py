"""A part of the replays: some histories of the corpus, with and without edits by hand. The scripts do all of it."""

from __future__ import annotations

import itertools
from pathlib import Path

import pytest
import replay_edits
import replay_histories
from support import replay
from support.replay import Project

from urdfsync.outcome import Result

HISTORIES = ("turtlebot3_burger", "so101_old_calib", "urdf_spirit_meshes")
"""Small ones, with steps of every class, renames and a version that is no robot."""
SEED = 3

pytestmark = pytest.mark.slow


def chosen() -> dict[str, list[bytes]]:
    return {name: list(all_of) for name, all_of in replay.histories().items() if name.endswith(HISTORIES)}


@pytest.mark.parametrize("number", range(len(HISTORIES)))
@pytest.mark.parametrize("meshes", [False, True], ids=["no-meshes", "meshes"])
def test_each_version_over_the_last_is_a_fresh_build(corpus: Path, tmp_path: Path, number: int, meshes: bool) -> None:
    versions = list(chosen().values())[number]
    with replay.in_haste():
        tally, faults = replay_histories.replayed(versions, tmp_path, base=replay.base_of(versions), meshes=meshes)
    assert faults == []
    assert tally["versions"] == len(versions)
    assert tally["unwritten"] > 0


def test_a_long_history_of_different_robots(corpus: Path, tmp_path: Path) -> None:
    versions = list(itertools.chain.from_iterable(chosen().values()))
    with replay.in_haste():
        tally, faults = replay_histories.replayed(versions, tmp_path, base="fixed", meshes=False)
    assert faults == []
    assert tally["structural"] > 3


def test_edits_follow_elements_with_another_name(corpus: Path, tmp_path: Path) -> None:
    with replay.in_haste():
        for name, versions in chosen().items():
            tally, faults = replay_histories.renames(versions, tmp_path / name, base="fixed")
            assert faults == []
            assert tally["renames"] > 0 or name.endswith("spirit_meshes")


def test_no_edited_line_gets_lost(corpus: Path) -> None:
    for tally, faults in replay_edits.run(60, SEED, length=20):  # noqa: B007 - the last one is looked at
        assert faults == []
    assert tally["steps"] == 60
    assert all(tally[column] for column in ("edits", "conflicts", "merges", "moves", "resolved", "clones"))


def test_a_lost_line_would_be_found(corpus: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    build = Project.build

    def careless(project: Project, **request: object) -> Result:
        result = build(project, **request)
        for path in project.package.rglob("*.mo"):
            path.write_text(
                "".join(line for line in path.read_text().splitlines(keepends=True) if "// mine" not in line)
            )
        return result

    monkeypatch.setattr(Project, "build", careless)
    _, found = next(replay_edits.run(20, SEED))
    assert any("lost: mine" in fault for fault in found)
    assert any("was edited, and is changed" in fault for fault in found)
