"""Names that a package loses: from texts before and after a build, with the names that they have now."""

from __future__ import annotations

from urdfsync.engine.dangling import code_words, lost_names

ROBOT = """\
within Plant;
model Arm
  Pin handFrame, elbowAxis;
  Links.Hand hand;
  Joints.Elbow elbow;
end Arm;
"""
ELBOW = "within Plant.Arm.Joints;\nmodel Elbow\n  Real phi;\nend Elbow;\n"


def never(path: tuple[str, ...]) -> bool:
    """Nothing is inherited."""
    return False


def test_what_a_class_inherits_now_is_not_lost() -> None:
    now = {"Joints/Elbow.mo": ELBOW.replace("Real phi;", "extends Turning;")}
    assert lost_names({"Joints/Elbow.mo": ELBOW}, now, {}, never) == {"phi": ""}
    assert lost_names({"Joints/Elbow.mo": ELBOW}, now, {}, lambda path: path == ("Joints", "Elbow", "phi")) == {}


def test_components_that_are_declared_no_more_are_lost() -> None:
    now = {"Arm.mo": ROBOT.replace("handFrame, ", "").replace("  Links.Hand hand;\n", "")}
    assert lost_names({"Arm.mo": ROBOT}, now, {}, never) == {"hand": "", "handFrame": ""}
    assert lost_names({"Arm.mo": ROBOT}, {"Arm.mo": ROBOT}, {}, never) == {}


def test_a_class_may_become_a_folder() -> None:
    now = {"Joints/Elbow/package.mo": ELBOW.replace("model", "package")}
    assert lost_names({"Joints/Elbow.mo": ELBOW}, now, {}, never) == {}


def test_new_names_follow_the_new_identifier() -> None:
    before = {"Arm.mo": ROBOT, "Joints/Elbow.mo": ELBOW}
    now = {
        "Arm.mo": ROBOT.replace("elbow", "wrist_roll").replace("Elbow", "Wrist_roll"),
        "Joints/Wrist_roll.mo": ELBOW.replace("Elbow", "Wrist_roll"),
    }
    assert lost_names(before, now, {"elbow": "wrist_roll", "el": "x"}, never) == {
        "Elbow": "Wrist_roll",
        "elbow": "wrist_roll",
        "elbowAxis": "wrist_rollAxis",
    }


def test_a_name_that_nothing_has_now_is_no_new_name() -> None:
    now = {"Arm.mo": ROBOT.replace("elbowAxis", "x").replace("elbow;", "wrist;")}
    assert lost_names({"Arm.mo": ROBOT}, now, {"elbow": "wrist"}, never) == {"elbow": "wrist", "elbowAxis": ""}


def test_words_are_those_outside_of_strings_and_comments() -> None:
    found = code_words('model A "one" // two\n  /* three */ B.four five = six; end A;')
    assert {"B", "four", "five", "six"} <= found
    assert found.isdisjoint({"one", "two", "three"})
