"""Every element and attribute of SDF is translated, or a finding names it, or it never acts."""

from __future__ import annotations

import re
from collections.abc import Collection
from pathlib import Path

import pytest
from support.sdf_walk import every_entry, judge

_PAGE = Path(__file__).parents[3] / "docs" / "sdf.md"


_COUNTED = """
    model/pose model@placement_frame link/pose model_state state initial_position
    collision/surface collision/max_contacts collision/geometry self_collide
    limit/stiffness limit/dissipation joint/physics world/physics
    sensor/camera sensor/lidar sensor/ray sensor/imu sensor/force_torque
    sensor/air_pressure sensor/air_speed sensor/altimeter sensor/contact sensor/gps sensor/logical_camera
    sensor/magnetometer sensor/navsat sensor/rfid sensor/rfidtag sensor/sonar sensor/transceiver
    magnetic_field atmosphere spherical_coordinates plugin gripper include population
""".split()
"""Elements that act in Gazebo and in no model: a note counts them."""
_NEVER = {
    "seen only: of visuals, the package has shape, place and colour": (
        "visual light material scene gui actor road projector particle_emitter laser_retro"
    ),
    "heard only": "audio audio_source audio_sink",
    "only plugins use it": "battery",
    "says how values of a sensor are sent, and not which": "always_on enable_metrics frame_id topic visualize",
    "takes the value that the sensor has measured": "sensor/plugin",
    "names alone": "world@name camera@name namespace",
    "rests a body that does not move": "allow_auto_disable",
    "a choice of a solver, and numbers of a joint that is left out as a whole": (
        "must_be_base_link thread_pitch screw_thread_pitch"
    ),
    "numbers for meshes, whose inertia is not computed": "auto_inertia_params",
    "libsdformat ignores them, too": "inertial/pose@frame inertial/pose@relative_to",
    "merges worlds alone; then the file has no model, and is refused": "include@merge",
}
"""Elements that never change motion, contacts, starts or values of sensors, by the reason."""


def elements_left_out() -> list[str]:
    """Return the elements in the table of the page."""
    section = _PAGE.read_text().partition("## What is left out\n")[2].partition("\n## ")[0]
    first_cells = (line.split("|")[1] for line in section.splitlines() if line.startswith("|"))
    return [name for cell in first_cells for name in re.findall("`(.*?)`", cell)]


def matching(path: str, names: Collection[str]) -> list[str]:
    """Return the names that stand in a path, such as `link/pose` in `model/link/pose@degrees`."""
    return [name for name in names if re.search(rf"(^|[/@]){re.escape(name)}($|[/@])", path)]


@pytest.mark.slow
def test_every_element_and_attribute_is_translated_or_told() -> None:
    left_out, never = elements_left_out(), " ".join(_NEVER.values()).split()
    quiet, used = list[str](), set[str]()
    for entry in every_entry():
        verdict = judge(entry)
        used |= {*(acting := matching(entry.path, left_out))}
        if acting and not verdict.is_told:
            quiet.append(entry.path)
        elif verdict.is_translated or verdict.is_told:
            continue
        else:
            named, idle = matching(entry.path, _COUNTED), matching(entry.path, never)
            used |= {*named, *idle}
            quiet += [] if idle or (named and verdict.is_counted) else [entry.path]
    assert quiet == []
    assert {*left_out, *_COUNTED, *never} == used
