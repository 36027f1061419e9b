"""What expressions of xacro may do: all that robots in the wild use, and nothing that gets at more than values."""

from __future__ import annotations

import re
from pathlib import Path
from xml.sax.saxutils import escape

import pytest
from support.xacros import problem, value, write_line

from urdfsync.engine.sources.expansion import expand

ESCAPE = "[c for c in ().__class__.__base__.__subclasses__() if c.__name__ == '_wrap_close'][0]"


MODULES = f"{ESCAPE}.__init__.__globals__['sys'].modules"
"""How an expression gets at all of Python if nobody reads its names."""


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
    found = problem(write_line(folder, value(f"(lambda: [{MODULES}{call} for i in [1]])()")))
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
        ("xacro.load_yaml(xacro.load_yaml('numbers.yaml')['binary'])", "the name of a file must be text, not b'/a'"),
        ("xacro.load_yaml('unit.yaml')", "the attribute `__class__` is not allowed"),
        ("xacro.load_yaml('string.yaml')", "not allowed in an expression: JoinedStr"),
        ("xacro.load_yaml(0)", "expected str, bytes or os.PathLike object, not int"),
        ("'\\ud800'", "a text or a path that it works with is not UTF-8"),
        ("xacro.message('\\ud800')", "a text or a path that it works with is not UTF-8"),
        pytest.param("'a' * 1000 * 1000 * 200", "it expands to more than 100,000,000 bytes", marks=pytest.mark.slow),
    ],
)
def test_a_way_out_of_an_expression_is_closed(folder: Path, expression: str, message: str) -> None:
    numbers = (
        "_a: 1\nformat: '{0.__class__}'\nnested: '{0:{0.__class__}}'\nkey: '%(__class__)s'\nbinary: !!binary L2E=\n"
    )
    texts = {"numbers": numbers, "unit": "a: !meters ().__class__\n", "string": "a: !meters f'{().a}'\n"}
    found = problem(write_line(folder, value(expression), **texts))
    assert found.startswith("arm.urdf.xacro:")
    assert message in found


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
    found = expand(write_line(folder, line, numbers=numbers), {})
    assert re.findall('<link name="(.*)"/>', found.text)[:-1] == list(USED.values())


def test_substitution_evaluates_too(folder: Path) -> None:
    line = '<xacro:arg name="length" default="2"/><link name="$(eval length * 2 if true else pi)"/>'
    assert '<link name="4"/>' in expand(write_line(folder, line), {}).text
