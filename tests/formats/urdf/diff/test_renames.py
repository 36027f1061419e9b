"""Renames: recognised where they are certain, never guessed."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from random import Random
from typing import Any

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st
from support import mutations

from urdfsync.domain import ChangeKind, ElementKey, Version
from urdfsync.domain.comparison import compare
from urdfsync.domain.matching import match
from urdfsync.engine.renames import find_matching
from urdfsync.formats.urdf.diff import renames
from urdfsync.formats.urdf.diff.renames import find_features
from urdfsync.formats.urdf.domain import DOMAIN
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import Inertial, Joint, Link, Loop, Mimic, Origin, Robot
from urdfsync.project.state.record import as_read


def model(data: mutations.Data) -> Robot:
    return as_read(data, Robot)  # type: ignore[no-any-return]


def find_renames(old: mutations.Data, new: mutations.Data) -> Mapping[ElementKey, str]:
    return match(find_features(model(old)), find_features(model(new))).renames


def comparable(old: mutations.Data, names: Mapping[ElementKey, str]) -> Mapping[str, Any]:
    return renames.comparable(model(old), Robot(""), names)[0]


def link(name: str, mass: float = 0.0) -> Link:
    return Link(name, Inertial(mass) if mass else None)


def joint(name: str, parent: str, child: str, x: float = 0.0, mimic: str = "") -> Joint:
    return Joint(name, "continuous", parent, child, Origin((x, 0.0, 0.0)), mimic=Mimic(mimic) if mimic else None)


def snapshot(*elements: Link | Joint | Loop) -> mutations.Data:
    links = tuple(element for element in elements if isinstance(element, Link))
    joints = tuple(element for element in elements if isinstance(element, Joint))
    loops = tuple(element for element in elements if isinstance(element, Loop))
    return mutations.recorded(Robot("robot", links, joints, loops=loops))


ARM = (
    link("base", 1),
    link("upper", 2),
    link("lower", 3),
    joint("shoulder", "base", "upper"),
    joint("elbow", "upper", "lower"),
)


def loop(name: str, parent: str, child: str) -> Loop:
    return Loop(name, "ball", parent, child)


def with_names(old: mutations.Data, new: Mapping[ElementKey, str]) -> mutations.Data:
    """The snapshot under new names, by an implementation of its own."""
    data = copy.deepcopy(old)
    for part in ("links", "joints"):
        targets = {name: new.get((part[:-1], name), name) for name in data[part]}
        for name in targets:
            mutations.rename(data, part, name, f"\0{name}")
        for name, target in targets.items():
            mutations.rename(data, part, f"\0{name}", target)
        data[part] = dict(sorted(data[part].items()))
    return data


@pytest.mark.parametrize("names", [
    {("link", "upper"): "arm"},
    {("joint", "elbow"): "bend"},
    {("link", "base"): "foot"},
    {("joint", "shoulder"): "s", ("link", "upper"): "u"},
    {("joint", "shoulder"): "s", ("link", "upper"): "u", ("joint", "elbow"): "e", ("link", "lower"): "l"},
    {("link", "base"): "b", ("link", "upper"): "u", ("link", "lower"): "l"},
])  # fmt: skip
def test_links_joints_subtrees_and_whole_robots(names: Mapping[ElementKey, str]) -> None:
    old = snapshot(*ARM)
    new = with_names(old, names)
    recognised = find_renames(old, new)
    assert recognised == names
    assert list(recognised) == sorted(names, key=lambda element: (element[0] != "link", element[1])), "links come first"
    found = compare(Version(model(old)), Version(model(new)), DOMAIN, Options())
    assert {change.kind for change in found.changes} == {ChangeKind.RENAMED}


def legs(*names: str, foot: Mapping[str, float] | None = None) -> mutations.Data:
    """A trunk with equal legs, unless their feet weigh differently."""
    elements: list[Link | Joint] = [link("trunk", 9)]
    for name in names:
        elements += [link(f"{name}_thigh", 2), link(f"{name}_foot", (foot or {}).get(name, 1.0))]
        elements += [joint(f"{name}_hip", "trunk", f"{name}_thigh")]
        elements += [joint(f"{name}_knee", f"{name}_thigh", f"{name}_foot")]
    return snapshot(*elements)


def leg_names(**names: str) -> Mapping[ElementKey, str]:
    parts = (("link", "thigh"), ("link", "foot"), ("joint", "hip"), ("joint", "knee"))
    return {(kind, f"{old}_{part}"): f"{new}_{part}" for old, new in names.items() for kind, part in parts}


PALM = (link("palm"), link("a"), link("b"), link("c"), link("d"))
FINGERS = snapshot(*PALM[:3], joint("one", "palm", "a"), joint("two", "palm", "b", 1.0, mimic="one"))
FIRST_AND_SECOND = {("joint", "one"): "first", ("joint", "two"): "second"}


def followers(first: str, second: str, third: str, last: str, leader: str) -> mutations.Data:
    """Four fingers; the third one follows one of the first two, and the last one the third."""
    return snapshot(
        *PALM,
        joint(first, "palm", "a"),
        joint(second, "palm", "b", 1.0),
        joint(third, "palm", "c", 2.0, leader),
        joint(last, "palm", "d", 3.0, third),
    )


def arm(upper: str, mass: float, *more: Link | Joint, base: str = "base", base_mass: float = 1.0) -> mutations.Data:
    """The arm with another upper link, and perhaps another base."""
    joints = joint("shoulder", base, upper), joint("elbow", upper, "lower")
    return snapshot(link(base, base_mass), link(upper, mass), ARM[2], *joints, *more)


OLD = snapshot(*ARM)
SWAPPED = {("link", "lower"): "upper", ("link", "upper"): "lower"}
TAKEN = {("link", "lower"): "hand", ("link", "upper"): "lower"}
WAS_FOOT = snapshot(*ARM, link("foot", 7), joint("heel", "base", "foot"))
CASES: dict[str, tuple[mutations.Data, mutations.Data, Mapping[ElementKey, str]]] = {
    "another mass": (OLD, arm("arm", 2.5), {("link", "upper"): "arm"}),
    "another mass, and a new link that looks as it did": (
        OLD,
        arm("arm", 2.5, link("rod", 2), joint("clamp", "base", "rod")),
        {},
    ),
    "the content of another link that is gone": (
        WAS_FOOT,
        arm("arm", 7),
        {("link", "foot"): "arm", ("joint", "heel"): "shoulder"},
    ),
    "another mass of the root": (OLD, arm("upper", 2, base="foot", base_mass=5), {("link", "base"): "foot"}),
    "another root, another joint": (snapshot(link("base", 1)), snapshot(link("foot", 5)), {}),
    "another mass, another joint": (
        OLD,
        snapshot(ARM[0], link("arm", 2.5), ARM[2], joint("turn", "base", "arm"), joint("elbow", "arm", "lower")),
        {("link", "upper"): "arm", ("joint", "shoulder"): "turn"},
    ),
    "another length": (
        OLD,
        snapshot(*ARM[:4], joint("bend", "upper", "lower", x=0.1)),
        {("joint", "elbow"): "bend"},
    ),
    "another place": (OLD, snapshot(*ARM[:4], joint("bend", "base", "lower")), {("joint", "elbow"): "bend"}),
    "swapped names": (OLD, with_names(OLD, SWAPPED), SWAPPED),
    "a name that was taken": (OLD, with_names(OLD, TAKEN), TAKEN),
    "legs that look the same": (legs("left", "right"), legs("l", "r"), {}),
    "one of these": (legs("left", "right"), legs("left", "r"), leg_names(right="r")),
    "legs that look the same but for their feet": (
        legs("left", "right", foot={"right": 1.5}),
        legs("l", "r", foot={"l": 1.5}),
        leg_names(left="r", right="l"),
    ),
    "a joint that others follow": (FINGERS, with_names(FINGERS, FIRST_AND_SECOND), FIRST_AND_SECOND),
    "a joint that follows another one now": (
        followers("x", "y", "two", "end", leader="x"),
        followers("p", "q", "zwei", "ende", leader="q"),
        {("joint", "x"): "p", ("joint", "y"): "q", ("joint", "two"): "zwei", ("joint", "end"): "ende"},
    ),
}


@pytest.mark.parametrize(("old", "new", "names"), CASES.values(), ids=CASES)
def test_what_is_certain_is_a_rename(old: mutations.Data, new: mutations.Data, names: Mapping[ElementKey, str]) -> None:
    assert find_renames(old, new) == names


@pytest.mark.parametrize(
    ("old", "new", "names"),
    [
        pytest.param([loop("a", "base", "lower")], [loop("b", "base", "lower")], {"a": "b"}, id="the only one"),
        pytest.param(
            [loop("a", "base", "lower")], [loop("b", "lower", "base")], {"a": "b"}, id="with its ends in other places"
        ),
        pytest.param([loop("a", "base", "lower")], [loop("b", "base", "upper")], {}, id="another end"),
        pytest.param(
            [loop("a", "base", "lower"), loop("b", "base", "lower")],
            [loop("a", "base", "lower"), loop("c", "base", "lower")],
            {"b": "c"},
            id="one of two",
        ),
        pytest.param(
            [loop("a", "base", "lower"), loop("b", "base", "lower")],
            [loop("c", "base", "lower"), loop("d", "base", "lower")],
            {},
            id="both of two",
        ),
    ],
)
def test_the_only_loop_between_two_links_is_the_same(
    old: list[Loop], new: list[Loop], names: Mapping[str, str]
) -> None:
    expected = {("loop", name): renamed for name, renamed in names.items()}
    assert find_renames(snapshot(*ARM, *old), snapshot(*ARM, *new)) == expected
    other = [msgspec.structs.replace(each, **{"child": "hand"} if each.child == "lower" else {}) for each in new]
    hand = link("hand", 3), joint("elbow", "upper", "hand")
    if all(each.child == "lower" for each in new):
        found = find_renames(snapshot(*ARM, *old), snapshot(*ARM[:2], ARM[3], *hand, *other))
        assert found == {**expected, ("link", "lower"): "hand"}, "under the new names of the links"


@pytest.mark.slow
@given(st.randoms(use_true_random=False), st.integers(0, 2))
def test_what_is_recognised_is_true(random: Random, others: int) -> None:
    """Fresh names for some elements, some of them declared, and other changes beside: no match is ever wrong."""
    old = mutations.version(random)
    edited = mutations.recorded(old.snapshot)
    if others and random.random() < 0.5:
        for _ in range(others):
            mutations.MUTATIONS[0](edited, random)
    names = {
        (kind, name): f"new_{name}"
        for kind in ("link", "joint")
        for name in edited[f"{kind}s"]
        if random.random() < 0.6
    }
    new = with_names(edited, names)
    assert find_renames(mutations.recorded(old.snapshot), new).items() <= names.items()
    declared = {name: renamed for (_, name), renamed in names.items() if random.random() < 0.3}
    found = find_matching(DOMAIN, old.snapshot, model(new), declared).renames
    assert {key: renamed for key, renamed in names.items() if key[1] in declared}.items() <= found.items()
    assert found.items() <= names.items()


def test_a_declared_exchange_is_done_where_the_old_version_has_it() -> None:
    exchange = {"upper": "lower", "lower": "upper"}
    old, new = snapshot(*ARM), snapshot(*ARM, link("tool", 5.0), joint("mount", "base", "tool"))
    assert find_matching(DOMAIN, model(old), model(new), exchange).renames == {}


def test_elements_have_their_new_names_wherever_they_are_mentioned() -> None:
    old = {
        **snapshot(*ARM, link("tip"), joint("wrist", "lower", "tip", mimic="elbow"), loop("rod", "base", "lower")),
        "extensions": {
            "link lower": {"sensor": ['<sensor name="eye"/>'] * 2},
            "joint elbow": {"hardware": ["<hardware/>"]},
            "robot": {"gazebo": ["<gazebo/>", "<gazebo/>"]},
        },
    }
    old["joints"]["wrist"]["transmission"] = {"joint": "elbow", "joint_reduction": 2.0}
    names = {("link", "lower"): "fore", ("joint", "elbow"): "bend", ("loop", "rod"): "bar"}
    found = comparable(old, names)
    assert found["links"].keys() == {"base", "upper", "fore", "tip"}
    bend, wrist = found["joints"]["bend"], found["joints"]["wrist"]
    assert (bend["child"], wrist["parent"], wrist["mimic"]["joint"]) == ("fore", "fore", "bend")
    assert wrist["transmission"]["joint"] == "bend"
    assert (bend["drive"], "drive" in wrist) == ("driven", False)
    assert {name: each["child"] for name, each in found["loops"].items()} == {"bar": "fore"}
    assert {owner: [*tags] for owner, tags in found["extensions"].items()} == {
        "link fore": ["sensor eye", "sensor eye (2)"],
        "joint bend": ["hardware"],
        "robot": ["gazebo", "gazebo (2)"],
    }


def test_an_element_whose_name_went_to_another_one_is_left_out() -> None:
    """`upper` is called `lower` now; what was `lower` is another element, and gone."""
    names = {("link", "upper"): "lower", ("joint", "shoulder"): "elbow", ("loop", "rod"): "bar"}
    old = snapshot(*ARM, loop("rod", "base", "lower"), loop("bar", "base", "upper"))
    found = comparable(old, names)
    assert (found["links"].keys(), found["joints"].keys()) == ({"base", "lower"}, {"elbow"})
    assert found["joints"]["elbow"]["child"] == "lower"
    assert found["loops"].keys() == {"bar"}
