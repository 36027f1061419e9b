"""A hundred logs with wrong units, signs, columns and factors: none is written, and none is said to be explained."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from support import measured
from support.commands import Execute
from support.files import unchanged

import urdfsync
from urdfsync.analysis.identification.records import read_records
from urdfsync.commands import cli
from urdfsync.domain.regressor import Array

ARM = """<robot name="arm"><link name="base"/>
  <link name="turret"><inertial><origin xyz="0.01 0 0.1"/><mass value="8"/>
    <inertia ixx="0.06" iyy="0.06" izz="0.04" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="upper"><inertial><origin xyz="0.2 0.02 0"/><mass value="5"/>
    <inertia ixx="0.01" iyy="0.09" izz="0.09" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="fore"><inertial><origin xyz="0.15 0 0.01"/><mass value="2"/>
    <inertia ixx="0.003" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="j1" type="revolute"><parent link="base"/><child link="turret"/><origin xyz="0 0 0.2"/><axis xyz="0 0 1"/>
    <limit lower="-1.9" upper="1.9" effort="100" velocity="3"/><dynamics damping="2" friction="1"/></joint>
  <joint name="j2" type="revolute"><parent link="turret"/><child link="upper"/><origin xyz="0.05 0 0.2"/>
    <axis xyz="0 1 0"/><limit lower="-2" upper="1.5" effort="120" velocity="3"/>
    <dynamics damping="3" friction="2"/></joint>
  <joint name="j3" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0.4 0 0"/><axis xyz="0 1 0"/>
    <limit lower="-2.2" upper="2.2" effort="40" velocity="4"/><dynamics damping="1" friction="0.5"/></joint>
</robot>
"""
HEADER = [
    "time",
    *(f"j{k}.position" for k in (1, 2, 3)),
    *(f"j{k}.velocity" for k in (1, 2, 3)),
    *(f"j{k}.effort" for k in (1, 2, 3)),
]
POSITIONS, VELOCITIES, EFFORTS = (1, 2, 3), (4, 5, 6), (7, 8, 9)


def wrong_logs() -> Iterator[tuple[str, Array, tuple[int, ...]]]:
    """Yield a name, the matrix that makes wrong columns of right ones, and the columns whose unit a header states."""
    groups = {"positions": POSITIONS, "velocities": VELOCITIES, "efforts": EFFORTS}
    factors = {
        "efforts": (-1, 1e-3, 1e3, 100, 9.81, 1 / 9.81, 0.1, 10, 8.85, 2.5, 0.4, 5, 50, -0.1),
        "positions": (180 / np.pi, np.pi / 180, 1e3, -1, 2 * np.pi, 100),
        "velocities": (180 / np.pi, np.pi / 180, -1, 30 / np.pi, 1e3),
    }
    for group, columns in groups.items():
        for factor in factors[group]:
            for some in (columns, *((column,) for column in columns)):
                matrix = np.eye(10)
                matrix[some, some] = factor
                yield f"{group} {some} times {factor:.3g}", matrix, ()
        for one, other in ((0, 1), (1, 2), (0, 2)):
            matrix = np.eye(10)
            matrix[[columns[one], columns[other]]] = matrix[[columns[other], columns[one]]]
            yield f"{group} {one} and {other} exchanged", matrix, ()
    for factor in (np.pi / 180, 180 / np.pi):
        for column in POSITIONS:
            matrix = np.eye(10)
            matrix[column, column] = factor
            yield f"position {column} times {factor:.3g}, said to be in rad", matrix, (column,)
    for factor in (1e-3, 1e3, -1, 9.81):
        matrix = np.eye(10)
        matrix[EFFORTS, EFFORTS] = factor
        yield f"efforts times {factor:.3g}, said to be in N.m", matrix, EFFORTS


WRONG = [*wrong_logs()]


@pytest.fixture
def right(folder: Path) -> Array:
    """A right log of a robot whose numbers differ a little from the source's; the robot is built."""
    Path("arm.urdf").write_text(ARM)
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\nignore = ["not-mirrored"]\n')
    urdfsync.build(config=folder / "urdfsync.toml")
    loaded = urdfsync.load()
    regressor = read_records(loaded, loaded.robots[0], 10).regressor()
    times = np.arange(0, 12, 0.02)
    phases = np.outer(times, [0.9, 1.1, 1.7]) + np.array([0, 1, 2])
    sizes, rates = np.array([1.8, 1.2, 1.6]), np.array([0.9, 1.1, 1.7])
    q, v, a = (
        sizes * np.sin(phases) + 0.1 * np.sin(3.1 * phases),
        rates * (sizes * np.cos(phases) + 0.31 * np.cos(3.1 * phases)),
        -(rates**2) * (sizes * np.sin(phases) + 0.961 * np.sin(3.1 * phases)),
    )
    derivatives, efforts = regressor.rows(q, v, a)
    change = np.zeros(derivatives.shape[2])
    change[[11, 21]] = 0.15, 0.05  # the first moments of two links in kg·m
    change[30:] = np.array([loss.value for loss in regressor.losses]) * np.tile([0.2, -0.2, 0], 3)
    noise = np.random.default_rng(3).standard_normal((len(times), 3)) * [0.02, 0.1, 0.02]
    return np.column_stack([times, q, v, efforts + derivatives @ change + noise])


def write(name: str, table: Array, stated: tuple[int, ...]) -> None:
    units = ["", *["rad"] * 3, *["rad/s"] * 3, *["N.m"] * 3]
    header = [f"{cell} [{units[k]}]" if k in stated else cell for k, cell in enumerate(HEADER)]
    # velocities have a log of their own, since without them those of the positions count
    keep = [k for k in range(10) if k not in VELOCITIES or "velocities" in name]
    np.savetxt("log.csv", table[:, keep], "%.9g", ",", header=",".join(header[k] for k in keep), comments="")


def test_the_right_log_is_written(right: Array, execute: Execute) -> None:
    write("velocities", right, ())
    (result,) = execute("identify", "arm", "log.csv", "--write", "--format=json").json["results"]
    assert min(joint["explained"] for joint in result["joints"]) > 0.98
    assert result["written"]


@pytest.mark.parametrize("part", [0, *(pytest.param(k, marks=pytest.mark.slow) for k in range(1, 20))])
def test_a_wrong_log_is_neither_written_nor_explained(right: Array, execute: Execute, folder: Path, part: int) -> None:
    """Each is refused when it is read, or doubted after the fit."""
    assert len(WRONG) > 100
    for name, matrix, stated in WRONG[part::20]:
        write(name, right @ matrix.T, stated)
        with unchanged(folder):
            document = execute("identify", "arm", "log.csv", "--write", "--format=json", code=None).json
        assert document["exit"] in (2, 5), name
        for result in document["results"]:
            assert result["numbers"] == [], name
            assert {joint["explained"] for joint in result["joints"]} == {None}, name


FIRST, SECOND = 'name="j1" type="revolute"', 'name="j2" type="revolute"'
LIFT = ARM.replace(FIRST, FIRST.replace("revolute", "prismatic")).replace(SECOND, SECOND.replace("revolute", "fixed"))
LIMITS = 'lower="-1.9" upper="1.9" effort="100"', 'lower="-0.3" upper="0.3" effort="400"'
ROBOTS = {
    "two": ARM.replace(FIRST, FIRST.replace("revolute", "fixed")),
    "three": ARM,
    "lift": LIFT.replace(*LIMITS),
    "six": measured.arm(),
}
FACTORS = 0.5, 0.8, 1.25, 1.3, 2


@pytest.mark.parametrize(
    ("name", "wrong"),
    [
        ("two", 1),
        *(
            pytest.param(name, k, marks=pytest.mark.slow)
            for name, joints in (("two", 1), ("three", 3), ("lift", 2), ("six", 6))
            for k in range(joints)
        ),
    ],
)
def test_a_factor_of_one_effort_is_told_by_the_others(folder: Path, execute: Execute, name: str, wrong: int) -> None:
    """From the factor on that the right log states, 1.25 without one. Below, a log may be refused, or states it."""
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\nignore = ["not-mirrored"]\n')
    Path("arm.urdf").write_text(ROBOTS[name])
    assert cli.main(["build", "--quiet"]) == 0
    log = measured.record(measured.changed(ROBOTS[name], 3), seconds=12)
    log.write(Path("log.csv"))
    joint = log.joints[wrong]
    least = least_factor(execute("identify", "arm", "log.csv").words, joint)
    assert least < 3
    for factor in FACTORS:
        factors = np.where(np.arange(len(log.joints)) == wrong, factor, 1.0)
        log._replace(efforts=log.efforts * factors).write(Path("log.csv"))
        with unchanged(folder):
            document = execute("identify", "arm", "log.csv", "--format=json", code=None).json
            (result,) = document["results"]
        told = " ".join(finding["message"] for finding in result["diagnostics"])
        if max(factor, 1 / factor) >= least:
            assert document["exit"] == 5, factor
            assert f"joint {joint}: its effort in the log is" in told
        else:
            assert document["exit"] == 5 or least_factor(told, joint) > max(factor, 1 / factor)


def least_factor(words: str, joint: str) -> float:
    """Return the factor from which on a log shows that the effort of a joint has it."""
    told = re.search(rf"joint {joint}: in this log, a factor of its effort would show only from ([\d.]+) on", words)
    return float(told[1]) if told else 1.25


def test_a_factor_of_all_efforts_is_told_from_1_45_on(right: Array, execute: Execute, folder: Path) -> None:
    """Below, the robot may be as much heavier: a fit takes the factor for masses."""
    for factor, code in ((0.5, 5), (0.8, 0), (1.3, 0), (2, 5)):
        matrix = np.eye(10)
        matrix[EFFORTS, EFFORTS] = factor
        write("efforts", right @ matrix.T, ())
        execute("identify", "arm", "log.csv", "--quiet", code=code)
