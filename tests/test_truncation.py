"""Sources that were cut off, as exporters leave them while they write: one error, and nothing changes.

`tests/scenarios/build.txt` has other files that are no robot.
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import pytest
from support.replay import Project

from urdfsync.common.diagnostics import Severity
from urdfsync.engine.result import Exit, exit_code

FULL = """\
<?xml version="1.0" encoding="utf-8"?>
<!-- every kind of element -->
<robot name="röbot">
  <material name="red"><color rgba="1 0 0 1"/></material>
  <link name="base">
    <inertial><origin xyz="0 0 .1" rpy="0 0 1.57"/><mass value="2"/>
      <inertia ixx=".1" ixy="0" ixz="0" iyy=".1" iyz="0" izz=".1"/></inertial>
    <visual name="v"><geometry><box size="1 2 3"/></geometry><material name="red"/></visual>
    <collision><geometry><sphere radius="1"/></geometry></collision>
  </link>
  <link name="a &amp; b"/>
  <link name="tip"/>
  <joint name="one" type="revolute">
    <parent link="base"/><child link="a &amp; b"/><origin xyz="0 0 1"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="5" velocity="2"/><dynamics damping=".1" friction=".2"/>
    <calibration rising="0"/><safety_controller k_velocity="1"/>
  </joint>
  <joint name="two" type="prismatic">
    <parent link="a &amp; b"/><child link="tip"/><limit effort="1" velocity="1"/><mimic joint="one" multiplier="2"/>
  </joint>
  <gazebo><plugin name="p" filename="lib.so"><![CDATA[x < y]]></plugin></gazebo>
</robot>
"""


def built(root: Path, content: bytes) -> Project:
    """A project with a package of this robot, one file of it edited by hand."""
    project = Project(root)
    project.save(content)
    assert not project.build().failed
    model = project.package / "Bot.mo"
    model.write_text(model.read_text() + "// mine\n")
    assert not project.build().conflicts
    return project


def assert_refused(project: Project, cuts: Iterable[bytes]) -> None:
    """A build of each of these contents is one error with file and line, and changes nothing."""
    before = {**project.stamps(), "bot.urdf": (0, 0)}
    for content in cuts:
        project.save(content)
        result = project.build()
        errors = [found for found in result.diagnostics if found.severity is Severity.ERROR]
        assert len(errors) == 1, (len(content), [str(error) for error in errors])
        assert errors[0].line > 0, len(content)
        assert errors[0].file.endswith("bot.urdf"), len(content)
        assert exit_code([result]) is Exit.ERROR, len(content)
        assert {**project.stamps(), "bot.urdf": (0, 0)} == before, len(content)


def end_of(content: bytes) -> int:
    """The least part of a URDF that is valid."""
    return content.rindex(b"</robot>") + len(b"</robot>")


@pytest.mark.slow
def test_every_truncation_is_one_error_and_changes_nothing(tmp_path: Path) -> None:
    content = FULL.encode()
    project = built(tmp_path / "project", content)
    assert_refused(project, (content[:end] for end in range(end_of(content))))
    project.save(content)
    assert project.build().in_step
