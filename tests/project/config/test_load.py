"""The configuration: what it means, and what is said about mistakes in it."""

from __future__ import annotations

import os
import re
from pathlib import Path

import msgspec
import pytest
from support.configurations import ROOT, failures, parse, robot

from urdfsync.common.diagnostics import ConfigError
from urdfsync.domain import Target
from urdfsync.project import config
from urdfsync.project.config import RobotConfig

pytestmark = pytest.mark.usefixtures("rc_domain")


def urdf(line: str, name: str = "arm", package: str = "Arm") -> str:
    return f"[robots.{name}]\nsource = 'a'\npackage = '{package}'\n{line}\n"


def test_defaults() -> None:
    (arm,) = parse(robot()).robots
    assert arm == RobotConfig(
        name="arm",
        source=ROOT / "arm.json",
        source_text="arm.json",
        output=ROOT / "modelica",
        target=Target("Arm", "Arm"),
        domain="rcnetwork",
        options=arm.options,
        lines={"": 1, "source": 2, "package": 3, "domain": 4},
    )
    assert arm.folder == ROOT / "modelica" / "Arm"
    assert msgspec.to_builtins(arm.options) == {"ground": True, "prefix": "node"}


def test_everything_set() -> None:
    loaded = parse("""
        [robots.arm]
        source = "../cad/./arm.json"
        output = "lib"
        package = "Plant.Robots.Arm"
        class = "SixAxis"
        domain = "rcnetwork"
        templates = "own"
        package_paths = ["ros", "/opt/ros"]
        create_parents = true
        on_conflict = "merge"
        on_build = "check"
        ground = false
        prefix = "n"
        [check]
        library = "../modelica/./lib"
    """)
    (arm,) = loaded.robots
    assert loaded.check.library == ROOT.parent / "modelica/lib"
    assert (arm.source, arm.source_text) == (ROOT.parent / "cad" / "arm.json", "../cad/arm.json")
    assert arm.folder == ROOT / "lib" / "Plant" / "Robots" / "Arm"
    assert arm.target == Target("Plant.Robots.Arm", "SixAxis")
    assert arm.templates == ROOT / "own"
    assert arm.package_paths == (ROOT / "ros", Path(os.path.normpath(ROOT / "/opt/ros")))
    assert (arm.create_parents, arm.on_conflict, arm.on_build) == (True, "merge", "check")
    assert msgspec.to_builtins(arm.options) == {"ground": False, "prefix": "n"}


def test_defaults_table_reaches_all_robots_but_what_they_set_themselves() -> None:
    text = (
        '[defaults]\noutput = "lib"\nprefix = "d"\ndomain = "rcnetwork"\non_build = "check"\n'
        + robot()
        + robot('prefix = "b"\non_build = "nothing"', "b", "B")
    )
    arm, other = parse(text).robots
    assert (arm.output, other.output) == (ROOT / "lib", ROOT / "lib")
    assert (arm.on_build, other.on_build) == ("check", "nothing")
    assert (arm.options.prefix, other.options.prefix) == ("d", "b")


MISTAKES = {
    "sorce = 'x'": "unknown key `sorce` in robot `arm`; did you mean `source`? [unknown-key]",
    "grund = true": "unknown key `grund` in robot `arm`; did you mean `ground`? [unknown-key]",
    "create_parents = 'yes'": '`create_parents` must be true or false, not "yes" [wrong-value]',
    "package_paths = ['a', 1]": '`package_paths` must be a list of paths, not ["a", 1] [wrong-value]',
    "on_build = true": '`on_build` must be "nothing" or "check", not true [wrong-value]',
    "arguments = { a = [1] }": (
        '`arguments` must be a table of strings, numbers, true and false, not {"a": [1]} [wrong-value]'
    ),
    "command = 'make'": '`command` must be a list of strings, not "make" [wrong-value]',
    "command_inputs = ['a']": (
        "robot `arm`: `command_inputs` without `command`; add the command, or take the inputs out [wrong-value]"
    ),
    "arguments = {}\ncommand = ['make']": (
        "robot `arm`: `command` writes a source that xacro does not expand; take one out [wrong-value]"
    ),
    "renamed = { a = 1 }": '`renamed` must be a table of strings, not {"a": 1} [wrong-value]',
    'output = ""': '`output` must be a path, not "" [wrong-value]',
    "ground = 1": "`ground` must be true or false, not 1 [wrong-value]",
    "x = ": "invalid value; put strings into quotes [toml-syntax]",
    'class = "2nd"': "'2nd' can't be the class of a robot model; set `class` to a name that begins with a capital and "
    "is not reserved by Modelica or urdfsync [modelica-name]",
}
"""By a line of a robot's table."""
DEEP = " tables and lists are nested more than 50 deep [toml-syntax]"
OTHER_MISTAKES = {
    robot('x = "C:\\Users"'): "5:10 invalid hex value; write paths with `/`, or in single quotes [toml-syntax]",
    robot("[check]\nlibary = 'x'"): "6 unknown key `libary` in `[check]`; did you mean `library`? [unknown-key]",
    robot().replace("work", "wok"): '4 there is no domain `rcnetwok`; did you mean "rcnetwork"? [unknown-domain]',
    robot().replace('package = "Arm"', ""): "1 robot `arm` has no `package`; add a line `package = …` [missing-key]",
    "[default]\n" + robot(): "1 unknown key `default` in the configuration; did you mean `defaults`? [unknown-key]",
    "[defaults]\nsource = 'a'\n" + robot(): "2 `source` can't have a default: every robot has its own",
    "[defaults]\nprefx = 'a'\n" + robot(): "2 unknown key `prefx` in `[defaults]`; did you mean `prefix`? "
    "[unknown-key]",
    "check = true\n" + robot(): "1 `check` must be a table [wrong-value]",
    "robots = 3": "1 `robots` must be a table [wrong-value]",
    "[robots]\narm = 3": "2 `robots.arm` must be a table [wrong-value]",
    "[robots\n": "1:8 expected ']' at the end of a table declaration [toml-syntax]",
    "# \u2028 \x85\n" + robot("grund = true"): "6 unknown key `grund` in robot `arm`; did you mean `ground`?",
    robot(package="Plant.end"): "3 'Plant.end' can't be a package; use letters, digits and `_`, and no name that "
    "Modelica, Windows or urdfsync reserves, as in Plant.Arm [modelica-name]",
    robot(
        'ignore = ["unresolve"]'
    ): "5 no warning or note has the code `unresolve`; did you mean `unresolved`? [unknown-code]",
    robot(
        'ignore = ["mesh-guessed"]'
    ): "5 no warning or note has the code `mesh-guessed`; write the code at the end of a warning; errors can't be "
    "ignored [unknown-code]",
    '[defaults]\nignore = ["nothing-here"]\n'
    + robot()
    + robot("", "other", "Other"): "2 no warning or note has the code `nothing-here`",
    "a = 1\na = 2\n[b]\n": "2:6 a key is set twice; remove one of the two",
    "[robots.a]\n[robots.a]\n": "2:10 the table `robots.a` is there twice; put the keys of both into one",
    "a = 1\n<<<<<<< ours\n": "2 unresolved merge markers; settle the merge",
    "a = " + "1" * 5000: " a number has too many digits",
    robot("x = " + "[" * 5000 + "]" * 5000): DEEP,
    ".".join(["a"] * 5000) + " = 1": DEEP,
    robot("x = " + "{a=" * 300 + "1" + "}" * 300): DEEP,
}
"""By the whole text, with the place in it; some messages only as they begin."""
URDF_MISTAKES = {
    "base = {a = 1}": '`base` must be "fixed" or "floating", not {"a": 1}',
    'base = "ä"': '`base` must be "fixed" or "floating", not "ä"',
    'frames = "leafs"': '`frames` must be "leaves" or "all" or a list of strings, not "leafs"',
    'frames = ["a", 3]': '`frames` must be "leaves" or "all" or a list of strings, not ["a", 3]',
    "loops = ['pin']": '`loops` must be a list of tables, not ["pin"]',
    "start = {elbow = nan}": '`start` must be finite numbers, not {"elbow": NaN}',
    "driven = [true]": "`driven` must be a list of strings, not [true]",
}
"""By a line of a robot of the other domain: what is wrong is repeated as it was written."""


LOOP = "[[robots.arm.loops]]\nname = 'pin'\nkind = 'ball'\nframes = ['a', 'b']\n"
LOOP_MISTAKES = {
    "axes = [0, 0, 1]": "unknown key `axes` in `loops` of robot `arm`; did you mean `axis`? [unknown-key]",
    "axis = [0, 1]": "`axis` must be a list of 3 numbers, not [0, 1] [wrong-value]",
    "axis = [0, 0, inf]": "`axis` must be finite numbers, not [0, 0, Infinity] [wrong-value]",
    "kind = 'ball'": '`kind` must be "ball" or "revolute" or "universal" or "fixed", not "bal" [wrong-value]',
    "name = 'pin'": '`name` must be a string, not " " [wrong-value]',
    "frames = ['a', 'b']": "`frames` of `loops` of robot `arm` has no `link`; add a line `link = …` [missing-key]",
}
"""By a line of the second loop; one that stands there already is replaced by a wrong one."""
WRONG = {
    "kind = 'ball'": "kind = 'bal'",
    "name = 'pin'": "name = ' '",
    "frames = ['a', 'b']": "frames = ['a', {xyz = [0, 0, 1]}]",
}


@pytest.mark.parametrize(("line", "message"), LOOP_MISTAKES.items())
def test_a_mistake_in_a_loop_names_its_key_and_the_line_of_its_table(line: str, message: str) -> None:
    second = LOOP.replace(line, WRONG[line]) if line in WRONG else LOOP + line + "\n"
    (found,) = failures(urdf("") + "\n" + LOOP + second)
    assert found.startswith("urdfsync.toml:")
    assert found.partition("error: ")[2] == message
    number = int(found.split(":")[1])
    assert (urdf("") + "\n" + LOOP + second).split("\n")[number - 1] == "[[robots.arm.loops]]"
    assert number > (urdf("") + "\n").count("\n") + 1


@pytest.mark.parametrize(
    ("text", "message"),
    [
        *((robot(line), f"5 {message}") for line, message in MISTAKES.items()),
        *((urdf(line), f"4 {message} [wrong-value]") for line, message in URDF_MISTAKES.items()),
        *OTHER_MISTAKES.items(),
    ],
)
def test_mistakes_are_one_line_each(text: str, message: str) -> None:
    place, _, words = message.partition(" ")
    (found,) = failures(text)
    expected = f"urdfsync.toml:{place}: error: {words}".replace("::", ":")
    assert (found if expected.endswith("]") else found[: len(expected)]) == expected


@pytest.mark.parametrize("output", [".urdfsync", "x/../.urdfsync/deep", ".URDFSYNC", (ROOT / ".urdfsync").as_posix()])
def test_the_folders_of_programs_are_no_outputs(output: str) -> None:
    for folder, owner in ((".urdfsync", "urdfsync"), (".git", "git")):
        found = output.replace(".URDFSYNC", folder.upper()).replace(".urdfsync", folder)
        assert failures(robot(f"output = '{found}'")) == [
            f"urdfsync.toml:5: error: `output` can't be in {folder}: {owner} keeps its own files there; "
            "name another folder [wrong-value]"
        ]


@pytest.mark.parametrize("output", [".", "..", ".urdfsync2", "a/.urdfsync"])
def test_outputs_beside_the_state_folder(output: str) -> None:
    (arm,) = parse(robot(f"output = '{output}'")).robots
    assert arm.output == Path(os.path.normpath(ROOT / output))


@pytest.mark.parametrize(
    "line", ['output = "a\\u0000b"', 'templates = "a\\nb"', 'package_paths = ["a", "\\u001b"]', '"a\\u007f" = 1']
)
def test_control_characters_are_refused_wherever_they_are(line: str) -> None:
    (message,) = failures(robot(line))
    assert message.startswith("urdfsync.toml:5: error: there is a control character in '")
    assert message.isprintable()


def test_lists_and_words_of_such_an_option() -> None:
    lines = ('frames = "all"', 'frames = ["a"]\ndriven = []', "")
    found = [one.options for one in parse("".join(map(urdf, lines, "ABC", "ABC"))).robots]
    assert [(one.frames, one.driven) for one in found] == [("all", None), (("a",), ()), ("leaves", None)]


@pytest.mark.parametrize(
    ("one", "two", "words"),
    [
        (("a", "Arm"), ("b", "Arm"), "robots `a` and `b` have the same package"),
        (("a", "Arm"), ("b", "ARM"), "robots `a` and `b` have the same package"),
        (("a", "Arm"), ("A", "Leg"), "robots `a` and `A` differ in case only"),
        (("a", "Plant"), ("b", "Plant.Arm"), "the package of robot `b` lies inside that of robot `a`"),
    ],
)
def test_robots_that_are_in_each_others_way(one: tuple[str, str], two: tuple[str, str], words: str) -> None:
    text = robot("", *one) + robot("", *two)
    assert failures(text) == [f"urdfsync.toml:7: error: {words} [clash]"]


def test_all_mistakes_are_told_at_once_in_the_order_of_lines() -> None:
    found = failures(robot("x = 1\n") + robot("ground = 'no'", "b", "end"))
    assert [message.split(":")[1] for message in found] == ["5", "8", "10"]


def test_load_takes_a_byte_order_mark(tmp_path: Path) -> None:
    file = tmp_path / "urdfsync.toml"
    file.write_bytes(b"\xef\xbb\xbf" + robot().encode())
    assert [arm.name for arm in config.load(file).robots] == ["arm"]


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (None, "urdfsync.toml: error: the configuration does not exist; write one with `urdfsync init SOURCE`"),
        (b"\xff\xfe[", "urdfsync.toml:1: error: the configuration is not UTF-8; save it as UTF-8"),
        (b"# a\n# B\xfccher\n", "urdfsync.toml:2: error: the configuration is not UTF-8; save it as UTF-8"),
    ],
)
def test_load_names_a_file_that_it_cant_read(tmp_path: Path, content: bytes | None, words: str) -> None:
    file = tmp_path / "urdfsync.toml"
    if content is not None:
        file.write_bytes(content)
    with pytest.raises(ConfigError, match=re.escape(words)):
        config.load(file)
