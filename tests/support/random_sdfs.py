"""Random robots as SDF, with each pose given in a random frame, and the same robots as URDF, by matrices of numpy."""

from __future__ import annotations

import math
from collections.abc import Sequence
from random import Random
from typing import Any, NamedTuple

import numpy as np
import pinocchio

from support.sdfs import sdf

_KINDS = ("fixed", "revolute", "continuous", "prismatic")


class Part(NamedTuple):
    """A link with the joint above it; poses are matrices, with all joints at zero."""

    name: str
    parent: str
    kind: str
    place: Any
    """Pose of the link in the model."""
    joint: Any
    """Pose of the joint in the link."""
    axis: Any
    """Axis in the joint's frame."""
    is_turned: bool
    """Whether the link is the joint's parent in the SDF."""
    is_nested: bool
    inertial: Any
    mass: float
    inertia: dict[str, float]

    @property
    def full(self) -> str:
        return f"sub::{self.name}" if self.is_nested else self.name


def random_pose(random: Random, *, is_plain: bool) -> Any:
    """A random pose; a plain one has zeros and quarters of a turn."""
    quarters = (0.0, 0.0, math.pi / 2, -math.pi / 2, math.pi)
    rpy = [random.choice(quarters) if is_plain else random.uniform(-3, 3) for _ in range(3)]
    xyz = [0.0 if is_plain and random.random() < 0.5 else random.uniform(-1, 1) for _ in range(3)]
    return at(pinocchio.rpy.rpyToMatrix(*rpy), xyz)


def at(rotation: Any, place: Any = (0.0, 0.0, 0.0)) -> Any:
    result = np.eye(4)
    result[:3, :3], result[:3, 3] = rotation, place
    return result


def random_parts(random: Random, *, is_fixed: bool) -> list[Part]:
    is_plain, parts = random.random() < 0.3, list[Part]()
    for number in range(random.randrange(2, 8)):
        moments = [random.uniform(0.5, 1) for _ in range(3)]  # no moment is larger than the two others together
        values = *moments, 0.01, -0.02, 0.03
        pose, joint, inertial = (random_pose(random, is_plain=is_plain) for _ in range(3))
        parts.append(
            Part(
                f"link{number}",
                random.choice(parts).full if parts else "world",
                random.choice(_KINDS if number != 1 else _KINDS[1:]),
                pose,
                joint if random.random() < 0.6 else np.eye(4),
                np.array(random.choice([(0, 0, 1), (0, -1, 0), (0.6, 0, 0.8)]), float),
                is_fixed and number > 0 and random.random() < 0.3,
                number > 0 and random.random() < 0.3,
                inertial,
                random.uniform(0.1, 5),
                dict(zip(("ixx", "iyy", "izz", "ixy", "ixz", "iyz"), values, strict=True)),
            )
        )
    return parts


def words(values: Any) -> str:
    return " ".join(repr(float(value)) for value in values)


def as_urdf(parts: Sequence[Part], model: Any, *, is_fixed: bool) -> str:
    frames, texts = {"world": np.linalg.inv(model)}, ['<link name="world"/>'] if is_fixed else []
    for part in parts:
        has_joint = is_fixed or part is not parts[0]
        frames[part.full] = part.place @ part.joint if has_joint else part.place
        inertial = np.linalg.inv(frames[part.full]) @ part.place @ part.inertial
        tensor = " ".join(f'{name}="{value!r}"' for name, value in part.inertia.items())
        numbers = f'{origin(inertial)}<mass value="{part.mass!r}"/><inertia {tensor}/>'
        texts.append(f'<link name="{part.full}"><inertial>{numbers}</inertial></link>')
        if has_joint:
            place = origin(np.linalg.inv(frames[part.parent]) @ frames[part.full])
            ends = f'<parent link="{part.parent}"/><child link="{part.full}"/><axis xyz="{words(part.axis)}"/>'
            limit = '<limit lower="-1" upper="1" effort="9" velocity="9"/>'
            texts.append(f'<joint name="of_{part.name}" type="{part.kind}">{ends}{place}{limit}</joint>')
    return f'<robot name="arm">{"".join(texts)}</robot>'


def origin(pose: Any) -> str:
    return f'<origin xyz="{words(pose[:3, 3])}" rpy="{words(pinocchio.rpy.matrixToRpy(pose[:3, :3]))}"/>'


class Scope:
    """Writes the poses of a model, each in a random frame of those that are written already."""

    def __init__(self, random: Random) -> None:
        self.random, self.frames = random, {"__model__": np.eye(4)}

    def pose(self, name: str, pose: Any, default: str, shown: Any = None) -> str:
        """Write the pose of a frame; `shown` is the pose of its placement frame."""
        base = self.random.choice([*self.frames, default, default])
        attribute = "" if base == default and self.random.random() < 0.5 else f' relative_to="{base}"'
        self.frames[name] = pose
        return f"<pose{attribute}{self.numbers(np.linalg.inv(self.frames[base]) @ (pose if shown is None else shown))}"

    def numbers(self, pose: Any) -> str:
        """Write the numbers of a pose in one of the three forms of an orientation."""
        rotation, place, form = pose[:3, :3], words(pose[:3, 3]), self.random.randrange(3)
        if form == 0:
            return f' rotation_format="quat_xyzw">{place} {words(pinocchio.Quaternion(rotation).coeffs())}</pose>'
        rpy = pinocchio.rpy.matrixToRpy(rotation)
        return f">{place} {words(rpy)}</pose>" if form == 1 else f' degrees="1">{place} {words(np.degrees(rpy))}</pose>'

    def link(self, part: Part, pose: Any) -> str:
        moments = "".join(f"<{name}>{value!r}</{name}>" for name, value in part.inertia.items())
        inertial = f"<pose{self.numbers(part.inertial)}<mass>{part.mass!r}</mass><inertia>{moments}</inertia>"
        own = self.pose(part.name, pose, "__model__")
        return f'<link name="{part.name}">{own}<inertial>{inertial}</inertial></link>'

    def joint(self, part: Part) -> str:
        parent, child = (part.full, part.parent) if part.is_turned else (part.parent, part.full)
        pose = part.place @ part.joint
        default = child if child in self.frames else "__model__"  # the world is no frame here
        own = (
            self.pose(f"of_{part.name}", pose, default)
            if default == child
            else (f'<pose relative_to="__model__"{self.numbers(pose)}')
        )
        base = self.random.choice([*self.frames, ""])
        rotation = self.frames[base] if base else pose
        axis = rotation[:3, :3].T @ pose[:3, :3] @ (-part.axis if part.is_turned else part.axis)
        given_in = f' expressed_in="{base}"' if base else ""
        limit = "<limit><lower>-1</lower><upper>1</upper></limit>" if part.kind != "continuous" else ""
        ends = f"<parent>{parent}</parent><child>{child}</child>"
        numbers = f"<axis><xyz{given_in}>{words(axis)}</xyz>{limit}</axis>" if part.kind != "fixed" else ""
        return f'<joint name="of_{part.name}" type="{part.kind}">{ends}{own}{numbers}</joint>'


def as_sdf(random: Random, parts: Sequence[Part], model: Any, *, is_fixed: bool) -> str:
    outer, inner, own = Scope(random), Scope(random), random_pose(random, is_plain=False)
    nested, texts = [part for part in parts if part.is_nested], list[str]()
    inside = "".join(inner.link(part, np.linalg.inv(own) @ part.place) for part in nested)
    for part in random.sample([part for part in parts if not part.is_nested], k=len(parts) - len(nested)):
        texts.append(outer.link(part, part.place))
    if nested:
        shown = random.choice([None, *nested])
        pose = outer.pose("sub", own, "__model__", None if shown is None else shown.place)
        placement = f' placement_frame="{shown.name}"' if shown else ""
        texts.append(f'<model name="sub"{placement}>{pose}{inside}</model>')
        outer.frames |= {part.full: part.place for part in nested}
    for number in range(random.randrange(3)):
        base, pose = random.choice(list(outer.frames)), random_pose(random, is_plain=False)
        text = outer.pose(f"frame{number}", pose, base)
        texts.append(f'<frame name="frame{number}" attached_to="{base}">{text}</frame>')
    texts += [outer.joint(part) for part in parts if is_fixed or part is not parts[0]]
    random.shuffle(texts)
    return sdf(f'<model name="arm"><pose{Scope(random).numbers(model)}{"".join(texts)}</model>')


class Example(NamedTuple):
    """A robot in both formats, with the names of its joints that move."""

    sdf: str
    urdf: str
    joints: list[str]
    is_fixed: bool


def example(seed: int) -> Example:
    random = Random(seed)
    is_fixed, model = random.random() < 0.7, random_pose(random, is_plain=False)
    parts = random_parts(random, is_fixed=is_fixed)
    moving = [part for part in parts if part.kind != "fixed" and (is_fixed or part is not parts[0])]
    texts = as_sdf(random, parts, model, is_fixed=is_fixed), as_urdf(parts, model, is_fixed=is_fixed)
    return Example(*texts, [f"of_{part.name}" for part in moving], is_fixed)
