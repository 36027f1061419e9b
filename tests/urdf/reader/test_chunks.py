"""Reading what has changed: what comes of it is what a fresh reading gives, and what is parsed is only that."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support import replay
from support.urdfs import joint, link, robot

from urdfsync.diagnostics import Diagnostic
from urdfsync.domain import Parts, Reading
from urdfsync.urdf import source
from urdfsync.urdf.domain import DOMAIN
from urdfsync.urdf.options import Options
from urdfsync.urdf.reader import part, xml

ONCE, TWICE = Options(cross_check=False), Options()


def arm(elbow: float = 2.0, *more: str) -> str:
    """Three links in a row, each element in a line of its own."""
    links = [link("base"), link("upper", 1.0), link("fore", elbow)]
    joints = [joint("shoulder", "continuous", "base", "upper"), joint("elbow", "continuous", "upper", "fore")]
    return robot(*links, *joints, *more)


def fresh(content: bytes, options: Options = ONCE) -> Reading:
    return DOMAIN.read(content, "a.urdf", options)


def read_in_turn(contents: Sequence[bytes], options: Options = ONCE) -> list[Reading]:
    """One version after the other, each of which has to give what a fresh reading gives, down to the order of keys."""
    parts: Parts = {}
    readings = [DOMAIN.read(content, "a.urdf", options, parts) for content in contents]
    for content, found in zip(contents, readings, strict=True):
        wanted = fresh(content, options)
        assert repr(found.snapshot) == repr(wanted.snapshot)
        assert found.diagnostics == wanted.diagnostics
        assert found.lines == wanted.lines
    return readings


# What stays the same, stays the same object


def elements(reading: Reading) -> Mapping[tuple[str, str], object]:
    assert reading.snapshot is not None
    return {(kind, name): data for kind in ("links", "joints") for name, data in reading.snapshot[kind].items()}


GREY = '<material name="grey"><color rgba="{0} {0} {0} 1"/></material>'
BOX = '<visual><geometry><box size="1 1 1"/></geometry><material name="grey"/></visual>'
BOXES = [*(f'<link name="{name}">{BOX}</link>' for name in "ab"), joint("ab", "fixed", "a", "b")]
CHANGES = {
    "nothing": (arm(), arm(), set()),
    "a mass": (arm(), arm(3.0), {("links", "fore")}),
    "another line": (arm(), arm().replace("<mass", "\n<mass"), set()),
    "a comment above": (arm(), f"<!-- exported\ntoday -->{arm().partition('?>')[2]}", set()),
    "the robot's name": (arm(), arm().replace('"own"', '"other"'), set()),
    "order": (robot(*BOXES, GREY.format(1)), robot(GREY.format(1), *reversed(BOXES)), set()),
    "a material": (
        robot(GREY.format(1), *BOXES),
        robot(GREY.format(0), *BOXES),
        {("links", "a"), ("links", "b")},
    ),
    "an axis that is normalised": (
        robot(link("a"), link("b"), joint("ab", "continuous", "a", "b", axis="0 0 2")),
        robot(link("a"), link("b", 1.0), joint("ab", "continuous", "a", "b", axis="0 0 2")),
        {("links", "b")},
    ),
    "a document type": (f"<!DOCTYPE robot>{arm().partition('?>')[2]}", arm(), set()),
}


@pytest.mark.parametrize(("old", "new", "changed"), CHANGES.values(), ids=CHANGES)
def test_elements_that_have_not_changed_are_the_same_objects(old: str, new: str, changed: set[tuple[str, str]]) -> None:
    before, after = map(elements, read_in_turn([old.encode(), new.encode()]))
    assert {key for key, data in after.items() if data is not before[key]} == changed


def test_a_version_that_can_not_be_read_leaves_no_trace() -> None:
    good, broken, twice = arm(), arm().replace("</robot>", ""), arm(2.0, link("fore", 5.0))
    readings = read_in_turn([text.encode() for text in (good, broken, twice, good.replace("rpy", " rpy"), good)])
    assert [reading.snapshot is None for reading in readings] == [False, True, True, False, False]
    first, *_, last = readings
    assert all(data is elements(first)[key] for key, data in elements(last).items())


def test_objects_are_those_of_the_last_version() -> None:
    readings = read_in_turn([arm(mass).encode() for mass in (1.0, 2.0, 2.0)])
    one, other, last = (elements(reading)["links", "fore"] for reading in readings)
    assert one is not other
    assert other is last


# What is parsed


@pytest.fixture
def parsed(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The texts that are parsed, in the order of time."""
    texts: list[str] = []
    parse = xml.parse

    def noting(text: str, taker: xml.Taker) -> Mapping[str, Diagnostic]:
        texts.append(text)
        return parse(text, taker)

    monkeypatch.setattr(xml, "parse", noting)
    return texts


LINES = arm().splitlines(keepends=True)
FIRST, LAST = f"{' ' * len(LINES[0].strip())}\n{LINES[1]}", LINES[-1]
EDITS = {
    "nothing": (2, "", "", ""),
    "a number": (4, '"2.0"', '"3.0"', LINES[4].replace('"2.0"', '"3.0"')),
    "the first child": (2, "<link", "<link ", LINES[2].replace("<link", "<link ")),
    "the last child": (6, "<joint", "<joint ", LINES[6].replace("<joint", "<joint ")),
    "a child more": (5, "<joint", "<gazebo/><joint", "<gazebo/>"),
    "a child less": (4, LINES[4], "", ""),
    "a comment before a child": (4, "<link", "<!-- <link/> --><link", LINES[3] + "<!-- <link/> -->"),
    "a comment behind a child": (3, "\n", "<!-- <link/> -->\n", LINES[3].replace("\n", "<!-- <link/> -->\n")),
}


@pytest.mark.parametrize(("number", "old", "new", "excerpt"), EDITS.values(), ids=EDITS)
def test_only_what_has_changed_is_parsed(number: int, old: str, new: str, excerpt: str, parsed: list[str]) -> None:
    lines = [*LINES[:number], LINES[number].replace(old, new, 1), *LINES[number + 1 :]]
    parts: Parts = {}
    for text in (arm(), "".join(lines)):
        source.read_robot(text.encode(), "a.urdf", cross_check=False, parts=parts)
    assert parsed[1:] == [FIRST + excerpt + LAST]


def test_where_much_has_changed_the_rest_is_parsed_but_not_read(
    parsed: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    names = [f"l{number}" for number in range(50)]
    joints = [joint(name, "fixed", "base", name) for name in names]
    read: list[str] = []

    def noting(node: xml.Node, path: str, text: str) -> part.Part:
        read.append(path)
        return part.read_part(node, path, text)

    monkeypatch.setattr(source, "read_part", noting)
    parts: Parts = {}
    for mass in (1.0, 2.0):
        read.clear()
        text = robot(link("base"), *(link(name, mass) for name in names), *joints, f"<gazebo>{mass}</gazebo>")
        assert source.read_robot(text.encode(), "a.urdf", cross_check=False, parts=parts).robot is not None
    assert read == [*(f"link {name}" for name in names), "gazebo number 1"]
    assert len(parsed) == 2
    assert joints[-1] in parsed[1]


def test_what_stands_at_the_end_is_not_parsed_again_however_much_has_changed(parsed: list[str]) -> None:
    names = [f"l{number}" for number in range(50)]
    joints = [joint(name, "fixed", "base", name) for name in names]
    parts: Parts = {}
    for mass in (1.0, 2.0):
        text = robot(link("base"), *(link(name, mass) for name in names), *joints)
        assert source.read_robot(text.encode(), "a.urdf", cross_check=False, parts=parts).robot is not None
    assert [text.count("<joint") for text in parsed] == [50, 0]


# What a child of the root says by itself, and what it does not


def own(*children: str, start: str = '<robot name="r">', end: str = "</robot>") -> str:
    return "".join([start, *children, end])


A, B = '<link name="a"/>', '<link name="b"/>'
AB = '<joint name="ab" type="fixed"><parent link="a"/><child link="b"/></joint>'
X = '<x:e y:z="1"/>'
T, U = (f'<transmission name="t"><joint name="{name}"/></transmission>' for name in ("ab", "abc"))
IDS = '<!DOCTYPE robot [<!ATTLIST sensor kind NMTOKENS #IMPLIED>]><robot name="r">'
TRICKS: dict[str, list[str]] = {
    "a comment that swallows a child": [
        own(A, B, AB, end="</robot><?x --></robot><?y ?>"),
        own(A, "<!--", B, AB, end="</robot><?x --></robot><?y ?>"),
    ],
    "children in a comment": [own(A, "<gazebo/>\n", "<gazebo/>\n "), own(A, "<!-- <gazebo/>\n<gazebo/>\n -->")],
    "children in CDATA": [own(A, "<gazebo/>\n"), own(A, "<q><![CDATA[<gazebo/>\n]]></q>")],
    "a child inside another one": [own(A, "<gazebo/>\n"), own(A, "<q><gazebo/>\n</q>")],
    "a root inside the root": [own(A, "<gazebo/>"), own(A, "<robot>", "<gazebo/>", "</robot>")],
    "an end that is none": [own(A, "<gazebo/>"), own(A, "<gazebo/>", end="<!-- </robot> --></robot><!-- </robot> -->")],
    "a second root": [own(A), own(A) + own(A)],
    "text instead of a root": [own(A), "a"],
    "no children": [own(A), own(), own(A), "<robot/>"],
    "numbers of equal names": [own(A, "<q name='1'/>", "<q name='1' />"), own(A, "<q name='1' />", "<q name='1'/>")],
    "places of nameless materials": [
        own(A, "<material/>", "<material><color rgba='a'/></material>"),
        own(A, "<material><color rgba='a'/></material>", "<material/>"),
        own("<material><color rgba='a'/></material>", A),
    ],
    "a namespace": [own(A, "<x:e/>", start=f'<robot name="r" xmlns:x="{uri}">') for uri in ("u", "v")],
    "a namespace that is taken away": [own(A, "<x:e/>", start='<robot name="r" xmlns:x="u">'), own(A, "<x:e/>")],
    "prefixes without a namespace": [own(A, X), own(A, "\n", X), own(A, "\n<x:f/>", X), own(A, "<y:f/>"), own(A)],
    "one more of them": [own(A), own(A, "\n", X), own(A, "\n", X, "\n<q/>")],
    "the kind of an attribute": [own(A, "<sensor kind='  a  '/>", start=start) for start in (IDS, '<robot name="r">')],
    "the kind of an attribute, later": [
        own(A, "<sensor kind='  a  '/>", start=start) for start in ('<robot name="r">', IDS)
    ],
    "an identity": [own(A, "<q xml:id='a'/>"), own(A, "<q xml:id='a'/>", "<p xml:id='a'/>")],
    "merge markers": [own(A, "\n", "<q/>"), own(A, "\n<<<<<<< HEAD\n", "<q/>")],
    "an entity": [own(A, "<q/>"), own(A, "<q>&e;</q>")],
    "a transmission": [own(A, B, turn, *end) for turn in (AB, AB.replace(">", " >")) for end in ([], [T], [T, T], [U])],
    "xacro": [own(A, "<xacro:leg/>"), own("<xacro:leg/>"), own(A, "<xacro:leg/>", "<material name='&#36;{a}'/>")],
    "a material elsewhere": [own(*BOXES, material) for material in (GREY.format(1), GREY.format("x"), "", "<q/>")],
    "several definitions": [own(*BOXES, *(GREY.format(n) for n in numbers)) for numbers in ((1, 0), (0, 1), (0, 0))],
    "a joint that connects nothing": [own(A, B, AB), own(A, B, AB.replace('"b"', '"c"')), own(A, B, AB[:42] + "/>")],
    "warnings told as one": [own(*(f"<link name='{n}' nam='1'/>\n" for n in range(k))) for k in (1, 4, 5)],
    "fewer of the same": [own(A, *["<gazebo/>"] * count, B, AB) for count in (5, 2, 3, 0)],
    "the same at both ends": [own("<gazebo/>", A, "<gazebo/>"), own("<gazebo/>"), own("<gazebo/>", "<gazebo/>", A)],
    "elements that change places": [own(A, B, AB, X), own(B, A, X, AB), own(X, AB, B, A)],
    "a child less at the start": [own("<gazebo/>\n", A, B, AB), own(A, B, AB), own("\n", A, B, AB)],
    "line ends": [own(A, "\n", B, "\n", AB), own(A, "\r\n", B, "\r", AB, "<q/>")],
    "another format": [own(A), own(A, start="<sdf>", end="</sdf>"), own(A)],
}


@pytest.mark.parametrize("texts", TRICKS.values(), ids=TRICKS)
def test_what_depends_on_other_places(texts: list[str]) -> None:
    contents = [text.encode() for text in texts]
    read_in_turn([own(A, B, AB).encode(), *contents, *reversed(contents)])


def test_encodings() -> None:
    texts = [arm(mass).replace('"1.0"', f'"1.0" encoding="{code}"', 1) for mass in (1.0, 2.0) for code in ENCODINGS]
    readings = read_in_turn([text.encode(code) for text, code in zip(texts, 2 * ENCODINGS, strict=True)])
    assert all(reading.snapshot for reading in readings)


ENCODINGS = ["utf-8", "utf-16", "latin-1"]


# Any robots, any edits

HEADS = [
    '<robot name="r">',
    '<?xml version="1.0"?>\n<!-- <link> -->\n<robot xmlns:x="u">\n',
    "<robot xmlns:x='v' name=''>",
]
TAILS = ["</robot>", "\n</robot>\n<!-- </robot> -->", "</robot><?x --></robot><?y ?>"]
NAMES = st.sampled_from("abcdefgh")
NUMBERS = st.sampled_from(["0", "1", "2.5", "-1", "1e-9", "x", ""])
BODIES = st.builds(
    (
        '<link name="{0}"><inertial><mass value="{1}"/></inertial>\n<visual><geometry><sphere radius="{2}"/></geometry>'
        '<material name="{3}"/></visual></link>\n<joint name="{0}" type="{4}"><parent link="base"/><child link="{0}"/>'
        '<axis xyz="0 0 {1}"/><mimic joint="{5}" offset="{2}"/><sensor n="{2}"/></joint>'
    ).format,
    *(NAMES, NUMBERS, NUMBERS, NAMES, st.sampled_from(["fixed", "continuous", "revolute", "spring"]), NAMES),
)
OTHERS = st.builds(
    str.format,
    st.sampled_from(
        [
            '<material name="{0}"><color rgba="0 0 {1} 1"/></material>\n',
            '<gazebo reference="{0}">{1}</gazebo>',
            '<transmission name="{1}">\n<joint name="{0}"/></transmission>',
            '<ros2_control name="{1}"><joint name="{0}"><command_interface/></joint></ros2_control>',
            "<x:e>\n<x:f/><![CDATA[</robot>]]></x:e>\n",
            "<y:e/>\n",
            '<xacro:{0} n="${{{1}}}"/>',
            '<link name="{0}" nam="{1}"/>',
            "<!-- {0}\n -->",
            "<?{0} {1}?>\n",
        ]
    ),
    NAMES,
    NUMBERS,
)
NOISE = st.sampled_from(
    [
        *"<>&'\"- \n",
        "<!--",
        "-->",
        "<![CDATA[",
        "]]>",
        "<?x ",
        "?>",
        "/>",
        "</robot>",
        "<robot>",
        "<e/>",
        "&#65;",
        "${1}",
    ]
)
CHILDREN = st.one_of(BODIES, OTHERS)


@st.composite
def versions(draw: st.DrawFn) -> list[bytes]:
    """Each version is an earlier one with some edits."""
    pieces = [draw(st.sampled_from(HEADS)), '<link name="base"/>', *draw(st.lists(CHILDREN, max_size=6))]
    known = [[*pieces, draw(st.sampled_from(TAILS))]]
    for _ in range(draw(st.integers(1, 5))):
        pieces = list(draw(st.sampled_from(known)))
        for _ in range(draw(st.integers(1, 2))):
            place = draw(st.integers(0, len(pieces) - 1))
            match draw(st.sampled_from(["insert", "replace", "remove", "repeat", "noise", "number", "move"])):
                case "insert":
                    pieces.insert(place, draw(CHILDREN))
                case "replace":
                    ends = HEADS if not place else TAILS if place == len(pieces) - 1 else None
                    pieces[place] = draw(st.sampled_from(ends) if ends else CHILDREN)
                case "remove":
                    pieces[place] = ""
                case "repeat":
                    pieces.insert(draw(st.integers(0, len(pieces))), pieces[place])
                case "number":
                    pieces[place] = re.sub(r'(?<=value=")[^"]*|(?<=radius=")[^"]*', draw(NUMBERS), pieces[place])
                case "move":
                    pieces.insert(draw(st.integers(0, len(pieces) - 1)), pieces.pop(place))
                case "noise":
                    offset = draw(st.integers(0, len(pieces[place])))
                    pieces[place] = pieces[place][:offset] + draw(NOISE) + pieces[place][offset:]
        known.append(pieces)
    return ["".join(pieces).encode() for pieces in known]


@pytest.mark.parametrize("options", [ONCE, TWICE], ids=["one reader", "two readers"])
@settings(deadline=None)
@given(contents=versions())
def test_any_edits_of_any_robots(options: Options, contents: list[bytes]) -> None:
    read_in_turn(contents, options)


@pytest.mark.parametrize(
    "name",
    [
        "ROBOTIS-GIT+turtlebot3__turtlebot3_description_urdf_turtlebot3_waffle_pi",
        "Rhoban+placo__python_sigmaban_robot",
    ],
)
def test_real_histories(name: str, corpus: None) -> None:
    read_in_turn(replay.histories()[name])
