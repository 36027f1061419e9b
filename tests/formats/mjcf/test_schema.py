"""Every attribute of every element of MuJoCo's schema: what changes the motion is translated, or told by its name.

An attribute is changed alone in models where it can act. If MuJoCo then computes another motion, start or sensor, the
URDF differs, or a finding or note names the attribute or its element.
"""

from __future__ import annotations

import random
import re
import sys
from collections import Counter, defaultdict
from collections.abc import Collection, Mapping
from xml.etree.ElementTree import fromstring

import pytest
from support.mjcf_schema import IS_OLD, Bench, benches, fates, find, real_path, schema

NEVER: Mapping[str, str] = {
    r"/model|.*/(name|class|childclass|prefix|sep|content_type|user)": "names elements, or holds a user's numbers",
    r"(visual|custom|statistic)(/.*)?": "draws, or holds numbers of a user and of viewers",
    r"(default|asset)/(material|texture|skin)/.*|asset/hfield/.*|deformable/skin/.*": "draws; hills count as a plane",
    r".*/(group|rgba|material|castshadow|width|texcoord|smoothnormal|normal)": "draws",
    r"(body|default)/(site|camera|light)/.*": "a frame, a picture or a light: the frame of a site is translated",
    r"size/.*": "the memory that MuJoCo takes",
    r"compiler/(meshdir|texturedir|assetdir|strippath)": "where files are; a file that is missing is refused",
    r"compiler/(save.*|usethread|passthrough|conflict)": "how MuJoCo works and writes",
    r"compiler/coordinate|body/geom/hfield": "has one value that MuJoCo accepts",
    r"compiler/(autolimits|fusestatic|discardvisual|balanceinertia|alignfree|fitaabb)": "resolved when MuJoCo compiles",
    r"compiler/lengthrange/.*": "computes the range of muscles, which are told",
    r"option/(jacobian|tolerance|(ls|ccd|sdf|noslip|sleep)_.*)": "how exactly MuJoCo solves",
    r"option/flag/(autoreset|energy|fwdinv|invdiscrete|island|(mid|multi|native)\w+|refsafe|warmstart)": "likewise",
    r"option/flag/(ipc|speculative|sleep)|body/sleep": "likewise, in contacts and at rest",
    r"option/flag/filterparent": "contacts of the robot with itself are in no model",
    r"body/(fuse|simple|mocap)|body/freejoint/align|.*/align": "a form of the same motion",
    r"(body|default)/geom/(priority|solmix|condim|fluidcoef|fluidshape|fitscale|hfield|mesh|fromto|type|size)": (
        "acts beside others; default/geom stands for body/geom"
    ),
    r"asset/mesh/(builtin|params|face|vertex|maxhullvert|file)|default/mesh/.*": "the shape alone, if masses are given",
    r"body/attach/.*|asset/model/.*": "resolved by MuJoCo: its elements are walked",
    r"(actuator|default)/\w+/(lengthrange|actdim|(crank|slider|ref)site|cranklength)": "of muscles, cranks and sites",
    r"(actuator|default)/\w+/(\w+limited|interp|nsample|gaintype|ctrlrange|delay|ffrange)": "follows from the range",
    r"sensor/.*/(noise|interp|nsample|interval|delay|cutoff)": "says how a sensor is used; its delay and cut are told",
    r"keyframe/key/(time|mpos|mquat|plastic)": "the clock, bodies outside of the robot, springs that yield (told)",
    r"(extension/plugin|(.*/)?plugin)(/.*)?": "MuJoCo refuses a plugin that is not loaded",
    r"(default/)?(asset/)?material/layer/.*": "draws",
    r"equality/(flex|flexstrain)/.*": "of flexible bodies, which are told",
    r"default/(adhesion|damper|dcmotor|orientation|pid|muscle|cylinder|general)/.*": "its element is told",
    r"deformable/.*|body/flexcomp.*": "its element is told",
}
"""Attributes that change no motion, with the reason."""

ACCURACY: Mapping[str, str] = {
    r"option/(timestep|integrator|solver|(ls_|noslip_)?iterations|tolerance)": "how exactly MuJoCo solves",
    r"option/flag/(diagexact|eulerdamp)": "likewise",
    r"(actuator|default)/\w+/(gainprm|biasprm)": "the command of Run is the joint's, not ctrl",
    r"keyframe/key/ctrl": "the commands of Run are those of its user",
    r"body/geom/pos|body/(pos|quat|euler|axisangle|xyaxes|zaxis)": "a floating robot stands on the ground",
}
"""Attributes that may change a motion, though nothing tells them, with the reason."""


def fates_of(names: Collection[tuple[str, str]], all_benches: Collection[Bench]) -> dict[str, dict[str, list[str]]]:
    """Return what becomes of each attribute."""
    found = dict[str, dict[str, list[str]]]()
    for path, attribute in names:
        name = found[f"{path}/{attribute}"] = defaultdict[str, list[str]](list)
        for bench in all_benches:
            tag = real_path(path)
            if re.match(bench.paths, f"{tag}/{attribute}") and find(fromstring(bench.text), tag):
                for fate, values in fates(path, attribute, bench).items():
                    name[fate] += values
    return found


def has_reason(name: str, reasons: Mapping[str, str]) -> bool:
    return any(re.fullmatch(pattern, name) for pattern in reasons)


def wrong(found: Mapping[str, Mapping[str, list[str]]]) -> list[str]:
    """Return the attributes that act quietly, or that never act without a reason."""
    quiet = [f"{name} acts: {values['quiet']}" for name, values in found.items() if values.get("quiet")]
    still = [f"{name} never acts" for name, values in found.items() if not values and not has_reason(name, NEVER)]
    return [line for line in quiet if not has_reason(line.partition(" ")[0], ACCURACY)] + still


FOUND = (
    ("body/joint/springyield", "told"),
    ("body/joint/solreffriction", "told"),
    ("body/geom/adhesion", "told"),
    ("body/geom/surfacevel", "told"),
    ("body/geom/condim", "told"),
    ("body/geom/contype", "translated"),
    ("body/geom/friction", "translated"),
    ("body/geom/euler", "told"),
    ("body/flexcomp/mass", "whole"),
    ("equality/weld/torquescale", "told"),
    ("actuator/general/actearly", "told"),
    ("actuator/position/delay", "told"),
    ("actuator/pid/kp", "whole"),
    ("actuator/orientation/kp", "whole"),
    ("sensor/gyro/cutoff", "told"),
    ("option/impratio", "told"),
    ("option/flag/sensor", "told"),
    ("keyframe/key/qvel", "told"),
)
"""Attributes that once acted quietly, and what becomes of them."""


@pytest.mark.parametrize(("name", "fate"), FOUND)
def test_what_was_quiet_is_told(name: str, fate: str) -> None:
    path, _, attribute = name.rpartition("/")
    if (path, attribute) not in {*schema()}:
        pytest.skip("of a newer MuJoCo")
    (found,) = fates_of([(path, attribute)], [*benches()]).values()
    if IS_OLD and not found:
        pytest.skip("without effect in an older MuJoCo")
    assert fate in found
    assert "quiet" not in found


@pytest.mark.skipif(IS_OLD, reason="the lists are those of MuJoCo 4")
def test_some_attributes_of_the_schema() -> None:
    found = fates_of(random.Random(0).sample([*schema()], 20), [*benches()])
    assert wrong(found) == []


@pytest.mark.slow
@pytest.mark.skipif(IS_OLD, reason="the lists are those of MuJoCo 4")
def test_each_attribute_of_the_schema(capsys: pytest.CaptureFixture[str]) -> None:
    """Some minutes; with `-s` it says how many act."""
    found = fates_of([*schema()], [*benches()])
    assert wrong(found) == []
    never = {name for name, values in found.items() if not values}
    quiet = {name for name, values in found.items() if "quiet" in values}
    for reasons, names in ((NEVER, never), (ACCURACY, quiet)):
        assert [pattern for pattern in reasons if not any(re.fullmatch(pattern, name) for name in names)] == []
    counts = Counter(fate for values in found.values() for fate in ["all", *({*values} or ["never"])])
    with capsys.disabled():
        sys.stdout.write(f"{dict(counts)}\n")
