"""Drives, gears, sweeps and contacts of the library against their documented formulas, in one model without a robot."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
from support.modelica import Array, Run, Task, simulate

pytestmark = pytest.mark.slow

STOP = 10.0
KINDS = {"Rotational": ("phi", "tau"), "Translational": ("s", "f")}
"""Names of position and effort."""
SWEEPS = {"Rotational": (0.05, 0.45 / math.pi), "Translational": (1.0, -0.63)}
"""Limit of the speed, and the way to the turning point: 90 % of the speed, or of the roomier side of the range."""
RADII = np.array([0.3, 0.1, 0.2])
AXES = np.array([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]])
"""Axes of an ellipsoid as columns: no two have the same height."""
PLACE = np.array([0.1, -0.2, 0.05])


def moved(kind: str, name: str, law: str) -> str:
    """A source that moves a flange."""
    return f"Modelica.Mechanics.{kind}.Sources.Position {name}(exact = true, {KINDS[kind][0]}_ref = {law});\n"


def springs(kind: str) -> str:
    """A spring that gives way, one that saturates, and a sweep with its housing."""
    (q, effort), weight = KINDS[kind], "Inertia {}(J = 1)" if kind == "Rotational" else "Mass {}(m = 1)"
    v = "w" if kind == "Rotational" else "v"
    parts = f"Modelica.Mechanics.{kind}.Components"
    text = moved(kind, f"near{kind}", "0.002*sin(7*time)") + moved(kind, f"far{kind}", "0.3*sin(3*time)")
    for name, limits in (("soft", ""), ("weak", "limits(effort = 5, velocity = 0.92), ")):
        text += f"UrdfSync.Drives.{kind}Spring {name}{kind}({limits}parameters(stiffness = 900, damping = 20));\n"
    numbers = f"{q}_start = 0.5, {q}_min = -0.2, {q}_max = 1, {v}_max = {SWEEPS[kind][0]}, reach = 2"
    text += f"UrdfSync.Drives.{kind}Sweep sweep{kind}({numbers}, {q}(fixed = true), {v}(fixed = true));\n"
    text += f"{parts}.Fixed housing{kind};\n{parts}.{weight.format(f'weight{kind}')};\n"
    text += f"Real balance{kind} = sweep{kind}.flange.{effort} + sweep{kind}.support.{effort};\n"
    return text


def connections(kind: str) -> str:
    ends = [(f"near{kind}.flange", f"{name}{kind}.flange_a") for name in ("soft", "weak")]
    ends += [(f"far{kind}.flange", f"{name}{kind}.flange_b") for name in ("soft", "weak")]
    ends += [(f"sweep{kind}.support", f"housing{kind}.flange"), (f"sweep{kind}.flange", f"weight{kind}.flange_a")]
    return "".join(f"connect({one}, {other});\n" for one, other in ends)


GEARS = f"""
{moved("Rotational", "turn", "0.4*time")}{moved("Translational", "push", "0.1*time")}
UrdfSync.Drives.RotationalGear rotationalGear(parameters(reduction = 50, offset = 0.2));
UrdfSync.Drives.TranslationalGear translationalGear(parameters(reduction = 300, offset = 0.02));
Modelica.Mechanics.Rotational.Components.Fixed ground;
Modelica.Mechanics.Translational.Components.Fixed rail;
Modelica.Mechanics.Rotational.Sources.ConstantTorque motor(tau_constant = 3);
Modelica.Mechanics.Rotational.Sources.ConstantTorque winch(tau_constant = 3);
UrdfSync.Robots.AxisSweeps sweeps(
  n = 2, start = fill(0.5, 2), lower = fill(-0.2, 2), upper = ones(2), velocity = {{0.05, 1}}, reach = 2);
UrdfSync.Records.JointDynamics.RotationalDynamics turning(friction = 3);
UrdfSync.Records.JointDynamics.TranslationalDynamics sliding(friction = 3);
UrdfSync.Records.RotationalTransmission turningGear;
UrdfSync.Records.TranslationalTransmission slidingGear;
UrdfSync.Records.RotationalLimits turningLimits(acceleration = 4);
UrdfSync.Records.TranslationalLimits slidingLimits(acceleration = 4);
Real force[3];
Real torque[3];
"""
CONNECTED = """
connect(ground.flange, rotationalGear.support);
connect(turn.flange, rotationalGear.flange_b);
connect(motor.flange, rotationalGear.flange_a);
connect(rail.flange, translationalGear.supportT);
connect(push.flange, translationalGear.flangeT);
connect(winch.flange, translationalGear.flangeR);
"""


def vector(numbers: Array) -> str:
    return "{" + ", ".join(map(repr, numbers.tolist())) + "}"


DEFAULTS = {
    **{f"{name}.breakaway": 3.0 for name in ("turning", "sliding")},
    "turning.stribeckSpeed": 0.05,
    "sliding.stribeckSpeed": 0.005,
    "turning.bristleDeflection": 1e-4,
    "sliding.bristleDeflection": 1e-5,
    "turning.bristleTime": 1e-3,
    "sliding.bristleTime": 1e-3,
    "turningGear.stiffness": 1e4,
    "slidingGear.stiffness": 1e6,
    "turningGear.damping": 100.0,
    "slidingGear.damping": 1e4,
    "turningLimits.deceleration": 4.0,
    "slidingLimits.deceleration": 4.0,
}
"""Numbers that no source states."""


def limited(asked: Array, speed: Array, most: float, fastest: float) -> Array:
    """The effort of a saturated drive: over the last 5 % of the speed, the accelerating effort fades out."""
    given = np.clip(asked, -most, most)
    fading = np.clip((fastest - abs(speed)) / (0.05 * fastest), 0, 1)
    return np.where(given * speed > 0, given * fading, given)


def test_drives_gears_and_contacts_are_their_formulas(modelica_library: Path) -> None:
    ellipsoid = f"0.05, {{0, 0, 1}}, {{0.002, 0.001, 0}}, zeros(3), 1e4, 2, 30, 0.7, 1e-3, {vector(PLACE)}"
    axes = "[" + "; ".join(", ".join(map(repr, row)) for row in AXES.tolist()) + "]"
    parts = "".join(map(springs, KINDS)) + GEARS + "".join(f"Real n{k} = {name};\n" for k, name in enumerate(DEFAULTS))
    call = f"(force, torque) = UrdfSync.Contacts.Functions.ellipsoid({ellipsoid}, {axes}, {vector(RADII)});\n"
    equations = "".join(map(connections, KINDS)) + CONNECTED + call
    text = f"model Laws\n  import Modelica;\n  import UrdfSync;\n{parts}equation\n{equations}end Laws;\n"
    values = ["rotationalGear.flange_a.phi", "translationalGear.flangeR.phi", "rotationalGear.flange_b.tau"]
    values += ["translationalGear.flangeT.f", "sweeps.y[1]", "sweeps.y[2]", *(f"n{k}" for k in range(len(DEFAULTS)))]
    values += [f"{name}[{k}]" for name in ("force", "torque") for k in (1, 2, 3)]
    for kind, (q, effort) in KINDS.items():
        values += [f"{name}{kind}.{effort}" for name in ("soft", "weak")]
        values += [f"sweep{kind}.{q}", f"balance{kind}"]
    (series,) = simulate(modelica_library, [], [Task(text, "Laws", [Run(STOP, 0.05, tolerance=1e-9)], values)])
    t, found = series.times, series.values
    assert [found[f"n{k}"][-1] for k in range(len(DEFAULTS))] == pytest.approx(list(DEFAULTS.values()), rel=1e-12)

    stretch, rate = 0.3 * np.sin(3 * t) - 0.002 * np.sin(7 * t), 0.9 * np.cos(3 * t) - 0.014 * np.cos(7 * t)
    asked, speed = 900 * stretch + 20 * rate, 0.9 * np.cos(3 * t)
    for kind, (q, effort) in KINDS.items():
        assert found[f"soft{kind}.{effort}"] == pytest.approx(asked, abs=1e-6)
        assert found[f"weak{kind}.{effort}"] == pytest.approx(-limited(-asked, speed, 5, 0.92), abs=1e-6)
        way = 0.5 + SWEEPS[kind][1] * 0.5 * (1 - np.cos(2 * math.pi * t / STOP))
        assert found[f"sweep{kind}.{q}"] == pytest.approx(way, abs=1e-4)  # it is integrated
        assert found[f"sweeps.y[{[*KINDS].index(kind) + 1}]"] == pytest.approx(way, abs=1e-9)
        assert found[f"balance{kind}"] == pytest.approx(0, abs=1e-9)
    assert found["rotationalGear.flange_a.phi"] == pytest.approx(50 * (0.4 * t - 0.2), abs=1e-9)
    assert found["translationalGear.flangeR.phi"] == pytest.approx(300 * (0.1 * t - 0.02), abs=1e-9)
    assert found["rotationalGear.flange_b.tau"] == pytest.approx(-150, rel=1e-9)
    assert found["translationalGear.flangeT.f"] == pytest.approx(-900, rel=1e-9)

    # the lowest point of an ellipsoid, by its half axes and the upward direction in its axes
    upward = AXES[2]
    point = PLACE - AXES @ (RADII**2 * upward) / np.linalg.norm(RADII * upward)
    normal = 1e4 * max(0.0, -0.05 - point[2])
    assert normal > 0
    slide = np.array([0.002, 0.001, 0])
    force = normal * (np.array([0, 0, 1]) - 0.7 * slide / math.hypot(*slide, 1e-3))
    assert [found[f"force[{k}]"][-1] for k in (1, 2, 3)] == pytest.approx(force, rel=1e-9)
    assert [found[f"torque[{k}]"][-1] for k in (1, 2, 3)] == pytest.approx(np.cross(point, force), rel=1e-9)
