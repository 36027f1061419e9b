"""Ground contact: shapes rest, roll, slide and land where their geometry says, in simulation."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from support.modelica import GRAVITY, Array, Run, Series, Task, bench, compile_task, simulate
from support.packages import generate
from support.urdfs import joint, link, robot

from urdfsync.domain import Target

pytestmark = pytest.mark.slow

MASS = 5.0
INERTIA = 0.02
WEIGHT = MASS * GRAVITY
MILLIMETRE = 1e-3
SETTLED = 0.5  # s

ACROSS = f"origin(rpy = {{{math.pi / 2!r}, 0, 0}})"  # turns the z axis of a shape to -y
WHEEL = f"Cylinder(parameters(radius = 0.1, length = 0.04, {ACROSS}))"
DISC = "Cylinder(parameters(radius = 0.1, length = 0.2))"
BALL = "Sphere(parameters(radius = 0.1))"
BRICK = "Box(parameters(size = {0.2, 0.3, 0.4}))"

Vector = tuple[float, float, float]
ZERO: Vector = (0.0, 0.0, 0.0)


VALUES = [
    f"{{body}}{name}"
    for k in (1, 2, 3)
    for name in (f".frame_a.r_0[{k}]", f".v_0[{k}]", f".w_a[{k}]", f".frame_a.R.T[{k},3]", f"Contact.f[{k}]")
]


@dataclass(frozen=True)
class Motion:
    """What a simulation recorded of a body and of the contact at its frame, which has the body's name + 'Contact'."""

    result: Series
    body: str

    def position(self, axis: int) -> Array:
        """Coordinate 1, 2 or 3 of the body's frame in the world, in m."""
        return self.result.values[f"{self.body}.frame_a.r_0[{axis}]"]

    @property
    def height(self) -> Array:
        return self.position(3)

    def speed(self, axis: int) -> Array:
        """Velocity of the body's frame in the world, in m/s."""
        return self.result.values[f"{self.body}.v_0[{axis}]"]

    def up(self, axis: int) -> Array:
        """Share of an axis of the body that points upward."""
        return self.result.values[f"{self.body}.frame_a.R.T[{axis},3]"]

    @property
    def upward_force(self) -> Array:
        """Vertical force of the ground on the body, in N."""
        values = self.result.values
        parts: list[Array] = [self.up(k) * values[f"{self.body}Contact.f[{k}]"] for k in (1, 2, 3)]
        return parts[0] + parts[1] + parts[2]

    def settled(self, signal: Array) -> Array:
        return signal[self.result.times >= SETTLED]


def vector(values: Vector) -> str:
    return "{" + ", ".join(map(repr, values)) + "}"


def body(name: str, contact: str, z: float, rpy: Vector = ZERO, v: Vector = ZERO, w: Vector = ZERO) -> str:
    """Declarations of a body of 5 kg with one contact at its frame, and how it starts (w in its own axes)."""
    return f"""
  Modelica.Mechanics.MultiBody.Parts.Body {name}(
    m = {MASS}, r_CM = {{0, 0, 0}}, I_11 = {INERTIA}, I_22 = {INERTIA}, I_33 = {INERTIA},
    r_0(each fixed = true, start = {{0, 0, {z!r}}}), v_0(each fixed = true, start = {vector(v)}),
    sequence_start = {{3, 2, 1}}, angles_start = {vector((rpy[2], rpy[1], rpy[0]))}, angles_fixed = true,
    w_0_start = {vector(w)}, w_0_fixed = true);
  UrdfSync.Contacts.{contact.replace("(", f" {name}Contact(", 1)};"""


def run(library: Path, bodies: dict[str, str], seconds: float, ground: str = f"load = {MASS}*world.g") -> Series:
    """Simulate a ground with its modifiers, and bodies (declarations by name) that do not feel each other."""
    text = f"""
model Case
  import Modelica;
  inner Modelica.Mechanics.MultiBody.World world(n = {{0, 0, -1}}, enableAnimation = false);
  inner UrdfSync.Contacts.Ground ground({ground});
{"".join(bodies.values())}
equation
{"".join(f"  connect({name}.frame_a, {name}Contact.frame_a);" for name in bodies)}
end Case;
"""
    values = [value.format(body=name) for name in bodies for value in VALUES]
    (series,) = simulate(library, [], [Task(text, "Case", [Run(seconds, 0.01, tolerance=1e-6)], values)])
    return series


def mesh_wheel() -> str:
    """The hull of a wheel that is a prism of 36 corners, with its axis along z of the mesh."""
    angles = [2 * math.pi * k / 36 for k in range(36)]
    rims = [(0.1 * math.cos(a), 0.1 * math.sin(a), side) for side in (-0.02, 0.02) for a in angles]
    return f"Points(parameters({ACROSS}), corners = {{{', '.join(map(vector, rims))}}})"


# --- At rest -----------------------------------------------------------------------------------------------------


RESTING = {  # name: (contact, height at which the body rests)
    "wheel": (WHEEL, 0.1),
    "meshWheel": (mesh_wheel(), 0.1),
    "ball": (BALL, 0.1),
    "egg": (f"Ellipsoid(parameters(radii = {{0.3, 0.1, 0.2}}, {ACROSS}))", 0.1),
    "turnedBox": (f"Box(parameters(size = {{0.2, 0.3, 0.4}}, {ACROSS}))", 0.15),
    "thinDisc": ("Cylinder(parameters(radius = 0.1, length = 0.001))", 0.0005),
    "footBelow": ("Cylinder(parameters(radius = 0.1, length = 0.1, origin(xyz = {0, 0, -0.2})))", 0.25),
}
FACES = {  # name: (roll and pitch that turn the face down, axis of the body that points up then, half height)
    "bottom": (0.0, 0.0, 3, 0.2),
    "left": (math.pi / 2, 0.0, 2, 0.15),
    "front": (0.0, math.pi / 2, -1, 0.1),
}
LEANING = {"stands": 22, "falls": 32}
ROLLING: dict[str, Any] = {"z": 0.1, "v": (0.5, 0.0, 0.0), "w": (0.0, 5.0, 0.0)}
PUSH = (1.0, 0.5, 3.0)
PILLAR = "Cylinder(parameters(radius = 0.1, length = 0.4))"


@pytest.fixture(scope="module")
def short(modelica_library: Path) -> Series:
    """One second of shapes that are dropped from 5 mm, and of bodies that slide and fall."""
    bodies = {name: body(name, contact, z=height + 0.005) for name, (contact, height) in RESTING.items()}
    bodies["sliding"] = body("sliding", BALL, z=0.1, v=(1.0, 0.0, 0.0))
    bodies["dropped"] = body("dropped", BRICK, z=0.7)
    return run(modelica_library, bodies, 1)


@pytest.fixture(scope="module")
def long(modelica_library: Path) -> Series:
    """Four seconds of boxes that land on a face, a little askew, and of bodies that are pushed and lean."""
    bodies = {
        name: body(name, BRICK, z=height + 0.03, rpy=(roll + 0.05, pitch + 0.03, 0.2))
        for name, (roll, pitch, _, height) in FACES.items()
    }
    bodies["pushed"] = body("pushed", DISC, z=0.1, w=PUSH)
    for name, angle in LEANING.items():
        bodies[name] = body(name, PILLAR, z=0.25, rpy=(math.radians(angle), 0.0, 0.0))
    bodies["sunk"] = body("sunk", BRICK, z=0.15)
    bodies["rolling"] = body("rolling", WHEEL, **ROLLING)
    return run(modelica_library, bodies, 4)


@pytest.mark.parametrize("name", RESTING)
def test_rests_with_its_lowest_points_on_the_ground(short: Series, name: str) -> None:
    motion, height = Motion(short, name), RESTING[name][1]
    assert motion.height[0] == pytest.approx(height + 0.005)
    assert motion.height.min() > height - MILLIMETRE
    assert np.abs(motion.settled(motion.height) - height).max() < MILLIMETRE
    assert np.abs(motion.settled(motion.upward_force) / WEIGHT - 1).max() < 1e-3


def test_one_point_sinks_in_by_the_penetration_of_the_load_wherever_the_ground_is(modelica_library: Path) -> None:
    """The numbers are those of the ground in the simulated model, not its defaults."""
    ground = f"height = 2, load = {2 * WEIGHT}, penetration = 1e-3"
    motion = Motion(run(modelica_library, {"body": body("body", BALL, z=2.1)}, 1, ground), "body")
    assert motion.height[-1] == pytest.approx(2.1 - 0.5e-3, abs=1e-6)


# --- Landing -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", FACES)
def test_a_box_lands_and_stands_on_its_face(long: Series, name: str) -> None:
    motion, (_, _, axis, height) = Motion(long, name), FACES[name]
    assert motion.height[-1] == pytest.approx(height, abs=MILLIMETRE)
    assert motion.up(abs(axis))[-1] == pytest.approx(math.copysign(1, axis), abs=1e-4)
    assert motion.upward_force[-1] == pytest.approx(WEIGHT, rel=1e-3)


def test_an_upright_cylinder_stands_when_it_is_pushed(long: Series) -> None:
    motion = Motion(long, "pushed")
    assert motion.height[-1] == pytest.approx(0.1, abs=MILLIMETRE)
    assert motion.up(3)[-1] == pytest.approx(1, abs=1e-4)
    assert abs(motion.speed(3)[-1]) < 1e-5


def test_a_cylinder_that_leans_too_far_falls_on_its_side(long: Series) -> None:
    """It tips where the centre is past the rim: at atan(radius / half length), 27 degrees here."""
    assert Motion(long, "stands").height[-1] == pytest.approx(0.2, abs=MILLIMETRE)
    assert Motion(long, "falls").height[-1] == pytest.approx(0.1, abs=MILLIMETRE)


def test_the_ground_never_pulls_and_nothing_bounces(short: Series) -> None:
    motion = Motion(short, "dropped")
    landed = motion.result.times > 0.4  # after a fall of 0.5 m, which takes 0.32 s
    assert motion.upward_force.min() >= 0
    assert motion.height[landed].max() < 0.2 + MILLIMETRE


def test_what_starts_below_the_ground_is_lifted_slowly(long: Series) -> None:
    motion = Motion(long, "sunk")
    assert 0 < motion.speed(3).max() < 0.03
    assert motion.height.max() < 0.2
    assert motion.height[-1] == pytest.approx(0.2, abs=MILLIMETRE)


# --- Rolling and sliding -----------------------------------------------------------------------------------------


def test_a_rolling_wheel_stays_at_its_height_without_bumps(long: Series) -> None:
    motion = Motion(long, "rolling")
    assert np.abs(motion.height - 0.1).max() < MILLIMETRE
    assert np.ptp(motion.settled(motion.height)) < 1e-6
    assert motion.position(1)[-1] == pytest.approx(2.0, rel=1e-3)
    assert motion.position(2)[-1] == pytest.approx(0, abs=1e-6)


def test_a_sliding_ball_ends_in_rolling(short: Series) -> None:
    """Friction acts at the lowest point, so the angular momentum about it stays: v = v0 / (1 + I / (m r²))."""
    motion = Motion(short, "sliding")
    rolling = 1 / (1 + INERTIA / (MASS * 0.1**2))
    assert motion.speed(1)[-1] == pytest.approx(rolling, rel=0.01)
    assert motion.result.values["sliding.w_a[2]"][-1] * 0.1 == pytest.approx(motion.speed(1)[-1], rel=0.01)
    assert motion.height[-1] == pytest.approx(0.1, abs=MILLIMETRE)


# --- A generated mobile robot: its wheels rest on their collision shapes, and stay there while they roll --------------

RADIUS = 0.12

INERTIAL = """<inertial><origin xyz="{at}"/><mass value="{mass}"/>
  <inertia ixx="{i}" iyy="{i}" izz="{i}" ixy="0" ixz="0" iyz="0"/></inertial>"""

WHEELS = f"""<link name="{{side}}">{INERTIAL.format(at="0 0 0", mass=1.5, i=0.01)}
  <collision><origin rpy="1.5707963267948966 0 0"/>
    <geometry><cylinder radius="{RADIUS}" length="0.05"/></geometry></collision></link>
<joint name="drive_{{side}}" type="continuous"><parent link="chassis"/><child link="{{side}}"/>
  <origin xyz="0.05 {{y}} 0"/><axis xyz="0 1 0"/></joint>"""

CART = f"""<robot name="cart"><link name="chassis">{INERTIAL.format(at="0.03 0 0.05", mass=12, i=0.3)}
  <collision><origin xyz="0 0 0.1"/><geometry><box size="0.5 0.3 0.1"/></geometry></collision></link>
{WHEELS.format(side="left", y=0.2)}{WHEELS.format(side="right", y=-0.2)}
<link name="ball"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
<joint name="ball_mount" type="fixed"><parent link="chassis"/><child link="ball"/><origin xyz="-0.2 0 -0.07"/></joint>
</robot>"""

HEIGHTS = {f"robot.{wheel}.frame_a.r_0[3]": RADIUS for wheel in ("left", "right")} | {"robot.ball.frame_a.r_0[3]": 0.05}

TURNED = [f"robot.drive_{wheel}Axis.phi" for wheel in ("left", "right")]


def test_the_ground_of_a_mobile_bench_is_designed_for_its_load(modelica_library: Path) -> None:
    text = """
model Case
  import Modelica;
  extends UrdfSync.Robots.PartialMobileBench(
    load = 500, stance(height = 1), world(enableAnimation = false), ground(animation = false));
  Modelica.Mechanics.MultiBody.Parts.Body body(m = 1, r_CM = {0, 0, 0});
  Real weight = ground.load;
equation
  connect(base.frame_b, body.frame_a);
end Case;
"""
    (series,) = simulate(modelica_library, [], [Task(text, "Case", [Run(0.01, 0.01)], ["weight"])])
    assert series.values["weight"][-1] == 500


def test_the_wheels_of_a_cart_stand_on_their_shapes_and_take_it_as_far_as_they_roll(
    modelica_library: Path, tmp_path: Path
) -> None:
    """In its Test model, which is at rest in the beginning; then both wheels turn forwards."""
    package = generate(CART.encode(), Target("Cart", "Cart"), base="floating")
    values = [*HEIGHTS, "robot.chassis.frame_a.r_0[1]", *TURNED]
    task = compile_task("Cart.CartTest", runs=[Run(3, 0.1)], values=values)
    (series,) = simulate(modelica_library, [package.write(tmp_path)], [task])
    for value, height in HEIGHTS.items():
        assert np.abs(series.values[value] - height).max() < MILLIMETRE, value
    turned = np.mean([series.values[name] for name in TURNED], axis=0)
    gone = series.values["robot.chassis.frame_a.r_0[1]"]
    assert turned[-1] > 0.5
    assert gone[-1] == pytest.approx(RADIUS * turned[-1], rel=0.02)


# --- Surfaces of links --------------------------------------------------------------------------------------------


FOOT, SLIP = 2.0, 0.001
"""Mass of the foot in kg, and the slip speed of the ground in m/s."""
SURFACE = {"mu": 0.3, "kp": 2e4, "kd": 40.0, "min_depth": 0.002}
INERTIAL = '<mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'


def foot(surface: str) -> str:
    """A ball that slides along x and z, and does not turn."""
    slide = '<limit lower="-9" upper="9" effort="1" velocity="9"/>'
    return robot(
        link("base"),
        link("sledge"),
        f'<link name="foot"><inertial>{INERTIAL}</inertial>'
        '<collision><geometry><sphere radius="0.1"/></geometry></collision></link>',
        joint("x", "prismatic", "base", "sledge", xyz="0 0 0", rpy="0 0 0", axis="1 0 0", inside=[slide]),
        joint("z", "prismatic", "sledge", "foot", xyz="0 0 0", rpy="0 0 0", axis="0 0 1", inside=[slide]),
        surface,
    )


def test_the_surface_of_a_link_is_what_its_urdf_says(modelica_library: Path, tmp_path: Path) -> None:
    """A foot rests, swings and slides as the equations of a spring, a damper and Coulomb's friction say."""
    mu, kp, kd, free = SURFACE.values()
    gazebo = (
        f'<gazebo reference="foot"><mu1>{mu}</mu1><kp value="{kp}"/><collision><surface><contact><ode>'
        f"<kd>{kd}</kd><min_depth>{free}</min_depth></ode></contact></surface></collision></gazebo>"
    )
    package = generate(foot(gazebo).encode(), Target("Foot", "Bot"), base="floating").write(tmp_path)
    rest = 0.1 - free - FOOT * GRAVITY / kp
    body = f"""
    inner UrdfSync.Contacts.Ground ground(load = {FOOT * GRAVITY}, slipSpeed = {SLIP}, dampingRatio = 0);
    Foot.Bot dropped(animation = false, z(s_start = 0.105));
    Foot.Bot swinging(animation = false, z(s_start = {rest!r}, v_start = 0.05));
    Foot.Bot sliding(animation = false, x(v_start = 2), z(s_start = {rest!r}));
    equation
    connect(world.frame_b, dropped.frame_a);
    connect(world.frame_b, swinging.frame_a);
    connect(world.frame_b, sliding.frame_a);"""
    values = [f"{name}.{joint}.prismatic.{value}" for name in ("dropped", "swinging", "sliding")
              for joint, value in (("z", "s"), ("x", "v"))]  # fmt: skip
    run = Run(2, 0.01, tolerance=1e-11)
    (series,) = simulate(modelica_library, [package], [bench(body, [run], values, packages=["Foot"])])
    height = {name: series.values[f"{name}.z.prismatic.s"] for name in ("dropped", "swinging", "sliding")}
    assert height["dropped"][-1] == pytest.approx(rest, abs=1e-6 * (0.1 - rest))

    decay, times = kd / (2 * FOOT), series.times
    omega = math.sqrt(kp / FOOT - decay**2)
    swing = 0.05 / omega * np.exp(-decay * times) * np.sin(omega * times)
    assert np.abs(height["swinging"] - rest - swing).max() < 1e-6 * 0.05 / omega

    speed = series.values["sliding.x.prismatic.v"][times <= 0.6]
    course = np.sqrt(speed**2 + SLIP**2) - SLIP * np.arcsinh(SLIP / speed)  # falls by mu*g in each second
    assert np.abs(course - course[0] + mu * GRAVITY * times[times <= 0.6]).max() < 1e-6
    assert np.abs(height["sliding"] - rest).max() < 1e-6 * (0.1 - rest)
