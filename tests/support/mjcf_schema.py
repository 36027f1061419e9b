"""Changes each attribute of each element of MuJoCo's schema alone, and sees whether MuJoCo computes another motion.

A model per kind of element; candidates for the values of attributes. What MuJoCo computes are the places of bodies, the
numbers of sensors and starts, from the pose as written and from the key `home`, with small and great commands.
"""

from __future__ import annotations

import os
import re
import warnings
from collections import defaultdict
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple
from xml.etree.ElementTree import Element, SubElement, fromstring

import mujoco
import numpy as np
import pytest

from support.mjcfs import FOLDER, SOURCE, stl
from urdfsync.formats.mjcf.document import read_document
from urdfsync.formats.mjcf.urdf import translated
from urdfsync.formats.translation.files import Files, TranslationError
from urdfsync.formats.translation.writer import in_xml

_READ_AS_BODIES = {
    "body/frame": "axisangle childclass euler name pos quat xyaxes zaxis",
    "body/replicate": "childclass count euler offset sep",
}
"""Elements that the printed schema does not list."""


def schema() -> Iterator[tuple[str, str]]:
    """Yield the path and the attributes of each element that the installed MuJoCo knows."""
    path, printed = list[str](), mujoco.mj_printSchema(flg_html=False, flg_pad=False)
    rows = dict[str, str]()
    for line in printed.split("\n"):
        if found := re.match(r"^( *)(?:\(world\))?(\w+) \((.)\) *(.*)$", line):
            depth = len(found[1]) // 3
            path[depth:] = [found[2]]
            where, more = "/".join(path[1:]), found[4]
        else:
            more = line
        rows[where] = f"{rows.get(where, '')} {more}"
    for name, attributes in {**rows, **_READ_AS_BODIES}.items():
        for attribute in attributes.split():
            yield name, attribute


IS_OLD = int(mujoco.__version__.partition(".")[0]) < 4
"""Whether the installed MuJoCo is older than the one whose schema was walked."""
NEEDS_ARMATURE = pytest.mark.skipif(("actuator/motor", "armature") not in {*schema()}, reason="of a newer MuJoCo")
_OFF = 'contype="0" conaffinity="0"'
_CHAIN = f"""
<body name="b" pos="0 .1 .2" euler=".3 .2 .1"><joint name="a" axis="0 1 0" pos="0 0 .1" range="-.1 .1"/>
  <geom name="ga" size=".1"/><site name="s1" size=".3"/><geom name="gm" type="mesh" mesh="m" {_OFF}/>
  <body name="c" pos=".1 0 1"><joint name="d" axis="1 0 0" damping="1" frictionloss="20"/>
    <geom name="gd" size=".1 .2 .3" type="box" group="2" {_OFF}/><site name="s2" pos=".1 .2 .3"/><site name="s0"/>
    <geom type="box" mesh="m" fitscale="1.1" pos=".1 .2 0" {_OFF}/>
    <frame name="fr" pos="0 0 1"><geom type="box" size=".1 .2 .3" pos=".1 0 0" {_OFF}/></frame>
    <replicate count="2" offset="0 0 1"><geom size=".1" pos=".1 0 0" {_OFF}/></replicate>
    <body name="e" pos="0 .2 1"><joint name="x" axis="0 1 1" type="slide" stiffness="90"/>
      <inertial pos="0 .1 0" mass="2" diaginertia=".3 .2 .4"/><site name="s" pos=".2 0 .3"/>
      <geom name="gf" size=".4" {_OFF}/><camera name="eye" pos="0 0 1" resolution="2 2"/><light name="lamp"/>
      <body name="k" pos=".1 .2 .3"><inertial pos="0 0 .1" mass="1" fullinertia=".1 .2 .2 .01 .02 .03"/></body>
    </body></body></body>"""
_ASSETS = (
    '<mesh name="m" file="a.stl"/><mesh name="n" file="b.stl"/><material name="red" rgba="1 0 0 1"/>'
    '<texture name="t" type="2d" builtin="flat" width="2" height="2"/>'
)
_CORNERS = '<mesh name="m" vertex="0 0 0 1 0 0 0 1 0 0 0 1" face="0 2 1 0 1 3 0 3 2 1 2 3"/>'
_TENDONS = (
    '<fixed name="f" range="-9 9"><joint joint="a" coef=".5"/><joint joint="d" coef="-1.5"/></fixed>'
    '<spatial name="sp" stiffness="9"><site site="s"/><geom geom="ga" sidesite="s1"/><site site="s1"/>'
    '<pulley divisor="2"/><site site="s0"/><site site="s1"/></spatial>'
)
_BALL = (
    '<body name="b"><joint name="a" axis="0 1 0"/><geom size=".1"/><body name="c" pos="0 0 .5">'
    f'<joint name="q" type="ball"/><geom name="gd" pos=".1 .2 .3" size=".1" {_OFF}/><site name="s" pos=".1 0 0"/>'
    '<site name="s2"/></body></body><site name="w"/>'
)
_GROUND = """
<geom name="floor" type="plane" size="1 1 1"/>
<body name="b" pos="0 0 .3"><freejoint name="free"/><geom name="ga" type="box" size=".3 .2 .1" pos="0 0 -.2"/>
  <body name="c" pos=".3 0 .2"><joint name="a" axis="0 1 0" damping="3" stiffness="30"/>
    <geom name="gd" type="capsule" size=".05" fromto="0 0 0 .3 0 -.4"/></body></body>"""
_FALL = '<key name="home" qpos="0 0 .3 1 0 0 0 .1" qvel="1 0 0 0 0 3 0"/>'
_SENSORS = {
    'site="s1"': "touch",
    'site="s"': "accelerometer velocimeter gyro force magnetometer rangefinder",
    'site="s0"': "torque",
    'site="s" camera="eye"': "camprojection",
    'joint="a"': "jointpos jointvel jointactuatorfrc jointlimitpos jointlimitvel jointlimitfrc",
    'tendon="f"': "tendonpos tendonvel tendonactuatorfrc tendonlimitpos tendonlimitvel tendonlimitfrc",
    'actuator="m"': "actuatorpos actuatorvel actuatorfrc",
    'objtype="site" objname="s"': "framepos framequat framexaxis frameyaxis framezaxis framelinvel frameangvel "
    "framelinacc frameangacc",
    'body="c"': "subtreecom subtreelinvel subtreeangmom",
    'site="s" objtype="site" objname="s2"': "insidesite",
    'geom1="ga" geom2="gd"': "distance normal fromto contact",
    "": "e_potential e_kinetic clock",
    'dim="1"': "user",
    'geom="ga" mesh="m"': "tactile",
}
_ACTUATORS = (
    '<general joint="a" gear="2" gainprm="30" biastype="affine" biasprm="1 -30 -2"/>',
    '<general joint="d" dyntype="filter" dynprm=".1" gainprm="3" forcerange="-2 1" ctrlrange="-1 1"/>',
    '<general joint="d" dyntype="integrator" gainprm="3" biastype="affine" biasprm="0 -3 -1" actrange="-1 1"/>',
    '<motor joint="d" gear="2" ctrlrange="-1 .5" group="2"/>',
    '<position joint="d" kp="20" kv="1"/>',
    '<position joint="a" kp="20" forcerange="-2 2" ctrlrange="-.2 .3" gear="2"/>',
    '<position joint="a" kp="20"/>',
    '<velocity joint="d" kv="2" gear="2" forcerange="-9 9"/>',
    '<intvelocity joint="d" kp="20" kv="1" actrange="-.3 .3"/>',
    '<intvelocity joint="a" kp="20"/>',
    '<damper joint="d" kv="2" ctrlrange="0 1"/>',
    '<cylinder joint="d" timeconst=".1" area="2" bias="1 0 0" forcerange="-9 9" ctrlrange="-1 1"/>',
    '<muscle joint="a" lengthrange="-1 1" force="20"/>',
    '<motor tendon="f" gear="2"/>',
    '<motor site="s" gear="0 0 2"/>',
    '<motor slidersite="s" cranksite="s2" cranklength="3"/>',
)
_LATER = ('joint="d"', 'joint="d" nsample="4" delay=".01" interp="zoh"')
"""An actuator of MuJoCo 4 that delays its control."""
_NEW_ACTUATORS = (
    '<pid joint="d" kp="20" kv="2" ki="1"/>',
    '<dcmotor joint="d" motorconst=".5" resistance="2"/>',
    '<general joint="d" dyntype="pid" gaintype="pid" gainprm="1" biastype="affine" biasprm="0 -3 -1" input="pos vel"/>',
)
"""Of MuJoCo 4."""
_KEY = '<key name="home" qpos=".2 .3 .1" qvel=".1 .2 -.3"/>'
_RODS = (
    '<flexcomp name="flex" type="grid" count="3 3 1" spacing=".1 .1 .1" radius=".01" dim="2" mass="1" pos="0 0 2">'
    '<edge/><contact selfcollide="none"/><elasticity young="1e3" thickness=".01" elastic2d="both"/><pin id="0 1"/>'
    "</flexcomp>"
)
_FLEX = (
    '<flex name="flex" dim="2" body="k e c" vertex="0 0 0 0 0 0 0 0 0" element="0 1 2" radius=".01">'
    '<edge damping="1"/><contact/><elasticity young="100"/></flex>'
)
_SKIN = (
    '<skin name="k" vertex="0 0 0 1 0 0 0 1 0" face="0 1 2"><bone body="b" bindpos="0 0 0" bindquat="1 0 0 0" '
    'vertid="0 1 2" vertweight="1 1 1"/></skin>'
)
_PART = (
    '<mujoco model="{0}"><worldbody><frame name="fr" pos="0 0 {1}"><body name="arm"><joint name="j" axis="1 0 0"/>'
    '<geom size="{1}"/><body name="tip" pos="1 0 0"><joint name="j2" axis="0 1 0"/><geom size=".2"/></body></body>'
    "</frame></worldbody></mujoco>"
)
FILES = {
    "a.stl": stl(0.1),
    "b.stl": stl(0.2),
    "part.xml": _PART.format("part", ".1").encode(),
    "other.xml": _PART.format("other", ".3").encode(),
}


class Bench(NamedTuple):
    """A model in which elements act, and the paths of those elements."""

    text: str
    paths: str
    """A regular expression."""


def _model(world: str = _CHAIN, assets: str = _ASSETS, *, option: str = "", flag: str = "", **sections: str) -> str:
    parts = "".join(f"<{name}>{text}</{name}>" for name, text in sections.items())
    return (
        f'<mujoco model="arm"><compiler angle="radian"/><option timestep=".005" {option}><flag {flag}/></option>'
        '<default><default class="other"><joint damping="3"/><geom mass="7" friction=".3"/></default></default>'
        f"<asset>{assets}</asset><worldbody>{world}</worldbody>{parts}</mujoco>"
    )


def benches() -> Iterator[Bench]:
    """Yield all models."""
    known = {path for path, _ in schema()}
    plain = _model(visual="<global/><quality/><headlight/><map/><scale/><rgba/>", keyframe=_KEY, deformable=_SKIN)
    custom = (
        '<numeric name="n" data="1"/><text name="t" data="x"/><tuple name="u"><element objtype="body" objname="b"/>'
    )
    plain = plain.replace("<asset>", f"<custom>{custom}</tuple></custom><asset>")
    yield Bench(
        plain.replace("<compiler", "<size/><statistic/><compiler"), "(?!compiler/lengthrange|actuator|sensor|tendon)"
    )
    yield Bench(_model(_BALL, ""), "body/(joint|site)")
    heavy = (
        '<body name="b" gravcomp="1"><joint name="a" axis="0 1 0" actuatorfrcrange="-1 1"/>'
        '<geom size=".1" pos="1 0 0"/></body>'
    )
    yield Bench(_model(heavy, "", actuator='<motor joint="a"/>'), "body/joint")
    yield Bench(_model(_CHAIN, _CORNERS), "asset/mesh")
    yield Bench(_model(_CHAIN, '<mesh name="m" builtin="sphere" params="1"/>'), "asset/mesh")
    free = (
        '<body name="b" pos="0 0 .3"><freejoint/>'
        '<geom size=".2 .1 .3" type="box" pos=".1 .2 .3" euler=".1 .2 .3"/></body>'
    )
    yield Bench(_model(free, ""), "compiler|body/freejoint")
    yield Bench(_model(_GROUND, "", keyframe=_FALL), "body|option|keyframe|compiler")
    yield Bench(_model(_GROUND, "", option='o_margin=".01"', flag='override="enable"', keyframe=_FALL), "option")
    swimmer = _CHAIN.replace('<geom name="ga"', '<geom name="ga" fluidshape="ellipsoid"')
    yield Bench(_model(swimmer, option='density="50"'), "body/geom|option")
    touching = _GROUND.replace('"ga"', '"ga" priority="1" contype="1" conaffinity="0"')
    touching = touching.replace('"gd"', '"gd" contype="0" conaffinity="1"').replace('"floor"', '"floor" solref=".03 1"')
    yield Bench(_model(touching, "", keyframe=_FALL), "body/geom")
    pairs = '<pair geom1="ga" geom2="floor"/><exclude body1="world" body2="c"/>'
    yield Bench(_model(_GROUND, "", contact=pairs), "contact")
    joints = '<joint name="i" joint1="a" joint2="d" polycoef=".1 .5 0 0 0"/><tendon tendon1="f" tendon2="sp"/>'
    connect = '<connect body1="e" body2="b" anchor=".1 .2 .3"/>'
    yield Bench(_model(tendon=_TENDONS, equality=joints + connect), "equality|option/flag")
    yield Bench(_model(equality='<weld body1="k" anchor="0 0 0"/>'), "equality")
    yield Bench(_model(equality='<weld site1="s" site2="s2"/>'), "equality")
    yield Bench(_model(equality='<connect site1="s" site2="s2"/>'), "equality")
    yield Bench(_model(tendon=_TENDONS), "tendon")
    ball = '<orientation joint="q" kp="20"/>'
    for text in (*_ACTUATORS, *([*_NEW_ACTUATORS, ball] if "actuator/pid" in known else ())):
        world, assets, tendons = (_BALL, "", {}) if text == ball else (_CHAIN, _ASSETS, {"tendon": _TENDONS})
        path = f"actuator/{text[1:].split()[0]}" + ("|option" if text.startswith("<motor joint") else "")
        keys = {"keyframe": '<key name="home"/>'} if "filter" in text or "<motor joint" in text else {}
        yield Bench(_model(world, assets, **tendons, actuator=text, **keys), path + ("|keyframe" if keys else ""))
        if "actuator/pid" in known and 'joint="d"' in text:
            late = text.replace(*_LATER)
            yield Bench(_model(world, assets, **tendons, actuator=late), f"{path}/(delay|nsample|interp)$")
    yield Bench(_model(_GROUND, "", actuator='<adhesion body="c" gain="50" ctrlrange="0 1"/>'), "actuator")
    sensors = "".join(f"<{tag} {words}/>" for words, tags in _SENSORS.items() for tag in tags.split())
    sensed = _model(sensor=sensors, tendon=_TENDONS, actuator='<motor name="m" joint="a"/>')
    yield Bench(sensed, "sensor|option/flag/sensor|option/magnetic|body/site")
    if "actuator/pid" in known:
        late = "".join(
            f'<{tag} site="s0" nsample="4" delay=".01"/>' for tag in ("accelerometer", "gyro", "force", "torque")
        )
        yield Bench(_model(sensor=late), "sensor/(accelerometer|gyro|force|torque)")
    yield Bench(_model(_BALL, "", sensor='<ballquat joint="q"/><ballangvel joint="q"/>'), "sensor")
    models = '<model name="part" file="part.xml"/><model name="other" file="other.xml"/>'
    attach = _CHAIN.replace("<camera", '<attach model="part" prefix="p_" body="arm"/><camera')
    yield Bench(_model(attach, _ASSETS + models), "body/attach|asset/model")
    framed = _CHAIN.replace("<camera", '<attach model="part" prefix="p_" frame="fr"/><camera')
    yield Bench(_model(framed, _ASSETS + models), "body/attach")
    yield Bench(_model(_CHAIN + _RODS), "body/flexcomp")
    yield Bench(_model(deformable=_FLEX), "deformable/flex")
    yield Bench(
        _model(assets=f'{_ASSETS}<hfield name="h" nrow="2" ncol="2" size="1 1 1 1"/>{_SKIN}'), "asset/(hfield|skin)"
    )


_WORDS = {
    "active": "true false",
    "angle": "degree radian",
    "axis": "0,0,1 1,2,3",
    "biastype": "none affine muscle",
    "builtin": "sphere none",
    "cone": "elliptic",
    "dyntype": "none integrator filter filterexact muscle",
    "eulerseq": "zyx XYZ",
    "fluidshape": "ellipsoid",
    "fullinertia": ".2,.3,.3,.02,.01,.03",
    "gaintype": "fixed affine muscle",
    "gravity": "0,0,-3 1,0,-9",
    "inertia": "shell exact convex legacy",
    "input": "pos vel pos,vel,ff none quat",
    "integrator": "RK4 implicit implicitfast Euler discrete",
    "interp": "linear cubic zoh",
    "inertiagrouprange": "1,2 0,0",
    "jacobian": "sparse dense",
    "mode": "all none trackcom",
    "objtype": "body xbody geom site",
    "reftype": "body",
    "memory": "2M",
    "settotalmass": "10",
    "sleep": "auto never allowed init",
    "solver": "PGS CG",
    "type": "hinge slide ball free sphere capsule ellipsoid cylinder box mesh plane",
    "range": "-.1,.1 0,20",
    "euler": ".3,.2,.1",
    "qpos": ".3,.1,.2",
    "vertex": "0,0,0,2,0,0,0,1,0,0,0,1",
    "face": "0,2,1,0,1,3,0,3,2",
    "relpose": "0,0,.1,1,0,0,0",
    "prefix": "q_",
    "body": "tip",
    "coordinate": "local",
    "conflict": "merge error",
}
"""Words and numbers that an attribute may have, with a comma for a blank."""
_NUMBERS = (
    "0 1 2 .02 .015 .3 -.4 50 -.1,.2 .01,.05 0,.5 .05,.9 .2,.5,.4 1,.4,.2 .5,.5,.5,.5 .9,.1,.2,.3 1,.1,.2,-.1,1,.3 "
    ".8,.9,.01,.4,3 .1,.2,.3,.4,.5 1,.5,.1,.01,.02"
)
_REFERENCES = re.compile(
    "(body|geom|joint|tendon|site|ref|obj|subtree)(name)?[12]?|class|childclass|mesh|material|actuator|camera|model|"
    "(crank|slider|ref|side)site|jointinparent|frame|texture|target|hfield|flex|prefix|file"
)
_SPEED = 0.7


def candidates(attribute: str, root: Element) -> Iterator[str]:
    """Yield values that the attribute may have, and others that MuJoCo refuses."""
    numbers = "" if attribute in ("type", "mode", "integrator") else _NUMBERS
    for word in f"{_WORDS.get(attribute, '')} true false enable disable {numbers}".split():
        yield word.replace(",", " ")
    if _REFERENCES.fullmatch(attribute):
        yield from sorted({name for each in root.iter() for key in ("name", "class") if (name := each.get(key))})
        yield from FILES


def observe(text: str) -> Any:
    """Return numbers of the motion that MuJoCo computes. Raises ValueError if MuJoCo refuses the model."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # some attributes are deprecated
        model = mujoco.MjSpec.from_string(
            text, include={name: text for name, text in FILES.items() if name.endswith("xml")}, assets=FILES
        ).compile()
    data, seen = mujoco.MjData(model), list[Any]()
    for start in range(-1, min(model.nkey, 1)):
        for command in (0.3, -20.0, 20.0):
            mujoco.mj_resetData(model, data)
            if start < 0:
                data.qvel[:] = _SPEED * np.cos(np.arange(model.nv))
            else:
                mujoco.mj_resetDataKeyframe(model, data, start)
            data.ctrl[:] += command
            for _ in range(4):
                mujoco.mj_step(model, data, 12)
                seen += [data.xpos.ravel().copy(), data.xquat.ravel().copy(), data.sensordata.copy()]
    return np.concatenate(seen)


_REAL = {
    "joint": "body/joint",
    "geom": "body/geom",
    "site": "body/site",
    "camera": "body/camera",
    "light": "body/light",
    "pair": "contact/pair",
    "mesh": "asset/mesh",
    "texture": "asset/texture",
    "material": "asset/material",
    "equality": "equality/weld",
    "tendon": "tendon/fixed",
}
"""Paths of elements that have defaults; others are actuators."""


def real_path(path: str) -> str:
    """Return the path of an element that a default is for."""
    if not path.startswith("default/"):
        return path
    first, *rest = path.split("/")[1:]
    return "/".join([_REAL.get(first, f"actuator/{first}"), *rest])


def lines_of(element: Element) -> Iterator[tuple[Element, str]]:
    """Yield the lines of a model: each element begins a line of its own."""
    yield element, f"<{element.tag}{in_xml(element.attrib)}>"
    for child in element:
        yield from lines_of(child)
    yield element, f"</{element.tag}>"


def find(root: Element, path: str) -> list[Element]:
    """Return the elements with a path of the schema."""
    *above, tag = path.split("/")
    parents = {child: parent for parent in root.iter() for child in parent}

    def matches(element: Element) -> bool:
        for name in reversed(above):
            element = parents[element]
            if element.tag != name and not (name == "body" and element.tag in ("worldbody", "frame", "replicate")):
                return False
        return bool(above) or element.tag in ("body",) or element == root or parents[element] == root

    return [element for element in root.iter(tag) if element in parents and matches(element)]


class Translation(NamedTuple):
    """The URDF of a model."""

    robot: str
    """Without notes."""
    notes: Mapping[int, tuple[str, ...]]
    """What is left out or counted, by lines of the source."""


_WHOLE = re.compile("actuator|tendon|flexible body|contact pair|plugin|equality.*|sensor-.*|motor|inactive")
"""What is left out or counted with all its attributes, beside elements with the tag of their note."""


def translation(root: Element) -> Translation | None:
    """Return the translation of a model; None if it is refused."""
    contents = {os.path.join(FOLDER, name): content for name, content in FILES.items()}  # noqa: PTH118
    files = Files({SOURCE: as_text(root).encode(), **contents}, [FOLDER])
    try:
        urdf, places = translated(read_document(SOURCE, files), "b")
    except TranslationError:
        return None
    notes, robot = defaultdict[int, list[str]](list), list[str]()
    for number, line in enumerate(urdf.split("\n"), 1):
        found = re.match(r"  +<(?!link|joint|ros2_control|sensor |loop_joint|gazebo)([\w-]+)(?=.*/>$)", line)
        if line.startswith("  <") and not line.startswith("   ") and found:
            place = [place for first, _, place in places if first <= number][-1]
            words = re.search('name="(.*?)" what="(.*?)"', line)
            notes[place] += [found[1]] if words is None else [words[2], words[1], words[2].partition(" of ")[0]]
        else:
            robot.append(line)
    return Translation("\n".join(robot), {line: tuple(words) for line, words in notes.items()})


def as_text(root: Element) -> str:
    """Return the text of a model."""
    return "\n".join(line for _, line in lines_of(root))


def _told(told: Translation, root: Element, element: Element) -> tuple[bool, set[str]]:
    """Return whether an element, or one around it, is left out whole, and words of the notes on it."""
    parents = {child: parent for parent in root.iter() for child in parent}
    numbers = dict[Element, int]()
    for number, (each, _) in enumerate(lines_of(root), 1):
        numbers.setdefault(each, number)
    words = {word for line in told.notes.values() for word in line if element.tag in ("option", "flag", "compiler")}
    words |= {*told.notes.get(numbers[element], ())}
    while element.tag not in ("body", "worldbody", "mujoco"):
        here = told.notes.get(numbers[element], ())
        if any(word == element.tag or _WHOLE.fullmatch(word) for word in here):
            return True, words
        element = parents[element]
    return False, words


NAMED_BY = (
    ("(.*/)?(nsample|interp)", "delay"),
    (
        "(actuator|default)/.*/(ctrllimited|ctrlrange|dynprm|timeconst|dyntype|gainprm|biasprm|area|diameter)",
        "activation",
    ),
    ("option/o_.*", "override"),
    ("(body|default)/geom/fluid(shape|coef)|option/wind", "density"),
    ("(body|default)/joint/actuatorgravcomp", "gravcomp"),
    ("option/magnetic", "sensor-magnetometer"),
    ("(body|default)/site/(size|type|fromto|.*angle|euler|quat|.*ax.s)", "sensor-touch"),
)
"""Attributes that act by another one, which is told."""


def fates(path: str, attribute: str, bench: Bench, most: int = 2) -> Mapping[str, list[str]]:
    """Change an attribute of each element with a path to its candidates; return what becomes of changes that act.

    The fates are `translated`, `told`, `whole` (told with its element) and `quiet`, with the values. At most `most`
    values of an element are translated.
    """
    found, root = defaultdict[str, list[str]](list), fromstring(bench.text)
    elements = users = find(root, real_path(path))
    if path != real_path(path) and elements:
        for element in users:
            element.attrib.pop(attribute, None)
        above = root.find("default")
        for tag in path.split("/")[1:]:
            assert above is not None
            above = SubElement(above, tag)
        assert above is not None
        elements = [above]
    for number, element in enumerate(elements):
        user, kept = users[number], dict(element.attrib)
        try:
            numbers = observe(as_text(root))
            base = translation(root)
        except (ValueError, mujoco.FatalError):
            continue
        if base and _told(base, root, user)[0]:
            found["whole"].append("")
            continue
        acting = 0
        for value in candidates(attribute, root):
            element.attrib = kept | {attribute: value}
            try:
                changed = observe(as_text(root))
            except (ValueError, mujoco.FatalError):
                continue
            if numbers.shape == changed.shape and np.allclose(numbers, changed, rtol=1e-7, atol=1e-9, equal_nan=True):
                continue
            found[_fate(f"{path}/{attribute}", base, translation(root), root, user)].append(value)
            if (acting := acting + 1) == most:
                break
        element.attrib = kept
    return found


def _fate(name: str, base: Translation | None, after: Translation | None, root: Element, user: Element) -> str:
    if base is None or after is None or (base.robot == after.robot and base.notes != after.notes):
        return "told"
    if base.robot != after.robot:
        return "translated"
    is_whole, words = _told(after, root, user)
    others = {other for pattern, other in NAMED_BY if re.fullmatch(pattern, name)}
    is_by_other = not others.isdisjoint(word for line in after.notes.values() for word in line)
    return "told" if is_whole or is_by_other or name.rpartition("/")[2] in words else "quiet"
