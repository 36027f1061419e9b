"""`urdfsync record`: one record, without a project, into a terminal, a pipe or a file that nobody loses."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from support.commands import Execute
from support.golden import golden
from support.screen import Terminal

pytestmark = pytest.mark.usefixtures("folder")

REPOSITORY = Path(__file__).parents[2]
TWIG = REPOSITORY / "tests/golden/twig.urdf"
BUOY = REPOSITORY / "modelica/UrdfSync/Resources/robots/floating_buoy/floating_buoy.urdf"
FAULTY = '<robot name="own">\n  <link name="base"/>\n  <link name="base"/>\n</robot>\n'


def test_the_record_is_that_of_a_package(execute: Execute) -> None:
    said = execute("record", TWIG, "--within", "Zoo.Twig", "--class", "TwigParameters")
    assert said.out == golden("record").texts["TwigParameters.mo"]
    assert "mimic-of-fixed" in said.err


def test_a_record_on_its_own_names_the_libraries_that_it_uses(execute: Execute) -> None:
    uses = '    uses(\n      Modelica(version="4.0.0"),\n      UrdfSync(version="1.0.0")),\n    '
    inside = golden("record").texts["TwigParameters.mo"].replace("within Zoo.Twig;", "within ;", 1)
    assert execute("record", TWIG).out == inside.replace("  annotation (", f"  annotation (\n{uses}")


def test_what_a_model_leaves_out_is_told(execute: Execute) -> None:
    loop = '<loop_joint name="bar" type="prismatic"><link1 link="world"/><link2 link="world"/></loop_joint>'
    Path("arm.urdf").write_text(f'<robot name="arm"><link name="world"/>{loop}</robot>')
    said = execute("record", "arm.urdf")
    assert 'name = "arm"' in said.out
    assert "warning: loop bar has type='prismatic', which is no kind of loop" in said.words


def test_a_terminal_shows_the_same_text(execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
    piped = execute("record", TWIG, code=None).out
    screen = Terminal()
    monkeypatch.setattr(sys, "stdout", screen)
    execute("record", TWIG)
    assert screen.getvalue() == piped


@pytest.mark.skipif(sys.platform == "win32", reason="needs a POSIX shell")
def test_a_pipe_gets_utf_8_whatever_the_locale(folder: Path) -> None:
    source = folder / "own.urdf"
    source.write_text(TWIG.read_text().replace('name="twig"', 'name="Zweig ä"'), encoding="utf-8")
    environment = os.environ | {
        "LC_ALL": "C",
        "PYTHONUTF8": "0",
        "PYTHONCOERCECLOCALE": "0",
        "PYTHONPATH": str(REPOSITORY),
    }
    command = [sys.executable, "-m", "urdfsync", "record", str(source)]
    done = subprocess.run(command, env=environment, capture_output=True, check=True)
    assert 'name = "Zweig ä"' in done.stdout.decode("utf-8")
    assert b"\r" not in done.stdout


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["-o", "Branch.mo"], "Branch"),
        (["-o", "my-branch.mo"], "TwigParameters"),
        (["-o", "Branch.mo", "--class", "Stick"], "Stick"),
        (["--class", "Stick"], "Stick"),
        ([], "TwigParameters"),
    ],
)
def test_the_class_is_called_as_asked_or_like_its_file(
    execute: Execute, arguments: list[str], expected: str, folder: Path
) -> None:
    out = execute("record", TWIG, "--within", "Plant", *arguments).out
    file = folder / arguments[1] if arguments[:1] == ["-o"] else None
    text = file.read_text() if file else out
    assert text.startswith(f"within Plant;\n\nrecord {expected} ")


def test_a_file_is_written_once(folder: Path, execute: Execute) -> None:
    assert execute("record", TWIG, "-o", "Twig.mo").lines == ["Twig.mo written: record Twig"]
    assert [path.name for path in folder.iterdir()] == ["Twig.mo"], "nothing else is left behind"
    assert execute("record", TWIG, "-o", "Twig.mo").lines == ["Twig.mo unchanged: record Twig"]
    (folder / "Twig.mo").write_bytes((folder / "Twig.mo").read_bytes().replace(b"\n", b"\r\n"))
    execute("record", TWIG, "-o", "Twig.mo", "--quiet")
    assert b"\r\n" in (folder / "Twig.mo").read_bytes()
    out = execute("record", TWIG, "-o", "-").out
    assert execute("record", TWIG).out == out, "a dash is the standard output"


def test_what_is_in_a_file_is_not_lost_unless_one_says_so(execute: Execute, folder: Path) -> None:
    file = folder / "Twig.mo"
    file.write_text("model Twig end Twig;")
    assert execute("record", TWIG, "-o", "Twig.mo", code=2).errors[-1] == (
        "Twig.mo: error: the file exists, and holds something else; name another file, or replace this one "
        "with --force [file-exists]"
    )
    assert file.read_text() == "model Twig end Twig;"
    execute("record", TWIG, "-o", "Twig.mo", "--force")
    assert "record Twig" in file.read_text()


@pytest.mark.parametrize("name", ["own.urdf", "link.mo"])
def test_the_source_is_never_replaced(execute: Execute, name: str, folder: Path) -> None:
    source = folder / "own.urdf"
    source.write_bytes(TWIG.read_bytes())
    (folder / "link.mo").symlink_to(source)
    assert execute("record", source, "-o", name, "--force", code=2).errors[-1] == (
        f"{name}: error: the source has this name; name another file [output-not-writable]"
    )
    assert source.read_bytes() == TWIG.read_bytes()


@pytest.mark.skipif(sys.platform == "win32", reason="links need rights there")
def test_a_link_stays_a_link(execute: Execute, folder: Path) -> None:
    (folder / "Real.mo").write_text("old")
    (folder / "Twig.mo").symlink_to("Real.mo")
    execute("record", TWIG, "-o", "Twig.mo", "--force")
    assert (folder / "Twig.mo").is_symlink()
    assert "record Twig" in (folder / "Real.mo").read_text()


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["lost.urdf"], "lost.urdf: error: the source can't be read: No such file or directory; name an existing"),
        ([TWIG, "-o", "lost/Twig.mo"], "lost/Twig.mo: error: there is no such folder; make it first"),
        ([TWIG, "-o", "."], ".: error: a folder is in its place; name a file"),
        ([TWIG, "--class", "twig"], "error: 'twig' can't be a class; choose a name that begins with a capital"),
        ([TWIG, "--within", "Plant.end"], "error: 'Plant.end' can't be a package; name a package like Plant.Robots"),
        ([TWIG, "--within", "Modelica"], "error: 'Modelica' can't be a package; name a package like Plant.Robots"),
        ([TWIG, "--domain", "urfd"], "error: "),
    ],
)
def test_mistakes_are_one_line(arguments: list[object], said: str, folder: Path, execute: Execute) -> None:
    found = [line for line in execute("record", *arguments, code=2).errors if "warning" not in line]
    assert len(found) == 1
    assert found[0].startswith(said)
    assert not list(folder.iterdir())


def test_a_faulty_source_is_told_with_its_line(folder: Path, execute: Execute) -> None:
    (folder / "own.urdf").write_text(FAULTY)
    assert "own.urdf:3: error: " in execute("record", "own.urdf", "-o", "Own.mo", code=2).err
    assert not (folder / "Own.mo").exists()


def test_a_robot_without_tables_is_written_with_a_warning(execute: Execute) -> None:
    said = execute("record", BUOY)
    assert "jointTree" not in said.out
    assert "floating_buoy.urdf:25: warning: joint 'drift' is floating; the generic robot has no such joints" in said.err


def test_a_domain_without_a_record_says_so(rc_domain: None, execute: Execute) -> None:
    ladder = REPOSITORY / "tests/rcnetwork/examples/ladder.json"
    assert execute("record", ladder, "--domain", "rcnetwork", code=2).err == (
        "error: the domain `rcnetwork` has no record approach; use `urdfsync build` [no-record]\n"
    )
