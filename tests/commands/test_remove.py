"""`urdfsync remove`: a robot leaves with what urdfsync wrote for it, and with nothing else."""

from __future__ import annotations

import contextlib
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from support import crashes
from support.commands import Execute
from support.files import unchanged
from support.networks import ROBOT, edit

from urdfsync.commands import cli
from urdfsync.modelica.stamp import split

REMOVE = ("remove", "filter", "--yes")
FILTER = "modelica/Plant/Filter"


@pytest.fixture
def plant(project: Path, execute: Execute) -> Path:
    """A project with two robots that were built, one of them inside of a package of the user's."""
    (project / "modelica/Plant").mkdir(parents=True)
    (project / "modelica/Plant/package.mo").write_text("package Plant\nend Plant;\n")
    (project / "modelica/Plant/package.order").write_text("Mine\n")
    with (project / "urdfsync.toml").open("a") as file:
        file.write("\n# in the plant\n" + ROBOT.format("filter", "Plant.Filter") + "# prefix = 1\n\n# the end\n")
    execute("build", "-q")
    return project


def test_a_robot_leaves(plant: Path, execute: Execute) -> None:
    before = (plant / "urdfsync.toml").read_text()
    printed = execute(*REMOVE)
    assert printed.lines == [
        "filter: removed; 1 file written; 14 deleted",
        f"  delete     {FILTER}/Elements/C1.mo",
        *printed.lines[2:15],
        "  update     modelica/Plant/package.order",
    ]
    assert not (plant / FILTER).exists()
    assert (plant / "modelica/Plant/package.order").read_text() == "Mine\n"
    assert [path.name for path in (plant / ".urdfsync/robots").iterdir()] == ["ladder.state"]
    begin, end = before.index("# in the plant"), before.index("# the end")
    assert (plant / "urdfsync.toml").read_text() == before[:begin] + before[end:]
    assert execute("build").lines == ["ladder: in step, 14 files"]


def test_edited_files_and_what_the_users_files_need_stay_and_are_named(plant: Path, execute: Execute) -> None:
    edit(f"{FILTER}/Elements/C1.mo", "end C1;", "// mine\nend C1;")
    Path(f"{FILTER}/Bench.mo").write_text("within Plant.Filter;\nmodel Bench\n  Elements.R1 r;\nend Bench;\n")
    with unchanged(plant):
        printed = execute("remove", "filter", "--dry-run")
    assert [line for line in printed.lines if line.endswith("kept")] == [
        f"  orphan     {FILTER}/Elements/C1.mo  no longer generated, but you edited it; kept",
        f"  orphan     {FILTER}/Elements/C1Parameters.mo  no longer generated, but your files need it; kept",
        f"  orphan     {FILTER}/Elements/package.mo  no longer generated, but your files need it; kept",
        f"  orphan     {FILTER}/package.mo  no longer generated, but your files need it; kept",
    ]
    assert f"{FILTER}/Bench.mo:3: warning: there is no class `Elements.R1`" in printed.words
    execute(*REMOVE)
    assert "// mine" in Path(f"{FILTER}/Elements/C1.mo").read_text()
    assert Path(f"{FILTER}/Elements/package.order").read_text() == "C1Parameters\nC1\n"
    assert Path("modelica/Plant/package.order").read_text() == "Mine\nFilter\n"


def test_the_source_may_be_gone(plant: Path, execute: Execute) -> None:
    (plant / "ladder.json").unlink()
    execute(*REMOVE)
    assert not (plant / FILTER).exists()


def test_a_package_that_was_to_move_goes_from_its_old_place(plant: Path, execute: Execute) -> None:
    edit("urdfsync.toml", '"Plant.Filter"', '"Plant.Other"')
    execute(*REMOVE)
    assert not (plant / FILTER).exists()


def test_a_text_that_another_machine_generated_goes_and_a_copy_is_put_aside(plant: Path, execute: Execute) -> None:
    """It has a base, but no source shows that it was generated: it may be a person's."""
    shutil.rmtree(plant / ".urdfsync/notes")
    state = plant / ".urdfsync/robots/filter.state"
    lines = state.read_text().splitlines(keepends=True)
    state.write_text("".join(line for line in lines if not line.startswith("model ")))
    text, _ = split((plant / FILTER / "Filter.mo").read_text())
    execute(*REMOVE)
    assert not (plant / FILTER / "Filter.mo").exists()
    assert text in [path.read_text() for path in (plant / ".urdfsync/aside").rglob("*") if path.is_file()]


def test_without_a_terminal_it_wants_a_word(plant: Path, execute: Execute) -> None:
    with unchanged(plant):
        printed = execute("remove", "filter", code=2)
        assert printed.lines[0].startswith("filter: its table in urdfsync.toml goes")
        assert printed.errors == [
            "error: nothing was removed: there is no terminal to ask on; look at what is shown, then give --yes "
            "[not-confirmed]"
        ]
        assert execute("remove", "filter", "--format=json", code=2).json["results"][0]["actions"]
        assert "'modelica' means 2 robots: name one" in execute("remove", "modelica", "--yes", code=2).err
        assert "did you mean `filter`?" in execute("remove", "filtre", "--yes", code=2).err


@pytest.mark.skipif(sys.platform == "win32", reason="no terminals of POSIX")
@pytest.mark.parametrize(("answer", "stays"), [("y", False), ("", True)])
def test_a_terminal_is_asked(plant: Path, rc_site: Path, answer: str, stays: bool) -> None:
    import pty

    main, terminal = pty.openpty()
    paths = [str(rc_site), *sys.path]
    code = f"import sys; sys.path[:0] = {paths}; from urdfsync.commands import cli; sys.exit(cli.main())"
    command = [sys.executable, "-c", code, "remove", "filter"]
    with subprocess.Popen(command, stdin=terminal, stdout=subprocess.PIPE, text=True) as process:
        os.write(main, f"{answer}\n".encode())
        assert process.stdout is not None
        assert "Remove it? [y/N] " in process.stdout.read()
    assert process.returncode == 0
    assert (plant / FILTER).exists() == stays
    os.close(main)
    os.close(terminal)


def test_the_last_robot_may_leave_and_another_one_join(project: Path, execute: Execute) -> None:
    assert execute("remove", "ladder", "--yes").lines == ["ladder: removed"]
    assert (project / "urdfsync.toml").read_text() == ""
    (error,) = execute("build", code=2).errors
    assert error.startswith("urdfsync.toml: error: the configuration has no robot; add one with `urdfsync add SOURCE`")
    execute("add", "--domain", "rcnetwork", "ladder.json", "-q")
    execute("build", "-q")


def test_a_robot_without_a_table_stays(project: Path, execute: Execute) -> None:
    values = '{ domain = "rcnetwork", source = "ladder.json", package = "Ladder" }'
    (project / "urdfsync.toml").write_text(f"robots = {{ ladder = {values} }}\n")
    with unchanged(project):
        assert "`ladder` is no table `[robots.ladder]`" in execute("remove", "ladder", "--yes", code=2).err


def test_what_the_document_says(plant: Path, execute: Execute) -> None:
    (robot,) = execute(*REMOVE, "--format=json").json["results"]
    assert {action["kind"] for action in robot["actions"]} == {"delete", "write"}
    assert not (plant / FILTER).exists()


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork on this system")
def test_a_removal_that_was_killed_goes_on(plant: Path, tmp_path: Path) -> None:
    """At each of its file operations until the configuration is written; what the user wrote is never lost."""
    edit(f"{FILTER}/Elements/C1.mo", "end C1;", "// mine\nend C1;")
    found: list[crashes.Operation] = []

    def remove(project: Path) -> int:
        with contextlib.chdir(project):
            return cli.main([*REMOVE, "-q"])

    clean = crashes.copy(plant, tmp_path / "clean")
    with crashes.before_each(found.append):
        assert remove(clean) == 0
    found = found[: next(place for place, one in enumerate(found) if clean / "urdfsync.toml" in one.paths)]
    for operation in found[:: max(1, len(found) // 20)]:
        work = crashes.copy(plant, tmp_path / "work")

        def kill(now: crashes.Operation, number: int = operation.number) -> None:
            if now.number == number:
                os.kill(os.getpid(), signal.SIGKILL)

        os.waitpid(crashes.forked(work, kill, remove), 0)
        assert remove(work) == 0
        assert crashes.contents(work) == crashes.contents(clean), operation


def test_what_is_saved_in_the_configuration_meanwhile_stays(plant: Path, execute: Execute) -> None:
    file = plant / "urdfsync.toml"
    saves = iter((f"# saved\n{file.read_text()}",))

    def save(found: crashes.Operation) -> None:
        if found.name == "exchange" and file in found.paths and (text := next(saves, "")):
            file.write_text(text)

    with crashes.before_each(save):
        assert "run the command again" in execute(*REMOVE, code=2).err
        execute(*REMOVE)
    assert file.read_text().startswith("# saved\n")
    assert "[robots.filter]" not in file.read_text()
