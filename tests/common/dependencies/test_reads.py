"""What is read is recorded; the list is incomplete if something changed meanwhile."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from support import xacros
from support.git import NEEDS_GIT, Repository
from support.networks import RECORD, configure, resistor, run, run_all

from urdfsync.common.dependencies import reads
from urdfsync.common.dependencies.facts import MODELICA, NAMES, NOTHING, PATH, VARIABLE, changes, look


def test_environment_variables_are_recorded(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("LENGTH", raising=False)
    for value in (None, "", "0.5", "0.6"):
        if value is not None:
            monkeypatch.setenv("LENGTH", value)
        before = look(VARIABLE, "LENGTH")
        with reads.Reads() as found:
            assert reads.read_variable("LENGTH") == value
        assert found.entries == {(VARIABLE, "LENGTH"): hash(before)}
        monkeypatch.setenv("LENGTH", "another")
        assert look(VARIABLE, "LENGTH") != before


def test_what_changes_or_fails_meanwhile_makes_the_record_incomplete(tmp_path: Path) -> None:
    file = tmp_path / "file"
    with reads.Reads() as found:
        assert not reads.is_file(file)
        file.write_text("a")
        assert reads.is_file(file)
    assert not found.complete, "it came meanwhile"
    with reads.Reads() as found:
        assert reads.read_file(file) == b"a"
        assert found.complete
        file.write_text("ab")
        assert reads.read_file(file) == b"ab"
    assert not found.complete, "it changed meanwhile"


@pytest.mark.posix("a path of any length is one where nothing is")
def test_what_the_system_does_not_tell_makes_the_record_incomplete(tmp_path: Path) -> None:
    with reads.Reads() as found, pytest.raises(OSError, match="too long"):
        reads.is_file(tmp_path / ("a" * 5000))
    assert not found.complete


def test_a_plan_lists_what_it_has_read(project: Path) -> None:
    """Files, places where nothing is, names in folders, and outputs that are to be made."""
    configure('package_paths = ["later"]\ntemplates = "own"\n')
    (project / "own").mkdir()
    (project / "Mine.mo").write_text("model Mine end Mine;")
    (project / "step.csv").unlink()
    entries = set(run(dry=True).reads)
    listed = ((PATH, "ladder.json"), (PATH, "Mine.mo"), (NAMES, "own"), (MODELICA, "."))
    assert {(kind, str((project / name).resolve())) for kind, name in listed} <= entries
    assert {(PATH, str(project / name)) for name in ("step.csv", "later/step.csv", "modelica")} <= entries
    run()
    assert (PATH, str(project / RECORD)) in run(dry=True).reads


def test_an_error_carries_the_list_in_the_place_of_a_plan(project: Path) -> None:
    for content in (None, "{"):
        (project / "ladder.json").unlink() if content is None else (project / "ladder.json").write_text(content)
        (failed,) = run_all()
        assert (PATH, str(project / "ladder.json")) in failed.reads


def test_so_does_an_error_of_xacro(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    source = xacros.ARM.replace("parts/beam.xacro", "parts/*.xacro").replace("masses.yaml", "gone.yaml")
    xacros.write(tmp_path, {"arm.urdf.xacro": source})
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "urdf/arm.urdf.xacro"\npackage = "Arm"\n')
    (failed,) = run_all()
    assert failed.failed
    assert {(PATH, str(tmp_path / "urdf/gone.yaml")), (NAMES, str(tmp_path / "urdf/parts"))} <= set(failed.reads)


def test_a_build_lists_what_it_wrote_as_it_is_then(project: Path) -> None:
    run()
    resistor(150)
    result = run()
    assert result.writes
    assert list(changes(result.reads, {})) == []
    (project / RECORD).write_text("changed")
    assert {path for _, path in changes(result.reads, {})} == {str(project / RECORD)}


# Links


def test_a_link_changes_with_itself_and_with_its_target(tmp_path: Path) -> None:
    first, second, link = tmp_path / "first", tmp_path / "second", tmp_path / "link"
    for target in (first, second):
        target.write_text("same")
    link.symlink_to(first)
    before = look(PATH, link)
    first.write_text("other text")
    changed = look(PATH, link)
    link.unlink()
    link.symlink_to(second)
    retargeted = look(PATH, link)
    second.unlink()
    assert len({before, changed, retargeted, look(PATH, link)}) == 4


def test_the_times_of_a_folder_are_no_fact(tmp_path: Path) -> None:
    before = look(PATH, tmp_path)
    (tmp_path / "new").touch()
    assert look(PATH, tmp_path) == before != NOTHING == look(PATH, tmp_path / "new/below")


# Git's index


@NEEDS_GIT
@pytest.mark.parametrize("version", ["2", "4"])
def test_unmerged_files_are_found_among_names_of_all_lengths(
    folder: Path, monkeypatch: pytest.MonkeyPatch, version: str
) -> None:
    repository = Repository(folder, monkeypatch)
    Path("later").write_text("")
    repository.git("add", "--intent-to-add", "later")  # it has more flags than others
    blob = repository.git("hash-object", "-w", "later").strip()
    wanted, lines = set[str](), list[str]()
    for number, size in enumerate((*range(1, 40), 4080, 4091, 4092, 5000)):
        name = f"{'n' * size}{size}"
        stages = (1, 2, 3) if number % 3 else (0,)
        lines += [f"100644 {blob} {stage}\t{name}" for stage in stages]
        wanted |= {name} if number % 3 else set()
    subprocess.run(["git", "update-index", "--index-info"], input="\n".join(lines).encode(), check=True)
    repository.git("update-index", "--index-version", version)
    index = Path(".git/index")
    assert reads.find_unmerged(index) == wanted
    index.write_bytes(index.read_bytes()[:700])
    assert reads.find_unmerged(index) < wanted
