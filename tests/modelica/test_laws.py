"""Laws of friction against their formulas, and drives that give way or saturate against a hand calculation."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
from support.modelica import Run, Series, Task, simulate, simulate_all
from support.packages import Package, generate
from support.urdfs import dynamics, joint, limit, links, robot

from urdfsync.analysis.checks.compilers import omc
from urdfsync.domain import Target
from urdfsync.formats.urdf.physics.reference import read

pytestmark = pytest.mark.slow

DAMPING, FRICTION, INERTIA = 0.3, 2.0, 0.5
"""Numbers of both kinds of friction: N·m·s/rad, N·m, kg·m²; N·s/m, N, kg."""
BREAKAWAY, DEFLECTION, STRIBECK = 2.4, 1e-4, 0.05
PARTS = {
    "Rotational": ("Inertia inertia(J", "phi", "w", "tau", "Torque", "phi"),
    "Translational": ("Mass inertia(m", "s", "v", "f", "Force", "s"),
}


def axis(kind: str, law: str) -> str:
    """A model of one inertia with friction, on which `push + wave*sin(time)` acts."""
    inertia, q, w, effort, source, _ = PARTS[kind]
    numbers = f"damping = {DAMPING}, friction = {FRICTION}, breakaway = {BREAKAWAY}"
    numbers += f", stribeckSpeed = {STRIBECK}, bristleDeflection = {DEFLECTION}"
    return f"""
  model {kind}{law}Axis
    parameter Real push = 0;
    parameter Real wave = 0;
    parameter Real speed = 0;
    parameter UrdfSync.Records.JointDynamics.{kind}Dynamics dynamics({numbers});
    UrdfSync.Friction.{kind}{law} friction(parameters = dynamics);
    Modelica.Mechanics.{kind}.Components.{inertia} = {INERTIA},
      {q}(start = 0, fixed = true), {w}(start = speed, fixed = true));
    Modelica.Mechanics.{kind}.Components.Fixed fixed;
    Modelica.Mechanics.{kind}.Sources.{source} source;
  equation
    source.{effort} = push + wave*sin(time);
    connect(fixed.flange, friction.flange_a);
    connect(friction.flange_b, inertia.flange_a);
    connect(source.flange, inertia.flange_b);
  end {kind}{law}Axis;
"""


LAWS = ("", "Stiction", "LuGre")
AXES = [(kind, law) for kind in PARTS for law in LAWS]
SLIDING, HELD, LOOSE, WAVE = (
    Run(2.0, 0.01, {"speed": 1.0}, 1e-9),
    Run(10.0, 0.1, {"push": 1.0}, 1e-9),
    Run(2.0, 0.01, {"push": 2.5}, 1e-9),
    Run(6.0, 0.01, {"wave": 6.0}, 1e-9),
)


def expected(law: str, kind: str, v: np.ndarray) -> np.ndarray:
    """Losses at constant speeds other than zero."""
    steepness = 100 if kind == "Rotational" else 1000
    dry = {
        "": FRICTION * np.tanh(0.5 * steepness * v),
        "Stiction": FRICTION * np.sign(v),
        "LuGre": (FRICTION + (BREAKAWAY - FRICTION) * np.exp(-((v / STRIBECK) ** 2))) * np.sign(v),
    }
    return np.asarray(DAMPING * v + dry[law])


def test_each_friction_is_its_formula_and_holds_or_creeps(modelica_library: Path) -> None:
    """The smooth law creeps as fast as predicted; the others hold to 1e-9, LuGre after its bristles have settled."""
    classes = "".join(axis(kind, law) for kind, law in AXES)
    source = f"package Laws\n  import Modelica;\n  import UrdfSync;\n{classes}end Laws;\n"
    values = {kind: [f"inertia.{PARTS[kind][k]}" for k in (1, 2)] + [f"friction.{PARTS[kind][3]}"] for kind in PARTS}
    tasks = [Task(source, f"Laws.{kind}{law}Axis", [SLIDING, HELD, LOOSE, WAVE], values[kind]) for kind, law in AXES]
    runs = iter(simulate(modelica_library, [], tasks))
    for kind, law in AXES:
        sliding, held, loose, wave = (next(runs) for _ in range(4))
        place, speed, effort = values[kind]
        for series in (sliding, wave):
            v, found = series.values[speed], series.values[effort]
            fast = np.abs(v) > 0.2  # where the bristles of LuGre have bent
            fast[:5] = False
            assert found[fast] == pytest.approx(expected(law, kind, v[fast]), abs=5e-3 if law == "LuGre" else 1e-6)
        creep = held.values[place][-1] - held.values[place][len(held.times) // 4]
        if law:
            assert abs(creep) < 1e-9, (kind, law)
            assert held.values[effort][-1] == pytest.approx(1.0, abs=1e-9)
        else:
            steepness = 100 if kind == "Rotational" else 1000
            predicted = 2 / steepness * math.atanh(1 / FRICTION)  # without damping, which changes little
            assert held.values[speed][-1] == pytest.approx(predicted, rel=0.01)
        assert loose.values[place][-1] > 0.1, "beyond its breakaway effort it goes"


ARM = robot(
    *links(base=4.0, upper=2.5, fore=1.5),
    joint(
        "shoulder", "revolute", "base", "upper", axis="0 1 0", rpy="0 0 0", xyz="0 0 0.5", inside=[dynamics(0.5, 90)]
    ),
    joint("elbow", "revolute", "upper", "fore", axis="0 1 0", rpy="0 0 0", xyz="0.4 0 0", inside=[dynamics(0.2, 60)]),
)
"""Two axes that gravity turns, by less than their friction."""


def in_world(package: Package, runs: Sequence[Run], values: Sequence[str], body: str = "") -> Task:
    name = package.target.name
    world = "inner Modelica.Mechanics.MultiBody.World world(n = {0, 0, -1}, enableAnimation = false);"
    text = f"model Hang\n  import Modelica;\n  import UrdfSync;\n  import {name};\n  {world}\n  {name}.{name} robot;\n"
    text += f"{body or 'equation'}\n  connect(world.frame_b, robot.frame_a);\nend Hang;\n"
    return Task(text, "Hang", runs, values)


OPENMODELICA = pytest.param("omc", marks=pytest.mark.skipif(omc.program("") is None, reason="no OpenModelica"))


@pytest.mark.parametrize("tool", ["rumoca", OPENMODELICA])
@pytest.mark.large  # the other tests of this file have the same laws
def test_an_arm_under_gravity_holds_still_or_creeps(tool: str, modelica_library: Path, tmp_path: Path) -> None:
    """The arm of the option: 1e-9 rad in 10 s by stiction, likewise by LuGre once its bristles have settled."""
    values = ["robot.shoulder.revolute.phi", "robot.elbow.revolute.phi"]
    options = {"Smooth": "smooth", "Stiff": "stiction", "Brush": "lugre"}
    packages = [generate(ARM.encode(), Target(name, name), friction=law, driven=()) for name, law in options.items()]
    tasks = [in_world(package, [Run(10.0, 0.5, tolerance=1e-9)], values) for package in packages]
    found = simulate(modelica_library, [package.write(tmp_path) for package in packages], tasks, tool=tool)
    stiff, brush = ([span(series, value) for value in values] for series in found[1:])
    assert max(*stiff, *brush) < 1e-9
    model = read(ARM.encode(), "arm.urdf").multibody.model
    gravity = np.abs(pin.computeGeneralizedGravity(model, model.createData(), pin.neutral(model)))[
        6:
    ]  # behind its free root
    predicted = 7.5 * gravity / ((0.5, 0.2) + np.array((90, 60)) * 100 / 2)  # s * N·m / (N·m·s/rad)
    assert [span(found[0], value) for value in values] == pytest.approx(predicted, rel=0.05)


@pytest.mark.parametrize("tool", ["rumoca", OPENMODELICA])
def test_what_rumoca_can_not_begin_is_named_with_the_alternative(
    tool: str, modelica_library: Path, tmp_path: Path
) -> None:
    """Two joints that slide from the start; in OpenModelica they come to rest."""
    package = generate(ARM.encode(), Target("Slide", "Slide"), friction="stiction", driven=())
    task = in_world(package, [Run(4.0, 0.5, tolerance=1e-9)], ["robot.shoulder.revolute.phi"])
    task = dataclasses.replace(
        task, source=task.source.replace(" robot;", " robot(elbow(w_start = 1), shoulder(w_start = 1));")
    )
    (series,) = simulate_all(modelica_library, [package.write(tmp_path)], [task], tool=tool)
    if tool == "omc":
        assert series.end("robot.shoulder.revolute.phi") > 1e-3
        assert span(series, "robot.shoulder.revolute.phi") < 1e-9
        return
    assert "joints with the friction law stiction that slide together, at t=" in series.error
    assert 'choose `friction = "lugre"`, or OpenModelica' in series.error


def span(series: Series, value: str, begin: float = 2.5) -> float:
    numbers = series.values[value][series.times >= begin]
    return float(numbers.max() - numbers.min())


WHEEL = robot(
    *links(base=4.0),
    '<link name="disc"><inertial><mass value="1"/>'
    '<inertia ixx="1" iyy="1" izz="0.5" ixy="0" ixz="0" iyz="0"/></inertial></link>',
    joint("spin", "continuous", "base", "disc", axis="0 0 1", rpy="0 0 0", inside=[limit(0, 0, 4.0, 3.0)]),
)
"""A drive of at most 3 N·m and 4 rad/s on 0.5 kg·m²."""


def test_a_drive_saturates_as_calculated_by_hand(modelica_library: Path, tmp_path: Path) -> None:
    """10 N·m give 3; from 3.8 rad/s on, the torque fades out over 0.2 rad/s, so the speed goes to 4 as exp(-30*t)."""
    interface = "<hardwareInterface>EffortJointInterface</hardwareInterface>"
    drive = f'<transmission name="t"><joint name="spin">{interface}</joint></transmission></robot>'
    urdf = WHEEL.replace("</robot>", drive)
    package = generate(urdf.encode(), Target("Disc", "Disc"), saturated="all")
    text = "model Push\n  import Modelica;\n  import UrdfSync;\n  import Disc;\n  Disc.DiscRun run;\nequation\n"
    text += "  run.spin_tau = 10;\nend Push;\n"
    task = Task(text, "Push", [Run(1.0, 0.01, tolerance=1e-9)], ["run.spin_w"])
    (series,) = simulate(modelica_library, [package.write(tmp_path)], [task])
    fading = 3.8 / 6.0  # s
    after = np.maximum(series.times - fading, 0)
    by_hand = np.where(series.times < fading, 6 * series.times, 4 - 0.2 * np.exp(-30 * after))
    assert series.values["run.spin_w"] == pytest.approx(by_hand, abs=1e-4)


def test_an_elastic_drive_gives_way_and_saturates(modelica_library: Path, tmp_path: Path) -> None:
    """Test moves the drive; the disc lags by what its inertia asks of the spring, or of the limit of effort."""
    slow, values = limit(0, 0, 4.0, 0.02), ["robot.spin.revolute.phi", "spinDrive.phi", "robot.spin.revolute.a"]
    packages = [
        generate(WHEEL.encode(), Target("Soft", "Soft"), elastic=("spin",)),
        generate(
            WHEEL.replace(limit(0, 0, 4.0, 3.0), slow).encode(), Target("Weak", "Weak"), elastic="all", saturated="all"
        ),
    ]
    tasks = []
    for package in packages:
        name = package.target.name
        imports = f"import Modelica;\n  import UrdfSync;\n  import {name};"
        text = f"model Go\n  {imports}\n  extends {name}.{name}Test;\nend Go;\n"
        tasks.append(Task(text, "Go", [Run(5.0, 0.05, tolerance=1e-9)], values))
    soft, weak = simulate(modelica_library, [package.write(tmp_path) for package in packages], tasks)
    lag = soft.values[values[1]] - soft.values[values[0]]
    late = soft.times > 1.0  # the spring has come to rest: 1e4 N·m/rad, 100 N·m·s/rad
    assert lag[late] == pytest.approx(0.5 * soft.values[values[2]][late] / 1e4, abs=1e-6)
    assert np.abs(weak.values[values[2]]).max() == pytest.approx(0.02 / 0.5, rel=1e-3)
