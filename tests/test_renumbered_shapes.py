"""CAD lists the meshes of a link in another order: each keeps its number; `scenarios/shapes.txt` has other shapes."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.commands import Execute
from support.meshes import stl
from support.urdfs import joint, link, robot


@pytest.mark.parametrize("is_numbered", [False, True])
def test_a_mesh_is_known_by_its_contents_else_by_its_name(folder: Path, execute: Execute, is_numbered: bool) -> None:
    """An exporter may number the files of meshes, too; or it writes other bytes under the same names."""

    def export_meshes(scale: float, **sizes: float) -> None:
        texts = []
        for number, (name, size) in enumerate(sizes.items(), 1):
            file = f"part_{number}.stl" if is_numbered else f"{name}.stl"
            Path(file).write_text(stl(size * (1 if is_numbered else scale)))
            texts.append(f'<visual><geometry><mesh filename="{file}"/></geometry></visual>')
        upper = link("upper", 4.0).replace("</link>", "".join([*texts, "</link>"]))
        Path("arm.urdf").write_text(robot(link("base", 9.0), upper, joint("shoulder", "revolute", "base", "upper")))

    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\non_conflict = "merge"\n')
    record = Path("modelica/Arm/Links/UpperParameters.mo")
    export_meshes(1, housing=0.4, motor=0.3)
    execute("build")
    first, second = record.read_text().split(" visual2(")
    record.write_text(f"{first} visual2({second.replace('{180, 180, 180}', '{255, 7, 7}')}")
    export_meshes(1.1, plate=0.9, housing=0.4, motor=0.3)
    execute("build")
    second, third = record.read_text().partition(" visual2(")[2].split(" visual3(")
    assert "{255, 7, 7}" in second
    assert ("part_3" if is_numbered else "motor") in second
    assert ("part_1" if is_numbered else "plate") in third
