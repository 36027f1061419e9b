"""A build that is killed, that fails or that meets the user's saves, at each of its file operations.

The next build must bring about what an undisturbed one does, with the user's edits as they were. Every
kind of operation is tried in all cases; `URDFSYNC_CRASHES=1` tries each single one.
"""

from __future__ import annotations

import errno
import functools
import json
import os
import shutil
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

import pytest
from support import crashes
from support.crashes import Operation, before_each, contents, killed, recorded, run, sample
from support.marks import LONG

from urdfsync import render
from urdfsync.state import operations
from urdfsync.state.batch import find_phase

LADDER = "modelica/Ladder"
RECORD = f"{LADDER}/Elements/C2Parameters.mo"
REMOVED = f"{LADDER}/Elements/R2.mo"
ADDED = f"{LADDER}/Elements/R3.mo"
MANIFEST = ".urdfsync/robots/ladder.toml"
RENDERER = render.Renderer
MINE = b"\n// mine\n"

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork on this system")

Contents = Mapping[str, bytes | None]


def edit(path: Path, old: str, new: str) -> None:
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


@pytest.fixture(autouse=True)
def _templates_compiled_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Hundreds of builds, also in forked processes, share their compiled templates."""
    monkeypatch.setattr(render, "Renderer", _renderer)


@functools.cache
def _compiled(folders: tuple[Path, ...]) -> render.Renderer:
    return RENDERER(folders)


def _renderer(folders: Sequence[Path]) -> render.Renderer:
    return _compiled(tuple(folders))


@pytest.fixture(autouse=True)
def _no_waiting_for_the_disk(monkeypatch: pytest.MonkeyPatch) -> None:
    """Only a power failure makes a difference between what is on the disk and what the system says is there."""
    monkeypatch.setattr(operations, "sync", lambda paths: None)


@pytest.fixture
def changed(project: Path) -> Path:
    """A network that was built and edited, and whose source has changed then in every way."""
    run(project)
    edit(project / LADDER / "Elements/C1.mo", "end C1;", "// mine\nend C1;")
    (project / LADDER / "Bench.mo").write_text("within Ladder;\nmodel Bench\nend Bench;\n")
    edit(project / LADDER / "package.order", "Ladder\n", "Bench\nLadder\n")
    edit(project / "ladder.json", '"R2"', '"R3"')
    edit(project / "ladder.json", "220.5", "330")
    edit(project / "ladder.json", "4.7e-6", "1e-5")
    edit(project / "step.csv", "0.1,5", "0.1,7")
    return project


@pytest.fixture
def renamed(project: Path) -> Path:
    """A network with a conflict that the user has settled by hand, and an edited element that has another name now."""
    run(project)
    record = project / LADDER / "Elements/R1Parameters.mo"
    edit(record, "100", "101")
    edit(project / "ladder.json", "100", "150")
    assert run(project).conflicts
    edit(record, "101", "150")
    edit(project / LADDER / "Elements/C1.mo", "end C1;", "// mine\nend C1;")
    edit(project / "ladder.json", '"C1"', '"Tank"')
    return project


@pytest.fixture
def first(project: Path) -> Path:
    """A network that was never built."""
    return project


@pytest.fixture
def moved(project: Path) -> Path:
    """A network whose package has another name and another parent now."""
    run(project)
    with (project / "urdfsync.toml").open("a") as file:
        file.write("create_parents = true\n")
    edit(project / "urdfsync.toml", '"Ladder"', '"Plant.Filters.Ladder"')
    return project


@pytest.fixture(params=["changed", "first", "moved", "renamed"])
def scenario(request: pytest.FixtureRequest) -> Path:
    path: Path = request.getfixturevalue(request.param)
    return path


def expected(project: Path, work: Path, before: Callable[[Path], object] = lambda project: None) -> Contents:
    """What an undisturbed build makes of the project."""
    clean = crashes.copy(project, work)
    before(clean)
    assert not run(clean).failed
    assert run(clean).in_step
    return contents(clean)


CHANGES = ("keep", "exchange", "place", "replace")
"""Operations on targets, and between the phases of a batch."""


def every(project: Path, work: Path, names: Sequence[str] = crashes.NAMES) -> Iterator[tuple[Operation, Path]]:
    """Operations of a build of the project, of these names, and for each a copy of the project."""
    found = recorded(crashes.copy(project, work))
    for operation in sample([operation for operation in found if operation.name in names]):
        yield operation, crashes.copy(project, work)


def assert_healed(project: Path, wanted: Contents, operation: Operation) -> None:
    """The next build does all that there is to do, without a conflict, and leaves nothing behind."""
    result = run(project)
    assert not result.failed, (operation, result.diagnostics)
    assert result.conflicts == [], operation
    assert contents(project) == wanted, operation


# Kills


def test_a_killed_build_is_finished_by_the_next(scenario: Path, tmp_path: Path) -> None:
    wanted = expected(scenario, tmp_path / "clean")
    for operation, project in every(scenario, tmp_path / "work"):
        assert killed(project, operation.number)
        assert_healed(project, wanted, operation)


def test_a_build_killed_in_the_middle_of_a_file_is_finished_by_the_next(changed: Path, tmp_path: Path) -> None:
    wanted = expected(changed, tmp_path / "clean")
    for operation, project in every(changed, tmp_path / "work", ["write"]):
        assert killed(project, operation.number, half=True)
        assert_healed(project, wanted, operation)


@pytest.mark.parametrize("missing", ["links", "renames"])
def test_killed_builds_on_lesser_file_systems(
    changed: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, missing: str
) -> None:
    def refuse(*paths: Path, **options: bool) -> None:
        raise PermissionError(errno.EPERM, os.strerror(errno.EPERM))

    if missing == "links":
        monkeypatch.setattr(os, "link", refuse)
    monkeypatch.setattr(operations, "_rename", lambda path, target, flag: False)
    wanted = expected(changed, tmp_path / "clean")
    for operation, project in every(changed, tmp_path / "work", CHANGES):
        assert killed(project, operation.number)
        assert_healed(project, wanted, operation)


def test_a_recovery_may_be_killed_too(changed: Path, tmp_path: Path) -> None:
    wanted = expected(changed, tmp_path / "clean")
    found = [op for op in recorded(crashes.copy(changed, tmp_path / "work")) if op.name in ("exchange", "place")]
    crashed = crashes.copy(changed, tmp_path / "crashed")
    assert killed(crashed, found[len(found) // 2].number)
    for operation, project in every(crashed, tmp_path / "work"):
        killed(project, operation.number)
        assert_healed(project, wanted, operation)


def test_an_undo_may_be_killed_too(changed: Path, tmp_path: Path) -> None:
    """Undone it is because the user edits what had still to be written."""
    replaced = [op for op in recorded(crashes.copy(changed, tmp_path / "work")) if op.name == "exchange"]
    crashed = crashes.copy(changed, tmp_path / "crashed")
    assert killed(crashed, replaced[-1].number)
    wanted = expected(changed, tmp_path / "clean")
    target = replaced[-1].paths[1].relative_to(tmp_path / "work")
    assert target.as_posix() == MANIFEST
    (crashed / target).write_bytes((crashed / target).read_bytes() + b"# mine\n")
    for operation, project in every(crashed, tmp_path / "work"):
        killed(project, operation.number)
        assert not run(project).failed, operation
        assert run(project).in_step
        assert contents(project) == wanted, operation


def test_what_the_user_does_after_a_crash_is_kept(changed: Path, tmp_path: Path) -> None:
    """An edit of a file that was written already is one of the new text: no conflict."""
    clean = crashes.copy(changed, tmp_path / "clean")
    run(clean)
    for path in (RECORD, f"{LADDER}/Ladder.mo"):
        new = (clean / path).read_bytes()
        for operation, project in every(changed, tmp_path / "work", (*CHANGES, "sync")):
            assert killed(project, operation.number)
            was_new = (project / path).read_bytes() == new
            (project / path).write_bytes((project / path).read_bytes() + MINE)
            mine = (project / path).read_bytes()
            result = run(project)
            assert (project / path).read_bytes() == mine, operation
            assert not result.failed
            assert bool(result.conflicts) is not was_new, operation
            assert run(project).conflicts == result.conflicts


def test_a_source_that_changes_after_a_crash(changed: Path, tmp_path: Path) -> None:
    def change(project: Path) -> None:
        edit(project / "ladder.json", "1e-5", "2e-5")
        edit(project / "ladder.json", '"R3"', '"R4"')

    wanted = expected(changed, tmp_path / "clean", change)
    for operation, project in every(changed, tmp_path / "work", CHANGES):
        killed(project, operation.number)
        change(project)
        assert_healed(project, wanted, operation)


@pytest.mark.slow
@pytest.mark.long
def test_a_robot_with_thirty_joints(tmp_path: Path) -> None:
    project = tmp_path / "project"
    project.mkdir()
    (project / "urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\ncross_check = false\n')
    (project / "arm.urdf").write_text(chain(30))
    run(project)
    edited = project / "modelica/Arm/Joints/J7.mo"
    edited.write_bytes(edited.read_bytes() + MINE)
    (project / "arm.urdf").write_text(chain(31).replace('mass value="1.0"', 'mass value="1.5"'))
    wanted = expected(project, tmp_path / "clean")
    assert str(wanted["modelica/Arm/Joints/J7.mo"]).count("// mine") == 1
    for operation, copied in every(project, tmp_path / "work"):
        assert killed(copied, operation.number)
        assert_healed(copied, wanted, operation)


def chain(joints: int) -> str:
    inertial = '<inertial><mass value="1.0"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
    links = "".join(f'<link name="l{number}">{inertial}</link>' for number in range(joints + 1))
    moving = "".join(
        f'<joint name="j{number}" type="continuous"><parent link="l{number}"/><child link="l{number + 1}"/></joint>'
        for number in range(joints)
    )
    return f'<robot name="chain">{links}{moving}</robot>'


# Errors of the system


FALLIBLE = [name for name in crashes.NAMES if name != "remove_folder"]  # which passes over every error


@pytest.mark.parametrize("number", [errno.ENOSPC, pytest.param(errno.EACCES, marks=LONG)])
@pytest.mark.parametrize("lasting", [False, True])
def test_a_system_that_refuses_leaves_all_as_it_was(changed: Path, tmp_path: Path, number: int, lasting: bool) -> None:
    before, wanted = contents(changed), expected(changed, tmp_path / "clean")
    for operation, project in every(changed, tmp_path / "work", FALLIBLE):

        def refuse(found: Operation, first: int = operation.number) -> None:
            if found.number == first or (lasting and found.number > first):
                raise OSError(number, os.strerror(number), str(found.paths[0]) if found.paths else None)

        with before_each(refuse):
            result = run(project)
        assert result.failed, operation
        assert any(os.strerror(number) in found.message for found in result.diagnostics)
        assert result.unfinished or contents(project) == before, operation
        assert lasting or not result.unfinished or find_phase(project / ".urdfsync"), operation
        assert_healed(project, wanted, operation)


def test_an_interrupt_leaves_all_as_it_was(changed: Path, tmp_path: Path) -> None:
    before, wanted = contents(changed), expected(changed, tmp_path / "clean")
    for operation, project in every(changed, tmp_path / "work"):

        def interrupt(found: Operation, first: int = operation.number) -> None:
            if found.number == first:
                raise KeyboardInterrupt

        with before_each(interrupt), pytest.raises(KeyboardInterrupt):
            run(project)
        left = find_phase(project / ".urdfsync")
        assert left or contents(project) in (before, wanted), operation
        assert_healed(project, wanted, operation)


# Saves in the instant of the change


def in_place(path: Path, content: bytes) -> None:
    path.write_bytes(content)


def by_renaming(path: Path, content: bytes) -> None:
    beside = path.with_name("editor~")
    beside.write_bytes(content)
    beside.replace(path)


@pytest.mark.parametrize("save", [in_place, by_renaming])
@pytest.mark.parametrize("path", [RECORD, REMOVED, ADDED, f"{LADDER}/Ladder.mo"])
def test_a_save_between_plan_and_replacement_survives(
    changed: Path, tmp_path: Path, path: str, save: Callable[[Path, bytes], None]
) -> None:
    """The result is that of a save before the build, or of one after it."""

    def saved(project: Path) -> bytes:
        target = project / path
        content = (target.read_bytes() if target.exists() else b"") + MINE
        save(target, content)
        return content

    early = crashes.copy(changed, tmp_path / "early")
    saved(early)
    run(early)
    late = crashes.copy(changed, tmp_path / "late")
    run(late)
    saved(late)
    outcomes = (contents(early), contents(late))
    for operation, project in every(changed, tmp_path / "work", (*CHANGES, "remove", "sync")):
        mine = b""

        def meddle(found: Operation, first: int = operation.number, project: Path = project) -> None:
            nonlocal mine
            if found.number == first:
                mine = saved(project)

        with before_each(meddle):
            result = run(project)
        assert not result.failed
        assert (project / path).read_bytes() == mine, operation
        assert contents(project) in outcomes, operation


def test_a_save_in_the_instant_of_a_kill_survives(changed: Path, tmp_path: Path) -> None:
    """The file has been exchanged already, and nobody has seen yet what for."""
    exchanges = [op for op in recorded(crashes.copy(changed, tmp_path / "work")) if op.name == "exchange"]
    for path in (RECORD, f"{LADDER}/Ladder.mo"):
        project = crashes.copy(changed, tmp_path / "work")
        mine = (project / path).read_bytes() + MINE
        (number,) = (op.number for op in exchanges if op.paths[1] == project / path)

        def save(found: Operation, number: int = number, target: Path = project / path, mine: bytes = mine) -> None:
            if found.number == number:
                by_renaming(target, mine)

        assert killed(project, number + 1, earlier=save)
        assert (project / path).read_bytes() != mine
        assert run(project).conflicts
        assert (project / path).read_bytes() == mine


def test_a_file_that_is_saved_all_the_time_stops_the_build(changed: Path) -> None:
    before = contents(changed)
    target, texts = changed / RECORD, iter(range(1000))
    original = target.read_bytes()

    def meddle(found: Operation) -> None:
        if found.name == "keep" and found.paths[0] == target:
            target.write_bytes(MINE * (next(texts) + 1))

    def restore(found: Operation) -> None:
        meddle(found)
        if found.name == "remove" and found.paths[0].parent.name == "journal":
            target.write_bytes(original)

    with before_each(restore):
        result = run(changed)
    assert [found.code for found in result.diagnostics] == ["restless"]
    assert contents(changed) == before


# What is found after a crash


@pytest.fixture
def crashed(changed: Path, tmp_path: Path) -> Path:
    """The changed network after a build that was killed when half of its files were in place."""
    swaps = [op for op in recorded(crashes.copy(changed, tmp_path / "work")) if op.name == "exchange"]
    assert killed(changed, swaps[len(swaps) // 2].number)
    assert find_phase(changed / ".urdfsync") == "apply"
    return changed


def test_what_was_recovered_is_said(crashed: Path) -> None:
    codes = [(found.code, found.message) for found in run(crashed).diagnostics]
    assert codes[0] == ("recovered", "the last build of robot `ladder` was interrupted; it is finished")


def test_a_dry_run_says_that_a_build_was_interrupted(crashed: Path) -> None:
    before = contents(crashed)
    result = run(crashed, dry=True)
    assert [found.code for found in result.diagnostics] == ["interrupted"]
    assert result.failed
    assert contents(crashed) == before


def test_another_robot_recovers_as_well(crashed: Path) -> None:
    shutil.move(crashed / "ladder.json", crashed / "other.json")
    text = (crashed / "urdfsync.toml").read_text()
    (crashed / "urdfsync.toml").write_text(text.replace("ladder", "other").replace('"Ladder"', '"Other"'))
    result = run(crashed)
    assert {"recovered", "stray-state"} == {found.code for found in result.diagnostics}
    assert "R3" in (crashed / LADDER / "Elements/package.order").read_text()
    assert find_phase(crashed / ".urdfsync") is None


def test_a_journal_can_not_reach_files_elsewhere(crashed: Path, tmp_path: Path) -> None:
    victim = tmp_path / "victim.mo"
    victim.write_text("precious")
    journal = crashed / ".urdfsync/journal/apply.json"
    journal.write_text(journal.read_text().replace("modelica/Ladder/Elements/R3.mo", "../victim.mo"))
    result = run(crashed)
    assert [found.code for found in result.diagnostics] == ["outside"]
    assert victim.read_text() == "precious"


def test_a_journal_that_cant_be_read_is_named(crashed: Path) -> None:
    (crashed / ".urdfsync/journal/apply.json").write_text("{")
    before = contents(crashed)
    result = run(crashed)
    assert [(found.code, found.file) for found in result.diagnostics] == [
        ("broken-journal", str(Path(".urdfsync/journal/apply.json")))
    ]
    assert contents(crashed) == before


def test_a_journal_that_the_power_failure_has_cut_short_costs_nothing(changed: Path, tmp_path: Path) -> None:
    wanted = expected(changed, tmp_path / "clean")
    found = recorded(crashes.copy(changed, tmp_path / "work"))
    prepared = next(op for op in found if op.name == "sync")
    assert killed(changed, prepared.number)
    (changed / ".urdfsync/journal/prepare.json").write_bytes(b"")
    assert list(changed.rglob("*.urdfsync-tmp"))
    assert_healed(changed, wanted, prepared)


@pytest.fixture
def output(project: Path, tmp_path: Path) -> Iterator[Path]:
    """Where the package of the network is built to: a folder on another file system."""
    memory = Path("/dev/shm")
    if not memory.is_dir() or memory.stat().st_dev == tmp_path.stat().st_dev:
        pytest.skip("there is no second file system")
    output = memory / f"urdfsync-{os.getpid()}"
    output.mkdir()
    edit(project / "urdfsync.toml", "[robots.ladder]", f'[robots.ladder]\noutput = "{output}"')
    try:
        yield output
    finally:
        shutil.rmtree(output)


def test_files_on_another_file_system_are_kept_by_copying(project: Path, output: Path) -> None:
    run(project)
    edit(project / "ladder.json", '"R2"', '"R3"')
    swaps = [operation for operation in recorded(project) if operation.name == "exchange"]
    edit(project / "ladder.json", '"R3"', '"R4"')
    assert killed(project, swaps[-1].number)
    assert [found.code for found in run(project).diagnostics] == ["recovered"]
    assert {path.name for path in (output / "Ladder/Elements").iterdir()} >= {"R4.mo", "R4Parameters.mo"}
    assert not (output / "Ladder/Elements/R3.mo").exists()
    edit(project / "ladder.json", '"R4"', '"R5"')
    before = contents(output)
    assert killed(project, swaps[-1].number)
    (output / "Ladder/Elements/C1.mo").write_bytes(MINE)
    manifest = project / MANIFEST
    manifest.write_bytes(manifest.read_bytes() + b"# mine\n")
    with before_each(stop_at("make_folder")), pytest.raises(KeyboardInterrupt):
        run(project)
    assert contents(output) == {**before, "Ladder/Elements/C1.mo": MINE}


@pytest.fixture(params=["another file system", "another mount"])
def far(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch, project: Path, output: Path) -> Path:
    """A network that is built to a folder to which nothing can be moved, and whose source has changed then.

    With a folder of the same file system that is mounted in another place, only the attempt tells.
    """
    if request.param == "another mount":
        monkeypatch.setattr(operations, "makes_alike", lambda folder, other: True)
    run(project)
    edit(project / "ladder.json", '"R2"', '"R3"')
    edit(project / "ladder.json", "4.7e-6", "1e-5")
    return project


def test_killed_builds_of_files_that_nothing_can_be_moved_to(far: Path, output: Path, tmp_path: Path) -> None:
    built = crashes.copy(output, tmp_path / "built")
    record = output / "Ladder/Elements/C2Parameters.mo"  # one of two files that are replaced in that folder
    clean = crashes.copy(far, tmp_path / "clean")
    found = recorded(clean)
    wanted = contents(clean), contents(output)
    start = next(op.number for op in found if op.name == "keep" and op.paths[0] == record)
    end = next(op.number for op in found if op.name == "exchange" and op.number > start)
    change = [op for op in found if start <= op.number <= end + 1]
    for operation in found if os.environ.get(crashes.ALL) else change:
        project = crashes.copy(far, tmp_path / "work")
        crashes.copy(built, output)
        assert killed(project, operation.number)
        result = run(project)
        assert not result.failed, operation
        assert result.conflicts == [], operation
        assert (contents(project), contents(output)) == wanted, operation


def test_a_save_of_a_file_that_nothing_can_be_moved_to_survives(far: Path, output: Path, tmp_path: Path) -> None:
    built, order = crashes.copy(output, tmp_path / "built"), output / "Ladder/Elements/package.order"
    found = recorded(crashes.copy(far, tmp_path / "work"))
    for last in [one for one in found if one.name in ("exchange", "replace") and one.paths[1] == order]:
        project = crashes.copy(far, tmp_path / "work")
        crashes.copy(built, output)

        def meddle(found: Operation, number: int = last.number) -> None:
            if found.number == number:
                by_renaming(order, order.read_bytes() + b"Mine\n")

        with before_each(meddle):
            assert not run(project).failed
        assert b"Mine" in order.read_bytes(), last
        assert not list(output.rglob("*.urdfsync-tmp"))


def test_what_an_older_urdfsync_has_left_is_finished(
    changed: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It wrote each temporary file beside its target, and took no notice of what stands apart."""
    wanted = expected(changed, tmp_path / "clean")
    for operation, project in every(changed, tmp_path / "work", ("exchange", "place")):
        with monkeypatch.context() as older:
            older.setattr(operations, "makes_alike", lambda folder, other: False)
            assert killed(project, operation.number)
        (file,) = (project / ".urdfsync/journal").iterdir()
        edit(file, '"format":2', '"format":1')
        journal = json.loads(file.read_bytes())
        names = [f".{journal['token']}-{number}.urdfsync-tmp" for number in range(len(journal["steps"]))]
        for name in names:
            (project / ".urdfsync/undo" / name).write_bytes(b"of another batch, whose journal was deleted")
        assert not run(project).failed
        for name in names:
            (project / ".urdfsync/undo" / name).unlink()
        assert_healed(project, wanted, operation)


def stop_at(name: str) -> Callable[[Operation], None]:
    def hook(found: Operation) -> None:
        if found.name == name:
            raise KeyboardInterrupt

    return hook
