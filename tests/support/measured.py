"""Logs of simulated robots: MuJoCo moves a robot whose numbers differ from those of its source.

MuJoCo is independent of Pinocchio, with which the logs are compared. Its dry friction holds a joint that stands, as
real friction does. A log has noise, quantised encoders, and efforts that arrive late.
"""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from numpy.typing import NDArray

from support.corpus import REPOSITORY

Array = NDArray[np.float64]

LEG = """<robot name="leg">
  <link name="trunk"/>
  <joint name="hip" type="revolute"><parent link="trunk"/><child link="hip_link"/><origin xyz="0.1934 0.0465 0"/>
    <axis xyz="1 0 0"/><limit lower="-1.05" upper="1.05" effort="23.7" velocity="30"/>
    <dynamics damping="0.05" friction="0.2" armature="0.01"/></joint>
  <link name="hip_link"><inertial><origin xyz="-0.0054 0.00194 -0.000105"/><mass value="0.678"/>
    <inertia ixx="0.00048" ixy="-3.01e-06" ixz="1.11e-06" iyy="0.000884" iyz="-1.42e-06" izz="0.000596"/></inertial>
  </link>
  <joint name="thigh" type="revolute"><parent link="hip_link"/><child link="thigh_link"/><origin xyz="0 0.0955 0"/>
    <axis xyz="0 1 0"/><limit lower="-1.57" upper="3.49" effort="23.7" velocity="30"/>
    <dynamics damping="0.05" friction="0.2" armature="0.01"/></joint>
  <link name="thigh_link"><inertial><origin xyz="-0.00374 -0.0223 -0.0327"/><mass value="1.152"/>
    <inertia ixx="0.00584" ixy="8.72e-05" ixz="-0.000289" iyy="0.0058" iyz="0.000808" izz="0.00103"/></inertial></link>
  <joint name="calf" type="revolute"><parent link="thigh_link"/><child link="calf_link"/><origin xyz="0 0 -0.213"/>
    <axis xyz="0 1 0"/><limit lower="-2.72" upper="-0.83" effort="45.4" velocity="15"/>
    <dynamics damping="0.05" friction="0.2" armature="0.02"/></joint>
  <link name="calf_link"><inertial><origin xyz="0.00548 -0.000975 -0.115"/><mass value="0.241"/>
    <inertia ixx="0.00149" ixy="0" ixz="0.00003" iyy="0.00146" iyz="0" izz="0.000053"/></inertial></link>
</robot>
"""
"""A leg of a quadruped on a stand, with numbers like those of Unitree's Go2."""

GRIPPER = """<robot name="gripper">
  <link name="palm"/>
  <joint name="drive" type="revolute"><parent link="palm"/><child link="left"/><origin xyz="0 0.02 0.05"/>
    <axis xyz="1 0 0"/><limit lower="-0.2" upper="1.2" effort="5" velocity="6"/>
    <dynamics damping="0.02" friction="0.03" armature="0.002"/></joint>
  <link name="left"><inertial><origin xyz="0 0.03 0.06"/><mass value="0.21"/>
    <inertia ixx="0.00021" ixy="0" ixz="0" iyy="0.00016" iyz="0.00002" izz="0.00008"/></inertial></link>
  <joint name="other" type="revolute"><parent link="palm"/><child link="right"/><origin xyz="0 -0.02 0.05"/>
    <axis xyz="1 0 0"/><limit lower="-1.2" upper="0.2" effort="5" velocity="6"/>
    <dynamics damping="0.01" friction="0.02"/><mimic joint="drive" multiplier="-1"/></joint>
  <link name="right"><inertial><origin xyz="0 -0.03 0.06"/><mass value="0.19"/>
    <inertia ixx="0.0002" ixy="0" ixz="0" iyy="0.00015" iyz="-0.00002" izz="0.00008"/></inertial></link>
</robot>
"""


def arm() -> str:
    """The six-axis arm of the examples without shapes, gripper and gears."""
    file = REPOSITORY / "modelica/UrdfSync/Resources/robots/six_axis_arm/six_axis_arm.urdf"
    root = ET.fromstring(re.sub(r"<!--.*?-->", "", file.read_text(), flags=re.DOTALL))
    removed = {"flange_to_tool", "gripper_mount", "gripper_stroke", "finger_coupling", "pinion_coupling", "grasp_frame"}
    gone = {joint.find("child").get("link") for joint in root.findall("joint") if joint.get("name") in removed}  # type: ignore[union-attr]
    for child in list(root):
        if child.tag not in ("link", "joint") or child.get("name") in removed | gone:
            root.remove(child)
    for link in root.findall("link"):
        for part in [*link.findall("visual"), *link.findall("collision")]:
            link.remove(part)
    for dynamics in root.iter("dynamics"):
        dynamics.set("armature", "0.5")
    return ET.tostring(root, encoding="unicode")


class Noise(NamedTuple):
    """The faults of a log."""

    effort: float = 0.01
    """Standard deviation of efforts, as a part of their root mean square."""
    step: float = 2 * np.pi / 2**17
    """Of the encoders, in rad."""
    delay: int = 2
    """Rows by which efforts arrive late."""


def changed(source: str, seed: int, share: float = 0.25) -> str:
    """Return a source with other masses, centres, tensors and losses: those of a real robot."""
    rng, root = np.random.default_rng(seed), ET.fromstring(source)
    for inertial in root.iter("inertial"):
        mass, origin, inertia = (inertial.find(tag) for tag in ("mass", "origin", "inertia"))
        assert mass is not None
        assert origin is not None
        assert inertia is not None
        factor = float(np.exp(share * rng.uniform(-1, 1)))
        mass.set("value", repr(float(mass.get("value", "")) * factor))
        names = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
        xx, yy, zz, xy, xz, yz = (float(inertia.get(name, "0")) for name in names)
        tensor = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        # a stretched body is a body: the second moments change by a matrix on both sides
        moments = 0.5 * np.trace(tensor) * np.eye(3) - tensor
        size = np.sqrt(np.trace(moments) / float(mass.get("value", "")))
        stretch = np.eye(3) + 0.5 * share * rng.uniform(-1, 1, (3, 3))
        moments = factor * stretch @ moments @ stretch.T
        tensor = np.trace(moments) * np.eye(3) - moments
        for name, value in zip(names, tensor[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]], strict=True):
            inertia.set(name, repr(float(value)))
        centre = [float(x) for x in origin.get("xyz", "0 0 0").split()] + share * size * rng.uniform(-1, 1, 3)
        origin.set("xyz", " ".join(map(repr, map(float, centre))))
    for dynamics in root.iter("dynamics"):
        for name, value in dynamics.attrib.items():
            dynamics.set(name, repr(float(value) * float(np.exp(share * rng.uniform(-1, 1)))))
    return ET.tostring(root, encoding="unicode")


NOISE = Noise()
RATE, STEP = 500, 0.5e-3
"""Samples per second of a log, and the simulation's step in s."""


class Recording(NamedTuple):
    """A log: times, and a column for each joint."""

    joints: list[str]
    times: Array
    positions: Array
    efforts: Array

    def spoiled(self, noise: Noise, seed: int) -> Recording:
        """Return the log with noise, quantised positions, and efforts that arrive late."""
        late, rng = noise.delay, np.random.default_rng(seed)
        efforts = np.concatenate([self.efforts[:1].repeat(late, axis=0), self.efforts[: len(self.efforts) - late]])
        efforts += noise.effort * efforts.std(axis=0) * rng.standard_normal(efforts.shape)
        return self._replace(positions=noise.step * np.round(self.positions / noise.step), efforts=efforts)

    def write(self, file: Path, *, header: str = "time,{}", decimals: int = 9) -> Path:
        """Write it as CSV."""
        names = [*(f"{joint}.position" for joint in self.joints), *(f"{joint}.effort" for joint in self.joints)]
        rows = np.column_stack([self.times, self.positions, self.efforts])
        np.savetxt(file, rows, f"%.{decimals}g", ",", header=header.format(",".join(names)), comments="")
        return file


def record(
    truth: str, seed: int = 0, seconds: float = 20.0, rate: int = RATE, noise: Noise | None = NOISE, motion: int = 0
) -> Recording:
    """Simulate a robot along a motion of sines, and record it; `seed` is that of the noise, `motion` of the sines."""
    mujoco: Any = pytest.importorskip("mujoco")
    root, step = ET.fromstring(truth), STEP
    joints = {joint.get("name", ""): joint for joint in root.findall("joint") if joint.get("type") != "fixed"}
    model, mimics = _model(mujoco, root)
    model.opt.timestep, model.opt.integrator = step, mujoco.mjtIntegrator.mjINT_RK4
    data, names = mujoco.MjData(model), [model.joint(k).name for k in range(model.nv)]
    axes = [k for k, name in enumerate(names) if name not in mimics]
    wanted = _motion([_numbers(joints[names[k]].find("limit")) for k in axes], motion)
    data.qpos[axes], data.qvel[axes], _ = wanted(0.0)
    for name, (leader, factor) in mimics.items():
        for values in (data.qpos, data.qvel):
            values[names.index(name)] = factor * values[names.index(leader)]
    friction = np.array([model.dof_frictionloss[k] for k in axes])
    every, rows, inertia = round(1 / rate / step), list[Array](), np.zeros((model.nv, model.nv))
    for k in range(round(seconds / step)):
        mujoco.mj_forward(model, data)
        q, v, a = wanted(data.time)
        gain = a + 400 * (q - data.qpos[axes]) + 40 * (v - data.qvel[axes])
        for row, unit in zip(inertia, np.eye(model.nv), strict=True):  # `mj_fullM` has other arguments in each version
            mujoco.mj_mulM(model, data, row, unit)
        effort = inertia[np.ix_(axes, axes)] @ gain + data.qfrc_bias[axes] + 0.9 * friction * np.tanh(20 * v)
        if k % every == 0:
            rows.append(np.array([data.time, *data.qpos[axes], *effort]))
        data.qfrc_applied[axes] = effort
        mujoco.mj_step(model, data)
    times, positions, efforts = np.split(np.array(rows), [1, 1 + len(axes)], axis=1)
    clean = Recording([names[k] for k in axes], times[:, 0], positions, efforts)
    return clean.spoiled(noise, seed) if noise else clean


def _numbers(element: ET.Element | None) -> dict[str, float]:
    return {} if element is None else {name: float(value) for name, value in element.attrib.items() if name != "joint"}


def _model(mujoco: Any, root: ET.Element) -> tuple[Any, dict[str, tuple[str, float]]]:
    """Return MuJoCo's model without stops, and the leader and the factor of each joint that follows another."""
    mimics = dict[str, tuple[str, float]]()
    for joint in root.findall("joint"):
        for mimic in joint.findall("mimic"):
            mimics[joint.get("name", "")] = mimic.get("joint", ""), _numbers(mimic).get("multiplier", 1.0)
            joint.remove(mimic)
    spec: Any = mujoco.MjSpec.from_string(ET.tostring(root, encoding="unicode"))
    spec.compiler.fusestatic, spec.compiler.balanceinertia, spec.compiler.boundmass = False, False, 0
    for name, (leader, factor) in mimics.items():
        equality = spec.add_equality(type=mujoco.mjtEq.mjEQ_JOINT, name1=name, name2=leader)
        equality.data[:2], equality.solref[:], equality.solimp[:2] = (0.0, factor), (0.001, 1), (0.9999, 0.9999)
    for joint in spec.joints:
        losses = _numbers(root.find(f"joint[@name='{joint.name}']/dynamics"))
        joint.armature, joint.frictionloss = losses.get("armature", 0.0), losses.get("friction", 0.0)
        damping = losses.get("damping", 0.0)
        joint.damping = [damping, 0, 0] if np.ndim(joint.damping) else damping  # a polynomial since MuJoCo 4
        joint.solref_friction[:], joint.solimp_friction[:2] = (0.001, 1), (0.9999, 0.9999)
        joint.limited = mujoco.mjtLimited.mjLIMITED_FALSE
    return spec.compile(), mimics


def _motion(limits: list[dict[str, float]], seed: int) -> Any:
    """Return positions, speeds and accelerations over time: five sines for each joint, within its limits."""
    w = 2 * np.pi * 0.1 * np.arange(1, 6)
    sines, cosines = np.random.default_rng(1000 + seed).uniform(-1, 1, (2, len(limits), 5))

    def at(time: float) -> tuple[Array, Array, Array]:
        s, c = np.sin(w * time), np.cos(w * time)
        return (
            sines @ s + cosines @ c,
            sines @ (w * c) - cosines @ (w * s),
            -sines @ (w * w * s) - cosines @ (w * w * c),
        )

    course = np.array([at(time)[:2] for time in np.arange(0, 10, 0.02)])
    lower, upper, speed = (np.array([each[name] for each in limits]) for name in ("lower", "upper", "velocity"))
    low, high = course[:, 0].min(axis=0), course[:, 0].max(axis=0)
    width = np.minimum(0.8 * (upper - lower) / (high - low), 0.6 * speed / np.abs(course[:, 1]).max(axis=0))
    middle = (upper + lower - width * (low + high)) / 2

    def within(time: float) -> tuple[Array, Array, Array]:
        q, v, a = at(time)
        return middle + width * q, width * v, width * a

    return within
