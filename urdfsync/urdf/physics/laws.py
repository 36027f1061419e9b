"""Checks the laws of joints that the reference lacks: a joint must not give away energy that it never got.

One joint of each kind in the package stands alone in the world and carries a body. Its axis moves to and fro from a
relaxed start. Up to any time, the axis must have taken in at least zero energy: friction loses some, springs and bodies
hand back what they got (passivity). A law with the wrong sign hands out more. Its effort must also be that of its
numbers: the documented equations are written here a second time.
"""

from __future__ import annotations

from collections.abc import Iterator

from urdfsync.checks.experiment import Compared, Part, Probe, Quantity, Trial
from urdfsync.domain import Target
from urdfsync.urdf.drives import assembly
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.model.joint import joint_model
from urdfsync.urdf.options import Options
from urdfsync.urdf.physics import probe
from urdfsync.urdf.robot import MOTION_KINDS, Joint

_STEP, _STOP = 0.02, 1.0  # s
_STROKE = 0.2  # rad or m
_SHAKE = 6.0  # times the effort at which the joint breaks loose


def laws_trial(tree: KinematicTree, target: Target, options: Options) -> Trial | None:
    """Return the simulation of one joint with each combination of laws; None if Pinocchio has them all."""
    chosen = dict[tuple[object, ...], tuple[Joint, str]]()
    driven = assembly(tree, options).driven
    for joint in tree.joints:
        if joint.type not in MOTION_KINDS:
            continue
        parts = joint_model(joint, options, joint.name in driven)
        elastic = ("saturated " if parts["saturated"] else "") + "spring" if parts["elastic"] else ""
        friction = parts["friction"] if parts["friction"] in ("stiction", "lugre") else ""
        if laws := " and ".join(filter(None, (friction, elastic))):
            chosen.setdefault((joint.type, *parts.values()), (joint, laws))
    if not chosen:
        return None
    times = tuple(k * _STEP for k in range(1, round(_STOP / _STEP) + 1))
    world = "inner Modelica.Mechanics.MultiBody.World world(g = 0, enableAnimation = false)"
    declarations, connections, compared = [world], list[str](), list[Compared]()
    for k, (joint, laws) in enumerate(chosen.values(), 1):
        declarations += _declarations(k, f"{target.package}.Joints.{tree.joint(joint.name).type}", joint, laws)
        connections += [
            *(f"world.frame_b, joint{k}.frame_a", f"joint{k}.frame_b, body{k}.frame_a"),
            f"stroke{k}.flange, joint{k}.axis",
        ]
        declarations.append(f"Real law{k} = {' + '.join(f'abs({term})' for term in _errors(k, joint, laws))}")
        for quantity, value in ((Quantity.ENERGY, f"stroke{k}.given"), (Quantity.LAW, f"law{k}")):
            compared.append(Compared(quantity, f"joint {joint.name}", "", (value,), times, Part.LOSSES, laws))
    source = probe.text(target, options, "", declarations, connections)
    values = tuple(each.values[0] for each in compared)
    expected = {"time": times, **dict.fromkeys(values, (0.0,) * len(times))}
    return Trial("laws of joints", Probe(source, "Probe_.Probe", _STOP, _STEP, values), tuple(compared), expected)


def _declarations(k: int, model: str, joint: Joint, laws: str) -> Iterator[str]:
    """Yield a joint, its body and its drive. A sticking joint is driven by an effort: it can't follow a prescribed way.

    The body is light, so that its energy hides no loss; on a spring it swings slowly enough for any solver, and needs
    more than a limited effort.
    """
    is_turning, is_pushed = MOTION_KINDS[joint.type] == "rotational", laws == "stiction"
    numbers = f"joint{k}.parameters"
    breakaway, stiffness = f"{numbers}.dynamics.breakaway", f"{numbers}.transmission.stiffness"
    light = f"1e-4*{stiffness}" if "spring" in laws else breakaway if is_pushed else "1e-6"
    if "saturated" in laws:
        light = f"if {numbers}.limits.effort < 1e15 then {numbers}.limits.effort/3 else {light}"
    mass, inertia = ("1", light) if is_turning else (light, "1")
    inertias = ", ".join(f"I_{i}{i} = {inertia}" for i in (1, 2, 3))
    # the drive gives a prescribed axis its start, where the spring is relaxed
    yield f"{model} joint{k}(checkLimits = false, fixedStart = {str(is_pushed).lower()})"
    yield f"Modelica.Mechanics.MultiBody.Parts.Body body{k}(animation = false, m = {mass}, r_CM = zeros(3), {inertias})"
    kind, q = ("Rotational", "phi") if is_turning else ("Translational", "s")
    if is_pushed:
        yield f"{kind}Shake stroke{k}(size = {_SHAKE}*{breakaway}, inertia = {light})"
    else:
        yield f"{kind}Stroke stroke{k}(size = {_STROKE}, start = joint{k}.{q}_start)"


def _errors(k: int, joint: Joint, laws: str) -> Iterator[str]:
    """Yield by how much the efforts of a joint's friction and spring differ from the equations of their laws."""
    is_turning = MOTION_KINDS[joint.type] == "rotational"
    (q, w, t), axis = (("phi", "w", "tau"), "revolute") if is_turning else (("s", "v", "f"), "prismatic")
    speed, effort, z = (f"joint{k}.friction.{name}" for name in (w, t, "z"))
    d, gear, limits = (f"joint{k}.parameters.{part}" for part in ("dynamics", "transmission", "limits"))
    dry = f"{effort} - {d}.damping*{speed}"
    if "stiction" in laws:
        held = f"max(0, abs({dry}) - {d}.breakaway)"
        yield f"if abs({speed}) > 1e-3 then {dry} - {d}.friction*sign({speed}) else {held}"
    if "lugre" in laws:
        stribeck = f"(1 + ({d}.breakaway/{d}.friction - 1)*exp(-({speed}/{d}.stribeckSpeed)^2))"
        yield f"der({z}) - {speed} + abs({speed})*{z}/({d}.bristleDeflection*{stribeck})"
        yield f"{dry} - {d}.friction/{d}.bristleDeflection*({z} + {d}.bristleTime*der({z}))"
    if "spring" in laws:
        spring = f"joint{k}.elasticity"
        asked = given = f"({gear}.stiffness*{spring}.{q}_rel + {gear}.damping*{spring}.{w}_rel)"
        if "saturated" in laws:  # it fades over the last twentieth of the speed, if it speeds the joint up
            v = f"joint{k}.{axis}.{w}"
            fading = f"max(0, min(1, 20 - 20*abs({v})/max(1e-9, {limits}.velocity)))"
            given = f"max(-{limits}.effort, min({limits}.effort, {asked}))*(if {asked}*{v} < 0 then {fading} else 1)"
        yield f"{spring}.{t} - {given}"
