"""The functions of UrdfSync.Dynamics against Pinocchio: masses, forces, Jacobians of all links and poses, to 1e-12."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest
from support import corpus, generic
from support.modelica import Array, Run, bench, simulate
from support.packages import generate
from support.urdfs import joint, link, robot

from urdfsync.domain import Target
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.model.record import obstacles
from urdfsync.formats.urdf.parse.source import read_robot
from urdfsync.formats.urdf.physics import completion, motion
from urdfsync.formats.urdf.robot import MOTION_KINDS
from urdfsync.modelica.literals import vector

pytestmark = pytest.mark.slow

CLOSE = 1e-12
CONFIGURATIONS = 3
WEIGHING = {"mass", "inertias", "bias", "gravity"}
STATUE = robot(link("base", 1.0), link("head", 2.0), joint("neck", "fixed", "base", "head"))
"""No moving joint: tables and results are empty, but for poses."""
SAMPLED = ("discrete Real", "algorithm when sample(0, 1) then", ":=", "end when;")
"""How the model calls the functions: each once per configuration, which is possible for robots of any size, if any
joint moves.

The compiler does not take results without elements here; and Jacobians that are assigned to parts of an array one by
one are silently zero, so there is a function for all of them.
"""
EQUATIONS = ("Real", "equation", "=", "")
"""At any time. Here the compiler calls a function anew for each element of its result, and writes each call out: 12
joints take more than a minute."""
CASES = {"gripper": (generic.GRIPPER, SAMPLED), "ladder": (generic.LADDER, EQUATIONS), "statue": (STATUE, EQUATIONS)}
JACOBIANS = """
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
"""
CALLS = """\
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
    bias {sign} UrdfSync.Dynamics.nonlinearEffects(data.tree, q, v, {{0, 0, -{g}}});
    gravity {sign} UrdfSync.Dynamics.gravityEfforts(data.tree, q, {{0, 0, -{g}}});
    jacobian {sign} jacobians(data.tree, q, 1:{links});
    (places, turns) {sign} UrdfSync.Dynamics.linkPoses(data.tree, q, 1:{links});
  {closing}"""
LONG_AXIS = """\
parameter Bot.BotParameters data(shoulder(axis = {1.2, 0, 1.6}));
    Real axis[3] = data.turnAxes[1, :];"""
"""An axis of the gripper is edited by hand; its direction is as before, its length is not."""


class Functions:
    """A robot, and what Pinocchio says of it."""

    def __init__(self, content: bytes) -> None:
        self.robot = generic.prepare(content)
        self._model = self.robot.reference.multibody.model
        self._model.gravity.linear = np.array([0, 0, -motion.GRAVITY])
        skeleton = self.robot.package.skeleton
        self.links = [link.name for link in skeleton.links]
        self.joints = [joint.name for joint in skeleton.joints if joint.type in MOTION_KINDS]
        n, chance = len(self.joints), np.random.default_rng(len(self.links))
        self.a, self.b = chance.uniform(0.5, 2, n), chance.uniform(0.5, 2, n)

    def expected(self, moved: float) -> Mapping[str, Array]:
        """What Pinocchio says of each function, in the configuration at this time."""
        model, data = self._model, self._model.createData()
        # configuration and velocity, the base at rest at the origin; `order` is where the joints are in the latter
        q, v, order = pin.neutral(model), np.zeros(model.nv), []
        numbers = np.arange(1, len(self.joints) + 1)
        positions, speeds = self.a * np.cos(self.b * moved + numbers), self.b * np.sin(self.a * moved + numbers)
        for name, position, speed in zip(self.joints, positions, speeds, strict=True):
            joint = model.joints[model.getJointId(name)]
            turns = joint.nq == 2  # continuous: cosine and sine
            q[joint.idx_q : joint.idx_q + joint.nq] = (np.cos(position), np.sin(position)) if turns else position
            v[joint.idx_v] = speed
            order.append(joint.idx_v)
        mass = generic.mass_matrix(self.robot.reference, q)[np.ix_(order, order)]
        bias = pin.nonLinearEffects(model, data, q, v)[order]
        gravity = pin.computeGeneralizedGravity(model, data, q)[order]
        frames = [int(model.getFrameId(link, pin.BODY)) for link in self.links]
        resolved = pin.LOCAL_WORLD_ALIGNED
        jacobians = [pin.computeFrameJacobian(model, data, q, frame, resolved)[:, order] for frame in frames]
        pin.framesForwardKinematics(model, data, q)
        places = [data.oMf[frame] for frame in frames]
        depths = {self.links[0]: 0}  # the tool is the last of the links that have the most moving joints before them
        for each in self.robot.package.skeleton.joints:
            depths[each.child] = depths[each.parent] + (each.type in MOTION_KINDS)
        tool = max(k for k, link in enumerate(self.links, 1) if depths[link] == max(depths.values()))
        return {
            "found": np.array([1, tool]),
            "mass": mass,
            "inertias": mass.diagonal(),
            "bias": bias,
            "gravity": gravity,
            "jacobian": np.array(jacobians),
            "places": np.array([place.translation for place in places]),
            "turns": np.array([place.rotation for place in places]),
        }

    def worst(self, library: Path, folder: Path, form: Sequence[str] = SAMPLED) -> Mapping[str, float]:
        """Per function the greatest of the `errors` in all configurations: every second there is another one."""
        a, b = (vector(values.tolist()) if len(values) else "fill(0, 0)" for values in (self.a, self.b))
        words = dict(zip(("variable", "opening", "sign", "closing"), form, strict=True))
        calls = CALLS.format(links=len(self.links), a=a, b=b, g=repr(motion.GRAVITY), **words)
        shapes = {part: array.shape for part, array in self.expected(0).items()}
        names = {part: elements(part, shape) for part, shape in shapes.items()}
        values = ["moved", *(name for several in names.values() for name in several)]
        task = bench(calls, [Run(CONFIGURATIONS - 1, 1)], values, classes=JACOBIANS)
        (series,) = simulate(library, [self.robot.package.write(folder)], [task])
        times = series.values["moved"]
        last = {round(moved): k for k, moved in enumerate(times)}  # an event has a row before it, too
        assert list(last) == list(range(CONFIGURATIONS))
        worst = dict.fromkeys(shapes, 0.0)
        for k in last.values():
            found = {
                part: np.array([series.values[name][k] for name in names[part]]).reshape(shape)
                for part, shape in shapes.items()
            }
            worst = {part: max(worst[part], error) for part, error in errors(found, self.expected(times[k])).items()}
        return worst


def elements(part: str, shape: Sequence[int]) -> list[str]:
    """Names of the elements of an array, row by row."""
    return [f"{part}[{','.join(str(i + 1) for i in index)}]" for index in np.ndindex(*shape)]


def errors(found: Mapping[str, Array], expected: Mapping[str, Array]) -> Mapping[str, float]:
    """Per function the greatest error of an element, relative to the greatest element.

    That of lengths and directions counts as 1 at least, that of forces as the greatest element of the mass matrix.
    """
    inertia = float(np.abs(expected["mass"]).max(initial=0)) or 1.0
    result = {}
    for part, array in expected.items():
        size = max(inertia if part in WEIGHING else 1.0, np.abs(array).max(initial=0))
        result[part] = float(np.abs(found[part] - array).max(initial=0) / size)
    return result


@pytest.mark.parametrize(("text", "form"), CASES.values(), ids=CASES)
def test_functions_agree_with_pinocchio_in_random_configurations(
    modelica_library: Path, tmp_path: Path, text: str, form: Sequence[str]
) -> None:
    """Base and tool link as well; the Jacobians are those of all links, also behind fixed joints, and of the root."""
    worst = Functions(text.encode()).worst(modelica_library, tmp_path, form)
    assert worst.keys() == {"found", "mass", "inertias", "bias", "gravity", "jacobian", "places", "turns"}
    assert max(worst.values()) < CLOSE, worst


@pytest.mark.large
@pytest.mark.parametrize("file", [file for file, count in corpus.moving_joints().items() if count], ids=corpus.label)
def test_functions_agree_with_pinocchio_for_robots_of_the_corpus(
    corpus: Path, modelica_library: Path, tmp_path: Path, file: str
) -> None:
    """Files without inertias get made-up ones, for both sides."""
    content = completion.completed_for_reference((corpus / file).read_bytes()).content
    found = read_robot(content, file).robot
    if found is None or obstacles(found.joints):
        pytest.skip("a faulty file, or planar and floating joints")
    content = completion.with_inertias(content, KinematicTree.of(found)).content
    worst = Functions(content).worst(modelica_library, tmp_path)
    assert max(worst.values()) < CLOSE, worst


def test_an_axis_of_any_length_counts_as_a_direction(modelica_library: Path, tmp_path: Path) -> None:
    """As in the joints of the package."""
    folder = generate(generic.GRIPPER.encode(), Target("Bot", "Bot"), approach=("record",)).write(tmp_path)
    values = [f"axis[{i}]" for i in (1, 2, 3)]
    (series,) = simulate(modelica_library, [folder], [bench(LONG_AXIS, [Run()], values)])
    assert series.end(*values) == pytest.approx([0.6, 0, 0.8], abs=CLOSE)
