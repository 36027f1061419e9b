"""What can't be expanded is one error at its place, in bounded time; what a file may do meanwhile is limited."""

from __future__ import annotations

import gzip
import os
import re
import sys
import time
from pathlib import Path
from xml.sax.saxutils import escape

import pytest
from support import xacros
from support.commands import Execute
from support.files import unchanged

from urdfsync.diagnostics import SourceError
from urdfsync.engine import expansion
from urdfsync.engine.expansion import Inputs, expand

ENDLESS = '<xacro:macro name="a"><xacro:a/></xacro:macro><xacro:a/>'
ESCAPE = "[c for c in ().__class__.__base__.__subclasses__() if c.__name__ == '_wrap_close'][0]"
MODULES = f"{ESCAPE}.__init__.__globals__['sys'].modules"
"""How an expression gets at all of Python if nobody reads its names."""


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


def test_a_package_whose_files_are_elsewhere_once_installed_is_named(folder: Path) -> None:
    (folder / "package.xml").write_text("<package><name>cart</name></package>")
    found = problem(write(folder, '<xacro:include filename="$(find cart)/control/cart.xacro"/>'))
    assert found.startswith("arm.urdf.xacro:2: error: ")
    assert "cart.xacro can't be read" in found
    assert (
        "; if package `cart` has this file once it is installed, name the installed xacro file as source [xacro]"
        in found
    )


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
    "call",
    [
        "['os'].open('victim', 512)",  # O_TRUNC
        "['os'].mkfifo('pipe')",
        "['os'].remove('victim')",
        "['builtins'].open('hacked', 'w')",
        "['builtins'].__import__('_posixsubprocess').fork_exec([b'touch', b'hacked'])",
        "['builtins'].__import__('subprocess').run(['touch', 'hacked'])",
        "['builtins'].__import__('socket').create_connection(('127.0.0.1', 9))",
    ],
)
def test_an_expression_gets_at_nothing_but_values(folder: Path, call: str) -> None:
    (folder / "victim").write_text("precious")
    found = problem(write(folder, value(f"(lambda: [{MODULES}{call} for i in [1]])()")))
    assert found.startswith("arm.urdf.xacro:2: error: the attribute `")
    assert "is not allowed in an expression" in found
    assert (folder / "victim").read_text() == "precious"
    assert sorted(path.name for path in folder.iterdir()) == ["arm.urdf.xacro", "victim"]


@pytest.mark.parametrize(
    ("expression", "message"),
    [
        ("(i for i in [1]).gi_frame.f_builtins", "may not read `gi_frame` of a generator"),
        ("(lambda: 1).func_globals", "may not read `func_globals` of a function"),
        ("xacro.load_yaml.func_globals", "may not read `func_globals` of a function"),
        ("map(str, []).a", "may not read `a` of a map"),
        ("'a'.join.a", "may not read `a` of a builtin_function_or_method"),
        ("str.mro()", "may not read `mro` of a str"),
        ("python.type('')", "name 'type' is not defined"),
        ("python.vars(xacro)", "name 'vars' is not defined"),
        ("xacro.parent", "name 'parent' is not defined"),
        ("math.root", "name 'root' is not defined"),
        ("__builtins__", "the name `__builtins__` is not allowed"),
        ("[__import__ for i in [1]]", "the name `__import__` is not allowed"),
        ("(lambda __attribute: 1)", "the name `__attribute` is not allowed"),
        ("[0 for math.pi in [3]]", "an expression may not assign"),
        ("[0 for x['a'] in [3]]", "an expression may not assign"),
        ("[a := 1]", "not allowed in an expression: NamedExpr"),
        ("(lambda: (yield))", "not allowed in an expression: Yield"),
        ("dict(a=1).__class__", "the attribute `__class__` is not allowed"),
        ("xacro.load_yaml('numbers.yaml')._a", "the attribute `_a` is not allowed"),
        ("str.format('a')", "may not read `format` of a str"),
        ("'a'.format_map(dict())", "may not read `format_map` of a str"),
        ("xacro.load_yaml('numbers.yaml')['format'].format('')", "`{0.__class__}` reads an attribute"),
        ("xacro.load_yaml('numbers.yaml')['nested'].format('')", "`{0.__class__}` reads an attribute"),
        ("xacro.load_yaml('numbers.yaml')['key'] % dict()", "'__class__'"),
        ("xacro.load_yaml('numbers.yaml')['binary'].hex()", "may not read `hex` of a bytes"),
        ("xacro.load_yaml(xacro.load_yaml('numbers.yaml')['binary'])", "the name of a file is text, not b'/a'"),
        ("xacro.load_yaml('unit.yaml')", "the attribute `__class__` is not allowed"),
        ("xacro.load_yaml('string.yaml')", "not allowed in an expression: JoinedStr"),
        ("xacro.load_yaml(0)", "expected str, bytes or os.PathLike object, not int"),
        ("'\\ud800'", "it works with text that is not Unicode"),
        ("xacro.message('\\ud800')", "it works with text that is not Unicode"),
        pytest.param("'a' * 1000 * 1000 * 200", "it expands to more than 100,000,000 bytes", marks=pytest.mark.slow),
    ],
)
def test_a_way_out_of_an_expression_is_closed(folder: Path, expression: str, message: str) -> None:
    numbers = (
        "_a: 1\nformat: '{0.__class__}'\nnested: '{0:{0.__class__}}'\nkey: '%(__class__)s'\nbinary: !!binary L2E=\n"
    )
    texts = {"numbers": numbers, "unit": "a: !meters ().__class__\n", "string": "a: !meters f'{().a}'\n"}
    found = problem(write(folder, value(expression), **texts))
    assert found.startswith("arm.urdf.xacro:")
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
    assert problem(write(folder, line)).startswith("arm.urdf.xacro:2: error: ")
    assert time.monotonic() - begin < 10


USED = {
    "[x * 2 for x in [1, 2] if x > 1]": "[4]",
    "' '.join([str(v * scale) for v in numbers['list']])": "2 4",
    "(lambda a, b=2: a + b)(*[1])": "3",
    "[k.upper() for k, v in numbers.items() if python.isinstance(v, list)]": "['LIST']",
    "numbers.deep.mass + numbers['deep']['mass']": "5.0",
    "xacro.dotify(dict(a=dict(b=7))).a.b": "7",
    "numbers.get('none', 'left'.replace('l', 'c').split('f')[0])": "ce",
    "fmt.format('ab', 1, side='left')": "ab_left a 1.00",
    "'%s_%.1f' % ('a', 2)": "a_2.0",
    "sin(pi / 2) + math.radians(180) // 3": "2.0",
    "list(map(str.lower, ['A']))": "['a']",
    "not numbers.deep.mass == 2.5 or 'x' in 'xyz'[0:2]": "True",
    "_own_": "mine",
    "side if side in ['left', 'right'] else 'none'": "left",
    "1 if $(arg flag) else 2": "1",
    "xacro.arg('flag').lower()": "true",
    "xacro.tokenize('a,b;c')[-1]": "c",
    "max([p for p in [(1, 'a'), (2, 'b')]], key=lambda p: p[0])[1]": "b",
}
"""Expressions such as robots in the wild have, with their values."""


def test_what_robots_in_the_wild_use_works(folder: Path) -> None:
    line = (
        """<xacro:arg name="flag" default="True"/><xacro:property name="_own_" value="mine"/>"""
        """<xacro:property name="numbers" value="${xacro.load_yaml('numbers.yaml')}"/>"""
        """<xacro:property name="scale" value="2"/><xacro:property name="side" value="left"/>"""
        """<xacro:property name="fmt" value="${numbers['format']}"/>"""
    )
    line += "".join(f'<link name="{escape("${" + used + "}")}"/>' for used in USED)
    numbers = "deep: {mass: 2.5}\nlist: [1, 2]\nformat: '{0}_{side} {0[0]} {1:.2f}'\n"
    found = expand(write(folder, line, numbers=numbers), {})
    assert re.findall('<link name="(.*)"/>', found.text)[:-1] == list(USED.values())


def test_substitution_evaluates_too(folder: Path) -> None:
    line = '<xacro:arg name="length" default="2"/><link name="$(eval length * 2 if true else pi)"/>'
    assert '<link name="4"/>' in expand(write(folder, line), {}).text


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
