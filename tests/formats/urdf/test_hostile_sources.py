"""Hostile sources: a robot with changed values, names, elements, entities, encodings and bytes.

Reader and generation end with a model or with complete diagnostics, and nothing that was read leaves a string of the
generated Modelica. `URDFSYNC_CASES=100000` runs so many cases with fresh seeds.
"""

from __future__ import annotations

import copy
import functools
import re
from collections.abc import Sequence
from pathlib import Path

import msgspec
import pytest
from hypothesis import event, given
from hypothesis import strategies as st
from lxml import etree
from support import corpus
from support.cases import SMALL_ROBOTS, damaged, often, seldom

from urdfsync.common.diagnostics import Severity
from urdfsync.common.files import Templates
from urdfsync.domain import Lookup, Target, Version
from urdfsync.engine.package.generate import generate
from urdfsync.formats.urdf.domain import DOMAIN
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import Robot
from urdfsync.modelica.parser import parse
from urdfsync.project.config import templates_folder

LARGEST = 12_000
"""Bytes of a robot of the corpus that is changed."""
TARGET = Target("Plant.Bot", "Bot")

NUMBERS = (
    *"nan inf -inf NaN Infinity 1e999 -1e999 1e308 5e-324 1e-999 -0 -0.0 0 1 -1 3.14 1. .5 +1 1e 1e5 0x10 0b1".split(),
    *"1_000 1,5 ١٢ ¼ true None 1;2;3".split(),
    *("1" * 400, "9" * 5000, "1 2", "1 2 3", "0 0 0", "1e200 1e200 1e200", "nan nan nan", "1 2 3 4", "1\t2\n3"),
)
TEXTS = (
    *("", " ", "\t", "{{1}}", "<< 1 >>", "<% include 'x' %>", "$(find x)/y", "a" * 300, "ä" * 3000, "\\n"),
    *"a A arm base world time end frame_a Links 7 _ - . .. / ../../evil a/b C:\\x con nul".split(),
    *"a\"b a'b a\\ */ // ]]> < &amp; &#0; &#27; ${x} é e\u0301 ﬁ İ ß 🤖 \ud7ff \ufdd0 \U0010ffff 名前 %s%n".split(),
    *("\u202e", "\u0000", "\u001b[31m", "\u0085", "\u2028"),
    *"package://a/b.stl file:///etc/passwd model://x modelica://A/B http://a/b.stl ~/x.stl a.stl".split(),
)
KINDS = ("revolute", "continuous", "prismatic", "fixed", "floating", "planar", "ball", "", "Revolute")
TAGS = (
    *"link joint robot origin axis inertial mass inertia visual collision geometry box mesh sphere cylinder".split(),
    *"capsule ellipsoid material color texture limit dynamics mimic parent child safety_controller calibration".split(),
    *"transmission gazebo ros2_control sensor".split(),
)
ATTRIBUTES = ("name", "xyz", "rpy", "value", "type", "link", "joint", "rgba", "size", "quat", "mass", "foo")
HEADS = (
    '<!DOCTYPE robot [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>',
    '<!DOCTYPE robot [<!ENTITY x SYSTEM "file:///etc/passwd">]>',
    '<!DOCTYPE robot SYSTEM "file:///dev/zero">',
    '<!DOCTYPE robot PUBLIC "-//A//B" "http://127.0.0.1:9/a.dtd">',
    '<!DOCTYPE robot [<!ATTLIST link name CDATA "default">]>',
    '<!DOCTYPE robot [<!ENTITY % p SYSTEM "file:///etc/passwd">%p;]>',
    '<?xml-stylesheet href="file:///etc/passwd"?>',
    "<!-- -- -->",
    "<![CDATA[",
    "<<<<<<< mine",
)
PIECES = (*HEADS, *"< > & &x; &#x1b; &#1114112; \x00 \x1b \ufeff <a:b/> <robot> </robot> &a; &b;".split(" "))
ENCODINGS = (
    *("utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32", "latin-1", "cp1252", "cp037", "utf-7"),
    *("shift_jis", "gb18030", "big5", "iso2022_jp", "koi8-r", "ascii"),
)
DECLARED = (
    *ENCODINGS,
    *("rot13", "hex", "zlib", "idna", "punycode", "unicode_escape", "raw_unicode_escape", "undefined", "mbcs", "UCS-4"),
    *("x" * 100, "utf-8\n", "UTF8", "u", "../utf8"),
)
DECLARATIONS = st.builds(
    '{}<?xml version="{}" encoding="{}"?>'.format,
    st.sampled_from(["", "\n", " "]),
    st.sampled_from(["1.0", "1.1", "0.0", "", "2"]),
    st.sampled_from(DECLARED),
)
CONTROLS = re.compile(r"[\x00-\x09\x0b-\x1f\x7f-\x9f\ud800-\udfff]")
OPTIONS = st.builds(
    Options,
    base=st.sampled_from(["fixed", "floating"]),
    approach=st.sampled_from([("package",), ("package", "record"), ("record",)]),
    frames=st.sampled_from(["leaves", "all"]),
    inputs=st.sampled_from(["names", "vector"]),
    collisions=st.booleans(),
)


@functools.cache
def small_corpus() -> Sequence[str]:
    """The small robots of the corpus; none where there is no corpus."""
    files = [corpus.FOLDER / file for file in corpus.robots() if file != corpus.ABSENT]
    return [path.read_text(errors="replace") for path in files if path.stat().st_size <= LARGEST]


def originals() -> st.SearchStrategy[str]:
    return SMALL_ROBOTS | st.sampled_from(small_corpus()) if small_corpus() else SMALL_ROBOTS


@st.composite
def sources(draw: st.DrawFn, original: st.SearchStrategy[str]) -> bytes:
    """A robot after some changes of elements, of the text, and of bytes."""
    text = draw(original)
    if draw(st.booleans()) and (root := etree.fromstring(text.encode(), etree.XMLParser(recover=True))) is not None:
        for _ in range(draw(st.integers(1, 4))):
            change_element(draw, root)
        text = etree.tostring(root, encoding="unicode")
    for _ in range(draw(st.integers(0, 3))):
        text = changed_text(draw, text)
    if seldom(draw):
        return text.encode(draw(st.sampled_from(ENCODINGS)), "replace")
    content = text.encode(errors="surrogatepass")
    return draw(damaged(content)) if seldom(draw) else content


def change_element(draw: st.DrawFn, root: etree._Element) -> None:
    elements = [element for element in root.iter("*") if element is not root]
    if not elements:
        return
    element, other = draw(st.sampled_from(elements)), draw(st.sampled_from(elements))
    parent = element.getparent()
    match draw(st.sampled_from(["remove", "repeat", "move", "retag", "swap", "swap", "set", "kinds", "nest", "chain"])):
        case "remove" if parent is not None:
            parent.remove(element)
        case "repeat" if parent is not None:
            parent.extend([copy.deepcopy(element) for _ in range(draw(st.sampled_from([1, 2, 30])))])
        case "move" if element is not other and element not in other.iterancestors():
            other.append(element)
        case "retag":
            element.tag = draw(st.sampled_from(TAGS))
        case "swap":  # values of one element go to another: duplicate names, cycles, two parents
            same = [found for found in root.iter(str(element.tag)) if found is not element] or [other]
            element.attrib.update(dict(draw(st.sampled_from(same)).attrib))
        case "set":
            name = draw(st.sampled_from([*ATTRIBUTES, *map(str, element.attrib)]))
            if draw(st.booleans()):
                element.attrib.pop(name, None)
            else:
                element.set(name, draw(st.sampled_from(["", "1", "0 0 0", "x", "base"])))
        case "kinds":
            for joint in root.iter("joint"):
                joint.set("type", draw(st.sampled_from(KINDS)))
        case "nest":
            for _ in range(draw(st.sampled_from([3, 50, 250]))):
                element = etree.SubElement(element, "gazebo")
        case "chain":
            above = next((found.get("name", "") for found in root.iter("link")), "base")
            for number in range(draw(st.sampled_from([5, 40, 120]))):
                etree.SubElement(root, "link", name=f"chain{number}")
                joint = etree.SubElement(root, "joint", name=f"c{number}", type=KINDS[number % 6])
                etree.SubElement(joint, "parent", link=above)
                etree.SubElement(joint, "child", link=f"chain{number}")
                etree.SubElement(joint, "mimic", joint=f"c{number * 7 % 11}")
                above = f"chain{number}"


def changed_text(draw: st.DrawFn, text: str) -> str:
    values = list(re.finditer(r'[\w:]+="([^"]*)"', text))
    at = draw(st.integers(0, len(text)))
    match draw(st.sampled_from(["value", "value", "number", "rename", "insert", "head", "declare", "cut"])):
        case "value" if values:
            place, value = draw(st.sampled_from(values)), draw(st.sampled_from((*NUMBERS, *TEXTS)))
            return text[: place.start(1)] + value.replace('"', "&quot;") + text[place.end(1) :]
        case "number" if numbers := list(re.finditer(r'(?<=[" ])[-.\d]+(?=[" ])', text)):
            place = draw(st.sampled_from(numbers))
            return text[: place.start()] + draw(st.sampled_from(NUMBERS)) + text[place.end() :]
        case "rename" if names := re.findall(r'name="([^"]+)"', text):  # wherever the name stands
            new = draw(st.sampled_from(TEXTS)).replace('"', "&quot;").replace("<", "&lt;")
            return text.replace(f'"{draw(st.sampled_from(names))}"', f'"{new}"')
        case "insert":
            return text[:at] + draw(st.sampled_from(PIECES)) + text[at:]
        case "head":
            return draw(st.sampled_from(HEADS)) + text.replace('name="', 'name="&a;', 1)
        case "declare":
            return draw(DECLARATIONS) + re.sub(r"<\?xml.*?\?>", "", text)
        case "cut":
            return text[:at]
    return text


@pytest.mark.slow
@often(150)
@given(sources(originals()), OPTIONS)
def test_a_source_is_read_and_generated_or_has_complete_diagnostics(content: bytes, options: Options) -> None:
    reading = DOMAIN.read(content, "bot.urdf", options)
    assert all(one.message and one.code and one.line >= 0 <= one.column for one in reading.diagnostics)
    assert (reading.snapshot is None) == any(one.severity is Severity.ERROR for one in reading.diagnostics)
    event("generated" if reading.snapshot else "refused")
    if reading.snapshot is None:
        return
    assert msgspec.json.decode(msgspec.json.encode(reading.snapshot), type=Robot) == reading.snapshot
    DOMAIN.dependencies(reading.snapshot, Lookup(Path("bot.urdf").absolute()), options, reading.lines)
    DOMAIN.advice.propose(reading.snapshot, reading.diagnostics)
    package = generate(DOMAIN, Version(reading.snapshot), TARGET, options, Templates((templates_folder(DOMAIN),), ""))
    for path in package.artifacts:
        text = package.content(path).decode()
        assert CONTROLS.findall(text) == [], path
    assert parse(package.content("package.mo").decode()).faults == []
    assert parse(text).faults == [], path
    if (drawing := DOMAIN.drawing(reading.snapshot, {}, TARGET, options, {})) is not None:
        etree.fromstring(drawing.encode())
