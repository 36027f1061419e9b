"""Masses, shapes, contacts and sensors."""

from __future__ import annotations

import pytest
from support.sdfs import arm, link, noted, problem, read, reading

from urdfsync.formats.urdf.robot import (
    Box,
    Camera,
    Capsule,
    Contact,
    Cylinder,
    Ellipsoid,
    Geometry,
    Inertia,
    Inertial,
    Material,
    Mesh,
    Origin,
    Sphere,
)


def shape(inside: str, tag: str = "visual") -> str:
    return f'<{tag} name="s"><geometry>{inside}</geometry></{tag}>'


@pytest.mark.parametrize(
    ("inside", "expected"),
    [
        ("", Inertial(1, inertia=Inertia(1, 0, 0, 1, 0, 1))),
        ("<inertial/>", Inertial(1, inertia=Inertia(1, 0, 0, 1, 0, 1))),
        (
            "<inertial><inertia><ixx>2</ixx><ixy>0.1</ixy></inertia></inertial>",
            Inertial(1, inertia=Inertia(2, 0.1, 0, 1, 0, 1)),
        ),
        (
            "<inertial><mass>3</mass><pose>1 2 3 0.1 0.2 0.3</pose></inertial>",
            Inertial(3, Origin((1, 2, 3), (0.1, 0.2, 0.3)), Inertia(1, 0, 0, 1, 0, 1)),
        ),
    ],
)
def test_a_mass_has_the_defaults_of_sdf(inside: str, expected: Inertial) -> None:
    assert link(read(arm(inside))).inertial == expected


def test_the_inertia_of_shapes_is_computed() -> None:
    box = shape("<box><size>1 2 3</size></box>", "collision").replace(
        "<geometry>", "<pose>0 0 1 0 0 0</pose><geometry>"
    )
    inertial = link(read(arm(f'<inertial auto="true"/>{box}', version="1.11"))).inertial
    assert inertial == Inertial(6000, Origin((0, 0, 1)), Inertia(6500, 0, 0, 5000, 0, 2500))


@pytest.mark.parametrize(
    ("inside", "told"),
    [
        ("", "arm.sdf:2: link 'part' has no collision with a volume"),
        (
            shape("\n<mesh/>", "collision"),
            "arm.sdf:3: the inertia of a <mesh> is not computed; write",
        ),
        (shape("<box><size>1 2</size></box>", "collision"), "arm.sdf:2: <size> '1 2' has 2 numbers instead of 3"),
    ],
)
def test_an_inertia_that_is_not_computed_has_a_line(inside: str, told: str) -> None:
    assert problem(arm(f'<inertial auto="1"/>{inside}')).startswith(told)


@pytest.mark.parametrize(
    ("inside", "expected"),
    [
        ("<box><size>1 2 3</size></box>", Box((1, 2, 3))),
        ("<sphere><radius>2</radius></sphere>", Sphere(2)),
        ("<ellipsoid><radii>1 2 3</radii></ellipsoid>", Ellipsoid((1, 2, 3))),
        ("<ellipsoid/>", Ellipsoid((1, 1, 1))),
        ("<cylinder><radius>2</radius><length>3</length></cylinder>", Cylinder(2, 3)),
        ("<capsule><radius>2</radius><length>3</length></capsule>", Capsule(2, 3)),
        ("<mesh><uri>model://a/b.stl</uri><scale>1 2 3</scale></mesh>", Mesh("model://a/b.stl", (1, 2, 3))),
        ("<mesh><uri>meshes/b.stl</uri></mesh>", Mesh("meshes/b.stl")),
    ],
)
@pytest.mark.parametrize("tag", ["visual", "collision"])
def test_a_shape(inside: str, expected: Geometry, tag: str) -> None:
    text = shape(inside, tag).replace("<geometry>", '<pose relative_to="base">1 0 0 0 0 0</pose><geometry>')
    part = link(read(arm("<pose>0 0 1 0 0 0</pose>" + text)))
    (found,) = part.visuals if tag == "visual" else part.collisions
    assert (found.geometry, found.name, found.origin) == (expected, "s", Origin((1, 0, -1)))


@pytest.mark.parametrize("kind", ["cone", "plane", "heightmap", "image", "polyline", "submesh", "empty"])
def test_a_shape_that_urdf_lacks_is_told(kind: str) -> None:
    inside = "<mesh><submesh><name>a</name></submesh></mesh>" if kind == "submesh" else f"<{kind}/>"
    found = [each for each in reading(arm(shape(inside))).diagnostics if each.code == "unknown-geometry"]
    assert [each.message for each in found] == [
        "a visual of link part has no geometry that URDF knows, and is left out"
    ]


@pytest.mark.parametrize(
    ("inside", "expected"),
    [
        ("<material><diffuse>0.1 0.2 0.3 0.4</diffuse><ambient>1 1 1 1</ambient></material>", (0.1, 0.2, 0.3, 0.4)),
        ("<material><diffuse>0.1 0.2 0.3</diffuse></material>", (0.1, 0.2, 0.3, 1)),
        ("<material><ambient>1 1 0 1</ambient></material><transparency>0.75</transparency>", (1, 1, 0, 0.25)),
    ],
)
def test_a_colour(inside: str, expected: tuple[float, float, float, float]) -> None:
    (found,) = link(read(arm(shape("<box/>").replace("</visual>", f"{inside}</visual>")))).visuals
    assert found.material == Material("", expected)


def test_a_contact_means_what_it_means_in_a_urdf() -> None:
    surface = (
        "<surface><friction><ode><mu>0.7</mu><mu2>0.6</mu2></ode></friction>"
        "<contact><ode><kp>1e5</kp><kd>3</kd><min_depth>0.001</min_depth></ode></contact></surface>"
    )
    text = arm(shape("<box/>", "collision").replace("</collision>", f"{surface}</collision>"))
    assert link(read(text)).contact == Contact(0.7, 1e5, 3, 0.001)
    assert noted(text) == "not modelled: 1 <mu2>"


@pytest.mark.parametrize(
    ("inside", "told"),
    [
        ("<contact><collide_bitmask>0</collide_bitmask></contact>", "1 <collide_bitmask>"),
        ("<friction><ode><mu2>0</mu2><slip1>0</slip1></ode></friction>", "1 <mu2>"),
        ("<bounce><threshold>1</threshold></bounce>", "1 <bounce>"),
    ],
)
def test_a_property_of_a_contact_that_no_model_has_is_counted(inside: str, told: str) -> None:
    text = shape("<box/>", "collision").replace("</collision>", f"<surface>{inside}</surface></collision>")
    assert noted(arm(text)) == f"not modelled: {told}"


def sensor(kind: str, inside: str = "") -> str:
    return f'<sensor name="s" type="{kind}"><pose>0 0 3 0 0 0</pose><update_rate>50</update_rate>{inside}</sensor>'


def test_a_sensor_of_a_link() -> None:
    robot = read(arm("<pose>0 0 5 0 0 0</pose>" + sensor("imu"), "<pose>0 0 1 0 0 0</pose><axis/>"))
    (found,) = robot.sensors
    assert (found.kind, found.at, found.origin, found.update_rate) == ("imu", "part", Origin((0, 0, 2)), 50)


def test_a_sensor_has_its_numbers() -> None:
    scan = "<scan><horizontal><samples>9</samples></horizontal></scan><range><max>7</max></range>"
    (found,) = read(arm(sensor("gpu_lidar", f"<lidar>{scan}</lidar>"))).sensors
    assert found.lidar is not None
    assert (found.kind, found.lidar.samples, found.lidar.max_range) == ("lidar", 9, 7)


def test_a_sensor_has_the_numbers_of_gazebo_if_it_states_none() -> None:
    (camera,) = read(arm(sensor("camera", "<camera><image><width>10</width></image></camera>"))).sensors
    assert camera.camera == Camera(10, 240, 1.047, 0.1, 100)
    (scanner,) = read(arm(sensor("ray", "<ray/>"))).sensors
    assert scanner.lidar is not None
    assert (scanner.lidar.samples, scanner.lidar.vertical_samples) == (640, 1)


def test_noise_of_a_sensor_is_counted() -> None:
    noise = '<angular_velocity><x><noise type="gaussian"><stddev>0.1</stddev></noise></x></angular_velocity>'
    assert noted(arm(sensor("imu", f"<imu>{noise}</imu>"))) == "not modelled: 1 <angular_velocity>"


def test_a_sensor_of_a_joint() -> None:
    inside = "<force_torque><frame>sensor</frame><measure_direction>parent_to_child</measure_direction></force_torque>"
    (found,) = read(arm(joint="<axis/>" + sensor("force_torque", inside))).sensors
    assert (found.kind, found.at, found.on_child) == ("force_torque", "turn", True)


def test_other_sensors_are_counted() -> None:
    assert noted(arm(sensor("contact") + sensor("unheard_of"))) == (
        "not modelled: 1 <sensor-contact>, 1 <sensor-unheard_of>"
    )
