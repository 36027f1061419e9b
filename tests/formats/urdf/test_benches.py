"""What a simulation tells of joints: which models are simulated, and the names of variables and limits."""

from __future__ import annotations

import pytest
from support.loops import FIVE_BAR
from support.robots import tree

from urdfsync.domain import Target
from urdfsync.domain.bench import Bench, JointSignals, Signal
from urdfsync.formats.urdf import benches
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.options import Options
from urdfsync.formats.urdf.robot import Joint, Limit, Mimic, Robot, Transmission

TARGET = Target("Plant.Arm", "Arm")
ARM = tree(
    Joint("base_joint", "revolute", "base", "upper", limit=Limit(-1, 1, 2, 3)),
    Joint("wheel_joint", "continuous", "upper", "wheel", transmission=Transmission(50.0)),
    Joint("finger_joint", "prismatic", "upper", "finger", limit=Limit(), mimic=Mimic("wheel_joint")),
    Joint("weld", "fixed", "finger", "tip"),
)


def freedoms(tree: KinematicTree, options: Options) -> int | None:
    return benches.freedoms(Robot("r", tree.links, tree.joints), options)


def bench(tree: KinematicTree, target: Target, options: Options) -> Bench | None:
    return benches.bench(Robot("r", tree.links, tree.joints), target, options)


def test_joints_that_move_have_variables_and_limits_in_the_package() -> None:
    name = "base_joint.parameters.limits"
    found = bench(ARM, TARGET, Options())
    assert found is not None
    assert (found.test, found.run) == ("ArmTest", "ArmRun")
    assert freedoms(ARM, Options()) == 2, "the finger follows"
    ((first, finger, wheel),) = found.layouts
    assert first == JointSignals(
        "joint base_joint",
        Signal("base_joint.revolute.phi", "rad", (f"{name}.lower", f"{name}.upper")),
        Signal("base_joint.revolute.w", "rad/s", (f"{name}.velocity",)),
        Signal("base_jointAxis.tau", "N·m", (f"{name}.effort",)),
    )
    assert wheel.position == Signal("wheel_joint.revolute.phi", "rad"), "it turns without end"
    assert (finger.position.variable, finger.position.unit) == ("finger_joint.prismatic.s", "m")
    assert finger.effort is None, "it follows another joint"


def test_a_loop_leaves_fewer_freedoms_than_joints() -> None:
    assert benches.freedoms(FIVE_BAR, Options()) == 2


def test_a_floating_base_has_six_degrees_of_freedom_more() -> None:
    assert freedoms(ARM, Options(base="floating")) == 8


def test_a_motor_behind_a_gear_drives_as_well() -> None:
    found = bench(ARM, TARGET, Options(drives="motor"))
    assert found is not None
    wheel = found.layouts[0][2].effort
    assert wheel is not None
    assert wheel.added == (("wheel_joint.parameters.transmission.reduction", "wheel_jointMotor.tau"),)


def test_two_motors_push_each_joint_of_a_differential() -> None:
    robot = tree(
        Joint("flex", "revolute", "base", "hand", transmission=Transmission(60.0, joint="roll")),
        Joint("roll", "revolute", "hand", "tip", transmission=Transmission(-60.0, joint="flex")),
    )
    found = bench(robot, TARGET, Options(drives="motor"))
    assert found is not None
    flex = found.layouts[0][0].effort
    assert flex is not None
    assert flex.added == (
        ("flex.parameters.transmission.reduction", "flexMotor.tau"),
        ("roll.parameters.transmission.otherReduction", "rollMotor.tau"),
    )


def test_a_robot_in_one_record_is_told_by_the_numbers_of_its_axes() -> None:
    found = bench(ARM, TARGET, Options(approach=("record",)))
    assert found is not None
    assert (found.test, found.run) == ("ArmGeneric", "")
    assert [axis.position.variable for axis in found.layouts[0]] == ["phi[1]", "phi[2]"]
    assert found.layouts[0][0].velocity == Signal("w_phi[1]", "rad/s", ("data.base_joint.limits.velocity",))
    assert found.layouts[0][0].effort == Signal("rotationalAxis[1].tau", "N·m", ("data.base_joint.limits.effort",))


@pytest.mark.parametrize("kind", ["planar", "floating", "ball"])
def test_a_record_that_no_generic_robot_reads_has_no_bench(kind: str) -> None:
    loose = tree(Joint("loose", kind, "a", "b"))  # type: ignore[arg-type]
    assert bench(loose, TARGET, Options(approach=("record",))) is None
    assert freedoms(loose, Options(approach=("record",))) is None
    assert bench(loose, TARGET, Options()) == Bench("ArmTest", "ArmRun", ((),))
    assert freedoms(loose, Options()) == {"planar": 3, "floating": 6, "ball": 3}[kind]


def test_a_robot_of_both_approaches_is_told_either_way() -> None:
    found = bench(ARM, TARGET, Options(approach=("package", "record")))
    assert found is not None
    assert [layout[0].position.variable for layout in found.layouts] == ["base_joint.revolute.phi", "phi[1]"]
