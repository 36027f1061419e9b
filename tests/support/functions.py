"""The functions of UrdfSync.Dynamics for a robot in random configurations, and what Pinocchio says of each."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from support import generic
from support.modelica import Array, Run, Series, Task, execute
from urdfsync.modelica.literals import vector
from urdfsync.urdf.physics import motion
from urdfsync.urdf.robot import MOTION_KINDS

_CONFIGURATIONS = 3
_WEIGHING = {"mass", "inertias", "bias", "gravity"}

_SOURCE = """
package Functions_
  import Modelica;
  import UrdfSync;
  import Bot;
  function jacobians
    input UrdfSync.Records.RigidBodyTree tree;
    input UrdfSync.Types.JointPosition q[:];
    input Integer links[:];
    output Real J[size(links, 1), 6, size(q, 1)];
  algorithm
    J := zeros(size(links, 1), 6, size(q, 1));
    for k in 1:size(links, 1) loop
      J[k, :, :] := UrdfSync.Dynamics.jacobian(tree, q, links[k]);
    end for;
  end jacobians;
  model Functions
    parameter Bot.BotParameters data;
    parameter Integer n = data.movingJoints;
    parameter Integer base = UrdfSync.Dynamics.baseLink(data.connectionMatrix);
    parameter Integer tool = UrdfSync.Dynamics.toolLink(data.jointTree, data.linkBodies);
    parameter Real a[n] = {a};
    parameter Real b[n] = {b};
    Real q[n];
    Real v[n];
    Real moved(start = 0, fixed = true);
    {variable} found[2];
    {variable} mass[n, n];
    {variable} inertias[n];
    {variable} bias[n];
    {variable} gravity[n];
    {variable} jacobian[{links}, 6, n];
    {variable} places[{links}, 3];
    {variable} turns[{links}, 3, 3];
  equation
    der(moved) = 1;
    for i in 1:n loop
      q[i] = a[i]*cos(b[i]*moved + i);
      v[i] = b[i]*sin(a[i]*moved + i);
    end for;
  {opening}
    found {sign} {{base, tool}};
    mass {sign} UrdfSync.Dynamics.massMatrix(data.tree, q);
    inertias {sign} UrdfSync.Dynamics.jointInertias(data.tree, q);
    bias {sign} UrdfSync.Dynamics.nonlinearEffects(data.tree, q, v, {{0, 0, -{gravity}}});
    gravity {sign} UrdfSync.Dynamics.gravityEfforts(data.tree, q, {{0, 0, -{gravity}}});
    jacobian {sign} jacobians(data.tree, q, 1:{links});
    (places, turns) {sign} UrdfSync.Dynamics.linkPoses(data.tree, q, 1:{links});
  {closing}
  end Functions;
end Functions_;
"""


@dataclasses.dataclass(frozen=True)
class Form:
    """How the model calls the functions."""

    variable: str
    opening: str
    sign: str
    closing: str


SAMPLED = Form("discrete Real", "algorithm when sample(0, 1) then", ":=", "end when;")
"""Each function once per configuration: that is possible for robots of any size, if any joint moves.

The compiler does not take results without elements here; and Jacobians that are assigned to parts of an array one by
one are silently zero, so there is a function for all of them.
"""
EQUATIONS = Form("Real", "equation", "=", "")
"""At any time. Here the compiler calls a function anew for each element of its result, and writes each call out: 12
joints take more than a minute."""


class Functions:
    """A robot, with the functions compiled for it."""

    def __init__(self, content: bytes) -> None:
        self.robot = generic.prepare(content)
        self._pin, self._model = self.robot.reference.pin, self.robot.reference.model
        self._model.gravity.linear = np.array([0, 0, -motion.GRAVITY])
        skeleton = self.robot.skeleton
        self.links = [link.name for link in skeleton.links]
        self._joints = [joint.name for joint in skeleton.joints if joint.type in MOTION_KINDS]
        n, chance = len(self._joints), np.random.default_rng(len(self.links))
        self._a, self._b = chance.uniform(0.5, 2, n), chance.uniform(0.5, 2, n)
        self._shapes: Mapping[str, Sequence[int]] = {
            "found": (2,),
            "mass": (n, n),
            "inertias": (n,),
            "bias": (n,),
            "gravity": (n,),
            "jacobian": (len(self.links), 6, n),
            "places": (len(self.links), 3),
            "turns": (len(self.links), 3, 3),
        }

    def task(self, form: Form) -> Task:
        """What is to be compiled and run: every second the robot is in another configuration."""
        source = _SOURCE.format(
            links=len(self.links),
            a=_numbers(self._a),
            b=_numbers(self._b),
            gravity=repr(motion.GRAVITY),
            **dataclasses.asdict(form),
        )
        values = [name for part, shape in self._shapes.items() for name in _elements(part, shape)]
        return Task(source, "Functions_.Functions", [Run(_CONFIGURATIONS - 1, 1)], [*values, "moved"])

    def worst(self, library: Path, folder: Path, form: Form = SAMPLED) -> Mapping[str, float]:
        """Per function the greatest of the `errors` in all configurations.

        Raises AssertionError for what does not compile or run.
        """
        (outcome,) = execute(library, [self.robot.package.write(folder)], [self.task(form)])
        assert not outcome.error, outcome.error
        (series,) = outcome.runs
        assert not series.error, series.error
        configurations = series.values["moved"]
        last = {round(moved): k for k, moved in enumerate(configurations)}  # an event has a row before it, too
        assert list(last) == list(range(_CONFIGURATIONS))
        several = [
            errors({part: self._array(part, series, k) for part in self._shapes}, self.expected(configurations[k]))
            for k in last.values()
        ]
        return {part: max(one[part] for one in several) for part in self._shapes}

    def _array(self, part: str, series: Series, k: int) -> Array:
        shape = self._shapes[part]
        return np.array([series.values[name][k] for name in _elements(part, shape)]).reshape(shape)

    def expected(self, moved: float) -> Mapping[str, Array]:
        """What Pinocchio says of each function, in the configuration at this time."""
        pin, model, data = self._pin, self._model, self._model.createData()
        q, v, order = self._state(moved)
        upper = np.triu(pin.crba(model, data, q))
        mass = (upper + np.triu(upper, 1).T)[np.ix_(order, order)]
        bias = pin.nonLinearEffects(model, data, q, v)[order]
        gravity = pin.computeGeneralizedGravity(model, data, q)[order]
        frames, resolved = [self._frame(link) for link in self.links], pin.LOCAL_WORLD_ALIGNED
        jacobians = [pin.computeFrameJacobian(model, data, q, frame, resolved)[:, order] for frame in frames]
        pin.framesForwardKinematics(model, data, q)
        places = [data.oMf[frame] for frame in frames]
        return {
            "found": np.array([1, self._tool()]),
            "mass": mass,
            "inertias": mass.diagonal(),
            "bias": bias,
            "gravity": gravity,
            "jacobian": np.array(jacobians),
            "places": np.array([place.translation for place in places]),
            "turns": np.array([place.rotation for place in places]),
        }

    def _state(self, moved: float) -> tuple[Array, Array, list[int]]:
        """Configuration and velocity, the base at rest at the origin; where the joints are in the latter."""
        model = self._model
        q, v, order = self._pin.neutral(model), np.zeros(model.nv), []
        numbers = np.arange(1, len(self._joints) + 1)
        positions, speeds = self._a * np.cos(self._b * moved + numbers), self._b * np.sin(self._a * moved + numbers)
        for name, position, speed in zip(self._joints, positions, speeds, strict=True):
            joint = model.joints[model.getJointId(name)]
            turns = joint.nq == 2  # continuous: cosine and sine
            q[joint.idx_q : joint.idx_q + joint.nq] = (np.cos(position), np.sin(position)) if turns else position
            v[joint.idx_v] = speed
            order.append(joint.idx_v)
        return q, v, order

    def _tool(self) -> int:
        """The last of the links that have the most moving joints before them."""
        joints = self.robot.skeleton.joints
        depths = {self.links[0]: 0}
        for joint in joints:
            depths[joint.child] = depths[joint.parent] + (joint.type in MOTION_KINDS)
        return max(k for k, link in enumerate(self.links, 1) if depths[link] == max(depths.values()))

    def _frame(self, link: str) -> int:
        return int(self._model.getFrameId(link, self._pin.BODY))


def errors(found: Mapping[str, Array], expected: Mapping[str, Array]) -> Mapping[str, float]:
    """Per function the greatest error of an element, relative to the greatest element.

    That of lengths and directions counts as 1 at least, that of forces as the greatest element of the mass matrix.
    """
    inertia = float(np.abs(expected["mass"]).max(initial=0)) or 1.0
    sizes = {
        part: max(inertia if part in _WEIGHING else 1.0, np.abs(array).max(initial=0))
        for part, array in expected.items()
    }
    return {part: float(np.abs(found[part] - expected[part]).max(initial=0) / size) for part, size in sizes.items()}


def _numbers(values: Array) -> str:
    return vector(values.tolist()) if len(values) else "fill(0, 0)"


def _elements(part: str, shape: Sequence[int]) -> list[str]:
    """Names of the elements of an array, row by row."""
    return [f"{part}[{','.join(str(i + 1) for i in index)}]" for index in np.ndindex(*shape)]
