"""Packages of the whole corpus as text: grammar, names, layout on disk, and what must not be in them.

None of it needs the Modelica Standard Library. Every robot and every version of the histories is
rendered; parsers see each distinct text once.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath
from xml.sax.saxutils import quoteattr

import pymoca.parser
import pytest
import rumoca
from support import corpus
from support.corpus import FOLDER
from support.modelica import URDFSYNC, compile_task, execute
from support.packages import Package, generate, proposed_base, read, scaled
from support.urdfs import dynamics, limit, link, robot

from urdfsync.domain import Role, Target
from urdfsync.modelica.lexer import is_name, lex
from urdfsync.modelica.names import is_identifier
from urdfsync.modelica.parser import parse

BOT = Target("Bot", "Bot")
PARTS = [pytest.param(part, marks=pytest.mark.large if part else pytest.mark.slow) for part in range(8)]
"""The slower parser's work is cut into so many tests."""

TURTLEBOT = "histories/ROBOTIS-GIT+turtlebot3__turtlebot3_description_urdf_turtlebot3"
SO101 = "histories/TheRobotStudio+SO-ARM100__Simulation_SO101_so101"
STOMPY = "histories/kscalelabs+sim__sim_stompy_legs_robot"
FAULTY = {
    "robots/random/spot_ros/spot_description/urdf/spot_arm.urdf": {"unknown-parent"},
    f"{TURTLEBOT}_waffle_pi.urdf/003.urdf": {"unknown-child"},
    f"{SO101}_new_calib.urdf/000.urdf": {"duplicate-link", "cycle", "two-parents"},
    f"{SO101}_new_calib.urdf/001.urdf": {"duplicate-link", "cycle", "two-parents"},
    f"{SO101}_old_calib.urdf/000.urdf": {"duplicate-link", "cycle", "two-parents"},
    f"{STOMPY}.urdf/000.urdf": {"not-urdf"},
    f"{STOMPY}_fixed.urdf/001.urdf": {"not-urdf"},
}
"""The files that no package can be made of, and their faults; the tests of the reader say why each is one."""

SOUND = [file for file in corpus.distinct_files() if file not in FAULTY]
SOURCES = corpus.by_source(SOUND)
each_source = pytest.mark.parametrize("files", SOURCES.values(), ids=SOURCES)
"""One robot, or all versions of one history."""
some_sources = pytest.mark.parametrize(
    "files",
    [
        pytest.param(files, id=source, marks=pytest.mark.large if number % 4 else pytest.mark.slow)
        for number, (source, files) in enumerate(SOURCES.items())
    ],
)
"""The same, of which CI takes every fourth."""


@functools.cache
def package(file: str) -> Package:
    """The package of a file of the corpus, stationary or mobile as `init` proposes."""
    return generate(FOLDER / file, BOT, base=proposed_base((FOLDER / file).read_bytes()))


@functools.cache
def texts() -> Mapping[str, str]:
    """Every distinct Modelica text of the corpus, with the first place that has it."""
    result: dict[str, str] = {}
    for file in SOUND:
        for path, text in package(file).models.items():
            result.setdefault(text, f"{file}: {path}")
    return result


def models(files: Sequence[str]) -> Iterator[tuple[str, str, str]]:
    """Path in the package, text, and both in words for messages, of every Modelica file of these sources.

    Versions of one robot share files; what has the same path and text comes once.
    """
    seen: set[tuple[str, str]] = set()
    for file in files:
        for path, text in package(file).models.items():
            if (path, text) not in seen:
                seen.add((path, text))
                yield path, text, f"{file}: {path}"


def test_a_file_without_package_has_a_fault(corpus: Path) -> None:
    for file, codes in FAULTY.items():
        reading = read((corpus / file).read_bytes(), file)
        assert reading.snapshot is None
        assert {d.code for d in reading.diagnostics if d.severity == "error"} == codes, file
        assert all(d.file == file and d.line for d in reading.diagnostics)


# Grammar


@functools.cache
def kinds_of_texts() -> Mapping[str, str]:
    """Texts that differ in nothing but numbers, names and strings are one to a grammar: one of each kind."""
    found = {}
    for text in texts():
        tokens = (token.text for token in lex(text)[0])
        kinds = ('"' if t[:1] == '"' else "0" if t[:1].isdigit() else "a" if is_name(t) else t for t in tokens)
        found[" ".join(kinds)] = text
    return found


@pytest.mark.parametrize("part", PARTS)
def test_pymoca_parses_every_kind_of_text(part: int, corpus: Path) -> None:
    for text in list(kinds_of_texts().values())[part :: len(PARTS)]:
        try:
            tree = pymoca.parser.parse(text, bypass_cache=True)
        except pymoca.parser.ModelicaSyntaxError as error:
            pytest.fail(f"{texts()[text]}: {error}")
        assert tree is not None


@each_source
def test_texts_are_tidy_belong_where_they_are_and_are_full_copies(files: Sequence[str], corpus: Path) -> None:
    """LF at every end of a line, no tabs, no fault that our own parser sees; links and joints extend no others.

    The `within` clause names the folder, and the class has the name of its file.
    """
    for path, text, place in models(files):
        assert not set("\t\r\f\v") & set(text), place
        assert parse(text).faults == [], place
        folder = ["Bot", *PurePosixPath(path).parent.parts]
        own = folder.pop() if path.endswith("package.mo") else PurePosixPath(path).stem
        found = re.match(r"within ?([\w.]*);\n\n(?:model|record|package) (\w+) ", text)
        assert found, place
        assert found.groups() == (".".join(folder), own), place
        assert text.endswith(f"\nend {own};\n"), place
        if path.startswith(("Links/", "Joints/")):
            assert not re.search(r"UrdfSync\.(Links|Joints)\b", code(text)), place


STRING = re.compile(r'"(?:\\.|[^"\\])*"', re.DOTALL)
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d*)?(?:[eE][+-]?\d+)?", re.ASCII)


def code(text: str) -> str:
    """A generated text with empty strings and without annotations."""
    return re.sub(r"\bannotation\s*\([^;]*;", ";", STRING.sub('""', text))


# Layout


@each_source
def test_orders_are_complete_and_names_are_distinct(files: Sequence[str], corpus: Path) -> None:
    """Neither two files nor two components of a robot model have one name, case folded."""
    for made in map(package, files):
        classes: dict[str, list[str]] = {}
        for path in map(PurePosixPath, made.texts):
            assert len(path.parts) <= 2
            assert not path.is_absolute()
            if path.name == "package.mo" and path.parent.name:
                classes.setdefault("package.order", []).append(path.parent.name)
            elif path.suffix == ".mo" and path.name != "package.mo":
                classes.setdefault(str(path.parent / "package.order"), []).append(path.stem)
        orders = {path: text.split() for path, text in made.texts.items() if made.roles[path] is Role.ORDER}
        assert {path: sorted(names) for path, names in orders.items()} == {
            path: sorted(names) for path, names in classes.items()
        }
        components = [identifier.component for identifier in made.skeleton.names.values()]
        for names in ([*made.texts], components):
            assert len({name.lower() for name in names}) == len(names)
        assert all(map(is_identifier, components))


@some_sources
def test_the_compiler_accepts_layout_and_names_of_all_versions(
    files: Sequence[str], corpus: Path, tmp_path: Path
) -> None:
    """Versions that differ in numbers and strings alone have the same layout and the same names.

    What is not found are names of the standard library, which is not there, and what follows from that.
    """
    distinct = {}
    for file in files:
        models = package(file).models.items()
        distinct[tuple((path, NUMBER.sub("0", STRING.sub("0", text))) for path, text in models)] = file
    for number, file in enumerate(distinct.values()):
        unknown = unknown_names(package(file).write(tmp_path / str(number)))
        assert [name for name in unknown if not name.startswith("Modelica.")] == [], file


def unknown_names(folder: Path) -> list[str]:
    """Types, base classes and functions that robot and benches refer to, and that no file has.

    The compiler's session must go in the thread that made it, so no exception may stay that refers to it:
    `pytest.raises` would.
    """
    components = "".join(f"  Bot.Bot{suffix} part{suffix};\n" for suffix in ("", "Run", "Test"))
    source, message = f"model Probe_\n  import UrdfSync;\n{components}end Probe_;\n", ""
    try:
        rumoca.Session(roots=[str(folder), str(URDFSYNC)]).loads(source, model="Probe_", filename="P.mo")
    except rumoca.CompileError as error:
        message = str(error)
    assert message, "it compiles"
    assert "Failed to load source root" not in message, message
    lines = [line for line in message.splitlines() if "unresolved" in line and "component reference" not in line]
    return [line.split("'")[1] for line in lines]


def test_the_compiler_notices_a_wrong_layout(tmp_path: Path) -> None:
    folder = generate(robot(link("arm")).encode(), BOT).write(tmp_path)
    arm = folder / "Links" / "Arm.mo"
    arm.write_text(arm.read_text().replace("within Bot.Links;", "within Bot.Joints;"))
    with pytest.raises(AssertionError, match=r"PKG-010 .* expected `within Bot\.Links;`"):
        unknown_names(folder)


# What must not be in them


@each_source
def test_models_contain_no_number_of_the_urdf(files: Sequence[str], corpus: Path) -> None:
    """A robot with all its numbers changed has other records, and the same models to the byte; benches have none."""
    for made in map(package, files):
        other = scaled(made, 1.37)
        for path, text in made.texts.items():
            if made.roles[path] is not Role.RECORD:
                assert other.texts[path] == text, path
        for suffix in ("Run", "Test"):
            assert NUMBER.findall(code(made.texts[f"Bot{suffix}.mo"])) == []


# Names that break careless generators


NASTY = (
    *("world", "../../evil", 'a"b', "end", "Links", "frame_a", "base link", "Gelenk_ä", "L_arm", "l_arm", "both"),
    *("_", "-", "7", "time", "parameters", "Nasty", "nastyRun", "x\\", "a</code></html>", "*/ //", "'q'", "phi_start"),
    *("modelica", "${prefix}link", "rotationalAxis[1]", "m", "con", "a" * 120),
)
"""Links in a chain; each joint has the name of its child link."""
MESH = 'it\'s "the" mesh.stl'
FACET = "facet normal 0 0 1\nouter loop\nvertex 0 0 {z}\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"


@pytest.fixture(scope="module")
def nasty_package(tmp_path_factory: pytest.TempPathFactory) -> Package:
    """Joints of four types, some with losses, one that mimics."""
    elements = []
    for number, name in enumerate(NASTY):
        quoted, box = quoteattr(name), '<geometry><box size="0.1 0.2 0.3"/></geometry>'
        material = f'<material name={quoted}><color rgba="1 0.5 0 1"/></material>'
        mesh = f"<visual name={quoted}><geometry><mesh filename={quoteattr(MESH)}/></geometry>{material}</visual>"
        shapes = f"{mesh}<visual>{box}</visual><collision name={quoted}>{box}</collision>"
        elements.append(link("", 1).replace('name=""', f"name={quoted}").replace("</link>", f"{shapes}</link>"))
        if number:
            kind = {1: "revolute", 2: "continuous", 3: "prismatic"}.get(number % 10, "fixed")
            ends = f"<parent link={quoteattr(NASTY[number - 1])}/><child link={quoted}/>"
            limits = limit(-1, 1) if kind in ("revolute", "prismatic") else ""
            losses = dynamics(0.1, 0.2) if number in (3, 12) else ""
            follows = f"<mimic joint={quoteattr(NASTY[1])}/>" if number == 11 else ""
            elements.append(f'<joint name={quoted} type="{kind}">{ends}{limits}{losses}{follows}</joint>')
    folder = tmp_path_factory.mktemp("nasty")
    (folder / MESH).write_text(f"solid s\n{FACET.format(z=0)}{FACET.format(z=1)}endsolid s\n")
    (folder / "nasty.urdf").write_text(robot(*elements, name="a&quot;b"), "utf-8")
    return generate(folder / "nasty.urdf", Target("Plant.Nasty", "Nasty"))


def test_nasty_names_stay_in_the_folder(nasty_package: Package, tmp_path: Path) -> None:
    folder = nasty_package.write(tmp_path / "deep" / "deeper")
    written = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert len(written) == len(nasty_package.texts) + len(nasty_package.imports)
    assert all(path.is_relative_to(folder) for path in written)
    assert {path.parent.name for path in written} == {"Nasty", "Links", "Joints", "Resources"}


def test_every_nasty_name_is_in_its_record(nasty_package: Package) -> None:
    """As a string literal that reads back as the name: the mapping can be undone."""
    for kind, name in nasty_package.skeleton.names:
        identifier = nasty_package.skeleton.names[kind, name]
        text = nasty_package.texts[f"{kind.capitalize()}s/{identifier.record}.mo"]
        literal = '"' + name.replace("\\", "\\\\").replace('"', '\\"') + '"'
        assert literal in [token.text for token in lex(text)[0]]


@pytest.mark.slow
def test_nasty_names_compile(nasty_package: Package, modelica_library: Path, tmp_path: Path) -> None:
    nasty_package.write(tmp_path)
    (tmp_path / "Plant" / "package.mo").write_text("within;\npackage Plant\nend Plant;\n")
    (outcome,) = execute(modelica_library, [tmp_path / "Plant"], [compile_task("Plant.Nasty.NastyTest")])
    assert outcome.error == ""
