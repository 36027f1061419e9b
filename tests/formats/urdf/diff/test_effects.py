"""What a change does to a robot as a whole: its mass, and the names that users may have connected to."""

from __future__ import annotations

from typing import Any

import msgspec
import pytest
from support.urdfs import joint, limit, link, links, version

from urdfsync.domain import ElementKey, Target, Version
from urdfsync.domain.changes import Effect
from urdfsync.formats.urdf.diff.effects import effects, interface, loads
from urdfsync.formats.urdf.names import identify
from urdfsync.formats.urdf.options import Options

TARGET = Target("Robot", "Robot")
STAR = links(base=1.0, a=1.0, b=1.0, c=1.0)


def changed(
    old: Version, new: Version, renames: dict[ElementKey, str] | None = None, **options: Any
) -> dict[str, tuple[Any, ...]]:
    found = interface(old, new, renames or {}, TARGET, Options(**options))
    return {" / ".join(one.path): (one.old, one.new) for one in found}


def kept(found: dict[str, tuple[Any, ...]]) -> dict[str, tuple[Any, ...]]:
    """What becomes of names that there were."""
    return {path: names for path, names in found.items() if names[0] is not None}


def test_a_connector_keeps_its_name_whatever_comes_and_goes_beside_it() -> None:
    old = version(*STAR[:1], *STAR[2:], joint("jb", "continuous", "base", "b"), joint("jc", "revolute", "base", "c"))
    new = version(
        *STAR,
        joint("ja", "continuous", "base", "a"),
        joint("jb", "continuous", "base", "b"),
        joint("jc", "prismatic", "base", "c"),
    )
    changes = {
        "joint jc / motion": ("rotational", "translational"),
        "joint jc / position in Run": ("jc_phi", "jc_s"),
        "joint jc / effort in Run": ("jc_tau", "jc_f"),
    }
    added = {"link a / frame": "aFrame", "joint ja / axis": "jaAxis", "joint ja / support": "jaSupport"}
    added |= {"joint ja / position in Run": "ja_phi", "joint ja / effort in Run": "ja_tau"}
    assert changed(old, new) == {**changes, **{path: (None, name) for path, name in added.items()}}
    assert [*changed(old, new)][-5:] == [*added], "what is new comes last"
    assert "joint jc / position in Run" not in changed(old, new, inputs="vector")  # one input for all joints


def test_a_joint_that_becomes_passive_loses_its_variables_of_run() -> None:
    joints = [joint(name, "continuous", "base", child) for name, child in (("wheel", "a"), ("caster", "b"))]
    drive = '<transmission name="t"><joint name="wheel"/></transmission>'
    old, new = version(*STAR[:3], *joints), version(*STAR[:3], *joints, drive)
    hint = 'set `driven = ["caster", "wheel"]` to bring it back'
    assert {one.hint for one in interface(old, new, {}, TARGET, Options())} == {hint}
    vector = changed(old, new, inputs="vector")
    assert vector["robot / order of positions"] == ("caster, wheel", "wheel")
    assert changed(new, old, inputs="vector")["robot / order of positions"] == ("wheel", "caster, wheel")
    gone = {"joint caster / position in Run": "caster_phi", "joint caster / effort in Run": "caster_tau"}
    assert changed(old, new) == {path: (name, None) for path, name in gone.items()}
    assert changed(new, old) == {path: (None, name) for path, name in gone.items()}


def test_a_link_that_is_no_leaf_any_more_loses_its_frame_unless_it_is_listed() -> None:
    first = joint("ja", "fixed", "base", "a")
    old, new = version(*STAR[:2], first), version(*STAR[:3], first, joint("jb", "fixed", "a", "b"))
    hint, more = 'set `frames = ["a"]` to bring it back', Effect(("link b", "frame"), None, "bFrame")
    assert interface(old, new, {}, TARGET, Options()) == [Effect(("link a", "frame"), "aFrame", None, hint=hint), more]
    back = [Effect(("link b", "frame"), "bFrame", None), Effect(("link a", "frame"), None, "aFrame")]
    assert interface(new, old, {}, TARGET, Options()) == back
    assert changed(old, new, frames=("a",)) == {"link b / frame": (None, "bFrame")}
    hint = 'set `frames = ["base", "a"]` to bring it back'
    assert interface(old, new, {}, TARGET, Options(frames=("base",)))[0].hint == hint


def test_a_frame_that_goes_when_its_link_gets_another_name_comes_back_by_the_new_one() -> None:
    old = version(*STAR[:2], joint("ja", "fixed", "base", "a"))
    new = version(STAR[0], *STAR[2:], joint("ja", "fixed", "base", "b"), joint("jc", "fixed", "b", "c"))
    found = interface(old, new, {("link", "a"): "b"}, TARGET, Options())[0]
    assert found == Effect(
        ("link b", "frame"), "aFrame", None, hint='set `frames = ["b"]` to bring it back as `bFrame`'
    )


def test_a_joint_that_gets_an_axis_gets_all_and_one_that_loses_it_loses_all() -> None:
    still, turning = (version(*STAR[:2], joint("j", kind, "base", "a")) for kind in ("fixed", "continuous"))
    names = {"joint j / axis": "jAxis", "joint j / support": "jSupport"}
    names |= {"joint j / position in Run": "j_phi", "joint j / effort in Run": "j_tau"}
    assert changed(still, turning) == {path: (None, name) for path, name in names.items()}
    assert changed(turning, still) == {path: (name, None) for path, name in names.items()}
    assert {one.hint for one in interface(turning, still, {}, TARGET, Options())} == {""}


def test_an_element_that_goes_takes_its_connectors_along() -> None:
    old, new = version(*STAR[:2], joint("j", "continuous", "base", "a")), version(STAR[0])
    assert changed(old, new) == {
        "link a / frame": ("aFrame", None),
        "joint j / axis": ("jAxis", None),
        "joint j / support": ("jSupport", None),
        "joint j / position in Run": ("j_phi", None),
        "joint j / effort in Run": ("j_tau", None),
        "link base / frame": (None, "baseFrame"),
    }
    assert {one.hint for one in interface(old, new, {}, TARGET, Options())} == {""}
    assert changed(old, new, inputs="vector")["robot / input of Run"] == ("positions", None)


def test_an_element_whose_name_another_one_has_now_is_gone() -> None:
    first, second = joint("ja", "fixed", "base", "a"), joint("jb", "fixed", "base", "b")
    found = interface(
        version(*STAR[:3], first, second), version(*STAR[:2], first), {("link", "b"): "a"}, TARGET, Options()
    )
    assert [(one.path[0], one.old, one.new) for one in found] == [
        ("link a", "aFrame", None),
        ("link a", "bFrame", "aFrame"),
    ]


def test_positions_by_name_take_the_place_of_a_vector() -> None:
    robot = version(*STAR[:2], joint("j", "continuous", "base", "a"))
    vector = Options(inputs="vector")
    assert interface(msgspec.structs.replace(robot, options=vector), robot, {}, TARGET, Options()) == [
        Effect(("robot", "input of Run"), "positions", None, hint='set `inputs = "vector"` to bring it back'),
        Effect(("joint j", "position in Run"), None, "j_phi"),
    ]
    assert interface(msgspec.structs.replace(robot, options=Options()), robot, {}, TARGET, vector) == [
        Effect(("joint j", "position in Run"), "j_phi", None, hint='set `inputs = "names"` to bring it back'),
        Effect(("robot", "input of Run"), None, "positions"),
    ]


def test_without_the_package_approach_the_model_goes() -> None:
    old = msgspec.structs.replace(version(STAR[0]), options=Options())
    assert changed(old, old, approach=("record",)) == {"robot / model": ("Robot", None)}


def test_a_connector_that_gives_way_to_a_new_element_is_named() -> None:
    turning = *STAR[:2], joint("turn", "continuous", "base", "a")
    old, new = version(*turning), version(*turning, link("turnAxis"), joint("f", "fixed", "base", "turnAxis"))
    assert kept(changed(old, new)) == {"joint turn / axis": ("turnAxis", "turnAxis_2")}


def test_a_renamed_joint_shows_its_new_connectors() -> None:
    def two(first: str, second: str) -> Version:
        joints = (joint(first, "continuous", "base", "a"), joint(second, "continuous", "base", "b"))
        return version(*STAR[:3], *joints)

    assert changed(two("u", "v"), two("u", "w"), {("joint", "v"): "w"}) == {
        "joint w / axis": ("vAxis", "wAxis"),
        "joint w / support": ("vSupport", "wSupport"),
        "joint w / position in Run": ("v_phi", "w_phi"),
        "joint w / effort in Run": ("v_tau", "w_tau"),
    }
    passive = interface(two("u", "v"), two("u", "w"), {("joint", "v"): "w"}, TARGET, Options(driven=()))
    assert [(one.path[1], one.hint) for one in passive] == [("axis", ""), ("support", "")]
    driven = interface(two("u", "v"), two("u", "w"), {("joint", "v"): "w"}, TARGET, Options())
    assert {one.hint for one in driven} == {""}


def test_another_motion_is_told_of_an_axis_that_keeps_its_name() -> None:
    turns, slides = (version(*STAR[:2], joint("v", kind, "base", "a")) for kind in ("revolute", "prismatic"))
    renamed = version(*STAR[:2], joint("w", "prismatic", "base", "a"))
    assert changed(turns, slides)["joint v / motion"] == ("rotational", "translational")
    assert "joint w / motion" not in changed(turns, renamed, {("joint", "v"): "w"})


def test_the_order_of_positions_counts_where_they_are_one_vector() -> None:
    old = version(*STAR[:3], joint("jb", "continuous", "base", "a"), joint("jc", "continuous", "base", "b"))
    new = version(
        *STAR,
        joint("ja", "continuous", "base", "c"),
        joint("jb", "continuous", "base", "a"),
        joint("jc", "continuous", "base", "b"),
    )
    assert kept(changed(old, new)) == {}
    assert changed(old, old, inputs="vector") == {}
    assert kept(changed(old, new, inputs="vector")) == {"robot / order of positions": ("jb, jc", "ja, jb, jc")}
    behind = version(
        *STAR, *(joint(f"j{n}", "continuous", "base", child) for n, child in zip("bcd", "abc", strict=True))
    )
    assert kept(changed(old, behind, inputs="vector")) == {"robot / order of positions": ("jb, jc", "jb, jc, jd")}
    another = version(*STAR[:3], joint("jb", "continuous", "base", "a"), joint("jz", "prismatic", "base", "b"))
    assert changed(old, another, inputs="vector")["robot / order of positions"] == ("jb, jc", "jb, jz")


def test_the_record_approach_has_no_names_to_connect_to() -> None:
    old = version(*STAR[:2], joint("turn", "continuous", "base", "a"))
    new = version(*STAR[:2], joint("turn", "fixed", "base", "a"))
    assert changed(old, new, approach=("record",)) == {}


def test_mass_and_centre_of_mass_of_both_versions() -> None:
    turn = joint("turn", "continuous", "base", "tip", xyz="2 0 0", rpy="0 0 0", axis="0 0 1")
    massless, light, heavy = (
        version(link("base", mass, center="0 0 0"), link("tip", mass and 3.0, center="0 0 1"), turn)
        for mass in (None, 1.0, 3.0)
    )
    mass, centre, reach = effects(light, heavy)
    assert (mass.path, mass.old, mass.new, mass.unit) == (("robot", "mass"), 4.0, 6.0, "kg")
    assert (centre.path, centre.unit) == (("robot", "centre of mass"), "m")
    assert centre.old == pytest.approx((1.5, 0, 0.75), abs=1e-15)
    assert centre.new == pytest.approx((1.0, 0, 0.5), abs=1e-15)
    assert (reach.path, reach.old, reach.new, reach.unit) == (("robot", "reach"), 2.0, 2.0, "m")
    assert [effect.old for effect in effects(massless, heavy)] == [0.0, None, 2.0]
    assert effects(version(link("base", 0.5, center="1 0 0")), heavy)[1].old == (1.0, 0.0, 0.0)


def test_the_greatest_load_of_gravity_stands_beside_the_limit_of_the_effort() -> None:
    def arm(mass: float, name: str, *more: str) -> Version:
        parts = links(base=1.0, tip=None), link("bar", mass, center="0.5 0 0")
        turn = joint(name, "revolute", "base", "bar", rpy="0 0 0", axis="0 1 0", inside=[limit(effort=20.0)])
        return version(*parts[0], parts[1], turn, *(more or [joint("lift", "fixed", "bar", "tip")]))

    slide = joint("lift", "prismatic", "bar", "tip", inside=["<limit lower='0' upper='1' effort='0' velocity='1'/>"])
    turn, lift = loads(arm(2.0, "j"), arm(4.0, "turn", slide), {("joint", "j"): "turn"})
    assert turn == Effect(("joint turn", "gravity torque"), 9.80665, 19.6133, "N·m", limit=20.0)
    assert lift == Effect(("joint lift", "gravity force"), None, 0.0, "N"), "new, and without a limit"
    swapped = loads(arm(2.0, "j"), arm(4.0, "j", slide), {("joint", "j"): "lift"})
    assert [effect.old for effect in swapped] == [None, 9.80665]


def test_what_is_commanded_decides_which_variables_run_has() -> None:
    control = '<ros2_control name="c"><joint name="ja"><command_interface name="{}"/></joint></ros2_control>'
    parts = *STAR[:2], joint("ja", "continuous", "base", "a")
    old, new = version(*parts, control.format("position")), version(*parts, control.format("effort"))
    assert changed(old, new) == {"joint ja / velocity in Run": (None, "ja_w")}
    speed = version(*parts, control.format("velocity"))
    assert changed(old, speed) == {
        "joint ja / position in Run": ("ja_phi", None),
        "joint ja / velocity in Run": (None, "ja_w"),
    }
    assert changed(old, speed, inputs="vector") == {"robot / input of Run": ("positions", "commands")}


def test_sensors_and_their_frames_come_and_go() -> None:
    parts = *STAR[:2], joint("ja", "continuous", "base", "a")
    imu, eye = (
        f'<gazebo reference="a"><sensor name="{name}" type="{kind}"/></gazebo>'
        for name, kind in (("a", "imu"), ("eye", "camera"))
    )
    assert changed(version(*parts, imu), version(*parts, eye)) == {
        "sensor a / component": (identify([("sensor", "a")], ["a"])["sensor", "a"].component, None),
        "sensor eye / component": (None, "eye"),
        "sensor eye / frame": (None, "eyeFrame"),
    }
