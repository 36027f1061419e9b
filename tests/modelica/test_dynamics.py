"""The functions of UrdfSync.Dynamics against Pinocchio: mass matrix, forces, Jacobian and poses, to 1e-12."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest
from support import generic
from support.modelica import Array, Run, Task, execute
from test_generic import ROBOTS

from urdfsync.literals import vector
from urdfsync.urdf.physics import motion
from urdfsync.urdf.skeleton import MOTIONS

pytestmark = pytest.mark.slow

CLOSE = 1e-12
POSITION, SPEED = 0.35, -0.8
"""Of the first axis; the others have other ones."""
DURATION = 0.25
TOOLS = {"gripper": "thumb", "ladder": "right"}

SOURCE = """
package Functions_
  import Modelica;
  import UrdfSync;
  import Bot;
  model Functions
    parameter Bot.BotParameters data;
    parameter Integer n = data.movingJoints;
    parameter Integer base = UrdfSync.Dynamics.baseLink(data.connectionMatrix);
    parameter Integer tool = UrdfSync.Dynamics.toolLink(data.jointTree, data.linkBodies);
    parameter Real links[{links}, 12] =
      UrdfSync.Dynamics.linkFrames(data.connectionMatrix, data.linkBodies, data.jointPositions, data.jointAngles);
    parameter Real frames[n, 15] = UrdfSync.Dynamics.jointFrames(
      data.connectionMatrix, data.linkBodies, data.jointPositions, data.jointAngles, data.jointAxes);
    parameter Real bodies[n + 1, 10] = UrdfSync.Dynamics.bodyInertias(
      data.linkBodies, links, data.linkMasses, data.linkCenters, data.inertialAngles, data.linkInertias, n);
    parameter Real start[n] = {q};
    parameter Real v[n] = {v};
    Real q[n];
    Real moved(start = 0, fixed = true);
    Real mass[n, n];
    Real bias[n];
    Real gravity[n];
    Real jacobian[6, n];
    Real poses[{links}, 12];
  equation
    der(moved) = 1;
    for i in 1:n loop
      q[i] = start[i] + moved*v[i];
    end for;
    mass = UrdfSync.Dynamics.massMatrix(data.jointTree, frames, bodies, q);
    bias = UrdfSync.Dynamics.nonlinearEffects(data.jointTree, frames, bodies, q, v);
    gravity = UrdfSync.Dynamics.gravityEfforts(data.jointTree, frames, bodies, q);
    jacobian = UrdfSync.Dynamics.jacobian(data.jointTree, frames, data.linkBodies, links, q, tool);
    poses = UrdfSync.Dynamics.linkPoses(data.jointTree, frames, data.linkBodies, links, q);
  end Functions;
end Functions_;
"""


class Functions:
    """What the functions give for a robot at the end of a motion, and Pinocchio's model of it."""

    def __init__(self, name: str, library: Path, folder: Path) -> None:
        self.name, own = name, generic.prepare(ROBOTS[name].encode())
        self.pin, self.model = own.reference.pin, own.reference.model
        self.links = [link.name for link in own.skeleton.links]
        joints = [joint.name for joint in own.skeleton.joints if joint.type in MOTIONS]
        n, start = len(joints), POSITION + 0.3 * np.arange(len(joints))
        speeds = SPEED * np.cos(np.arange(n))
        source = SOURCE.format(links=len(self.links), q=vector(start.tolist()), v=vector(speeds.tolist()))
        self.shapes = {
            "mass": (n, n),
            "bias": (n,),
            "gravity": (n,),
            "jacobian": (6, n),
            "poses": (len(self.links), 12),
        }
        values = [name for part, shape in self.shapes.items() for name in _elements(part, shape)]
        task = Task(source, "Functions_.Functions", [Run(DURATION, DURATION)], [*values, "moved"])
        (outcome,) = execute(library, [own.package.write(folder)], [task])
        assert not outcome.error, outcome.error
        (series,) = outcome.runs
        assert not series.error, series.error
        self.found = self._arrays(series.values)
        self.order = [self.model.joints[self.model.getJointId(name)].idx_v for name in joints]
        self.q, self.v = self._configuration(joints, start + speeds * series.values["moved"][-1], speeds)

    def _arrays(self, values: Mapping[str, Array]) -> dict[str, Array]:
        return {
            part: np.array([values[name][-1] for name in _elements(part, shape)]).reshape(shape)
            for part, shape in self.shapes.items()
        }

    def _configuration(self, joints: list[str], positions: Array, speeds: Array) -> tuple[Array, Array]:
        q, v = self.pin.neutral(self.model), np.zeros(self.model.nv)
        for name, position, speed in zip(joints, positions, speeds, strict=True):
            joint = self.model.joints[self.model.getJointId(name)]
            turns = joint.nq == 2
            q[joint.idx_q : joint.idx_q + joint.nq] = (np.cos(position), np.sin(position)) if turns else position
            v[joint.idx_v] = speed
        return q, v

    def frame(self, link: str) -> int:
        """Pinocchio's number of the frame of a link."""
        return int(self.model.getFrameId(link, self.pin.BODY))


def _elements(part: str, shape: tuple[int, ...]) -> list[str]:
    """Names of the elements of an array, row by row."""
    return [f"{part}[{','.join(str(i + 1) for i in index)}]" for index in np.ndindex(*shape)]


@pytest.fixture(scope="module", params=ROBOTS)
def functions(
    request: pytest.FixtureRequest, modelica_library: Path, tmp_path_factory: pytest.TempPathFactory
) -> Functions:
    return Functions(request.param, modelica_library, tmp_path_factory.mktemp(request.param))


def test_mass_matrix(functions: Functions) -> None:
    upper = np.triu(functions.pin.crba(functions.model, functions.model.createData(), functions.q))
    expected = (upper + np.triu(upper, 1).T)[np.ix_(functions.order, functions.order)]
    assert functions.found["mass"] == pytest.approx(expected, abs=CLOSE * np.abs(expected).max())
    assert np.linalg.eigvalsh(functions.found["mass"]).min() > 0


def test_coriolis_and_gravity_forces(functions: Functions) -> None:
    functions.model.gravity.linear = np.array([0, 0, -motion.GRAVITY])
    data = functions.model.createData()
    bias = functions.pin.nonLinearEffects(functions.model, data, functions.q, functions.v)[functions.order]
    gravity = functions.pin.computeGeneralizedGravity(functions.model, data, functions.q)[functions.order]
    assert functions.found["bias"] == pytest.approx(bias, abs=CLOSE * np.abs(bias).max())
    assert functions.found["gravity"] == pytest.approx(gravity, abs=CLOSE * np.abs(gravity).max())
    assert np.abs(bias - gravity).max() > 0.1, "there are Coriolis forces"


def test_jacobian_of_the_tool(functions: Functions) -> None:
    """The tool is the last of the links that have the most moving joints before them."""
    frame, resolved = functions.frame(TOOLS[functions.name]), functions.pin.LOCAL_WORLD_ALIGNED
    data = functions.model.createData()
    expected = functions.pin.computeFrameJacobian(functions.model, data, functions.q, frame, resolved)
    assert functions.found["jacobian"] == pytest.approx(expected[:, functions.order], abs=CLOSE)


def test_poses_of_all_links(functions: Functions) -> None:
    data = functions.model.createData()
    functions.pin.framesForwardKinematics(functions.model, data, functions.q)
    for found, link in zip(functions.found["poses"], functions.links, strict=True):
        place = data.oMf[functions.frame(link)]
        assert found[:9].reshape(3, 3) == pytest.approx(place.rotation, abs=CLOSE)
        assert found[9:] == pytest.approx(place.translation, abs=CLOSE)
