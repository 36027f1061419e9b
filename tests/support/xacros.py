"""A project whose source is xacro: a file with a macro in another file, and numbers in a YAML."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfsync.common.diagnostics import SourceError
from urdfsync.engine.sources.expansion import SourceFiles, expand

HEAD = '<robot name="{0}" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
ARM = (
    HEAD.format("arm")
    + """\
  <xacro:arg name="length" default="0.5"/>
  <xacro:include filename="parts/beam.xacro"/>
  <xacro:property name="masses" value="${xacro.load_yaml('masses.yaml')}"/>
  <link name="base"/>
  <xacro:beam name="upper" parent="base" mass="${masses['upper']}" length="$(arg length)"/>
</robot>
"""
)
BEAM = (
    HEAD.format("beam")
    + """\
  <xacro:macro name="beam" params="name parent mass length">
    <link name="${name}">
      <inertial>
        <mass value="${mass}"/>
        <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/>
      </inertial>
      <visual>
        <geometry><box size="0.1 0.1 ${length}"/></geometry>
      </visual>
    </link>
    <joint name="to_${name}" type="revolute">
      <parent link="${parent}"/>
      <child link="${name}"/>
      <limit lower="-1" upper="1" effort="10" velocity="1"/>
    </joint>
  </xacro:macro>
</robot>
"""
)
MASSES = "upper: 1.5\n"
CONFIG = '[robots.arm]\nsource = "urdf/arm.urdf.xacro"\narguments = { length = 0.5 }\npackage = "Arm"\n'
RECORD = "modelica/Arm/Links/UpperParameters.mo"
EXPANDED = Path(".urdfsync/robots/arm.expanded")


def write(folder: Path, files: dict[str, str] | None = None, config: str = CONFIG) -> None:
    """Write the project; `files` replace files of the project."""
    contents = {"arm.urdf.xacro": ARM, "parts/beam.xacro": BEAM, "masses.yaml": MASSES, **(files or {})}
    for name, text in contents.items():
        place = folder / "urdf" / name
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text)
    (folder / "urdfsync.toml").write_text(config)


def write_line(folder: Path, line: str, **files: str) -> SourceFiles:
    """Write a source with this second line, and other files beside the source."""
    for name, text in files.items():
        (folder / f"{name}.yaml").write_text(text)
    file = folder / "arm.urdf.xacro"
    file.write_text(f'{HEAD.format("arm")}{line}\n<link name="a"/>\n</robot>\n')
    return SourceFiles(folder, file, ())


def problem(inputs: SourceFiles) -> str:
    """The only error of an expansion."""
    with pytest.raises(SourceError) as error:
        expand(inputs, {})
    (found,) = error.value.diagnostics
    return str(found)


def value(expression: str) -> str:
    return f'<link name="b" mass="${{{expression}}}"/>'
