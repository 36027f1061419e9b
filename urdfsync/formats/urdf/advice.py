"""Options that suit a robot; `urdfsync.domain.advice.Advice` describes the functions."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import get_args

from urdfsync.common.diagnostics import Diagnostic
from urdfsync.domain import Target
from urdfsync.domain.advice import Proposal
from urdfsync.formats.urdf.assembly import Assembly, connector_options
from urdfsync.formats.urdf.kinematics.tree import KinematicTree
from urdfsync.formats.urdf.names import natural_key
from urdfsync.formats.urdf.options import LeftOut, Options
from urdfsync.formats.urdf.robot import Robot

_FOOTPRINT = re.compile(r"base_?footprint", re.IGNORECASE)
_LIMBS = (
    ("wheels", re.compile(r"wheel|caster|castor|track(?!er|ing)", re.IGNORECASE)),
    (
        "legs",
        re.compile(
            r"(?<![a-z])(?:(?:upper|lower)?leg|foot|feet|ankle|knee|hip|thigh|calf|shank|shin|toe)s?(?![a-z])",
            re.IGNORECASE,
        ),
    ),
)
_ROTORS = re.compile(r"rotor|propell?er|thruster|motor|(?<![a-z])props?(?![a-z])", re.IGNORECASE)
_CAMEL = re.compile(r"(?<=[a-z0-9])(?=[A-Z])")


def propose(robot: Robot, diagnostics: Sequence[Diagnostic]) -> Sequence[Proposal]:
    """Propose a base, and the errors to allow."""
    codes = {entry.code for entry in diagnostics}
    is_free = "free-root" in codes
    proposals = [Proposal("base", "floating", "its root moves freely", "free-root") if is_free else guess_base(robot)]
    if needed := [code for code in get_args(LeftOut) if code in codes]:
        proposals.append(Proposal("allow", needed, "the model leaves this part out, see the warnings"))
    return proposals


def option_for(name: str, robot: Robot, target: Target, options: Options) -> str:
    """Return the option that adds `name`: the name of a record, a frame or a variable of Run."""
    if name == f"{target.name}Parameters" and "record" not in options.approach:
        return 'approach = ["package", "record"]'
    return connector_options(Assembly(robot, options, target)).get(name, "")


def guess_base(robot: Robot) -> Proposal:
    """Guess from names whether a robot moves freely: on the ground, in the air or in water.

    The reason quotes the name that decides.
    """
    root = KinematicTree.of(robot).links[0].name
    if root.lower() == "world":
        return Proposal("base", "fixed", f'its root link is named "{root}"')
    if _FOOTPRINT.search(root):
        return Proposal("base", "floating", f'its root link is named "{root}"')
    turning = [joint for joint in robot.joints if joint.type in ("continuous", "revolute")]
    # a rotor carries no further joint; a motor of an arm does
    carrying = {joint.parent for joint in robot.joints}
    spinning = [joint for joint in turning if joint.type == "continuous" and joint.child not in carrying]
    for limbs, pattern, joints in (*((*limbs, turning) for limbs in _LIMBS), ("rotors", _ROTORS, spinning)):
        for kind, names in (("link", {j.child for j in joints}), ("joint", {j.name for j in joints})):
            matches = sorted((name for name in names if pattern.search(_CAMEL.sub(" ", name))), key=natural_key)
            if len(matches) > 1:
                return Proposal("base", "floating", f'{kind} "{matches[0]}" and others sound like {limbs}')
    return Proposal("base", "fixed", "no link or joint sounds like wheels, legs or rotors")
