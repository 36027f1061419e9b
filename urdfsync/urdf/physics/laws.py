"""Checks the laws of joints that Pinocchio lacks: a joint must not give away more energy than it got.

One joint of each kind in the package stands alone in the world and carries a body. Its axis moves to and fro from a
relaxed start. Up to any time, the energy into the axis must be at least zero (passivity). Friction loses energy;
springs and bodies only hand it back. A law with the wrong sign hands out more energy. The efforts must also follow from
the numbers of the law. For this, the documented equations and the library's default numbers are written here a second
time. The second reading says which joint has which law.
"""

from __future__ import annotations

from collections.abc import Iterator

from urdfsync.domain.experiment import Aspect, Compared, Probe, Quantity, Trial
from urdfsync.urdf.physics import probe
from urdfsync.urdf.physics.subject import Subject
from urdfsync.urdf.robot import MECHANISMS
from urdfsync.urdf.second.dynamics import OF_DYNAMICS
from urdfsync.urdf.second.reading import MOVES, TURNS, SecondElement, SecondReading

_STEP, _STOP = 0.02, 1.0  # s
_STROKE = 0.2  # Motion of an axis, in rad or m.
_SHAKE = 6.0  # Greatest push, as a multiple of the effort at which the joint breaks loose.
_DEFAULTS = {
    True: {"stribeckSpeed": 0.05, "bristleDeflection": 1e-4, "stiffness": 1e4, "damper": 100.0},
    False: {"stribeckSpeed": 0.005, "bristleDeflection": 1e-5, "stiffness": 1e6, "damper": 1e4},
}
"""Default numbers of the library, for turning (True) and sliding joints."""
_BRISTLE_TIME = 1e-3  # s
_ENDLESS = 1e15
_BREAKAWAY = 1.5
"""This multiple of the dry friction breaks a joint loose. The default of packages, 1, would hide faults."""
_RUN = "saturated drive in Run"


def laws_trial(subject: Subject, reading: SecondReading) -> Trial | None:
    """Return the simulation of one joint with each combination of laws; None if Pinocchio has all laws.

    `reading` has the laws of the source; the subject has simpler laws.
    """
    tree, target, driven = subject.tree, subject.target, subject.closed.driven
    chosen = dict[tuple[object, ...], tuple[SecondElement, str]]()
    for joint in (joint for joint in reading.joints.values() if joint.type in MOVES):
        parts = frozenset(path.partition(".")[0] for path in joint.values)
        is_limited = joint.is_saturated and joint.command != "effort" and "servo" not in parts
        spring = ("saturated " if is_limited else "") + "spring" if joint.is_elastic and joint.name in driven else ""
        friction = joint.friction if joint.friction != "smooth" else ""
        if laws := " and ".join(filter(None, (friction, spring))):
            chosen.setdefault((joint.type, laws, parts), (joint, laws))
        if joint.is_saturated and not is_limited and joint.name in driven:
            chosen.setdefault((joint.type, _RUN), (joint, _RUN))
    if not chosen:
        return None
    times = tuple(k * _STEP for k in range(round(_STOP / _STEP) + 1))
    world = "inner Modelica.Mechanics.MultiBody.World world(g = 0, enableAnimation = false)"
    declarations, connections, compared = [world], list[str](), list[Compared]()
    for k, (joint, laws) in enumerate(chosen.values(), 1):
        quantities = [(Quantity.LAW, f"law{k}")]
        if laws != _RUN:
            declarations += _declarations(k, f"{target.package}.Joints.{tree.joint(joint.name).type}", joint, laws)
            connections += [
                *(f"world.frame_b, joint{k}.frame_a", f"joint{k}.frame_b, body{k}.frame_a"),
                f"stroke{k}.flange, joint{k}.axis",
            ]
            quantities.insert(0, (Quantity.ENERGY, f"stroke{k}.given"))
        declarations.append(f"Real law{k} = {' + '.join(f'abs({term})' for term in _errors(k, joint, laws))}")
        for quantity, value in quantities:
            compared.append(Compared(quantity, f"joint {joint.name}", "", (value,), times, Aspect.LOSSES, laws))
    source = probe.text(target, "", declarations, connections)
    values = tuple(each.values[0] for each in compared)
    expected = {"time": times, **dict.fromkeys(values, (0.0,) * len(times))}
    return Trial("laws of joints", Probe(source, "Probe_.Probe", _STOP, _STEP, values), tuple(compared), expected)


def _limits(joint: SecondElement) -> tuple[float, float]:
    """Return the limits of effort and speed; a large number stands for no limit."""
    return min(joint.number("limits.effort"), _ENDLESS), min(joint.number("limits.velocity"), _ENDLESS)


def _declarations(k: int, model: str, joint: SecondElement, laws: str) -> Iterator[str]:
    """Yield a joint, its body and its drive.

    An effort drives a joint with stiction, which can't follow a prescribed motion. The body is light, so that its
    energy hides no loss; on a spring, the body swings slowly enough for any solver. A saturated drive is asked for
    twice its limit of effort and three times its limit of speed.
    """
    is_turning, is_pushed, stroke = joint.type in TURNS, laws == "stiction", _STROKE
    kind, q = ("Rotational", "phi") if is_turning else ("Translational", "s")
    light = 1e-4 * _DEFAULTS[is_turning]["stiffness"] if "spring" in laws else 1e-6
    own = ["checkLimits = false", f"fixedStart = {str(is_pushed).lower()}"]
    # mechanisms store energy, too
    storing = (number for number, attribute in OF_DYNAMICS.items() if attribute in MECHANISMS.values())
    changed = [f"{number} = 0" for number in storing if f"dynamics.{number}" in joint.values]
    if joint.friction in ("stiction", "lugre"):
        dry = joint.number("dynamics.friction")
        changed.append(f"breakaway = {_BREAKAWAY * dry!r}")
        yield f"UrdfSync.Records.JointDynamics.{kind}Dynamics default{k}(friction = {dry!r})"
        light = _BREAKAWAY * dry if is_pushed else light
    if changed:
        own.append(f"parameters(dynamics({', '.join(changed)}))")
    if "saturated" in laws:
        effort, velocity = _limits(joint)
        stroke = velocity / 2 if 0 < velocity < _ENDLESS else stroke
        light = effort / (20 * stroke) if 0 < effort < _ENDLESS else light
    mass, inertia = ("1", repr(light)) if is_turning else (repr(light), "1")
    inertias = ", ".join(f"I_{i}{i} = {inertia}" for i in (1, 2, 3))
    # the drive starts a prescribed axis with a relaxed spring
    yield f"{model} joint{k}({', '.join(own)})"
    yield f"Modelica.Mechanics.MultiBody.Parts.Body body{k}(animation = false, m = {mass}, r_CM = zeros(3), {inertias})"
    if is_pushed:
        yield f"{kind}Shake stroke{k}(size = {_SHAKE * light!r}, inertia = {light!r})"
    else:
        yield f"{kind}Stroke stroke{k}(size = {stroke!r}, start = joint{k}.{q}_start)"


def _errors(k: int, joint: SecondElement, laws: str) -> Iterator[str]:
    """Yield the differences of a joint's efforts from the equations of its laws, as expressions."""
    is_turning = joint.type in TURNS
    (q, w, t), axis = (("phi", "w", "tau"), "revolute") if is_turning else (("s", "v", "f"), "prismatic")
    speed, effort, z = (f"joint{k}.friction.{name}" for name in (w, t, "z"))
    numbers = _DEFAULTS[is_turning]
    if laws == _RUN:
        most, fastest = (limit if 0 < limit < _ENDLESS else 1.0 for limit in _limits(joint))
        asked, speed = f"{2 * most!r}*sin(5*time)", f"{1.2 * fastest!r}*sin(23*time)"
        limited = f"UrdfSync.Functions.limitedEffort({asked}, {speed}, {most!r}, {fastest!r})"
        yield f"{limited} - {_limited(asked, speed, most, fastest)}"
    if "stiction" in laws or "lugre" in laws:
        d = joint.number("dynamics.friction")
        dry = f"{effort} - {joint.number('dynamics.damping')!r}*{speed}"
        yield f"default{k}.breakaway - {d!r}"
    if "stiction" in laws:
        held = f"max(0, abs({dry}) - {_BREAKAWAY * d!r})"
        yield f"if abs({speed}) > 1e-3 then {dry} - {d!r}*sign({speed}) else {held}"
    if "lugre" in laws:
        stribeck = f"(1 + {_BREAKAWAY - 1!r}*exp(-({speed}/{numbers['stribeckSpeed']!r})^2))"
        yield f"if time > 0 then 0 else {z}"  # the bristles are straight at the start
        yield f"der({z}) - {speed} + abs({speed})*{z}/({numbers['bristleDeflection']!r}*{stribeck})"
        yield f"{dry} - {d!r}/{numbers['bristleDeflection']!r}*({z} + {_BRISTLE_TIME!r}*der({z}))"
    if "spring" in laws:
        spring = f"joint{k}.elasticity"
        asked = f"({numbers['stiffness']!r}*{spring}.{q}_rel + {numbers['damper']!r}*{spring}.{w}_rel)"
        if "saturated" in laws:
            most, fastest = _limits(joint)
            given = f"-{_limited(f'(-{asked})', f'joint{k}.{axis}.{w}', most, fastest)}"
            # large efforts have large rounding errors
            yield f"({spring}.{t} - ({given}))/{most if 1 < most < _ENDLESS else 1.0!r}"
        else:
            yield f"{spring}.{t} - {asked}"


def _limited(asked: str, speed: str, most: float, fastest: float) -> str:
    """Return the effort of a saturated drive: over the last 5 % of the speed, the accelerating effort fades out."""
    fading = f"max(0, min(1, 20 - 20*abs({speed})/{max(fastest, 1e-9)!r}))"
    return f"max(-{most!r}, min({most!r}, {asked}))*(if {asked}*{speed} > 0 then {fading} else 1)"
