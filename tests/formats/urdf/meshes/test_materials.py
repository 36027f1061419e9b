"""Colours of OBJ and COLLADA files: a file for each, and the mean colours of textures."""

from __future__ import annotations

import io
from collections.abc import Mapping
from pathlib import Path

import pytest
from PIL import Image
from support import meshes
from support.commands import Execute

from urdfsync.common.dependencies.facts import PATH
from urdfsync.domain import Conversion, Dependency
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.formats.urdf.meshes.convert import convert
from urdfsync.formats.urdf.meshes.lookup import BOUNDS, COLORLESS, COLORS, PARTS, TEXTURED, key, mentioned_files, target
from urdfsync.formats.urdf.robot import Mesh
from urdfsync.project import config

OBJ = b"""\
mtllib paint.mtl
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
vt 0 0
usemtl red paint
f 1/1 2/1 3/1
usemtl wood
f 1 2 4
f 1 3 4
usemtl red paint
f 2 3 4
"""
PAINT = b"newmtl red paint\nKd 1 0 0\nnewmtl wood\nKd 0.2 0.2 0.2\nmap_Kd -s 1 1 1 textures/wood.png\n"
TWICE_RED = PAINT.replace(b"map_Kd", b"# map_Kd").replace(b"0.2 0.2 0.2", b"1 0 0")


def picture() -> bytes:
    """A picture, left half black and right half green."""
    image, file = Image.new("RGB", (64, 64)), io.BytesIO()
    image.paste((0, 200, 0), (32, 0, 64, 64))
    image.save(file, "png")
    return file.getvalue()


def dae(*, texture: bool = False, bound: str = "steel") -> bytes:
    """A square of two triangles of different materials; the second has no colour, or a texture."""
    image = '<library_images><image id="i"><init_from>./wood%20grain.png</init_from></image></library_images>'
    parameters = """<newparam sid="f"><surface type="2D"><init_from>i</init_from></surface></newparam>
      <newparam sid="s"><sampler2D><source>f</source></sampler2D></newparam>"""
    diffuse = '<diffuse><texture texture="s" texcoord="t"/></diffuse>' if texture else ""
    effects = "".join(
        f'<effect id="{name}-e"><profile_COMMON>{more}<technique sid="c"><phong>{color}</phong></technique>'
        "</profile_COMMON></effect>"
        for name, more, color in (
            ("steel", "", "<diffuse><color>0.5 0.25 1 1</color></diffuse>"),
            ("wood", parameters, diffuse),
        )
    )
    materials = "".join(
        f'<material id="{name}-m"><instance_effect url="#{name}-e"/></material>' for name in ("steel", "wood")
    )
    triangles = "".join(
        f'<triangles count="1" material="{name}"><input semantic="VERTEX" source="#v" offset="0"/>'
        f"<p>{corners}</p></triangles>"
        for name, corners in (("first", "0 1 2"), ("second", "0 2 3"))
    )
    binding = "".join(
        f'<instance_material symbol="{symbol}" target="#{name}-m"/>'
        for symbol, name in (("first", bound), ("second", "wood"))
    )
    geometry = f"""<geometry id="g"><mesh>
      <source id="p"><float_array id="a" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array><technique_common>
        <accessor source="#a" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
        <param name="Z" type="float"/></accessor></technique_common></source>
      <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>{triangles}</mesh></geometry>"""
    libraries = f"""{image if texture else ""}<library_effects>{effects}</library_effects>
      <library_materials>{materials}</library_materials>"""
    bound_parts = f"<bind_material><technique_common>{binding}</technique_common></bind_material>"
    scene = f'<node><instance_geometry url="#g">{bound_parts}</instance_geometry></node>'
    return meshes.dae(scene, geometry=geometry, libraries=libraries).encode()


def converted(
    name: str, content: bytes, others: Mapping[str, bytes] | None = None, fact: str = PARTS, scale: float = 1
) -> Conversion:
    mesh = Mesh(name, (scale, scale, scale))
    dependency = Dependency(key(mesh), name, (), target(mesh), "mesh", facts=(BOUNDS, fact, TEXTURED))
    return convert(dependency, Path(name), content, others or {})


def test_an_obj_file_becomes_a_file_for_each_colour() -> None:
    found = converted("a.obj", OBJ, {"paint.mtl": PAINT, "textures/wood.png": picture()})
    assert found.facts[PARTS] == [[255, 0, 0], [0, 100, 0]]
    assert found.facts[TEXTURED]
    assert found.facts[COLORLESS] == []
    (wood,) = found.more
    assert found.content.count(b"\nf ") == 2
    assert (wood.content.count(b"v "), wood.content.count(b"\nf ")) == (4, 2)
    assert wood.facts[BOUNDS] == [[0, 0, 0], [1, 1, 1]]


def test_a_texture_that_is_too_large_to_be_read_in_time_has_no_colour() -> None:
    file = io.BytesIO()
    Image.new("1", (6000, 6000)).save(file, "png")
    found = converted("a.obj", OBJ, {"paint.mtl": PAINT, "textures/wood.png": file.getvalue()})
    assert found.facts[PARTS] == [[255, 0, 0], [51, 51, 51]]
    assert found.facts[COLORLESS] == []


NO_PART, RED_AND_WOOD = ["a part has no colour"], b"newmtl red paint\nKd 1 0 0\nnewmtl wood\nKd 0 0 1\n"
MISSING = {
    "no library": (OBJ, {"paint.mtl": b""}, ["`paint.mtl` not found"]),
    "no material": (OBJ, {"paint.mtl": b"newmtl wood\nKd 1 1 1"}, NO_PART),
    "no texture": (OBJ, {"paint.mtl": PAINT, "textures/wood.png": b""}, ["`textures/wood.png` not found"]),
    "no use of a library": (OBJ.replace(b"mtllib", b"#"), {}, []),
    "two libraries on a line": (OBJ.replace(b"mtllib", b"mtllib red paint.mtl"),
        {"red paint.mtl": RED_AND_WOOD[:25], "paint.mtl": RED_AND_WOOD[25:]}, []),
    "COLLADA": (dae(texture=True), {"wood grain.png": b""}, ["`wood grain.png` not found"]),
    "COLLADA, bumps": (dae(texture=True), {"wood grain.png": picture(), "bumps.png": b""}, []),
    "COLLADA, damaged": (dae(texture=True), {"wood grain.png": b"?"}, NO_PART),
    "COLLADA, not bound": (dae(bound="stone", texture=True), {"wood grain.png": picture()}, NO_PART),
}  # fmt: skip


@pytest.mark.parametrize(("content", "others", "missing"), MISSING.values(), ids=MISSING)
def test_colours_that_are_missing_are_told(content: bytes, others: Mapping[str, bytes], missing: list[str]) -> None:
    assert converted("a.dae" if b"COLLADA" in content else "a.obj", content, others).facts[COLORLESS] == missing


def test_the_whole_stays_where_something_else_needs_it() -> None:
    found = converted("a.obj", OBJ, {"paint.mtl": PAINT, "textures/wood.png": b""}, COLORS)
    assert found.content == OBJ
    assert found.facts[COLORS] == [[255, 0, 0], [51, 51, 51]]
    assert [part.content.count(b"\nf ") for part in found.more] == [2, 2]


@pytest.mark.parametrize(
    ("paint", "colors"), [(TWICE_RED, [[255, 0, 0]]), (b"", [None]), (b"newmtl wood\nKd x", [None])]
)
def test_an_obj_file_of_one_colour_stays_as_it_is(paint: bytes, colors: list[list[int] | None]) -> None:
    found = converted("a.obj", OBJ, {"paint.mtl": paint})
    assert (found.content, found.facts[PARTS], found.more) == (OBJ, colors, ())


def test_a_scaled_obj_file_becomes_stl() -> None:
    found = converted("a.obj", OBJ, {"paint.mtl": PAINT}, scale=2)
    assert [len(one.content) for one in (found, *found.more)] == [84 + 2 * 50] * 2
    assert found.facts[BOUNDS] == [[0, 0, 0], [2, 2, 2]]


@pytest.mark.parametrize(("content", "others", "colors"), [
    (dae(), {}, [[128, 64, 255], None]),
    (dae(texture=True), {"wood grain.png": picture()}, [[128, 64, 255], [0, 100, 0]]),
    (dae(texture=True), {"wood grain.png": b"no picture"}, [[128, 64, 255], None]),
    (dae(bound="wood"), {}, [None]),
])  # fmt: skip
def test_a_collada_file_has_the_colours_that_its_scene_binds(
    content: bytes, others: Mapping[str, bytes], colors: list[list[int] | None]
) -> None:
    found = converted("a.dae", content, others)
    assert found.facts[PARTS] == colors
    assert len(found.more) == len(colors) - 1


def test_of_many_colours_those_of_the_smallest_parts_are_left_out() -> None:
    names = [f"m{number}" for number in range(40)]
    paint = "".join(f"newmtl {name}\nKd {number / 40} 0 0\n" for number, name in enumerate(names))
    faces = "".join(f"usemtl {name}\n" + "f 1 2 3\n" * (40 - number) for number, name in enumerate(names))
    found = converted("a.obj", b"mtllib p.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n" + faces.encode(), {"p.mtl": paint.encode()})
    assert len(found.facts[PARTS]) == 21
    assert found.facts[PARTS][-1] is None
    assert found.facts[COLORLESS] == NO_PART
    assert sum(one.content.count(b"\nf ") for one in (found, *found.more)) == sum(range(1, 41))


@pytest.mark.parametrize(("name", "content", "mentioned"), [
    ("a.obj", b"mtllib my paint.mtl\r\n", ["my paint.mtl"]),
    ("a.obj", b"mtllib a.mtl my b.MTL\tc.mtl\nmtllib d\n", ["a.mtl", "my b.MTL", "c.mtl", "d"]),
    ("lib/a.mtl", b"  map_Kd -bm 1.0 -clamp on wood grain.png\n", ["lib/wood grain.png"]),
    ("a.dae", b"<init_from>../textures/a%20b.png</init_from><init_from>b</init_from>", ["../textures/a b.png", "b"]),
    ("a.dae", dae(texture=True), ["wood grain.png"]),
    ("a.dae", b"<init_from>file:///etc/a.png</init_from><init_from>/etc/b.png</init_from>", []),
    ("a.obj", b"mtllib C:\\paint.mtl\nmtllib http://a.b/c.mtl\n", []),
    ("a.stl", b"mtllib a.mtl", []),
])  # fmt: skip
def test_names_of_other_files(name: str, content: bytes, mentioned: list[str]) -> None:
    assert mentioned_files(name, content) == mentioned


@pytest.fixture
def painted(folder: Path, execute: Execute) -> Path:
    """A robot that is built; its mesh has two colours, one of them of a texture."""
    (folder / "meshes/textures").mkdir(parents=True)
    for name, content in (("a.obj", OBJ), ("paint.mtl", PAINT), ("textures/wood.png", picture())):
        (folder / "meshes" / name).write_bytes(content)
    geometry = '<geometry><mesh filename="meshes/a.obj"/></geometry>'
    (folder / "arm.urdf").write_text(f'<robot name="arm"><link name="base"><visual>{geometry}</visual></link></robot>')
    execute("init", "arm.urdf")
    assert "note: 1 mesh has textures, which become their mean colours [texture]" in execute("build").err
    return folder


def record() -> str:
    return Path("modelica/Arm/Links/BaseParameters.mo").read_text()


def test_a_build_draws_a_shape_for_each_colour(painted: Path, execute: Execute) -> None:
    assert "color = {255, 0, 0}" in record()
    assert "color = {0, 100, 0}" in record()
    assert {"visual1_1", "visual1_2"} <= set(Path("modelica/Arm/Links/Base.mo").read_text().replace("(", " ").split())
    assert len(list(Path("modelica/Arm/Resources").iterdir())) == 2
    assert execute("build").lines == [f"arm: in step, {len([*Path('modelica').rglob('*.*')])} files"]


def test_a_change_of_another_file_is_a_change_of_the_mesh(painted: Path, execute: Execute) -> None:
    paint = painted / "meshes/paint.mtl"
    paint.write_bytes(PAINT.replace(b"Kd 1 0 0", b"Kd 0 0 1"))
    assert execute("build", "--check", code=1).lines[1].startswith("  mesh meshes/a.obj: content ")
    execute("build")
    assert "color = {0, 0, 255}" in record()
    (painted / "meshes/textures/wood.png").unlink()
    for _ in range(2):
        said = execute("build", "--verbose").words
        assert "arm.urdf:1: warning: mesh `meshes/a.obj` lacks colours: " in said
        assert "`textures/wood.png` not found; put the missing files beside the mesh" in said
    assert "color = {51, 51, 51}" in record()


def test_the_other_files_are_listed_as_read_too(painted: Path) -> None:
    loaded = config.load(painted / "urdfsync.toml")
    (result,) = build(loaded, loaded.robots, BuildOptions(dry=True))
    read = {path for check, path in result.reads if check == PATH}
    assert {str(painted / "meshes" / name) for name in ("a.obj", "paint.mtl", "textures/wood.png")} <= read


def test_copies_serve_where_the_mesh_is_missing(painted: Path, execute: Execute) -> None:
    before = record()
    (painted / "meshes/a.obj").unlink()
    assert "the imported copy is kept" in execute("build", "--full").err
    assert record() == before
    next(Path("modelica/Arm/Resources").glob("*_1.obj")).unlink()
    execute("build", code=None)
    assert "color = {0, 100, 0}" not in record()


def test_a_colour_of_the_urdf_hides_those_of_the_mesh(painted: Path, execute: Execute) -> None:
    urdf = painted / "arm.urdf"
    material = '<material name="m"><color rgba="0 1 1 1"/></material>'
    urdf.write_text(urdf.read_text().replace("</visual>", f"{material}</visual>"))
    assert execute("build").err == ""
    assert record().count("color = ") == 1
    assert "color = {0, 255, 255}" in record()
    assert len(list(Path("modelica/Arm/Resources").iterdir())) == 1
