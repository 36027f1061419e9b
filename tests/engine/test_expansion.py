"""What can't be expanded is one error at its place, in bounded time; what a file may do meanwhile is limited."""

from __future__ import annotations

import gzip
import sys
import time
from pathlib import Path

import pytest
from support import xacros
from support.commands import Execute
from support.files import unchanged

from urdfsync.diagnostics import SourceError
from urdfsync.engine import expansion
from urdfsync.engine.expansion import Inputs, expand

ENDLESS = '<xacro:macro name="a"><xacro:a/></xacro:macro><xacro:a/>'
ESCAPE = "(lambda: [c for c in ().__class__.__base__.__subclasses__() if c.__name__ == '_wrap_close'][0])()"
MODULES = f"{ESCAPE}.__init__.__globals__['sys'].modules"
"""What an expression gets at that xacro does not mean to allow."""


def write(folder: Path, line: str, **files: str) -> Inputs:
    """Write a source whose second line is this one, with other files beside it."""
    for name, text in files.items():
        (folder / f"{name}.yaml").write_text(text)
    file = folder / "arm.urdf.xacro"
    file.write_text(f'{xacros.HEAD.format("arm")}{line}\n<link name="a"/>\n</robot>\n')
    return Inputs(folder, file, ())


def problem(inputs: Inputs) -> str:
    """The one error of an expansion."""
    with pytest.raises(SourceError) as error:
        expand(inputs, {})
    (found,) = error.value.diagnostics
    return str(found)


def value(expression: str) -> str:
    return f'<link name="b" mass="${{{expression}}}"/>'


@pytest.mark.parametrize(
    ("line", "message", "code"),
    [
        ('<link name="$(arg side)"/>', "the argument `side` is not set", "no-argument"),
        ('<xacro:include filename="$(find no_such_package)/a.xacro"/>', "no package `no_such_package`", "no-package"),
        ('<xacro:include filename="arm.urdf.xacro"/>', "includes or calls itself without end", "xacro"),
        (ENDLESS, "includes or calls itself without end", "xacro"),
        ('<xacro:include filename="gone.xacro"/>', "gone.xacro can't be read: No such file or directory", "xacro"),
        (value("nothing"), "name 'nothing' is not defined", "xacro"),
        (value("1 +"), "invalid syntax", "xacro"),
        ("<xacro:leg/>", "unknown macro name: xacro:leg", "xacro"),
        ('<link name="$(env NO_SUCH_VARIABLE)"/>', "environment variable 'NO_SUCH_VARIABLE' is not set", "xacro"),
        (value("xacro.fatal('no such tool')"), "no such tool", "xacro"),
    ],
)
def test_an_error_is_told_at_its_line(folder: Path, line: str, message: str, code: str) -> None:
    found = problem(write(folder, line))
    assert found.startswith("arm.urdf.xacro:2: error: ")
    assert message in found
    assert found.endswith(f" [{code}]")


def test_an_error_in_an_included_file_is_told_there(folder: Path) -> None:
    inputs = write(folder, '<xacro:include filename="more.xacro"/>')
    more = folder / "more.xacro"
    more.write_text(f"{xacros.HEAD.format('more')}\n\n{value('nothing')}</robot>")
    assert problem(inputs).startswith("more.xacro:4: error: ")
    more.write_text("<robot>\n\n<link</robot>")
    assert problem(inputs).startswith("more.xacro:3: error: this is no XML: not well-formed")
    more.write_text("")
    assert problem(inputs).startswith("more.xacro:1: error: this is no XML: no element found")


@pytest.mark.parametrize(
    ("text", "line"),
    [("a: 1\nb: !!python/object/apply:os.system ['touch hacked']\n", 2), ("a: !thing 1\n", 1), ("a: [1\nb: 2\n", 2)],
)
def test_yaml_makes_no_objects(folder: Path, text: str, line: int) -> None:
    found = problem(write(folder, value("xacro.load_yaml('numbers.yaml')"), numbers=text))
    assert found.startswith(f"numbers.yaml:{line}: error: this YAML can't be used: ")
    assert not Path("hacked").exists()


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (gzip.compress(b"a: 1", mtime=0), "numbers.yaml:1: error: the file is packed by gzip"),
        ("a: é".encode("latin-1"), "numbers.yaml:1: error: this is not UTF-8; save it as UTF-8 [xacro]"),
    ],
)
def test_yaml_that_is_no_text_is_named(folder: Path, content: bytes, message: str) -> None:
    inputs = write(folder, value("xacro.load_yaml('numbers.yaml')['a']"))
    (folder / "numbers.yaml").write_bytes(content)
    assert problem(inputs).startswith(message)


def test_a_merge_conflict_is_told(folder: Path) -> None:
    found = problem(write(folder, "<<<<<<< HEAD\n<link/>\n=======\n>>>>>>> other"))
    assert (
        found
        == "arm.urdf.xacro:2: error: the file has merge conflict markers; resolve the merge, then build again "
        + ("[merge-conflict]")
    )


def test_the_folder_is_that_of_the_configuration(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    inputs = write(folder, '<link name="$(cwd)"/>')
    monkeypatch.chdir("/")
    assert f'name="{folder}"' in expand(inputs, {}).text


def test_units_of_yaml_are_read(folder: Path) -> None:
    found = expand(write(folder, value("xacro.load_yaml('numbers.yaml')['a']"), numbers="a: !degrees 180\n"), {})
    assert 'mass="3.14159' in found.text


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="it has no such limits")
@pytest.mark.parametrize(
    "expression", ["[i for i in range(10**15)]", "len('a' * 10**12)", "9**9**9**9", "[[0] * 10**8 for i in range(99)]"]
)
def test_an_endless_expression_is_ended(folder: Path, monkeypatch: pytest.MonkeyPatch, expression: str) -> None:
    monkeypatch.setattr(expansion, "CPU_SECONDS", 1.0)
    begin = time.monotonic()
    found = problem(write(folder, value(expression)))
    assert "arm.urdf.xacro:" in found
    assert "expanding it takes more than 1 s or 1 GB" in found
    assert time.monotonic() - begin < expansion.WALL_SECONDS


@pytest.mark.skipif(sys.platform == "win32", reason="it has no such limits")
def test_the_line_that_takes_too_long_is_told(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(expansion, "CPU_SECONDS", 0.5)
    inputs = write(folder, '<xacro:include filename="more.xacro"/>')
    endless = value("[0 for i in range(10**15) if i == -1]")
    (folder / "more.xacro").write_text(f"{xacros.HEAD.format('more')}\n\n{endless}</robot>")
    assert problem(inputs).startswith("more.xacro:4: error: expanding it takes more than 0.5 s")


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (gzip.compress(xacros.ARM.encode(), mtime=0), "packed by gzip; unpack it (`gunzip < FILE > ROBOT.urdf`)"),
        (b"PK\x03\x04zip", "a zip archive; unpack it (`unzip FILE`)"),
        (b"launch:\n- node:\n", "a launch file of ROS, not URDF; name the URDF or xacro file that it loads"),
        (b"version https://git-lfs.github.com/spec/v1\n", "a Git LFS pointer, not the robot; run `git lfs pull`"),
    ],
)
def test_what_is_no_xacro_is_called_what_it_is(folder: Path, content: bytes, message: str) -> None:
    inputs = write(folder, '<xacro:include filename="more.xacro"/>')
    for name in ("more.xacro", "arm.urdf.xacro"):
        (folder / name).write_bytes(content)
        found = problem(inputs)
        assert found.startswith(f"{name}:1: error: ")
        assert message in found


@pytest.mark.parametrize(
    ("call", "event"),
    [
        ("['os'].system('touch hacked')", "os.system"),
        ("['builtins'].open('hacked', 'w')", "open"),
        ("['os'].open('hacked', 65)", "open"),
        ("['os'].remove('arm.urdf.xacro')", "os.remove"),
        ("['builtins'].__import__('socket').create_connection(('127.0.0.1', 9))", "socket."),
        ("['builtins'].__import__('subprocess').run(['touch', 'hacked'])", "subprocess.Popen"),
    ],
)
def test_programs_network_and_writing_are_refused(folder: Path, call: str, event: str) -> None:
    found = problem(write(folder, value(f"(lambda: {MODULES}{call})()")))
    assert f"an expansion may not do this: {event}" in found
    assert sorted(path.name for path in folder.iterdir()) == ["arm.urdf.xacro"]


def test_what_it_prints_nothing_of_is_no_robot(folder: Path, execute: Execute) -> None:
    xacros.write(folder, {"arm.urdf.xacro": f"{xacros.HEAD.format('arm')}</robot>"}, xacros.CONFIG)
    with unchanged(folder):
        assert "urdf/arm.urdf.xacro:1: error: the robot has no link" in execute("build", code=2).err


def test_a_failed_expansion_leaves_the_package(folder: Path, execute: Execute) -> None:
    xacros.write(folder)
    execute("build")
    (folder / "urdf/masses.yaml").write_text("upper: [1\n")
    with unchanged(folder):
        assert "urdf/masses.yaml:2: error:" in execute("build", code=2).err
