"""The experiment as the core sees it: content, notes, and how numbers become deviations."""

from __future__ import annotations

import itertools
import math
import re
import sys
from collections.abc import Sequence
from typing import Any

import pytest
from support.physics import pinocchio_series
from support.urdfs import dynamics, joint, link, links, robot

from urdfsync.check.results import TOLERANCE
from urdfsync.diagnostics import SourceError
from urdfsync.domain import Deviation, Experiment, Quantity, Target
from urdfsync.urdf.domain import DOMAIN
from urdfsync.urdf.options import Options

BOT = Target("Bot", "Bot")
POSE = (("position", "m"), ("orientation", ""))
ARM = robot(
    *links(base=4.0, arm=2.5, drone=0.7, plate=0.7),
    joint("elbow", "revolute", "base", "arm", inside=[dynamics(1, 1)]),
    joint("slide", "prismatic", "base", "drone"),
    joint("skate", "planar", "arm", "plate"),
)


ELBOW = robot(link("base", 4.0), link("arm", 2.5), joint("elbow", "revolute", "base", "arm"))
BARE = robot(link("base"), link("arm"), joint("elbow", "continuous", "base", "arm")).encode()


def experiment(urdf: str | bytes, complete: bool = True, **options: Any) -> Experiment:
    content = urdf if isinstance(urdf, bytes) else urdf.encode()
    found = DOMAIN.experiment(content, "robot.urdf", BOT, Options(**options), complete)
    assert found is not None
    return found


def zeros(one: Experiment) -> dict[str, Sequence[float]]:
    """A series in which nothing ever moves."""
    still: Sequence[float] = (0.0, 0.0, 0.0)
    return {"time": (0.0, 0.005, 0.01), **dict.fromkeys(one.probe.values, still)}


def key(one: Deviation) -> tuple[str, str, str]:
    return one.quantity.value, one.element, one.unit


def test_every_element_has_its_deviations_from_the_root_outwards() -> None:
    """Axes that slide and axes that turn are told in the order of the tree, not in that of flange vectors."""
    one = experiment(ARM.replace('"slide"', '"a slide"'))
    expected = [
        *((quantity, f"link {name}", unit) for name in ("base", "drone", "arm", "plate") for quantity, unit in POSE),
        *(("effort", "joint a slide", "N"), ("effort", "joint elbow", "N·m")),
        *(("reaction", "link base", "N"), ("reaction", "link base", "N·m")),
        *(("acceleration", "link plate", "m/s²"), ("acceleration", "link plate", "rad/s²")),
        *(("mass", "robot", "kg"), ("centre of mass", "robot", "m")),
    ]
    assert list(map(key, one.compare(zeros(one)))) == expected
    assert list(map(key, one.compare(zeros(one), zeros(one)))) == expected


def test_differences_are_the_greatest_of_the_first_and_last_instant() -> None:
    one = experiment(robot(link("base", 4.0)))
    series = zeros(one)
    (mass,) = [found for found in one.compare(series) if found.quantity is Quantity.MASS]
    assert (mass.difference, mass.value, mass.size) == (4.0, 4.0, 4.0)
    series["mass"] = (4.0, 100.0, 4.25)
    (mass,) = [found for found in one.compare(series) if found.quantity is Quantity.MASS]
    assert mass.difference == 0.25


def test_sizes_are_those_of_a_quantity_in_one_unit() -> None:
    """A torque is not held against forces, and what drives an axis is not held against what holds the base."""
    found = experiment(ARM).compare(zeros(experiment(ARM)))
    sizes = {(one.quantity, one.unit): one.size for one in found}
    kinds = {kind: max(one.value for one in found if (one.quantity, one.unit) == kind) for kind in sizes}
    assert sizes == kinds
    assert all(one.size == sizes[one.quantity, one.unit] for one in found)
    assert len(set(sizes.values())) == len(sizes) == 10


def test_a_heavy_base_hides_no_lost_damping() -> None:
    """The base is held by 50 kN: against that, or against its torque, the loss would be nothing."""
    heavy = ARM.replace(link("base", 4.0), link("base", 5000.0)).replace(dynamics(1, 1), dynamics(1e-7, 0))
    found = experiment(heavy).compare(pinocchio_series(heavy.replace(dynamics(1e-7, 0), "")))
    assert [key(one) for one in found if one.relative > TOLERANCE] == [("effort", "joint elbow", "N·m")]
    sizes = {(one.quantity, one.unit): one.size for one in found}
    (elbow,) = [one for one in found if one.element == "joint elbow"]
    assert elbow.difference < TOLERANCE * sizes[Quantity.REACTION, "N"]


def test_what_pinocchio_says_itself_agrees() -> None:
    found = experiment(ARM).compare(pinocchio_series(ARM))
    assert max(one.relative for one in found) < 1e-14


def test_a_baseline_takes_the_place_of_the_reference() -> None:
    """A lost damping of an edited robot, against the robot as it is generated."""
    one, edited = experiment(ARM), pinocchio_series(ARM.replace(dynamics(1, 1), ""))
    against_pinocchio, against_generated = one.compare(edited), one.compare(edited, pinocchio_series(ARM))
    assert [key(each) for each in against_generated if each.difference] == [("effort", "joint elbow", "N·m")]
    for this, that in zip(against_generated, against_pinocchio, strict=True):
        numbers = (this.difference, this.value, this.size)
        assert numbers == pytest.approx((that.difference, that.value, that.size), abs=1e-12)


@pytest.mark.parametrize(
    ("kind", "instant", "step", "told"),
    [("planar", 2, 1e-8, 0.0), ("planar", 2, 1e-5, 1e-5), ("planar", 0, 1e-8, 1e-8), ("fixed", 2, 1e-8, 1e-8)],
)
def test_steps_of_a_solver_are_no_effect_of_an_edit(kind: str, instant: int, step: float, told: float) -> None:
    """An edit may add states: free joints are then integrated in other steps. At the start nothing is integrated."""
    one = experiment(ARM.replace('type="planar"', f'type="{kind}"'))
    series = zeros(one)
    series["robot.plate.frame_a.r_0[1]"] = [step if k == instant else 0.0 for k in range(3)]
    assert max(found.difference for found in one.compare(series, zeros(one))) == told


def test_a_value_that_either_simulation_lacks_is_infinitely_far_off() -> None:
    one = experiment(ARM)
    gone = {name: values for name, values in zeros(one).items() if "drone.frame_a.r_0" not in name}
    for series, baseline in ((gone, zeros(one)), (zeros(one), gone), (gone, gone)):
        found = one.compare(series, baseline)
        infinite = [each for each in found if not math.isfinite(each.relative)]
        assert [key(each) for each in infinite] == [("position", "link drone", "m")]
        assert all(each.difference == math.inf and math.isfinite(each.value) for each in infinite)


@pytest.mark.parametrize("values", [None, (), (math.nan, 0.0, 0.0), (0.0, 0.0, math.nan), (0.0, 0.0, math.inf)])
def test_a_value_that_is_no_number_is_infinitely_far_off(values: tuple[float, ...] | None) -> None:
    one = experiment(ARM)
    series = zeros(one)
    del series["robot.drone.frame_a.r_0[2]"]
    if values is not None:
        series["robot.drone.frame_a.r_0[2]"] = values
    infinite = [key(found) for found in one.compare(series) if math.isinf(found.difference)]
    assert ("position", "link drone", "m") in infinite
    assert ("position", "link base", "m") not in infinite


def test_what_is_made_up_if_it_is_asked_for_is_said_and_read_by_both_sides() -> None:
    one = experiment(BARE)
    assert one.notes == (
        "inertias were made up for 2 links of the generated package only, because they move without any mass",
    )
    reading = DOMAIN.read(one.content, "robot.urdf", Options())
    assert reading.snapshot is not None
    assert reading.snapshot["links"]["arm"]["inertial"]["mass"] > 0
    one = experiment(BARE, complete=False)
    assert (one.content, one.notes) == (BARE, ())


def test_the_reference_has_a_name_and_a_version() -> None:
    assert re.fullmatch(r"Pinocchio \d+\.\d+\.\d+", experiment(ARM).reference)


def test_free_joints_without_inertia_get_some_but_not_for_the_effects_of_edits() -> None:
    plane = robot(link("floor", 1.0), link("plate"), joint("skate", "planar", "floor", "plate"))
    assert "inertias were made up" in experiment(plane).notes[0]
    one = experiment(plane, complete=False)
    assert one.notes == ()
    assert all(found.difference == 0 for found in one.compare(zeros(one), zeros(one))), "there is a baseline"


def test_points_that_move_freely_in_a_row_have_no_motion() -> None:
    """They have masses, so that nothing is made up."""
    point = '<inertial><mass value="1"/><inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial>'
    names = [f"puck_{number}" for number in range(3)]
    slips = [
        joint(f"slip_{k}", "planar", a, b, xyz="0 0 0", rpy="0 0 0", axis="0 0 1")
        for k, (a, b) in enumerate(itertools.pairwise(names))
    ]
    rows = robot(*(f'<link name="{name}">{point}</link>' for name in names), *slips)
    with pytest.raises(SourceError, match="no simulation can tell how 'slip_0', 'slip_1' move"):
        experiment(rows)


def test_a_source_with_errors_says_what_is_wrong() -> None:
    with pytest.raises(SourceError) as caught:
        experiment("<robot name='a'><link name='b'/><link name='b'/></robot>")
    assert "duplicate-link" in [diagnostic.code for diagnostic in caught.value.diagnostics]


def test_without_pinocchio_there_is_no_experiment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pinocchio", None)
    with pytest.raises(SourceError, match="no-pinocchio"):
        experiment(ARM)


def test_the_record_alone_is_compared_through_the_generic_robot() -> None:
    one = experiment(ELBOW, approach=("record",))
    assert "UrdfSync.Robots.GenericRobot robot(redeclare parameter Bot.BotParameters data, " in one.probe.source
    assert "robot.r_0[2,3]" in one.probe.values
    assert "robot.R_0[2,1,3]" in one.probe.values
    assert sorted({found.element for found in one.compare(zeros(one))}) == [
        "joint elbow",
        "link arm",
        "link base",
        "robot",
    ]


def test_axes_of_links_are_read_in_the_same_order_in_both_approaches() -> None:
    package, record = experiment(ELBOW), experiment(ELBOW, approach=("record",))
    axes = [value for value in package.probe.values if "base.frame_a.R.T" in value]
    transposed = [re.sub(r".*\[(.),(.)\]", r"robot.R_0[1,\2,\1]", value) for value in axes]
    assert [value for value in record.probe.values if "R_0[1," in value] == transposed


def test_with_both_approaches_the_package_is_compared() -> None:
    one = experiment(ELBOW, approach=("package", "record"))
    assert "Bot.Bot robot(" in one.probe.source


def test_there_is_nothing_to_compare_where_the_record_has_no_tables() -> None:
    options = Options(approach=("record",))
    assert DOMAIN.experiment(ARM.encode(), "robot.urdf", BOT, options, complete=True) is None
    with pytest.raises(SourceError):
        DOMAIN.experiment(b"<robot>", "robot.urdf", BOT, options, complete=True)
