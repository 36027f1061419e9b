"""All that the shipped templates write is in golden texts, so each changed statement of a template changes one.

`tests/urdf/second/test_comparison.py` has faults in numbers and attributes, `tests/checks/test_seen_faults.py` has
those in motion, and `tests/modelica/test_visualizers.py` those in the library's drawings.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from support import packages
from support.golden import TEMPLATES, VARIANTS, kept, rendered
from support.packages import record_text
from support.urdfs import link, parsed, robot

from urdfsync.engine.render import Renderer

_TAG = re.compile(r"<[%#].*?[%#]>", re.DOTALL)
_ALTERNATIVE = re.compile(r'(?:"[^"\\]*(?:\\.[^"\\]*)*"(?= if | ~ ))|(?:(?<= else )|(?<= ~ ))"[^"\\]*(?:\\.[^"\\]*)*"')
"""A string of an expression that not every text has, or a part of a longer string."""
ELSEWHERE = ("  extends UrdfSync.Records.Link;",)
"""Of links without a name: `tests/test_library_templates.py` compares the library's own."""


def marked(text: str, marks: list[str]) -> str:
    """Return a template whose lines, and the alternatives in a line, end with marks; `marks` gets what they mark."""

    def mark(match: re.Match[str]) -> str:
        marks.append(f"{match[0]} in {line.strip()}")
        return f'{match[0][:-1]}§{len(marks) - 1}§"'

    lines, tags, begin = list[str](), [tag.span() for tag in _TAG.finditer(text)], 0
    for line in text.split("\n"):
        end = begin + len(line)
        new = line
        if not any(first < begin < last or first < end < last for first, last in tags):  # of several lines
            new = _ALTERNATIVE.sub(mark, line)
            if _TAG.sub("", line).strip():
                marks.append(line)
                new += f"§{len(marks) - 1}§"
        lines.append(new)
        begin = end + 1
    return "\n".join(lines)


def test_each_line_of_each_template_is_in_a_golden_text(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """So are both alternatives of `"a" if … else "b"`. What is missing needs a golden variant, or a larger source."""
    marks = list[str]()
    for path in sorted(TEMPLATES.rglob("*.jinja")):
        own = tmp_path / path.relative_to(TEMPLATES)
        own.parent.mkdir(parents=True, exist_ok=True)
        own.write_text(marked(path.read_text("utf-8"), marks), "utf-8")
    renderer = Renderer([tmp_path])
    texts = [text for name in VARIANTS for text in rendered(name, renderer).values()]
    monkeypatch.setattr(packages, "RENDERER", renderer)  # not earlier: golden packages are remembered
    texts.append(record_text(parsed(robot(link("base")))))  # tests/commands/test_record.py has its text
    found = {int(number) for text in texts for number in re.findall("§([0-9]+)§", text)}
    assert [line for number, line in enumerate(marks) if number not in found and line not in ELSEWHERE] == []
    assert len(found) > 1000


RUN, TEST, ROBOT, GENERIC = (f"robot/{name}" for name in ("run", "test", "robot", "generic"))
FAULTS = {
    "an input of Run at another joint": (
        "fixed", RUN, "connect(<< drive.input >>, << drive.joint", "connect(<< drive.input >>, << drives[0].joint"),
    "inputs of a vector in another order": ("motors", RUN, "[<< loop.index >>]", "[<< loop.revindex >>]"),
    "a source of another quantity": ("laws", RUN, '"velocity": "v_ref"', '"velocity": "s_ref"'),
    "a source at another axis": ("fixed", TEST, "robot.<< drive.axis", "robot.<< drives[0].axis"),
    "a source that pushes against another housing": (
        "fixed", RUN, "robot.<< drive.support >>)", "robot.<< drives[0].support >>)"),
    "an output with the other sign": (
        "fixed", RUN, "= robot.<< drive.axis >>.<< effort", "= -robot.<< drive.axis >>.<< effort"),
    "a sensor's output of another sensor": (
        "fixed", RUN, "robot.<< sensor.component >>.", "robot.<< sensors[0].component >>."),
    "no output of a sensor": (
        "fixed", RUN, "<< sensor.component >>_<< sensor.output >>[3]", "<< sensor.component >>_v[3]"),
    "an input in degrees": ("fixed", RUN, '"position": "rad"', '"position": "deg"'),
    "a slow filter": ("fixed", RUN, "exact = false", "exact = false, f_crit = 0.5"),
    "a drive that begins at zero": ("laws", RUN, "s(start = robot.<< drive.joint >>.s_start)", "s(start = 0)"),
    "a second force at an axis": (
        "fixed", RUN, "\nequation\n", "\nequation\n  connect(brake.flange, robot.<< drives[0].axis >>);\n"),
    "the ground for another weight": ("floating", RUN, "load = robot.m", "load = 10*robot.m"),
    "effort above a limit": ("motors", RUN, "parameters.limits.effort,", "parameters.limits.velocity,"),
    "a Test that begins elsewhere": ("fixed", TEST, ">>.s_start", ">>.s_min"),
    "a Test within other limits": ("fixed", TEST, "s_max = robot", "s_max = 3*robot"),
    "a Test that opens a loop": ("loops", TEST, "reach = robot", "reach = 2*robot"),
    "a Test that stops early": ("fixed", TEST, "StopTime=10", "StopTime=1"),
    "a source of another kind": ("fixed", TEST, "Drives.RotationalSweep", "Drives.OtherSweep"),
    "a bench without ground": ("floating", TEST, "PartialMobileBench(", "PartialBench("),
    "another stance": ("floating", TEST, "redeclare << type >>Stance", "redeclare UrdfSync.Records.Stance"),
    "another gravity": ("floating", TEST, "PartialMobileBench(", "PartialMobileBench(world(g = 1), "),
    "another start of the generic robot": ("motors", GENERIC, '"startPositions."', '"0.5*startPositions."'),
    "another way of the generic robot": ("record", GENERIC, "reach = 1)", "reach = 10)"),
    "the frame of another link": ("fixed", ROBOT, "connect(<< line.start", "connect(<< lines[0].start"),
    "a range that a follower does not narrow": ("fixed", ROBOT, "phi_max = min({<< joint", "phi_max = max({<< joint"),
    "a start of no joint": ("motors", ROBOT, "s_start = startPositions.<< joint.component >>", "s_start = 0"),
    "limits that nothing checks": ("fixed", ROBOT, "checkLimits = checkLimits", "checkLimits = false"),
    "a sensor with the numbers of another": (
        "fixed", ROBOT, "sensorParameters.<< sensor.component", "sensorParameters.<< sensors[0].component"),
    "a mass that is left out": (
        "fixed", ROBOT, "<% for link in links %>\n    <<", "<% for link in links[1:] %>\n    <<"),
    "a coupling that does not know its limits": ("fixed", ROBOT, "    w_max = << coupling.follower >>.w_max,\n", ""),
    "two joints at one flange": (
        "fixed", ROBOT, "\nequation\n", "\nequation\n  connect(<< drives[0].axis >>, << drives[1].axis >>);\n"),
    "a gear with the numbers of another": (
        "motors", ROBOT, "(parameters = << drive.joint", "(parameters = << drives[0].joint"),
    "a visual with the numbers of another": (
        "fixed", "link/model", "parameters = parameters.<< shape", "parameters = parameters.<< visuals[0]"),
    "a collision that is always drawn": ("fixed", "link/model", '"showCollisions" if', '"animation" if'),
    "a visual that is never drawn": ("fixed", "link/model", 'else "animation" >>)', 'else "animation" >>) if false'),
    "a contact without friction": ("motors", "link/model", "friction = parameters.contact.mu", "friction = 0"),
    "a contact without damping": ("motors", "link/model", "    viscosity = parameters.contact.kd,\n", ""),
    "a contact of another shape": ("floating", "link/model", "Contacts.Box", "Contacts.Sphere"),
    "another law of friction": ("laws", "macros", '"lugre": "LuGre"', '"lugre": ""'),
    "a drive with other limits": ("laws", "macros", "limits = parameters.limits", "limits(effort = 1, velocity = 1)"),
    "another spring": ("laws", "macros", "c = parameters.transmission.stiffness", "c = 1"),
    "a joint that slides the other way": (
        "fixed", "joint/planar", "cross(parameters.axis, n_x)", "cross(n_x, parameters.axis)"),
    "losses that the record does not have": (
        "fixed", "joint/planar", "friction_y(parameters = parameters.translation)", "friction_y"),
    "a floating joint that begins elsewhere": (
        "fixed", "joint/floating", "connect(frame_a, origin.frame_a)", "connect(frame_a, freeMotion.frame_a)"),
    "a ball without damping": ("loops", "joint/ball", "(damping = parameters.damping)", ""),
    "a loop that closes late": (
        "loops", "joint/loop", "parameters.childRotations)", "parameters.childRotations, decay = 1)"),
}  # fmt: skip
"""The variant that shows the fault, and what a template says otherwise. No number of a record differs."""


def template(name: str) -> Path:
    (file,) = TEMPLATES.glob(f"{name}.*")
    return file


PLANTED = [name for name, (_, file, old, _) in FAULTS.items() if old in template(file).read_text("utf-8")]
"""A statement may change: then its fault can't be planted, and its row may go, or follow."""


def test_most_faults_can_be_planted() -> None:
    assert len(PLANTED) > 0.8 * len(FAULTS)


@pytest.mark.parametrize("fault", PLANTED)
def test_a_fault_in_a_template_changes_a_golden_text(fault: str, tmp_path: Path) -> None:
    variant, file, old, new = FAULTS[fault]
    own = tmp_path / template(file).relative_to(TEMPLATES)
    own.parent.mkdir(exist_ok=True)
    own.write_text(template(file).read_text("utf-8").replace(old, new), "utf-8")
    assert rendered(variant, Renderer([tmp_path, TEMPLATES])).items() - kept(variant).items()
