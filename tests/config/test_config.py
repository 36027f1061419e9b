"""The configuration: what it means, and what is said about mistakes in it."""

from __future__ import annotations

import os
import re
from pathlib import Path

import msgspec
import pytest

from urdfsync import config, registry, tomlfile
from urdfsync.config import CheckConfig, Config
from urdfsync.diagnostics import ConfigError
from urdfsync.domain import Target

pytestmark = pytest.mark.usefixtures("rc_domain")

ROOT = Path(os.path.abspath("/project"))  # noqa: PTH100 - a drive on Windows


def parse(text: str) -> Config:
    return config.parse(text, ROOT / "urdfsync.toml", "urdfsync.toml")


def robot(more: str = "", name: str = "arm", package: str = "Arm") -> str:
    return f'[robots.{name}]\nsource = "arm.json"\npackage = "{package}"\ndomain = "rcnetwork"\n{more}'


def failures(text: str) -> list[str]:
    with pytest.raises(ConfigError) as caught:
        parse(text)
    return [str(diagnostic) for diagnostic in caught.value.diagnostics]


def test_defaults() -> None:
    (arm,) = parse(robot()).robots
    assert arm.name == "arm"
    assert arm.source == ROOT / "arm.json"
    assert arm.output == ROOT / "modelica"
    assert arm.folder == ROOT / "modelica" / "Arm"
    assert arm.target == Target("Arm", "Arm")
    assert arm.templates is None
    assert arm.package_paths == ()
    assert not arm.create_parents
    assert not arm.checking
    assert msgspec.to_builtins(arm.options) == {"ground": True, "prefix": "node"}


def test_everything_set() -> None:
    text = """
        [robots.arm]
        source = "../cad/./arm.json"
        output = "lib"
        package = "Plant.Robots.Arm"
        class = "SixAxis"
        domain = "rcnetwork"
        templates = "own"
        package_paths = ["ros", "/opt/ros"]
        create_parents = true
        on_build = "check"
        ground = false
        prefix = "n"
    """
    (arm,) = parse(text).robots
    assert arm.source == ROOT.parent / "cad" / "arm.json"
    assert arm.source_text == "../cad/arm.json"
    assert arm.folder == ROOT / "lib" / "Plant" / "Robots" / "Arm"
    assert arm.target == Target("Plant.Robots.Arm", "SixAxis")
    assert arm.templates == ROOT / "own"
    assert arm.package_paths == (ROOT / "ros", Path(os.path.normpath(ROOT / "/opt/ros")))
    assert arm.create_parents
    assert arm.checking
    assert msgspec.to_builtins(arm.options) == {"ground": False, "prefix": "n"}


def test_a_library_is_named_from_the_configuration_on() -> None:
    assert parse(robot()).check == CheckConfig(None, 0)
    assert parse(robot("[check]\nlibrary = '../modelica/./lib'")).check == CheckConfig(ROOT.parent / "modelica/lib", 6)
    absolute = (ROOT.parent / "lib").as_posix()
    assert parse(robot(f"[check]\nlibrary = '{absolute}'")).check.library == Path(absolute)


def test_an_absolute_source_is_recorded_by_its_name_only() -> None:
    (arm,) = parse(robot().replace("arm.json", (ROOT / "cad" / "arm.json").as_posix())).robots
    assert arm.source == ROOT / "cad" / "arm.json"
    assert arm.source_text == "arm.json"


def test_defaults_table_reaches_all_robots_but_what_they_set_themselves() -> None:
    text = (
        '[defaults]\noutput = "lib"\nprefix = "d"\ndomain = "rcnetwork"\non_build = "check"\n'
        + robot()
        + robot('prefix = "b"\non_build = "nothing"', "b", "B")
    )
    arm, other = parse(text).robots
    assert (arm.output, other.output) == (ROOT / "lib", ROOT / "lib")
    assert (arm.checking, other.checking) == (True, False)
    assert (arm.options.prefix, other.options.prefix) == ("d", "b")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            robot("sorce = 'x'"),
            "urdfsync.toml:5: error: unknown key `sorce` in robot `arm`; did you mean `source`? [unknown-key]",
        ),
        (
            robot("grund = true"),
            "urdfsync.toml:5: error: unknown key `grund` in robot `arm`; did you mean `ground`? [unknown-key]",
        ),
        (
            "[default]\n" + robot(),
            "urdfsync.toml:1: error: unknown key `default` in the configuration; "
            "did you mean `defaults`? [unknown-key]",
        ),
        (
            "[defaults]\nsource = 'a'\n" + robot(),
            "urdfsync.toml:2: error: `source` can't have a default: every robot has its own [unknown-key]",
        ),
        (
            "[defaults]\nprefx = 'a'\n" + robot(),
            "urdfsync.toml:2: error: unknown key `prefx` in `[defaults]`; did you mean `prefix`? [unknown-key]",
        ),
        (
            "[robots.arm]\ndomain = 'rcnetwork'\nsource = 'a'",
            "urdfsync.toml:1: error: robot `arm` has no `package`; add a line `package = …` [missing-key]",
        ),
        (
            robot("create_parents = 'yes'"),
            'urdfsync.toml:5: error: `create_parents` must be true or false, not "yes" [wrong-value]',
        ),
        (
            robot("package_paths = ['a', 1]"),
            'urdfsync.toml:5: error: `package_paths` must be a list of strings, not ["a", 1] [wrong-value]',
        ),
        (
            robot("on_build = true"),
            'urdfsync.toml:5: error: `on_build` must be "nothing" or "check", not true [wrong-value]',
        ),
        (
            robot("[check]\nlibary = 'x'"),
            "urdfsync.toml:6: error: unknown key `libary` in `[check]`; did you mean `library`? [unknown-key]",
        ),
        (
            robot("[check]\nlibrary = 4"),
            "urdfsync.toml:6: error: `library` must be a string, not 4 [wrong-value]",
        ),
        (
            robot("[check]\nlibrary = ''"),
            "urdfsync.toml:6: error: `library` must name a folder; "
            "give the path of the folder that holds the Modelica Standard Library, or take the line out [wrong-value]",
        ),
        ("check = true\n" + robot(), "urdfsync.toml:1: error: `check` must be a table [wrong-value]"),
        (
            "[defaults]\noutput = 1\n" + robot(),
            "urdfsync.toml:2: error: `output` must be a string, not 1 [wrong-value]",
        ),
        (robot("ground = 1"), "urdfsync.toml:5: error: `ground` must be true or false, not 1 [wrong-value]"),
        (
            "[robots.arm]\nsource = 'a'\npackage = 'Arm'\nbase = 'floatin'",
            'urdfsync.toml:4: error: `base` must be "fixed" or "floating", not "floatin" [wrong-value]',
        ),
        (
            robot().replace("rcnetwork", "rcnetwok"),
            'urdfsync.toml:4: error: there is no domain `rcnetwok`; did you mean "rcnetwork"? [unknown-domain]',
        ),
        ("robots = 3", "urdfsync.toml:1: error: `robots` must be a table [wrong-value]"),
        ("[robots]\narm = 3", "urdfsync.toml:2: error: `robots.arm` must be a table [wrong-value]"),
        (
            "",
            "urdfsync.toml: error: the configuration has no robot; "
            "add a table `[robots.NAME]` with `source` and `package` [no-robots]",
        ),
        (robot() + "x = ", "urdfsync.toml:5: error: invalid value; strings stand in quotes [toml-syntax]"),
        ("[robots\n", "urdfsync.toml:1:8: error: expected ']' at the end of a table declaration [toml-syntax]"),
        (
            robot('class = "2nd"'),
            "urdfsync.toml:5: error: `class`: '2nd' is no Modelica identifier; "
            "use letters, digits and `_`, a letter first [modelica-name]",
        ),
        (
            robot('class = "robot"'),
            "urdfsync.toml:5: error: `robot` can't be the class of a robot model; set `class` to a name with a "
            "capital first that neither Modelica nor urdfsync has a use for [modelica-name]",
        ),
        (
            robot('class = "Links"'),
            "urdfsync.toml:5: error: `Links` can't be the class of a robot model; set `class` to a name with a "
            "capital first that neither Modelica nor urdfsync has a use for [modelica-name]",
        ),
    ],
)
def test_mistakes_are_one_line_each(text: str, message: str) -> None:
    assert failures(text) == [message]


@pytest.mark.parametrize(
    "package", ["Modelica.Arm", "Plant.real.Arm", "Plant.sin.Arm", "Plant.Aux.Arm", "com1", "Plant.UrdfSync.Arm",
                "UrdfSync", "urdfsync.Arm", "visualization2", "Plant.time", "Plant.Resources.Arm", "Complex"]
)  # fmt: skip
def test_packages_that_would_hide_what_models_refer_to(package: str) -> None:
    (message,) = failures(robot('class = "Robot1"', package=package))
    assert message.startswith("urdfsync.toml:3: error: `package`: `")
    assert "has a use for the name; choose another name, for example `" in message
    proposed = message.rpartition("example `")[2].partition("`")[0]
    assert parse(robot(package=proposed)).robots


@pytest.mark.parametrize("package", ["UrdfSync.Examples.Arm", "Plant.Sum.Arm", "Plant.Links.Arm", "Plant.World"])
def test_packages_that_hide_nothing(package: str) -> None:
    assert parse(robot(package=package)).robots[0].target.package == package


@pytest.mark.parametrize("name", ["Package", "Aux", "Complex", "Joints", "Visualization2"])
def test_classes_that_clash_with_files_or_other_classes_are_told_at_their_line(name: str) -> None:
    (message,) = failures(robot(f'class = "{name}"'))
    assert message.startswith(f"urdfsync.toml:5: error: `{name}` can't be the class of a robot model; set `class`")


def test_a_keyword_in_a_package_gets_a_name_that_can_be_used() -> None:
    assert failures(robot(package="Plant.end")) == [
        "urdfsync.toml:3: error: `package`: `end` is a keyword of Modelica; "
        "choose another name, for example `EndRobot` [modelica-name]"
    ]


@pytest.mark.parametrize("output", [".urdfsync", "x/../.urdfsync/deep", ".URDFSYNC", (ROOT / ".urdfsync").as_posix()])
def test_the_state_folder_is_no_output(output: str) -> None:
    assert failures(robot(f"output = '{output}'")) == [
        "urdfsync.toml:5: error: `output` can't be in .urdfsync: that is where urdfsync keeps its own files; "
        "name another folder [wrong-value]"
    ]


@pytest.mark.parametrize("output", [".", "..", ".urdfsync2", "a/.urdfsync"])
def test_outputs_beside_the_state_folder(output: str) -> None:
    (arm,) = parse(robot(f"output = '{output}'")).robots
    assert arm.output == Path(os.path.normpath(ROOT / output))


def test_an_empty_output_is_refused() -> None:
    (message,) = failures(robot('output = ""'))
    assert message.startswith('urdfsync.toml:5: error: `output` must name a folder; write "." for the folder')


@pytest.mark.parametrize(
    "line",
    ['output = "a\\u0000b"', 'templates = "a\\nb"', 'package_paths = ["a", "\\u001b"]', '"a\\u007f" = 1'],
)
def test_control_characters_are_refused_wherever_they_are(line: str) -> None:
    (message,) = failures(robot(line))
    assert message.startswith("urdfsync.toml:5: error: there is a control character in '")
    assert message.isprintable()


@pytest.mark.parametrize(
    "text",
    [
        robot("x = " + "[" * 5000 + "]" * 5000),
        robot("x = " + "[" * 200 + "]" * 200),
        ".".join(["a"] * 5000) + " = 1",
        robot("x = " + "{a=" * 300 + "1" + "}" * 300),
    ],
)
def test_tables_nested_without_reason_are_refused(text: str) -> None:
    assert failures(text) == ["urdfsync.toml: error: tables and lists are nested more than 50 deep [toml-syntax]"]


@pytest.mark.parametrize("depth", [1, tomlfile.DEEPEST - 1, tomlfile.DEEPEST])
def test_tables_and_lists_may_be_nested_so_deep_and_no_deeper(depth: int) -> None:
    for text in (f"a = {'[' * (depth - 1)}1{']' * (depth - 1)}", ".".join("a" * depth) + " = 1"):
        assert tomlfile.parse(text, "f", ConfigError)
        if depth == tomlfile.DEEPEST:
            with pytest.raises(ConfigError, match="more than 50 deep"):
                tomlfile.parse(f"b.{text}", "f", ConfigError)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("a = 1\na = 2\n[b]\n", "2: error: `a` is set twice; remove one of them"),
        ("[robots.a]\nx.y = 1\nx.y = 2", "3: error: `x.y` is set twice; remove one of them"),
        ("[robots.a]\n[robots.a]\n", "2: error: the table `robots.a` is there twice; put the keys of both into one"),
        ("[robots.a]\nsource = arm.urdf\n", "2:10: error: invalid value; strings stand in quotes"),
        ("a = 1\n<<<<<<< ours\n", "2: error: unresolved merge markers; settle the merge"),
        ("a = " + "1" * 5000, " error: a number has too many digits"),
    ],
)
def test_syntax_errors_say_what_to_do(text: str, words: str) -> None:
    (message,) = failures(text)
    assert message.startswith(f"urdfsync.toml:{words}")


@pytest.mark.parametrize(
    ("value", "words"), [("true", "true"), ("3", "3"), ("[1]", "[1]"), ("{a = 1}", '{"a": 1}'), ('"ä"', '"ä"')]
)
def test_a_wrong_choice_is_repeated_as_it_was_written(value: str, words: str) -> None:
    found = failures(f"[robots.arm]\nsource = 'a'\npackage = 'Arm'\nbase = {value}")
    assert found == [f'urdfsync.toml:4: error: `base` must be "fixed" or "floating", not {words} [wrong-value]']


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ('frames = "leafs"', '`frames` must be "leaves" or "all" or a list of strings, not "leafs"'),
        ("frames = 3", '`frames` must be "leaves" or "all" or a list of strings, not 3'),
        ('frames = ["a", 3]', '`frames` must be "leaves" or "all" or a list of strings, not ["a", 3]'),
        ('driven = "a"', '`driven` must be a list of strings, not "a"'),
        ("driven = [true]", "`driven` must be a list of strings, not [true]"),
    ],
)
def test_an_option_that_may_be_a_list(line: str, words: str) -> None:
    found = failures(f"[robots.arm]\nsource = 'a'\npackage = 'Arm'\n{line}")
    assert found == [f"urdfsync.toml:4: error: {words} [wrong-value]"]


def test_lists_and_words_of_such_an_option() -> None:
    text = "[robots.{0}]\nsource = 'a'\npackage = '{0}'\n{1}\n".format
    lines = ('frames = "all"', 'frames = ["a"]\ndriven = []', "")
    found = [one.options for one in parse("".join(map(text, "ABC", lines))).robots]
    assert [(one.frames, one.driven) for one in found] == [("all", None), (("a",), ()), ("leaves", None)]


def test_lines_do_not_depend_on_separators_inside_of_strings() -> None:
    assert failures("# \u2028 \x85\n" + robot("grund = true"))[0].startswith("urdfsync.toml:6: ")


@pytest.mark.parametrize("package", ["", ".", "Arm.", ".Arm", "Arm.end", "A b", "Gelenk_ä", "../evil", 'a\\"b', "1A"])
def test_packages_that_are_no_names_of_classes(package: str) -> None:
    assert all(message.startswith("urdfsync.toml:3: error: `package`") for message in failures(robot(package=package)))


@pytest.mark.parametrize("name", ["a/b", "..", ".hidden", "con", "NUL.x", "a:b", "a b", "ä", "x" * 101, "a."])
def test_robots_whose_names_are_no_names_of_files(name: str) -> None:
    assert failures(robot(name=f'"{name}"')) == [
        f"urdfsync.toml:1: error: the robot's name {name!r} can't be a file's name; "
        "use letters, digits, `_`, `-` and `.`, a letter or digit first [robot-name]"
    ]


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


def test_find_looks_upwards(tmp_path: Path) -> None:
    (tmp_path / "urdfsync.toml").write_text(robot())
    folder = tmp_path / "a" / "b"
    folder.mkdir(parents=True)
    assert config.find(folder) == tmp_path / "urdfsync.toml"


def test_find_says_what_to_do(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match="write one with `urdfsync init SOURCE`"):
        config.find(tmp_path)


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


def test_a_working_folder_that_is_gone_is_said_clearly(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert config.working_folder() == Path.cwd()

    def gone() -> str:
        raise FileNotFoundError(2, "No such file or directory")

    monkeypatch.setattr(os, "getcwd", gone)
    with pytest.raises(ConfigError, match="the working folder does not exist any more; change to a folder"):
        config.working_folder()
    assert config.shown(tmp_path) == str(tmp_path)


def test_paths_are_shown_as_they_are_seen_from_the_working_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    inside, beside = tmp_path / "cad" / "arm.urdf", tmp_path.with_name(f"{tmp_path.name}-2") / "arm.urdf"
    assert [config.shown(path) for path in (tmp_path, inside, beside)] == [".", str(Path("cad/arm.urdf")), str(beside)]


def test_select() -> None:
    loaded = parse(robot() + robot("", "leg", "Leg"))
    assert [arm.name for arm in loaded.select([])] == ["arm", "leg"]
    assert [arm.name for arm in loaded.select(["leg"])] == ["leg"]
    with pytest.raises(ConfigError, match="did you mean `leg`"):
        loaded.select(["legg"])


def test_ros_package_path() -> None:
    value = os.pathsep.join(["/a", "", "/b/c"])
    assert config.ros_package_path({"ROS_PACKAGE_PATH": value}) == (Path("/a").absolute(), Path("/b/c").absolute())
    assert config.ros_package_path({}) == ()


def test_packaged_data_is_there() -> None:
    assert (config.library_folder() / "UrdfSync").is_dir()
    assert config.templates_folder(registry.domain("urdf")).name == "urdf"
    assert config.templates_folder(registry.domain("rcnetwork")) == registry.domain("rcnetwork").templates


@pytest.mark.parametrize(
    ("path", "line"),
    [
        (("defaults", "output"), 3),
        (("robots", "my arm"), 5),
        (("robots", "my arm", "package"), 7),
        (("robots", "my arm", "missing"), 5),
        (("robots", "leg", "source"), 9),
        (("nothing",), 0),
    ],
)
def test_lines_of_keys(path: tuple[str, ...], line: int) -> None:
    text = "# first\n[defaults]\noutput = 'x'\n\n[robots.'my arm'] # the arm\nsource = 'a=b'\n\"package\" = 'P'\n"
    text += "[robots]\nleg.source = 'x'\n"
    assert tomlfile.nearest(tomlfile.lines(text), *path) == line
