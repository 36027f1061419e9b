"""Packages of the whole corpus as text: grammar, names, layout on disk, and what must not be in them.

Every robot and every version of the histories is rendered, one source of four in CI; but for the last test, nothing is
compiled.
"""

from __future__ import annotations

import functools
import re
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import pytest
from support import corpus
from support.cases import sampled
from support.corpus import FOLDER
from support.modelica import compile_task, execute
from support.packages import Package, generate, proposed_base, read, scaled
from support.urdfs import dynamics, limit, link, robot

from urdfsync.analysis.checks.package import PackageTexts
from urdfsync.analysis.checks.texts import check_layout
from urdfsync.domain import Role, Target
from urdfsync.modelica.lexer import lex
from urdfsync.modelica.names import is_identifier

BOT = Target("Bot", "Bot")
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
_LONG = ("upkie", "Rhoban+placo__python_sigmaban", "pollen-robotics+reachy_mini", "drake-atlas_convex_hull")
"""Sources of many meshes or versions, which take seconds."""


def _marked(case: Any) -> Any:
    (source,) = case.values
    return pytest.param(source, marks=[*case.marks, pytest.mark.slow]) if source.startswith(_LONG) else case


each_source = pytest.mark.parametrize("source", [*map(_marked, sampled(SOURCES, 4))])
"""One robot, or all versions of one history."""


@functools.cache
def package(file: str) -> Package:
    """The package of a file of the corpus, with the `base` that `init` proposes."""
    return generate(FOLDER / file, BOT, base=proposed_base((FOLDER / file).read_bytes()))


def test_a_file_without_package_has_a_fault(corpus: Path) -> None:
    for file, codes in FAULTY.items():
        reading = read((corpus / file).read_bytes(), file)
        assert reading.snapshot is None
        assert {d.code for d in reading.diagnostics if d.severity == "error"} == codes, file
        assert all(d.file == file and d.line for d in reading.diagnostics)


STRING = re.compile(r'"(?:\\.|[^"\\])*"', re.DOTALL)
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d*)?(?:[eE][+-]?\d+)?", re.ASCII)


def code(text: str) -> str:
    """A generated text with empty strings and without annotations."""
    return re.sub(r"\bannotation\s*\([^;]*;", ";", STRING.sub('""', text))


@each_source
def test_packages_are_sound_and_full_copies(source: str, corpus: Path) -> None:
    """`check` finds no fault in texts, names, folders and orders; besides, links and joints extend no other ones.

    Versions that differ only in numbers and strings count as one. LF ends each line, and there are no tabs.
    """
    distinct = {}
    for made in map(package, SOURCES[source]):
        distinct[tuple((path, NUMBER.sub("0", STRING.sub("0", text))) for path, text in made.texts.items())] = made
    for made in distinct.values():
        texts = {path: text.encode() for path, text in made.texts.items()}
        assert check_layout(PackageTexts("Bot", Path("Bot"), texts)) == []
        for path, text in made.models.items():
            assert not set("\t\r\f\v") & set(text), path
            if path.startswith(("Links/", "Joints/")):
                assert not re.search(r"UrdfSync\.(Links|Joints)\b", code(text)), path
        components = [identifier.component for identifier in made.skeleton.names.values()]
        assert len({name.lower() for name in components}) == len(components)
        assert all(map(is_identifier, components))


@each_source
def test_models_contain_no_number_of_the_urdf(source: str, corpus: Path) -> None:
    """If all numbers of a robot change, its records change, and its models stay equal to the byte."""
    for made in map(package, SOURCES[source]):
        other = scaled(made, 1.37)
        for path, text in made.texts.items():
            # if nothing drives a freedom of a loop, the numbers decide which joint is its state
            if made.roles[path] is not Role.RECORD and not source.startswith(("drake-robotiq", "pollen-robotics")):
                assert other.texts[path] == text, path
        for suffix in ("Run", "Test"):
            text = code(made.texts[f"Bot{suffix}.mo"]).replace("[3](each unit", "")  # vectors of sensors
            assert NUMBER.findall(text) == []


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
        shapes = "" if is_identifier(name) else shapes  # which take the longest part of the compilation
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
    """The text has the name as a string literal, so the mapping can be undone."""
    for kind, name in nasty_package.skeleton.names:
        identifier = nasty_package.skeleton.names[kind, name]
        text = nasty_package.texts[f"{kind.capitalize()}s/{identifier.record}.mo"]
        literal = '"' + name.replace("\\", "\\\\").replace('"', '\\"') + '"'
        assert literal in [token.text for token in lex(text)[0]]


@pytest.mark.slow
@pytest.mark.large  # every name is in its record, and compiles, in the test before
def test_nasty_names_compile(nasty_package: Package, modelica_library: Path, tmp_path: Path) -> None:
    nasty_package.write(tmp_path)
    (tmp_path / "Plant" / "package.mo").write_text("within;\npackage Plant\nend Plant;\n")
    (outcome,) = execute(modelica_library, [tmp_path / "Plant"], [compile_task("Plant.Nasty.NastyTest")])
    assert outcome.error == ""
