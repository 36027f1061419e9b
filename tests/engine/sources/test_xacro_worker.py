"""What xacro can't expand is one error at its place, in whatever file that is."""

from __future__ import annotations

import gzip
import os
import sys
import time
from pathlib import Path

import pytest
from support import xacros
from support.xacros import problem, value, write_line

from urdfsync.engine.sources.expansion import expand

ENDLESS = '<xacro:macro name="a"><xacro:a/></xacro:macro><xacro:a/>'


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
    found = problem(write_line(folder, line))
    assert found.startswith("arm.urdf.xacro:2: error: ")
    assert message in found
    assert found.endswith(f" [{code}]")


def test_all_unset_arguments_are_named_at_once(folder: Path) -> None:
    (folder / "more.xacro").write_text(f"{xacros.HEAD.format('more')}<link name='$(arg tool)'/></robot>")
    declared = '<xacro:include filename="more.xacro"/><xacro:arg name="speed" default="1"/><!-- $(arg old) -->'
    found = problem(write_line(folder, f'{declared}<link name="$(arg speed)$(arg side)$(arg tool)"/>'))
    assert "more.xacro:2: error: the argument `tool` is not set, nor is `side`; set it in `arguments`" in found


def test_a_package_whose_files_are_elsewhere_once_installed_is_named(folder: Path) -> None:
    (folder / "package.xml").write_text("<package><name>cart</name></package>")
    found = problem(write_line(folder, '<xacro:include filename="$(find cart)/control/cart.xacro"/>'))
    assert found.startswith("arm.urdf.xacro:2: error: ")
    assert "cart.xacro can't be read" in found
    assert (
        "; if package `cart` has this file once it is installed, name the installed xacro file as source [xacro]"
        in found
    )


@pytest.mark.slow
def test_an_error_in_an_included_file_is_told_there(folder: Path) -> None:
    inputs = write_line(folder, '<xacro:include filename="more.xacro"/>')
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
    found = problem(write_line(folder, value("xacro.load_yaml('numbers.yaml')"), numbers=text))
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
    inputs = write_line(folder, value("xacro.load_yaml('numbers.yaml')['a']"))
    (folder / "numbers.yaml").write_bytes(content)
    assert problem(inputs).startswith(message)


def test_a_merge_conflict_is_told(folder: Path) -> None:
    found = problem(write_line(folder, "<<<<<<< HEAD\n<link/>\n=======\n>>>>>>> other"))
    assert (
        found
        == "arm.urdf.xacro:2: error: the file has merge conflict markers; resolve the merge, then build again "
        + ("[merge-conflict]")
    )


def test_the_folder_is_that_of_the_configuration(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    inputs = write_line(folder, '<link name="$(cwd)"/>')
    monkeypatch.chdir("/")
    assert f'name="{folder}"' in expand(inputs, {}).text


def test_units_of_yaml_are_read(folder: Path) -> None:
    found = expand(write_line(folder, value("xacro.load_yaml('numbers.yaml')['a']"), numbers="a: !degrees 180\n"), {})
    assert 'mass="3.14159' in found.text


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
    inputs = write_line(folder, '<xacro:include filename="more.xacro"/>')
    for name in ("more.xacro", "arm.urdf.xacro"):
        (folder / name).write_bytes(content)
        found = problem(inputs)
        assert found.startswith(f"{name}:1: error: ")
        assert message in found


@pytest.mark.parametrize(
    "line",
    [
        "<link name=\"$(eval ${'[c for c in [().__class__]])'}\"/>",
        '<link name="$(eval [c for c in [pi.__class__]])"/>',
        '<xacro:property name="__builtins__" value="1"/>',
        '<xacro:include filename="/dev/zero"/>',
        '<xacro:include filename="pipe"/>',
        '<xacro:include filename="loop"/>',
        "<link name=\"${xacro.load_yaml('pipe')}\"/>",
        "<link name=\"${xacro.load_yaml('/dev/zero')}\"/>",
        '<xacro:include filename="*/*.xacro"/>',
        '<xacro:include filename="parts/**/*.xacro"/>',
    ],
)
@pytest.mark.skipif(sys.platform == "win32", reason="it has no pipes")
def test_a_file_that_leads_elsewhere_is_one_error(folder: Path, line: str) -> None:
    os.mkfifo(folder / "pipe")
    (folder / "loop").symlink_to("loop")
    begin = time.monotonic()
    assert problem(write_line(folder, line)).startswith("arm.urdf.xacro:2: error: ")
    assert time.monotonic() - begin < 10


def test_a_macro_that_is_named_without_its_prefix_is_told(folder: Path) -> None:
    """Only the file before its expansion says which names are macros."""
    macro = '<xacro:macro name="wheel" params="at"><link name="${at}"/></xacro:macro>'
    (warning,) = expand(write_line(folder, f'{macro}<wheel at="b"/>'), {}).warnings
    assert warning == "warning: <wheel> of line 2 calls no macro: write <xacro:wheel …>"
