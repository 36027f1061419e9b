"""The diagram shows the texts on disk: a text gives the places, lines and numbers that OMEdit would show."""

from __future__ import annotations

import re

import pytest
from lxml import etree
from support.packages import generate
from support.urdfs import joint, limit, link, mimic, robot

from urdfsync.domain import Target
from urdfsync.formats.urdf.assembly import Assembly
from urdfsync.formats.urdf.diagram.drawing import draw
from urdfsync.formats.urdf.diagram.layout import FRAME_A, Placement, layout
from urdfsync.formats.urdf.diagram.text import read_model

SVG = "{http://www.w3.org/2000/svg}"
FRAME = {"frame_a": Placement.around(FRAME_A, 32)}
ARM = robot(
    link("base", 5.0),
    link("upper", 3.0),
    link("hand", 1.0),
    link("finger", 0.25),
    joint("shoulder", "revolute", "base", "upper", inside=[limit()]),
    joint("wrist", "revolute", "upper", "hand", inside=[limit()]),
    joint("grip", "revolute", "hand", "finger", inside=[limit(), mimic("wrist", 0.5)]),
)
PACKAGE = generate(ARM.encode(), Target("Bot", "Bot"))
IMU = '  Modelica.Mechanics.MultiBody.Sensors.AbsoluteSensor imu "Added"'
PLACE = "annotation (Placement(transformation(extent={{-20, -120}, {0, -100}})))"
CONNECT = "  connect(imu.frame_a, hand.frame_a)"
LINE = "annotation (Line(points={{-20, -110}, {-30, -110}, {-30, -20}}, color={95, 95, 95}))"


def edited(path: str, *replacements: tuple[str, str]) -> dict[str, tuple[str, str]]:
    """Return a file of the package with replaced pieces, as an edit."""
    text = generated = PACKAGE.texts[path]
    for old, new in replacements:
        assert old in text, old
        text = text.replace(old, new, 1)
    return {path: (generated, text)}


def added(*elements: str, equations: str = "") -> dict[str, tuple[str, str]]:
    return edited("Bot.mo", ("\nequation\n", "\n{}\n\nequation\n{}\n".format("\n".join(elements), equations)))


def drawn(differing: dict[str, tuple[str, str]]) -> etree._Element:
    return etree.fromstring(draw(PACKAGE.robot, PACKAGE.target, PACKAGE.options, differing))


def words(root: etree._Element) -> list[str]:
    return [element.text or "" for element in root.iter(f"{SVG}text")]


def titles(root: etree._Element, *, marked: bool = False) -> set[str]:
    """Return the names of the components in the picture; if `marked`, of those that differ from the source."""
    groups = [group for group in root.iter(f"{SVG}g") if group.find(f"{SVG}title") is not None]
    has_mark = {group: group.find(f".//{SVG}rect[@stroke-dasharray]") is not None for group in groups}
    return {group.findtext(f"{SVG}title") or "" for group in groups if has_mark[group] or not marked}


def test_the_generated_text_has_the_layout() -> None:
    expected = layout(PACKAGE.skeleton, Assembly(PACKAGE.robot, PACKAGE.options, PACKAGE.target).connectors)
    read = read_model(PACKAGE.texts["Bot.mo"], FRAME, {})
    assert read is not None
    assert read.diagram.placements == expected.placements
    assert read.diagram.extent == expected.extent
    assert {frozenset(ends): line for ends, line in read.diagram.lines.items()} == {
        frozenset(ends): line for ends, line in expected.lines.items()
    }


@pytest.mark.parametrize(
    ("edit", "mass"),
    [
        (edited("Links/HandParameters.mo", ("mass = 1", "mass = 1.75")), "1.75 kg"),
        (edited("Links/HandParameters.mo", ("mass = 1", "mass = 2*0.6")), "2*0.6 kg"),
        (edited("Links/HandParameters.mo", ("mass = 1", "mass = = 1")), "? kg"),
        (edited("Links/Hand.mo", ("m = parameters.inertial.mass", "m = 4")), "4 kg"),
        (edited("Bot.mo", ("Links.Hand hand(", "Links.Hand hand(parameters(inertial(mass = 6)), ")), "6 kg"),
        (edited("Bot.mo", ("Links.Hand hand(", "MyHand hand(")), "? kg"),
    ],
)
def test_an_edited_mass_is_shown_and_marked(edit: dict[str, tuple[str, str]], mass: str) -> None:
    picture = drawn(edit)
    assert mass in words(picture)
    assert "1 kg" not in words(picture)
    assert titles(picture, marked=True) == {"hand"}
    assert "differs from the source" in words(picture)


def test_an_edited_ratio_is_shown() -> None:
    picture = drawn(edited("Joints/GripParameters.mo", ("multiplier = 0.5", "multiplier = -2")))
    assert "× -2" in words(picture)
    assert titles(picture, marked=True) == {"grip"}


def test_nothing_is_marked_if_nothing_differs() -> None:
    picture = drawn({})
    assert titles(picture, marked=True) == set()
    assert not {"differs from the source", "not in the source"} & set(words(picture))
    same = drawn(edited("Bot.mo", ("model Bot", "// a remark\nmodel Bot")))
    assert (titles(same, marked=True), words(same)) == (set(), words(picture))


def test_an_added_component_stands_at_its_place_with_its_line() -> None:
    picture = drawn(added(f"{IMU} {PLACE};", equations=f"{CONNECT} {LINE};"))
    assert {"imu", "not in the source"} <= set(words(picture))
    assert '<rect x="-10" y="-10"' in etree.tostring(picture).decode()
    assert 'translate(-10 110)" stroke="#7a3fc0"' in etree.tostring(picture).decode()
    assert "M-20 110L-30 110L-30 20" in etree.tostring(picture).decode()


@pytest.mark.parametrize(
    ("elements", "equations", "names"),
    [
        ([f"{IMU};"], f"{CONNECT};", {"imu"}),
        ([f"{IMU}, second {PLACE};"], f"{CONNECT}; connect(second.frame_a, imu.frame_a);", {"imu", "second"}),
        (["  inner Modelica.Mechanics.MultiBody.World world;", f"{IMU};"], f"{CONNECT};", {"imu", "world"}),
        (["  Foo eyes[2] if true;"], "  connect(eyes[1].frame_a, hand.frame_a);", {"eyes"}),
        (["  Foo 'a b.c';"], "  connect('a b.c'.frame_a, hand.frame_a);", {"'a b.c'"}),
    ],
)
def test_a_component_without_a_place_stands_below(elements: list[str], equations: str, names: set[str]) -> None:
    picture = drawn(added(*elements, equations=equations))
    assert names <= titles(picture)
    read = read_model(added(*elements, equations=equations)["Bot.mo"][1], FRAME, {})
    generated = read_model(PACKAGE.texts["Bot.mo"], FRAME, {})
    assert read is not None
    assert generated is not None
    unplaced = [read.diagram.placements[name] for name in names if PLACE not in elements[0] or name == "imu"]
    assert all(place.y2 <= generated.diagram.extent[1] for place in unplaced)
    assert read.diagram.extent[1] < min(place.y1 for place in unplaced)
    assert len(read.diagram.lines) > len(generated.diagram.lines)


def test_variables_and_parameters_are_no_parts_of_the_picture() -> None:
    declared = added("  parameter Real gain = 2;", "  Modelica.Units.SI.Angle phi, psi;", "  Real x[3];")
    assert titles(drawn(declared)) == titles(drawn({}))


def test_a_user_s_layout_is_that_of_the_picture() -> None:
    text = PACKAGE.texts["Bot.mo"]
    places = re.findall(r"Links\.Hand hand.*?Placement\(transformation\(extent=(\{\{.*?\}\})", text, re.DOTALL)
    turned = "{{-10, -20}, {10, 20}}, origin={300, -90}, rotation=90"
    read = read_model(text.replace(places[0], turned, 1), FRAME, {})
    assert read is not None
    assert read.diagram.placements["hand"] == Placement(280, -100, 320, -80)
    assert read.diagram.extent[2] >= 320


def test_a_component_that_the_user_removed_is_told() -> None:
    text = PACKAGE.texts["Bot.mo"]
    without = re.sub(r"\n  replaceable Joints\.Grip grip\b.*?;\n", "\n", text, count=1, flags=re.DOTALL)
    picture = drawn({"Bot.mo": (text, without)})
    assert "grip" not in titles(picture)
    assert "in the source, but not in Bot.mo: grip" in words(picture)


@pytest.mark.parametrize("damage", ["model Bot", "", "model Bot Foo ; ; end Bot;", "<<<<<<< yours"])
def test_a_model_that_cannot_be_read_is_drawn_from_the_source_and_that_is_told(damage: str) -> None:
    picture = drawn({"Bot.mo": (PACKAGE.texts["Bot.mo"], damage)})
    assert titles(picture) == titles(drawn({}))
    assert "Bot.mo can't be read: this is the diagram of the source" in words(picture)


@pytest.mark.parametrize("number", ["1e300", "Modelica.Constants.inf", "x", "-1e7", '"1"', "{1}"])
def test_a_place_that_no_diagram_has_is_none(number: str) -> None:
    place = PLACE.replace("-120", number)
    picture = drawn(added(f"{IMU} {place};", equations=f"{CONNECT} {LINE.replace('-30', number)};"))
    assert "imu" in titles(picture)
    assert max(map(float, picture.get("viewBox", "").split())) < 2000
