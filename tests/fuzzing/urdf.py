"""Mutated URDF text through the reader and the generation; some of it through whole builds, after a build of the robot.

Seeds are small robots made at random, and the smaller ones of the corpus if there is one. A mutation knows the
structure of a URDF: it changes values, names, elements and their places, then the text, its entities and its encoding,
at last bytes.
"""

from __future__ import annotations

import copy
import functools
import re
from collections.abc import Sequence
from pathlib import Path
from random import Random
from typing import Any

import msgspec
from lxml import etree
from support import corpus, robots
from support.workplace import Fault, Workplace

from fuzzing.cases import run_cases
from urdfsync.config import templates_folder
from urdfsync.diagnostics import Severity, UrdfsyncError
from urdfsync.domain import Lookup, Target, Templates
from urdfsync.engine.generate import generate
from urdfsync.modelica.parser import parse
from urdfsync.urdf.domain import DOMAIN
from urdfsync.urdf.options import Options

PARSED = 10
"""The package of one of so many cases is read as Modelica, which takes more time than all the rest."""
BUILDS = 100
"""One of so many cases goes through whole builds."""
LARGEST = 12_000
"""Bytes of a robot of the corpus that serves as a seed."""
TARGET = Target("Plant.Bot", "Bot")
CONFIGURATION = """\
[robots.bot]
source = "bot.urdf"
package = "Bot"
approach = ["package", "record"]
"""

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
    *"capsule material color texture limit dynamics mimic parent child safety_controller calibration".split(),
    *"transmission gazebo ros2_control a:b xacro:if sensor".split(),
)
ENTITIES = (
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
ENCODINGS = (
    *("utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32", "latin-1", "cp1252", "cp037", "utf-7"),
    *("shift_jis", "gb18030", "big5", "iso2022_jp", "koi8-r", "ascii"),
)
DECLARED = (
    *ENCODINGS,
    *("rot13", "hex", "zlib", "idna", "punycode", "unicode_escape", "raw_unicode_escape", "undefined", "mbcs", "UCS-4"),
    *("x" * 100, "utf-8\n", "UTF8", "u", "../utf8"),
)
_CONTROLS = re.compile(r"[\x00-\x09\x0b-\x1f\x7f-\x9f\ud800-\udfff]")
_ATTRIBUTE = re.compile(r'([\w:]+)="([^"]*)"')


def run(count: int, seed: int) -> int:
    """Run cases; returns the number of faults."""
    return run_cases("URDF", functools.partial(_case, Workplace(Path.cwd() / "work")), count, seed)


def _case(work: Workplace, random: Random) -> str:
    original = _seed(random)
    content = mutated(original, random)
    if random.randrange(BUILDS) == 0:
        return _build(work, original.encode(), content, random)
    return read_and_generate(content, random)


def read_and_generate(content: bytes, random: Random) -> str:
    """Take a source through reader and generation; what they must keep to is checked. Returns what became of it."""
    options = _options(random)
    reading = DOMAIN.read(content, "bot.urdf", options)
    for found in reading.diagnostics:
        if not found.message or not found.code or found.line < 0 or found.column < 0:
            raise Fault(f"an incomplete diagnostic: {found!r}")
    failed = any(found.severity is Severity.ERROR for found in reading.diagnostics)
    if (reading.snapshot is None) is not failed:
        raise Fault(f"a model and errors, or neither: {reading.diagnostics}")
    if reading.snapshot is None:
        return "refused"
    if msgspec.json.decode(msgspec.json.encode(reading.snapshot)) != msgspec.to_builtins(reading.snapshot):
        raise Fault("the recorded model is not the one that was read")
    list(DOMAIN.check_options(reading.snapshot, options))
    DOMAIN.dependencies(reading.snapshot, Lookup(Path("bot.urdf").absolute()), options, reading.lines)
    DOMAIN.propose(reading.snapshot)
    templates = Templates((templates_folder(DOMAIN),), "")
    try:
        package = generate(DOMAIN, reading.snapshot, {}, TARGET, options, templates)
    except UrdfsyncError as error:
        raise Fault(f"a model that was read, and can't be generated: {error}") from None
    parses = random.randrange(PARSED) == 0
    for path in package.artifacts:
        text = package.content(path).decode()
        if odd := _CONTROLS.findall(text):
            raise Fault(f"{path} has the characters {odd!r}")
        if parses and (faults := parse(text).faults):
            raise Fault(f"{path} is no Modelica: {faults[:3]}")
    if random.random() < 0.1 and (drawing := DOMAIN.drawing(reading.snapshot, {}, TARGET, options)) is not None:
        etree.fromstring(drawing.encode())
    return "generated"


def _options(random: Random) -> Options:
    chosen: dict[str, Any] = {
        "base": random.choice(("fixed", "floating")),
        "approach": random.choice((("package",), ("package", "record"), ("record",))),
        "frames": random.choice(("leaves", "all")),
        "inputs": random.choice(("names", "vector")),
        "collisions": random.random() < 0.8,
        "visualizer": random.choice(("standard", "standard", "visualization2")),
    }
    return Options(**chosen)


def _build(work: Workplace, original: bytes, content: bytes, random: Random) -> str:
    """Build the robot, then its mutation, as after an export."""
    empty = work.folder / "empty"
    if not empty.is_dir():
        empty.mkdir(parents=True)
        (empty / "urdfsync.toml").write_text(CONFIGURATION)
    work.fill(empty)
    source = work.project / "bot.urdf"
    source.write_bytes(original)
    work.run(["build"])
    source.write_bytes(content)
    for command in (
        ["diff"],
        ["status"],
        ["build"],
        ["record", "bot.urdf"],
        ["init", "--config", "other.toml", "bot.urdf"],
    ):
        if command == ["build"] or random.random() < 0.5:
            code, _ = work.run(command)
    return "built" if code == 0 else "not built"


# --- seeds ------------------------------------------------------------------------------------------------------------


def _seed(random: Random) -> str:
    texts = _corpus()
    return random.choice(texts) if texts and random.random() < 0.5 else small_robot(random)


@functools.cache
def _corpus() -> Sequence[str]:
    """The small robots of the corpus; none where there is no corpus."""
    files = [corpus.FOLDER / file for file in corpus.robots() if file != corpus.ABSENT]
    return [path.read_text(errors="replace") for path in files if path.stat().st_size <= LARGEST]


def small_robot(random: Random) -> str:
    """A right robot of one to seven links, with some of all that a URDF may say."""
    return robots.urdf(robots.dressed(robots.random_robot(random), random))


# --- mutations --------------------------------------------------------------------------------------------------------


def mutated(text: str, random: Random) -> bytes:
    """A robot after some random changes, as bytes."""
    if random.random() < 0.4:
        text = _mutate_tree(text, random)
    for _ in range(random.choice((0, 1, 1, 1, 3))):
        text = _mutate_text(text, random)
    encoding = random.choice(ENCODINGS)
    content = text.encode(encoding, "replace") if random.random() < 0.08 else text.encode(errors="surrogatepass")
    if random.random() < 0.08:
        content = damaged(content, random)
    return content


def _mutate_tree(text: str, random: Random) -> str:
    root = etree.fromstring(text.encode(), etree.XMLParser(recover=True, resolve_entities=False))
    if root is None:
        return text
    for _ in range(random.choice((1, 1, 2, 5))):
        elements = [element for element in root.iter("*") if element is not root]
        if elements:
            _mutate_element(root, random.choice(elements), random.choice(elements), random)
    return etree.tostring(root, encoding="unicode")


TREE_MUTATIONS = (
    *("remove", "repeat", "move", "retag", "swap", "swap", "drop attribute", "add attribute", "change kinds", "nest"),
    *("set text", "lengthen"),
)


def _mutate_element(root: etree._Element, element: etree._Element, other: etree._Element, random: Random) -> None:
    parent, name = element.getparent(), random.choice(list(element.attrib) or [""])
    match random.choice(TREE_MUTATIONS):
        case "remove" if parent is not None:
            parent.remove(element)
        case "repeat" if parent is not None:
            for _ in range(random.choice((1, 1, 2, 30))):
                parent.append(copy.deepcopy(element))
        case "move" if element not in other.iterancestors() and element is not other:
            other.insert(random.randint(0, len(other)), element)
        case "retag":
            element.tag = random.choice([tag for tag in TAGS if ":" not in tag])
        case "swap":  # values of one element go to another: duplicate names, cycles, two parents
            same = [found for found in root.iter("*") if found.tag == element.tag and found is not element] or [other]
            taken = [item for item in random.choice(same).attrib.items() if random.random() < 0.7]
            element.attrib.update(dict(taken))
        case "drop attribute" if name:
            del element.attrib[name]
        case "add attribute":
            names = ("name", "xyz", "rpy", "value", "type", "link", "joint", "rgba", "size", "quat", "mass", "foo")
            element.set(random.choice(names), random.choice(("", "1", "0 0 0", "x", "base")))
        case "change kinds":
            for found in root.iter("joint"):
                if random.random() < 0.5:
                    found.set("type", random.choice(KINDS))
        case "nest":
            for _ in range(random.choice((3, 50, 250))):
                element = etree.SubElement(element, random.choice(("link", "gazebo", "origin", "a")))
        case "set text":
            element.text = random.choice(("1 2 3", "text", "\n\n", "  <&> ", "é"))
        case "lengthen":  # a long chain of links
            first = next((found.get("name", "") for found in root.iter("link")), "base")
            for number in range(random.choice((5, 40, 120))):
                child, above = f"chain{number}", f"chain{number - 1}" if number else first
                etree.SubElement(root, "link", name=child)
                added = etree.SubElement(root, "joint", name=f"c{number}", type=random.choice(KINDS[:6]))
                etree.SubElement(added, "parent", link=above)
                etree.SubElement(added, "child", link=child)
                if random.random() < 0.3:
                    etree.SubElement(added, "mimic", joint=f"c{random.randint(0, number + 1)}")


TEXT_MUTATIONS = (*["value"] * 10, *["rename"] * 8, "insert", "entity", "declare", "repeat lines", "cut")


def _mutate_text(text: str, random: Random) -> str:
    names, places = re.findall(r'name="([^"]+)"', text), list(_ATTRIBUTE.finditer(text))
    plain = re.sub(r"<\?xml.*?\?>", "", text)
    match random.choice(TEXT_MUTATIONS):
        case "value" if places:
            return _change_value(text, random.choice(places), random)
        case "rename" if names:  # another name, wherever the old one stands
            new = random.choice(TEXTS).replace('"', "&quot;").replace("<", "&lt;")
            return text.replace(f'"{random.choice(names)}"', f'"{new}"')
        case "insert":
            place = random.choice([match.start() for match in re.finditer("<", text)] or [0])
            parts = (*ENTITIES, *"< > & &x; &#x1b; &#1114112; \x00 \x1b \ufeff <a:b/> <robot> </robot>".split(" "))
            return text[:place] + random.choice(parts) + text[place:]
        case "entity":
            entity = random.choice("abx")
            used = plain.replace('name="', f'name="&{entity};', 1)
            return f"{random.choice(ENTITIES)}\n{used}"
        case "declare":
            version = random.choice(("1.0", "1.1", "0.0", "", "2"))
            head = f'<?xml version="{version}" encoding="{random.choice(DECLARED)}"?>'
            return random.choice(("", "\n", " ")) + head + plain
        case "repeat lines":
            lines = text.splitlines()
            lines[random.randrange(len(lines)) : 0] = [random.choice(lines)] * random.choice((1, 2, 20))
            return "\n".join(lines)
        case "cut":
            return text[: random.randint(0, len(text))]
    return text


def _change_value(text: str, place: re.Match[str], random: Random) -> str:
    values = NUMBERS if place[2][:1] in "-.0123456789" and random.random() < 0.8 else TEXTS
    value = random.choice(values).replace('"', "&quot;")
    if random.random() < 0.3 and " " in place[2]:  # one number of a vector
        parts = place[2].split(" ")
        parts[random.randrange(len(parts))] = value
        value = " ".join(parts)
    return text[: place.start(2)] + value + text[place.end(2) :]


def damaged(content: bytes, random: Random) -> bytes:
    """Bytes with noise: some changed, a piece gone, repeated or put in."""
    for _ in range(random.choice((1, 1, 3, 20))):
        at, size = random.randint(0, len(content)), random.choice((1, 1, 4, 100))
        kind = random.randrange(5)
        if kind == 0:
            content = content[:at] + random.randbytes(size) + content[at + size :]
        elif kind == 1:
            content = content[:at] + content[at + size :]
        elif kind == 2:
            content = content[:at] + content[at : at + size] * 3 + content[at + size :]
        elif kind == 3:
            content = content[:at] + bytes([random.choice((0, 10, 13, 27, 34, 60, 127, 255))]) + content[at:]
        else:
            content = content[:at]
    return content
