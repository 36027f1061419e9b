"""A robot of the user's that extends the generated one goes through histories: built, and told what has another name.

The user's package stands beside the generated one: a joint with a rotor takes the place of one joint, and a payload
hangs on an inner link. `test_customized` and `test_custom_arm` simulate such parts.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import pytest
from support import replay
from support.packages import read
from support.replay import Project

from urdfsync.common.diagnostics import Severity
from urdfsync.domain import Target
from urdfsync.domain.matching import match
from urdfsync.engine.result import Result
from urdfsync.formats.urdf.domain import DOMAIN

ROTOR = 0.03
"""Inertia about the joint's axis, in kg.m2."""
MASS, CENTRE, INERTIA = 0.7, (0.02, -0.05, 0.08), (0.002, 0.003, 0.004)
"""The payload: about its centre of mass, in axes of its link."""

PACKAGE = """\
package Mine "What a user keeps beside the generated package"
  model RotorJoint "The joint with the inertia of its drive"
    extends UrdfSync.Interfaces.PartialRevoluteJoint(redeclare Bot.Joints.{class_}Parameters parameters);
    Bot.Joints.{class_} rigid(
      parameters = parameters, checkLimits = false, fixedStart = fixedStart, phi_start = phi_start, w_start = w_start);
    Modelica.Mechanics.Rotational.Components.Inertia rotor(J = {rotor});
  equation
    connect(frame_a, rigid.frame_a);
    connect(rigid.frame_b, frame_b);
    connect(rigid.support, support);
    connect(axis, rotor.flange_a);
    connect(rotor.flange_b, rigid.axis);
  end RotorJoint;

  model MyRobot
    extends Bot.Bot(redeclare RotorJoint {joint});
    Modelica.Mechanics.MultiBody.Parts.Body payload(
      m = {mass}, r_CM = {{{centre}}}, I_11 = {inertia[0]}, I_22 = {inertia[1]}, I_33 = {inertia[2]},
      animation = false);
  equation
    connect({link}.frame_a, payload.frame_a);
  end MyRobot;

  model MyTest
    extends Bot.BotTest(redeclare MyRobot robot);
  end MyTest;
end Mine;
"""


class History(NamedTuple):
    """Versions whose structures differ, and the elements that are customised; `links` in each version."""

    name: str
    versions: Sequence[int]
    joint: str
    links: Sequence[str]


HISTORIES = {
    "renamed-links": History("so101_new_calib", (3, 4), "elbow_flex", ("lower_arm", "lower_arm_link")),
    "other-sensors": History("spirit_meshes", (0, 2, 3), "10", ("upper2",) * 3),
    "stiff-arms": History(
        "stompymicro_robot_fixed",
        (0, 1, 2),
        "left_knee_pitch",
        ("DRIVING_ROTOR_PLATE_9",) * 2 + ("knee_pitch_right_2",),
    ),
}


def warnings(result: Result) -> list[str]:
    """What a build warns of in the user's files; how to follow a new name there is a note beside that."""
    found = (one for one in result.diagnostics if "Mine" in one.file)
    return [str(one) for one in found if one.severity is Severity.WARNING]


@pytest.mark.slow
@pytest.mark.parametrize("history", HISTORIES.values(), ids=HISTORIES)
def test_an_extension_survives(corpus: Path, tmp_path: Path, history: History) -> None:
    contents = next(all_of for name, all_of in replay.histories().items() if name.endswith(history.name))
    project = Project(tmp_path / "project")
    file = project.package.parent / "Mine" / "package.mo"
    link = history.links[0]
    for number, content in enumerate(contents):
        if number < history.versions[0] or read(content).snapshot is None:
            continue
        project.save(content)
        if not file.exists():
            assert not project.build().failed
            file.parent.mkdir()
            file.write_text(text_of(content, history.joint, link))
        before = file.read_text()
        result = project.build()
        assert not result.failed
        assert file.read_text() == before
        if number not in history.versions:
            assert warnings(result) == []
            continue
        now = history.links[history.versions.index(number)]
        found = warnings(result)
        if now == link:
            assert found == []
        else:
            (found_one,) = found
            assert "`payload" not in found_one
            old, new = read(contents[number - 1]).snapshot, read(content).snapshot
            assert old is not None
            assert new is not None
            is_renamed = ("link", link) in match(DOMAIN.features(old), DOMAIN.features(new)).renames
            assert (f"use `{component(content, 'links', now)}` instead" in found_one) == is_renamed
            assert ("change or remove this use" in found_one) != is_renamed
            link = now
            file.write_text(text_of(content, history.joint, link))
            assert warnings(project.build()) == []


def component(content: bytes, kind: str, name: str) -> str:
    """How a link or joint is called in the robot model."""
    snapshot = read(content).snapshot
    assert snapshot is not None
    return DOMAIN.names(snapshot, Target("Bot", "Bot"))[kind][name]


def text_of(content: bytes, joint: str, link: str) -> str:
    """The user's package."""
    names = {"joint": component(content, "joints", joint), "link": component(content, "links", link)}
    class_ = names["joint"][0].upper() + names["joint"][1:]
    centre = ", ".join(map(str, CENTRE))
    return PACKAGE.format(class_=class_, rotor=ROTOR, mass=MASS, centre=centre, inertia=INERTIA, **names)
