"""Which files were edited, and what each edit does by itself."""

from __future__ import annotations

from collections.abc import Mapping

from hypothesis import given
from hypothesis import strategies as st

from urdfsync.checking import edits
from urdfsync.checking.verdict import TOLERANCE, Comparison
from urdfsync.domain import Deviation, Quantity

GENERATED = {
    "package.mo": b"package Arm\n",
    "package.order": b"Arm\n",
    "Arm.mo": b"robot\n",
    "ArmTest.mo": b"test\n",
    "Joints/Elbow.mo": b"elbow\n",
    "Links/Hand.mo": b"hand\n",
}


def torque(joint: str, difference: float) -> Deviation:
    return Deviation(Quantity.EFFORT, f"joint {joint}", difference, 10.0, 50.0, "N·m")


def test_line_ends_are_no_edit() -> None:
    disk = {**GENERATED, "Links/Hand.mo": b"hand\r\n", "Joints/Elbow.mo": b"flexible elbow\n"}
    assert edits.edited(GENERATED, disk, ()) == ["Joints/Elbow.mo"]


def test_files_without_a_part_in_it_and_order_files_do_not_count() -> None:
    disk = {**GENERATED, "ArmTest.mo": b"another test\n", "package.order": b"Mine\nArm\n", "Mine.mo": b"mine\n"}
    assert edits.edited(GENERATED, disk, {"ArmTest.mo"}) == []


def test_a_variant_has_one_edit_and_all_that_is_the_users_own() -> None:
    disk = {**GENERATED, "Joints/Elbow.mo": b"1", "Links/Hand.mo": b"2", "Spring.mo": b"mine"}
    found = dict(edits.variants(["Joints/Elbow.mo", "Links/Hand.mo"], GENERATED, disk))
    assert found["Joints/Elbow.mo"] == {**GENERATED, "Joints/Elbow.mo": b"1", "Spring.mo": b"mine"}
    assert found["Links/Hand.mo"] == {**GENERATED, "Links/Hand.mo": b"2", "Spring.mo": b"mine"}


def test_one_edited_file_needs_no_variant() -> None:
    disk = {**GENERATED, "Joints/Elbow.mo": b"1"}
    assert dict(edits.variants(["Joints/Elbow.mo"], GENERATED, disk)) == {}
    (effect,) = edits.effects(
        ["Joints/Elbow.mo"], Comparison((torque("elbow", 2.0), torque("wrist", 1e-15))), {}, Comparison(())
    )
    assert effect.files == ("Joints/Elbow.mo",)
    assert effect.deviations == (torque("elbow", 2.0),)


def test_edits_are_told_apart() -> None:
    single = {"A.mo": Comparison((torque("elbow", 2.0),)), "B.mo": Comparison((torque("elbow", 0.0),))}
    first, second = edits.effects(["A.mo", "B.mo"], Comparison((torque("elbow", 2.0),)), single, Comparison(()))
    assert (first.files, first.deviations) == (("A.mo",), (torque("elbow", 2.0),))
    assert (second.files, second.deviations) == (("B.mo",), ())


def test_edits_that_need_each_other_are_one_effect() -> None:
    """B alone did not compile, so that nothing is known of it apart."""
    whole, single = Comparison((torque("elbow", 5.0),)), {"A.mo": Comparison((torque("elbow", 2.0),))}
    first, rest = edits.effects(["A.mo", "B.mo"], whole, single, Comparison(()))
    assert first.files == ("A.mo",)
    assert (rest.files, rest.deviations) == (("B.mo",), (torque("elbow", 5.0),))


def test_edits_that_only_together_change_anything_are_named_together() -> None:
    single = {name: Comparison((torque("elbow", 0.0),)) for name in ("A.mo", "B.mo")}
    *apart, together = edits.effects(["A.mo", "B.mo"], Comparison((torque("elbow", 3.0),)), single, Comparison(()))
    assert [effect.deviations for effect in apart] == [(), ()]
    assert (together.files, together.deviations) == (("A.mo", "B.mo"), (torque("elbow", 3.0),))


def test_what_the_generated_package_differs_in_is_no_edits_doing() -> None:
    """A wrong template is wrong in the edited package, too."""
    (effect,) = edits.effects(
        ["A.mo"],
        Comparison((torque("elbow", 2.0), torque("wrist", 1.0))),
        {},
        Comparison((torque("elbow", 2.0), torque("wrist", 0.0))),
    )
    assert effect.deviations == (torque("wrist", 1.0),)


def test_a_value_that_is_missing_counts() -> None:
    (effect,) = edits.effects(["A.mo"], Comparison((torque("elbow", float("nan")),)), {}, Comparison(()))
    assert [one.element for one in effect.deviations] == ["joint elbow"]


names = st.sampled_from(["A.mo", "Joints/B.mo", "Links/C.mo", "Links/D.mo", "package.order"])
packages = st.dictionaries(names, st.sampled_from([b"", b"x\n", b"x\r\n", b"y\n"]))


@given(generated=packages, disk=packages)
def test_edited_files_are_those_that_differ_beyond_line_ends(
    generated: Mapping[str, bytes], disk: Mapping[str, bytes]
) -> None:
    generated = {path: content.replace(b"\r", b"") for path, content in generated.items()}
    found = edits.edited(generated, disk, ())
    for path in generated.keys() & disk.keys():
        differs = disk[path].replace(b"\r\n", b"\n") != generated[path]
        assert (path in found) == (differs and path.endswith(".mo"))
    assert set(found) <= generated.keys() & disk.keys()


values = st.floats(0, 1e3) | st.sampled_from([0.0, 1e-12, float("inf")])


@given(st.lists(values, min_size=1, max_size=4), st.lists(values, min_size=1, max_size=4))
def test_effects_hold_all_that_is_beyond_the_tolerance_and_only_that(whole: list[float], alone: list[float]) -> None:
    comparison = Comparison(tuple(torque(str(number), value) for number, value in enumerate(whole)))
    single = {"A.mo": Comparison(tuple(torque(str(number), value) for number, value in enumerate(alone)))}
    found = edits.effects(["A.mo", "B.mo"], comparison, single, Comparison(()))
    told = {one for effect in found for one in effect.deviations}
    assert all(one.relative > TOLERANCE for one in told)
    assert {one for one in comparison.deviations if one.relative > TOLERANCE} <= told
