"""Where meshes are looked for, and what they are called in the package."""

from __future__ import annotations

import re
from pathlib import Path, PureWindowsPath

import msgspec
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from urdfsync.domain import Lookup
from urdfsync.formats.urdf.meshes.lookup import as_is, candidates, dependencies, key, mesh, target
from urdfsync.formats.urdf.robot import Box, Collision, Link, Mesh, Robot, Visual

LOOKUP = Lookup(Path("/ws/src/arm/urdf/arm.urdf"), (Path("/opt/robots"), Path("/opt/gripper")))

scales = st.tuples(*[st.floats(allow_nan=False, allow_infinity=False)] * 3)


@pytest.mark.posix("its paths have no drives")
@pytest.mark.parametrize(("uri", "paths"), [
    ("package://arm/meshes/a.stl", ["/opt/robots/arm/meshes/a.stl", "/ws/src/arm/meshes/a.stl"]),
    ("package://gripper/a.stl", ["/opt/robots/gripper/a.stl", "/opt/gripper/a.stl", "/ws/src/gripper/a.stl"]),
    ("package://assets/a.stl", ["/opt/robots/assets/a.stl", "/ws/src/arm/urdf/assets/a.stl"]),
    ("package:///a.stl", ["/ws/src/arm/urdf/a.stl", "/ws/src/arm/a.stl", "/opt/robots/a.stl"]),
    ("package:///arm/meshes/a.stl", ["/ws/src/arm/urdf/arm/meshes/a.stl", "/opt/robots/arm/meshes/a.stl"]),
    ("package://arm//meshes/a.stl", ["/opt/robots/arm/meshes/a.stl", "/ws/src/arm/meshes/a.stl"]),
    ("Package://arm/a.stl", ["/opt/robots/arm/a.stl", "/ws/src/arm/a.stl"]),
    ("package:/arm/a.stl", ["/ws/src/arm/urdf/arm/a.stl", "/ws/src/arm/a.stl", "/opt/robots/arm/a.stl"]),
    ("package://arm\\meshes\\a.stl", ["/opt/robots/arm/meshes/a.stl", "/ws/src/arm/meshes/a.stl"]),
    ("package://arm/a%20b.stl", ["/opt/robots/arm/a%20b.stl", "/ws/src/arm/a%20b.stl", "/ws/src/arm/a b.stl"]),
    ("model://arm/meshes/a.stl", ["/opt/robots/arm/meshes/a.stl", "/ws/src/arm/meshes/a.stl"]),
    ("$(find arm)/meshes/a.stl", ["/opt/robots/arm/meshes/a.stl", "/ws/src/arm/meshes/a.stl"]),
    ("file://$(find-pkg-share arm)/meshes/a.stl", ["/opt/robots/arm/meshes/a.stl", "/ws/src/arm/meshes/a.stl"]),
    ("file:///data/a.stl", ["/data/a.stl"]),
    ("file:////data/a.stl", ["/data/a.stl"]),
    ("file:/data/a.stl", ["/data/a.stl"]),
    ("file://localhost/data/a.stl", ["/data/a.stl"]),
    ("file://meshes/a.stl", ["/ws/src/arm/urdf/meshes/a.stl", "/ws/src/arm/meshes/a.stl"]),
    ("/data/a.stl", ["/data/a.stl"]),
    ("meshes/a.stl", ["/ws/src/arm/urdf/meshes/a.stl", "/ws/src/arm/meshes/a.stl", "/opt/robots/meshes/a.stl"]),
    ("./meshes/a.stl", ["/ws/src/arm/urdf/meshes/a.stl", "/ws/src/arm/meshes/a.stl"]),
    ("../meshes/a.stl", ["/ws/src/arm/urdf/../meshes/a.stl"]),
    ("..\\meshes\\a.stl", ["/ws/src/arm/urdf/../meshes/a.stl"]),
    ("  a.stl ", ["/ws/src/arm/urdf/a.stl"]),
])  # fmt: skip
def test_uri_is_looked_for_in_this_order(uri: str, paths: list[str]) -> None:
    found = [str(path) for path in candidates(uri, LOOKUP)]
    assert found[0] == paths[0]
    assert [path for path in found if path in paths] == paths


@pytest.mark.parametrize(("uri", "is_found"), [
    (r"\\server\share\meshes\a.stl", True),
    ("//SERVER/Share/meshes/a.stl", True),
    ("file://server/share/meshes/a.stl", True),
    ("file:////server/share/meshes/a.stl", True),
    (r"\\stranger\share\meshes\a.stl", False),
    ("file://stranger/share/meshes/a.stl", False),
    (r"\\server\other\meshes\a.stl", False),
])  # fmt: skip
def test_a_mesh_on_a_share_is_looked_for_where_the_source_is(uri: str, is_found: bool) -> None:
    """Windows signs in to each server that is looked at: a stranger's would get what proves who the user is."""
    lookup = Lookup(PureWindowsPath(r"\\server\share\arm.urdf"), ())  # type: ignore[arg-type]
    places = [path.as_posix().lower() for path in candidates(uri, lookup) if str(path).startswith(("//", "\\\\"))]
    assert ("//server/share/meshes/a.stl" in places) is is_found
    assert not [place for place in places if "stranger" in place and "server" not in place]
    elsewhere = Lookup(Path("/robots/arm.urdf").absolute(), (PureWindowsPath(r"\\server\share\meshes"),))  # type: ignore[arg-type]
    assert (
        any("server/share/meshes/a.stl" in path.as_posix().lower() for path in candidates(uri, elsewhere)) is is_found
    )


@pytest.mark.windows
@pytest.mark.parametrize(
    "uri", ["file:///C:/data/a.stl", r"C:\data\a.stl", "file://C:/data/a.stl", "file:C:/data/a.stl"]
)
def test_a_mesh_on_a_drive_is_looked_for(uri: str) -> None:
    assert candidates(uri, Lookup(Path(r"D:\robots\arm.urdf"), ()))[0] == Path("C:/data/a.stl")


@pytest.mark.posix("its paths have no drives")
@pytest.mark.parametrize(("uri", "paths"), [
    ("modelica://Meshes/a.stl", ["/lib/Meshes 1.2/a.stl", "/ws/src/arm/urdf/Meshes/a.stl", "/ws/Meshes/a.stl"]),
    ("Modelica://Meshes//a.stl", ["/lib/Meshes 1.2/a.stl", "/ws/src/Meshes/a.stl"]),
    ("modelica:/Meshes/a.stl", ["/lib/Meshes 1.2/a.stl", "/ws/src/Meshes/a.stl"]),
    ("modelica://Meshes/Resources/a%20b.stl",
     ["/lib/Meshes 1.2/Resources/a%20b.stl", "/lib/Meshes 1.2/Resources/a b.stl"]),
    ("modelica://Meshes.Arms/a.stl", ["/lib/Meshes 1.2/Arms/a.stl", "/lib/Meshes 1.2/a.stl", "/ws/Meshes/Arms/a.stl"]),
    ("modelica://arm/meshes/a.stl", ["/ws/src/arm/urdf/arm/meshes/a.stl", "/ws/src/arm/meshes/a.stl"]),
])  # fmt: skip
def test_modelica_uri_is_looked_for_in_the_library_and_then_around_the_source(uri: str, paths: list[str]) -> None:
    known = msgspec.structs.replace(LOOKUP, libraries={"Meshes": Path("/lib/Meshes 1.2")})
    found = [str(path) for path in candidates(uri, known)]
    assert found[0] == paths[0]
    assert [path for path in found if path in paths] == paths


@pytest.mark.posix("its paths have no drives")
def test_the_source_may_be_in_a_library_with_a_version() -> None:
    inside = Lookup(Path("/lib/Plant 2.1/Resources/arm.urdf"))
    assert Path("/lib/Plant 2.1/Resources/a.stl") in candidates("modelica://Plant/Resources/a.stl", inside)


def test_an_encoded_step_upwards_is_not_taken() -> None:
    known = msgspec.structs.replace(LOOKUP, libraries={"Meshes": Path("/lib/Meshes")})
    assert all(".." not in path.parts for path in candidates("modelica://Meshes/%2e%2e/%2E%2E/a.stl", known))


NOWHERE = [
    *("", " ", "package://", "package://arm", "http://example.org/a.stl", "https://example.org/a.stl"),
    *("data:model/stl;base64,AAAA", "meshes/a\0.stl", "meshes/a\n.stl", "meshes/a\ud800.stl"),
    *(f"meshes/{'a' * 300}.stl", "a/" * 3000 + "a.stl"),
    *("modelica://", "modelica://Meshes", "modelica://Meshes/", "modelica:///a.stl"),
    *("modelica://Meshes/../other/a.stl", "modelica://Meshes/Resources/../../../a.stl"),
    *("modelica://Meshes/..\\a.stl", "modelica://../a.stl", "modelica://Meshes../a.stl"),
]


@pytest.mark.parametrize("uri", NOWHERE)
def test_uri_that_names_no_file_or_leads_out_of_a_library_has_no_candidates(uri: str) -> None:
    known = msgspec.structs.replace(LOOKUP, libraries={"Meshes": Path("/lib/Meshes")})
    assert candidates(uri, known) == ()


@pytest.mark.posix("its paths have no drives")
def test_folders_above_the_source_may_have_names_that_are_not_utf_8() -> None:
    assert candidates("a.stl", Lookup(Path("/ws/\udcff/arm.urdf")))[0] == Path("/ws/\udcff/a.stl")


@pytest.mark.posix("its paths have no drives")
def test_a_guess_leaves_out_the_name_of_the_package() -> None:
    uri, places = "package://hand/meshes/a.stl", LOOKUP.source.parents
    plain, guess = candidates(uri, LOOKUP), candidates(uri, msgspec.structs.replace(LOOKUP, guess=True))
    assert guess == (*plain, *(folder / "meshes/a.stl" for folder in places))


def test_a_package_that_is_somewhere_is_not_guessed() -> None:
    known = msgspec.structs.replace(LOOKUP, packages={"hand": Path("/opt/hand-1.2")})
    uri = "package://hand/meshes/a.stl"
    assert candidates(uri, msgspec.structs.replace(known, guess=True)) == candidates(uri, known)


@given(st.text(), scales)
@example("a\0b", (1.0, 1.0, 1.0))
@example("\ud800.stl", (1.0, 1.0, 1.0))
@example("../../evil.stl", (1.0, 1.0, 1.0))
@example("a.stl scale 2.0 2.0 2.0", (1.0, 1.0, 1.0))
def test_any_uri_has_a_safe_target_harmless_candidates_and_a_reversible_key(
    uri: str, scale: tuple[float, float, float]
) -> None:
    wanted = Mesh(uri, scale)
    assert re.fullmatch(r"Resources/[A-Za-z0-9_-]{1,40}_[0-9a-f]{8}\.(stl|obj)", target(wanted))
    assert mesh(key(wanted)) == wanted
    for path in candidates(uri, LOOKUP):
        assert path.is_absolute()
        path.is_file()  # raises for what no file system can have


@pytest.mark.parametrize(("uri", "scale", "name", "kept"), [
    ("package://arm/meshes/Upper Arm.STL", (1.0, 1.0, 1.0), r"Upper_Arm_\w{8}\.stl", True),
    ("meshes/base.obj", (1.0, 1.0, 1.0), r"base_\w{8}\.obj", True),
    ("meshes/base.obj", (0.001, 0.001, 0.001), r"base_\w{8}\.stl", False),
    ("meshes/base.stl", (1.0, 1.0, -1.0), r"base_\w{8}\.stl", False),
    ("meshes/base.DAE", (1.0, 1.0, 1.0), r"base_\w{8}\.stl", False),
    ("C:\\robots\\base.stl", (1.0, 1.0, 1.0), r"base_\w{8}\.stl", True),
    ("package://arm/%C3%A4%20b.stl", (1.0, 1.0, 1.0), r"b_\w{8}\.stl", True),
    ("ä.stl", (1.0, 1.0, 1.0), r"mesh_\w{8}\.stl", True),
    ("a" * 90 + ".stl", (1.0, 1.0, 1.0), r"a{40}_\w{8}\.stl", True),
    ('a".stl', (1.0, 1.0, 1.0), r"a_\w{8}\.stl", True),
    ("base", (1.0, 1.0, 1.0), r"base_\w{8}\.stl", False),
])  # fmt: skip
def test_target_tells_the_name_and_the_format(
    uri: str, scale: tuple[float, float, float], name: str, kept: bool
) -> None:
    assert re.fullmatch("Resources/" + name, target(Mesh(uri, scale)))
    assert as_is(Mesh(uri, scale)) is kept


def test_targets_differ_by_folder_by_case_and_by_scale() -> None:
    meshes = [
        Mesh("visual/base.stl"),
        Mesh("collision/base.stl"),
        Mesh("visual/Base.stl"),
        Mesh("visual/base.stl", (2.0, 2.0, 2.0)),
        Mesh("visual/base.stl", (2.0, 2.0, -2.0)),
    ]
    assert len({target(mesh).lower() for mesh in meshes}) == len(meshes)


def _robot(*meshes: tuple[Mesh, Mesh]) -> Robot:
    links = [
        Link(f"l{n}", visuals=(Visual(Box((1, 1, 1))), Visual(v)), collisions=(Collision(c),))
        for n, (v, c) in enumerate(meshes)
    ]
    return Robot("r", tuple(links))


def test_each_mesh_is_a_dependency_once_with_its_first_line() -> None:
    base, scaled, wheel = Mesh("base.dae"), Mesh("base.dae", (2.0, 2.0, 2.0)), Mesh("wheel.stl")
    lines = {
        "link l0": 3,
        "link l0 / visual 2 / geometry": 9,
        "link l0 / collision 1 / geometry": 14,
        "link l1 / visual 2 / geometry": 7,
        "link l1": 20,
    }
    links = _robot((base, wheel), (base, scaled)).links
    found = dependencies(links, ("visual", "collision"), LOOKUP, lines, touches=True)
    assert [(d.key, d.uri, d.line) for d in found] == [
        ("base.dae scale 1.0 1.0 1.0", "base.dae", 7),
        ("base.dae scale 2.0 2.0 2.0", "base.dae", 20),
        ("wheel.stl scale 1.0 1.0 1.0", "wheel.stl", 14),
    ]
    assert [d.target for d in found] == [target(base), target(scaled), target(wheel)]
    assert found[0].candidates == candidates("base.dae", LOOKUP)


def test_a_floating_robot_without_collisions_in_its_models_stands_on_the_points_of_shown_meshes_that_collide() -> None:
    shared, seen = Mesh("shared.stl"), Mesh("seen.stl")
    robot = _robot((shared, shared), (seen, Mesh("hidden.stl")))
    found = dependencies(robot.links, ("visual",), LOOKUP, {}, touches=True)
    assert {one.uri: "hull" in one.facts for one in found} == {"shared.stl": True, "seen.stl": False}
