"""The multibody form of the generic robot, written out for one robot, against Pinocchio.

rumoca loses the subscripts of components in the class as it stands. So its arrays, loops and conditions are written out
here by the tables of a robot, term by term, and the result moves freely. What is written out is the text of the class.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from support import generic
from support.modelica import URDFSYNC, Task, simulate
from support.urdfs import dynamics, joint, link, links, robot

from urdfsync.formats.urdf.model.record import tables as integer_tables
from urdfsync.formats.urdf.physics import motion
from urdfsync.formats.urdf.robot import MOTION_KINDS

pytestmark = pytest.mark.slow

CRANE = robot(
    *links(base=2.0, plate=1.0),
    *(link(name, 1.5) for name in ("arm", "slide", "wheel")),
    joint("bolts", "fixed", "base", "plate"),
    joint("shoulder", "revolute", "plate", "arm", axis="0.6 0 0.8", inside=[dynamics(0.4, 0.2)]),
    joint("rail", "prismatic", "arm", "slide", axis="0 1 0", inside=[dynamics(3.0, 0.5)]),
    joint("roll", "continuous", "arm", "wheel", axis="1 0 0"),
)
"""A fixed joint, two that turn and one that slides, on branches."""
START = motion.Course(0.3, 0.2, 0.0)
STOP = 0.5
DERIVATIVES = re.compile(r"    \w+\[k\] = der\(\w+\[k\]\);\n")
"""Of positions and speeds: rumoca takes them from the joints, which have them as well."""

Table = list[list[int]]


def tables(own: generic.Robot) -> Mapping[str, Table]:
    """The integers of the record that the class reads, vectors as columns; counted from 1."""
    skeleton = own.skeleton
    found = integer_tables(skeleton)
    numbers = {each.name: number for number, each in enumerate(skeleton.links, 1)}
    kinds = [kind for _, kind in found.joint_tree]
    return {
        "data.connectionMatrix": [[numbers[each.parent], numbers[each.child]] for each in skeleton.joints],
        "data.moveableJoints": [[k, 1] for k, each in enumerate(skeleton.joints, 1) if each.type in MOTION_KINDS],
        "data.linkBodies": [[body] for body in found.link_bodies],
        "data.turning": [[i] for i, kind in enumerate(kinds, 1) if kind == 1],
        "data.sliding": [[i] for i, kind in enumerate(kinds, 1) if kind == 2],
    }


def written_out(text: str, known: Mapping[str, Table]) -> str:
    """The class without arrays of components, loops and conditions."""
    sizes = {"nLinks": len(known["data.linkBodies"]), "nJoints": len(known["data.connectionMatrix"])}
    sizes |= {f"{kind}Joints": len(known[kind]) for kind in ("data.turning", "data.sliding")}
    text = re.sub(r"\n +annotation \((?:Line|Placement)\(.*\)\);", ";", text)
    text = re.sub(r"^  final parameter Integer .*?;\n", "", text, flags=re.MULTILINE | re.DOTALL)
    text = text.replace("link[tool]", "link[1]")  # nothing is attached to it
    component = re.compile(r'^  (Modelica\.\S+) (\w+)\[([\w.]+)\]\(([^"]*)\)\s+"[^"]*";', re.MULTILINE)
    names = [found[2] for found in component.finditer(text)]
    text = component.sub(
        lambda found: "\n".join(
            f"  {found[1]} {found[2]}_{k}({one(found[4], k)});" for k in range(1, sizes[found[3]] + 1)
        ),
        text,
    )
    text = re.sub(
        r"\{(UrdfSync[^{}]*) for k in 1:nLinks\}", lambda found: f"{{{each(found[1], sizes['nLinks'], ', ')}}}", text
    )
    text = re.sub(
        r"  for k in 1:([\w.]+) loop\n(.*?)\n  end for;",
        lambda found: each(found[2], sizes[found[1]], "\n"),
        text,
        flags=re.DOTALL,
    )
    text = looked_up(text.replace("[nLinks,", f"[{sizes['nLinks']},"), known)
    text = re.sub(
        r"    if (\d+) == (\d+) then\n(.*?)\n    end if;",
        lambda found: found[3] if found[1] == found[2] else "",
        text,
        flags=re.DOTALL,
    )
    return re.sub(rf"\b({'|'.join(names)})\[(\d+)\]", r"\1_\2", text)


def each(text: str, count: int, between: str) -> str:
    """A text once per k."""
    return between.join(re.sub(r"\bk\b", str(k), text) for k in range(1, count + 1))


def one(modifiers: str, k: int) -> str:
    """Modifiers of an array of components as those of its component k, rows of tables as they are needed."""
    text = modifiers.replace("each ", "").replace("[:, ", f"[{k}, ")
    text = re.sub(r"data\.linkMasses", rf"\g<0>[{k}]", text)
    text = re.sub(r"data\.(?:linkCenters|jointPositions)", lambda found: row(f"{found[0]}[{k}, %d]"), text)
    text = re.sub(r"(data\.jointAxes)\[([\w.]+), :\]", lambda found: row(f"{found[1]}[{found[2]}[{k}], %d]"), text)
    return re.sub(
        r"(\S+to_deg)\((\S+) \{3, 2, 1\}\]\)", lambda found: row(f"{found[1]}({found[2]} %d])", (3, 2, 1)), text
    )


def row(element: str, columns: tuple[int, ...] = (1, 2, 3)) -> str:
    return f"{{{', '.join(element % column for column in columns)}}}"


def looked_up(text: str, known: Mapping[str, Table]) -> str:
    """Elements of the tables as numbers, from the inside out."""
    element = re.compile(rf"({'|'.join(map(re.escape, known))})\[(\d+)(?:, (\d+))?\]")
    while element.search(text):
        text = element.sub(lambda found: str(known[found[1]][int(found[2]) - 1][int(found[3] or 1) - 1]), text)
    return text


def source(own: generic.Robot, task: Task) -> str:
    """The text of the task, with the classes in it."""
    known = tables(own)
    base, form = (
        (URDFSYNC / "Robots" / f"{name}.mo").read_text("utf-8").replace("within UrdfSync.Robots;", "")
        for name in ("PartialRecordRobot", "MultiBodyGenericRobot")
    )
    base, count = DERIVATIVES.subn("", base)
    assert count == 4
    found = integer_tables(own.skeleton)
    axes = [
        (f"revolute_{known['data.turning'].index([i]) + 1}", k, "w_phi", "w", "a_phi")
        for k, i in enumerate(found.axes["rotational"], 1)
    ]
    axes += [
        (f"prismatic_{known['data.sliding'].index([i]) + 1}", k, "v_s", "v", "a_s")
        for k, i in enumerate(found.axes["translational"], 1)
    ]
    moved = "".join(f"  {name}.{v} = {speed}[{k}];\n  {name}.a = {a}[{k}];\n" for name, k, speed, v, a in axes)
    head, equations = written_out(form, known).split("equation\n", 1)
    classes = f"{base}{head}equation\n{moved}{equations}".replace(
        "extends UrdfSync.Robots.PartialR", "extends PartialR"
    )
    text = task.source.replace("UrdfSync.Robots.MultiBodyGenericRobot", "MultiBodyGenericRobot")
    return text.replace("  model Bench\n", f"{classes}\n  model Bench\n", 1)


def test_free_motion_agrees_with_pinocchio(modelica_library: Path, tmp_path: Path) -> None:
    own = generic.prepare(CRANE.encode(), "Crane")
    start = [START] * len(own.reference.axes)
    task = generic.free_task(own, "MultiBodyGenericRobot", start, STOP, 1e-9)
    values = [*task.values, *(f"robot.r_0[{len(own.skeleton.links)},{i}]" for i in (1, 2, 3))]
    whole = Task(source(own, task), task.model, task.runs, values)
    (series,) = simulate(modelica_library, [own.package.write(tmp_path)], [whole])
    expected = generic.free_motion(own, start, STOP, 250)
    place = generic.link_place(own, expected, own.skeleton.links[-1].name)
    assert np.abs(expected - START.position).min() > 1e-3, "every axis moves"
    assert np.abs(series.end(*values) - np.array([*expected, *place])).max() < 1e-6
