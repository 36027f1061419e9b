"""What users connect to keeps its name through all real histories, unless its element is another one.

Connectors are read from the generated text, elements from the URDF, each by a few lines of its own here: nothing of
the code that makes the names has a say in what is a fault. See docs/naming.md for the rule.
"""

from __future__ import annotations

import functools
import itertools
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import pytest
from lxml import etree
from support import replay
from support.packages import RENDERER, read

from urdfsync.domain import Effect, Order, Snapshot, Target, Version
from urdfsync.urdf.domain import DOMAIN
from urdfsync.urdf.options import Options

TARGET = Target("Bot", "Bot")
FILES = ("Bot.mo", "BotRun.mo")

pytestmark = pytest.mark.slow

Key = tuple[str, str]
"""Kind (`link` or `joint`) and name of an element of the URDF."""


# --- what a version offers, from its generated text ---------------------------------------------------------------

CONNECTORS = {
    "Frame_b": "frame",
    "Flange_a": "axis",
    "Flange_b": "support",
    "RealInput": "input",
    "RealOutput": "output",
}
_STATEMENT = re.compile(r'(?:[^;"]|"(?:[^"\\]|\\.)*")*;')
_CONNECTOR = re.compile(rf"\s*Modelica\.[\w.]+\.({'|'.join(CONNECTORS)}) (\w+)")
_PART = re.compile(r"\s*replaceable (?:Links|Joints)\.\w+ (\w+)\b")
_ELEMENT = re.compile(r'\b(link|joint) \\"((?:[^"\\]|\\\\)*)\\"', re.IGNORECASE)


class Declared(NamedTuple):
    """A component that somebody can connect to, or whose connectors somebody can."""

    what: str
    """`frame`, `axis`, `support`, `input`, `output`, or `part` of a link or joint."""
    element: Key


def declared(text: str) -> dict[str, Declared]:
    """The connectors, and the links and joints, that a model declares, by their names."""
    found = {}
    for statement in _STATEMENT.findall(text.partition("\nequation\n")[0]):
        connector, part = _CONNECTOR.match(statement), _PART.match(statement)
        if connector or part:
            element = _ELEMENT.search(statement)
            assert element, statement
            name, what = (connector[2], CONNECTORS[connector[1]]) if connector else (part[1], "part")  # type: ignore[index]
            found[name] = Declared(what, (element[1].lower(), element[2].replace("\\\\", "\\")))
    return found


# --- what elements are, from the URDF -----------------------------------------------------------------------------


class Elements:
    """The links and joints of a URDF."""

    def __init__(self, content: bytes) -> None:
        root = etree.fromstring(content, etree.XMLParser(recover=True))
        self.joints = {joint.get("name", ""): joint for joint in root.findall("joint")}
        self.links = {link.get("name", "") for link in root.findall("link")}
        parents = {parent.get("link") for parent in root.findall("joint/parent")}
        self.leaves = self.links - parents

    def __contains__(self, element: Key) -> bool:
        return element[1] in (self.links if element[0] == "link" else self.joints)

    def moves(self, joint: str) -> bool:
        """Whether a joint has one axis that something can drive."""
        found = self.joints[joint]
        return found.get("type") in ("revolute", "continuous", "prismatic") and found.find("mimic") is None


# --- versions -----------------------------------------------------------------------------------------------------


class Built(NamedTuple):
    """A version of a history that can be built."""

    number: int
    snapshot: Snapshot
    texts: Mapping[str, str]
    robot: Mapping[str, Declared]
    run: Mapping[str, Declared]
    elements: Elements


@functools.cache
def versions(history: str, frames: str = "leaves") -> Sequence[Built]:
    """The versions of a history, as `init` would have configured the robot."""
    contents = replay.histories()[history]
    chosen = {} if frames == "leaves" else {"frames": frames}
    options = Options(base=replay.base_of(contents), meshes="skip", **chosen)  # type: ignore[arg-type]
    found = []
    for number, content in enumerate(contents):
        snapshot = read(content).snapshot
        if snapshot is None:
            continue
        artifacts = [a for a in DOMAIN.artifacts(snapshot, {}, TARGET, options) if a.path in FILES]
        texts = {a.path: RENDERER.render(a.template, a.data) for a in artifacts if not isinstance(a, Order)}
        robot, run = declared(texts["Bot.mo"]), declared(texts["BotRun.mo"])
        elements = Elements(content)
        parts = sorted(one.element for one in robot.values() if one.what == "part")
        assert parts == sorted(
            [*(("link", name) for name in elements.links), *(("joint", name) for name in elements.joints)]
        )
        found.append(Built(number, snapshot, texts, robot, run, elements))
    return found


def excuse(name: str, thing: Declared, old: Built, new: Built, every_frame: bool = False) -> str:
    """Why a name of the old version may be gone in the new one; empty if it may not."""
    kind, element = thing.element
    if thing.element not in new.elements:
        return "its element is gone"
    if thing.what == "frame" and not every_frame and element not in new.elements.leaves:
        return "it is a leaf no more"
    if kind == "joint" and thing.what != "part" and not new.elements.moves(element):
        return "it stands still, or follows"
    part, now = (_component(thing.element, version) for version in (old, new))
    if _is_anothers(part, thing, new) or (name in old.robot and _is_anothers(name, thing, new)):
        return "it gave way to a new name"
    if now != part and _is_anothers(now, thing, old):
        return "nothing has the name any more that it gave way to"
    return ""


def _component(element: Key, version: Built) -> str:
    return next(name for name, other in version.robot.items() if other == ("part", element))


def _is_anothers(name: str, thing: Declared, version: Built) -> bool:
    """Whether a robot has something else by this name; capital and small letters count as equal."""
    return any(name.lower() == one.lower() and other.element != thing.element for one, other in version.robot.items())


def lost(old: Mapping[str, Declared], new: Mapping[str, Declared]) -> Mapping[str, Declared]:
    """What is not there any more under its name, or where that is something else."""
    return {name: thing for name, thing in old.items() if new.get(name) != thing}


NAMES = tuple(replay.histories())
HISTORIES = pytest.mark.parametrize("history", NAMES or ("no-corpus",), ids=lambda name: name[-40:])


@pytest.mark.parametrize("frames", ["leaves", "all"])
@HISTORIES
def test_no_step_renames_what_somebody_connected_to(corpus: Path, history: str, frames: str) -> None:
    """With all frames each link keeps its own."""
    for old, new in itertools.pairwise(versions(history, frames)):
        gone = {**lost(old.robot, new.robot), **lost(old.run, new.run)}
        unexcused = [name for name, one in gone.items() if not excuse(name, one, old, new, frames == "all")]
        assert not unexcused, f"version {new.number}"


@HISTORIES
def test_each_case_is_named_with_the_key_that_keeps_a_frame(corpus: Path, history: str) -> None:
    for old, new in itertools.pairwise(versions(history)):
        gone, run = lost(old.robot, new.robot), lost(old.run, new.run)
        said = {(effect.path, effect.old): effect for effect in effects(old, new)}
        named = {effect.old for effect in said.values()}
        for name, (_, element) in run.items():
            assert name in named or element not in new.elements, name
        for name, (what, element) in gone.items():
            if what == "part" or element not in new.elements:
                continue
            effect = said[(" ".join(element), what), name]
            assert (effect.new is not None) == (Declared(what, element) in new.robot.values())
            if effect.new is None and what == "frame":
                assert f'list "{element[1]}" in `frames`' in effect.hint
        for effect in said.values():
            assert effect.old is None or effect.old in {**gone, **run}, effect
            coming = {**lost(new.robot, old.robot), **lost(new.run, old.run)}
            assert effect.new is None or effect.new in coming, effect


def effects(old: Built, new: Built) -> Sequence[Effect]:
    """What the domain says of a step."""
    renames = DOMAIN.renames(old.snapshot, new.snapshot)
    options = Options(meshes="skip")
    return DOMAIN.interface(Version(old.snapshot), Version(new.snapshot), renames, TARGET, options)
