"""Small robots, written as URDF text: one line per element."""

from __future__ import annotations

from collections.abc import Iterable

from urdfsync.domain import Version
from urdfsync.formats.urdf.parse.source import read_robot
from urdfsync.formats.urdf.robot import Dynamics, Robot


def robot(*elements: str, name: str = "own", version: str = "1.0") -> str:
    """A URDF of links and joints; `version` is the version of URDF."""
    said = "" if version == "1.0" else f' version="{version}"'
    return "\n".join(['<?xml version="1.0"?>', f'<robot name="{name}"{said}>', *elements, "</robot>", ""])


def link(name: str, mass: float | None = None, *, center: str = "0.02 -0.05 0.1", rpy: str = "0.4 -0.3 0.7") -> str:
    """A link; a link with mass has a full tensor in a turned, off-centre inertial frame."""
    if mass is None:
        return f'<link name="{name}"/>'
    tensor = {"ixx": 0.021, "iyy": 0.018, "izz": 0.015, "ixy": 0.002, "ixz": -0.001, "iyz": 0.0015}
    numbers = " ".join(f'{key}="{value * mass!r}"' for key, value in tensor.items())
    inertial = f'<origin xyz="{center}" rpy="{rpy}"/><mass value="{mass!r}"/><inertia {numbers}/>'
    return f'<link name="{name}"><inertial>{inertial}</inertial></link>'


def links(**masses: float | None) -> list[str]:
    """Links by their names, with these masses."""
    return [link(name, mass) for name, mass in masses.items()]


def joint(
    name: str,
    kind: str,
    parent: str,
    child: str,
    *,
    xyz: str = "0.1 -0.2 0.3",
    rpy: str = "0.5 -0.6 0.7",
    axis: str = "",
    inside: Iterable[str] = (),
) -> str:
    """A joint, moved and turned against its parent; `inside` has further elements. Default limits are wide."""
    parts = [f'<origin xyz="{xyz}" rpy="{rpy}"/>', f'<parent link="{parent}"/>', f'<child link="{child}"/>']
    if axis:
        parts.append(f'<axis xyz="{axis}"/>')
    parts += inside
    if kind in ("revolute", "prismatic") and not any(part.startswith("<limit") for part in parts):
        parts.append(limit())
    return f'<joint name="{name}" type="{kind}">{"".join(parts)}</joint>'


def robot_of(words: str, *, are_legs: bool = False) -> str:
    """A robot with the links that a line names, as `tests/test_scenarios.py` explains it."""
    elements, parent = [link("base", 9.0)], "base"
    for *names, numbers in (part.split() for part in words.split(", ")):
        mass, *boxes = numbers.split("/")
        of_link = f"link_{names[-1]}" if names[-1].isdigit() else names[-1]
        of_joint = names[0] if len(names) > 1 else of_link.replace("link_", "joint_")
        shapes = "".join(_box(kind, *box.rpartition(":")[::2]) for kind in ("visual", "collision") for box in boxes)
        elements.append(link(of_link, float(mass)).replace("</link>", f"{shapes}</link>"))
        place, limits = "0 0 0" if boxes else f"{float(mass) / 10} 0 0.1", [limit(effort=10.0)]
        elements.append(joint(of_joint, "revolute", parent, of_link, xyz=place, inside=limits))
        parent = parent if are_legs else of_link
    return robot(*elements)


def _box(kind: str, name: str, size: str) -> str:
    named = f' name="{name}"' if name else ""
    place = f'<origin xyz="{float(size) / 2} 0 0"/>'
    return f'<{kind}{named}>{place}<geometry><box size="{size} 0.1 0.1"/></geometry></{kind}>'


def limit(lower: float = -3, upper: float = 3, velocity: float = 10, effort: float = 1000) -> str:
    """Limits of a joint."""
    return f'<limit lower="{lower!r}" upper="{upper!r}" velocity="{velocity!r}" effort="{effort!r}"/>'


def dynamics(damping: float, friction: float, **more: float) -> str:
    """Losses of a joint, and other numbers of it by their attributes, such as `armature`."""
    numbers = {"damping": damping, "friction": friction, **more}
    words = " ".join(f'{name}="{value!r}"' for name, value in numbers.items())
    return f"<dynamics {words}/>"


def every_number(damping: float, friction: float, **more: float) -> str:
    """The dynamics with these numbers, and with one for each other field: so tests see a new attribute at once."""
    further = {name: 0.125 * k for k, name in enumerate(Dynamics.__struct_fields__[2:], 1)}
    return dynamics(damping, friction, **further | more)


def mimic(leader: str, multiplier: float | None = None, offset: float | None = None) -> str:
    """A joint follows another one."""
    numbers = {"multiplier": multiplier, "offset": offset}
    attributes = "".join(f' {key}="{value!r}"' for key, value in numbers.items() if value is not None)
    return f'<mimic joint="{leader}"{attributes}/>'


def parsed(urdf: str) -> Robot:
    """The robot of a URDF without errors."""
    found = read_robot(urdf.encode(), "own.urdf")
    assert found.robot is not None, found.diagnostics
    return found.robot


def version(*elements: str) -> Version:
    """A robot of elements, as comparisons take it."""
    return Version(parsed(robot(*elements)).by_name())


ELBOW_ARM = """\
<robot name="arm">
  <link name="base"/>
  <link name="fore">
    <inertial><mass value="2.5"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
  </link>
  <joint name="elbow" type="revolute">
    <parent link="base"/><child link="fore"/><axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="5" velocity="2"/>
  </joint>
</robot>
"""
"""Two links, one of 2.5 kg, and the joint between them."""
