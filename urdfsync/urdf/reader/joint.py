"""Reads joints. A fault is a finding, and a default stands in for the value."""

from __future__ import annotations

from typing import get_args

from urdfsync.urdf.reader.checks import LIMITED, SCALAR, nearest
from urdfsync.urdf.reader.fields import Element
from urdfsync.urdf.reader.link import read_origin
from urdfsync.urdf.robot import (
    Calibration,
    Dynamics,
    Extension,
    Joint,
    JointType,
    Limit,
    Mimic,
    SafetyController,
)

_TYPES: tuple[JointType, ...] = get_args(JointType)
_PARTS = ("parent", "child", "origin", "axis", "limit", "dynamics", "mimic", "calibration", "safety_controller")
_SAFETY = ("k_velocity", "k_position", "soft_lower_limit", "soft_upper_limit")
_X = (1.0, 0.0, 0.0)


def read_joint(element: Element, extensions: list[Extension]) -> Joint | None:
    """The joint with its axis as written, or None, after an error, if it connects nothing.

    Adds what is not modelled to `extensions`. A joint of unknown type is read as a plain fixed one.
    """
    element.expect(("name", "type"))
    name = element.node.attributes.get("name", "")
    extensions += element.extensions(f"joint {name}", _PARTS)
    kind, parent, child = _read_type(element), _read_end(element, "parent"), _read_end(element, "child")
    if not parent or not child:
        return None
    if kind is None:
        return Joint(name, "fixed", parent, child)
    axis = element.child("axis", "xyz")
    return Joint(
        name=name,
        type=kind,
        parent=parent,
        child=child,
        origin=read_origin(element),
        axis=axis.vector("xyz", _X) if axis else _X,
        limit=_read_limit(element, kind),
        dynamics=_read_dynamics(element),
        mimic=_read_mimic(element),
        calibration=_read_calibration(element),
        safety_controller=_read_safety_controller(element),
    )


def _read_type(element: Element) -> JointType | None:
    """One of URDF's joint types; None after an error."""
    text = element.text("type")
    kind = next((known for known in _TYPES if known == text), None)
    if kind is None and text.strip():
        meant = nearest(text.lower(), _TYPES)
        hint = f"perhaps {meant!r} is meant" if meant else f"use one of {', '.join(_TYPES)}"
        element.error("unknown-joint-type", f"{element.path} has the unknown type {text!r}", hint)
    return kind


def _read_end(element: Element, tag: str) -> str:
    """Name of the parent or child link; empty after an error."""
    end = element.child(tag, "link")
    if end is None:
        element.error("missing-element", f"{element.path} has no <{tag}>", f'add <{tag} link="…"/>')
        return ""
    return end.text("link")


def _read_limit(joint: Element, kind: JointType) -> Limit | None:
    """The limits; what is absent is 0 for a position, and no limit for effort and velocity."""
    element = joint.child("limit", "lower", "upper", "effort", "velocity")
    if element is None:
        if kind in LIMITED:
            message = f"{joint.path} is {kind} but has no <limit>: it moves without limits"
            joint.warn("missing-limit", message, "add <limit>, or make a revolute joint continuous")
        return None
    given = element.node.attributes
    zero = [name for name in ("lower", "upper") if name not in given and kind in LIMITED]
    without = [name for name in ("effort", "velocity") if name not in given and kind in SCALAR]
    if zero or without:
        hint = "add what is missing, or make a joint that turns freely continuous"
        told = [f"{' and '.join(zero)}, taken as 0"] if zero else []
        told += [f"{' and '.join(without)}, taken as unlimited"] if without else []
        element.warn("missing-limit-value", f"{element.path} has no {'; no '.join(told)}", hint)
    return Limit(
        element.number("lower", 0.0),
        element.number("upper", 0.0),
        element.number("effort", None),
        element.number("velocity", None),
    )


def _read_dynamics(joint: Element) -> Dynamics | None:
    """Damping and friction, each 0 if absent."""
    element = joint.child("dynamics", "damping", "friction")
    return Dynamics(element.number("damping", 0.0), element.number("friction", 0.0)) if element else None


def _read_mimic(joint: Element) -> Mimic | None:
    """The mimic relation; None, after an error, if it names no joint."""
    element = joint.child("mimic", "joint", "multiplier", "offset")
    if element is None:
        return None
    leader, multiplier, offset = element.text("joint"), element.number("multiplier", 1.0), element.number("offset", 0.0)
    return Mimic(leader, multiplier, offset) if leader else None


def _read_calibration(joint: Element) -> Calibration | None:
    """The reference edges, each None if absent."""
    element = joint.child("calibration", "rising", "falling")
    return Calibration(element.number("rising", None), element.number("falling", None)) if element else None


def _read_safety_controller(joint: Element) -> SafetyController | None:
    """Soft limits and gains, each 0 if absent; URDF requires the gain of the velocity."""
    element = joint.child("safety_controller", *_SAFETY)
    if element is None:
        return None
    if "k_velocity" not in element.node.attributes:
        element.warn("missing-gain", f"{element.path} has no 'k_velocity', taken as 0", "add k_velocity=…")
    return SafetyController(*(element.number(name, 0.0) for name in _SAFETY))
