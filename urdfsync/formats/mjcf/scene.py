"""Reads the text of an MJCF with MuJoCo, chooses the robot in it, and names its parts."""

from __future__ import annotations

import functools
import re
from collections.abc import Collection, Iterable, Iterator
from typing import Any

import mujoco
import numpy as np

from urdfsync.common.spelling import nearest
from urdfsync.formats.mjcf.document import MjcfDocument
from urdfsync.formats.translation.files import TranslationError
from urdfsync.formats.translation.writer import free_name, listed

_BODY, _SITE = int(mujoco.mjtObj.mjOBJ_BODY), int(mujoco.mjtObj.mjOBJ_SITE)
WORLD = "world"
_MOST_BODIES = 2_000
"""The most bodies of a robot: a package has two files for each."""
_LINE = re.compile(r"('[^']*')|\(?\bline (\d+)\)?")
"""A name in quotes, or the number of a line."""
_KINDS = ("body", "joint", "geom", "site", "equality", "tendon", "actuator", "sensor", "key", "pair")
_LISTS = {kind: f"{kind}s" for kind in _KINDS} | {"body": "bodies", "equality": "equalities"}
"""Lists of a `MjSpec` by kinds of elements."""
_NUMBERS = int, float, np.ndarray
_CUBE = b"""\
v -1 -1 -1\nv -1 -1 1\nv -1 1 -1\nv -1 1 1\nv 1 -1 -1\nv 1 -1 1\nv 1 1 -1\nv 1 1 1
f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4
"""
"""A mesh as OBJ."""


class MujocoScene:
    """A model as MuJoCo compiles it, and the robot in it: the bodies below `root`."""

    def __init__(self, document: MjcfDocument, spec: Any, model: Any, body: str) -> None:
        """`body` is the user's choice; empty for none. Raises TranslationError if there is not one robot."""
        self.document, self.spec, self.model = document, spec, model
        self._elements = {kind: {one.id: one for one in getattr(spec, name)} for kind, name in _LISTS.items()}
        self._new = mujoco.MjSpec()  # its elements end with it
        self._usual = {kind: getattr(self._new.default, kind, None) for kind in _KINDS}
        self._usual["body"], self._usual["sensor"] = self._new.worldbody.add_body(), self._new.add_sensor()
        self._usual["option"] = self._new.option
        """Elements with MuJoCo's defaults."""
        self.controls, self.outputs = (
            getattr(model, f"actuator_{kind}adr", range(model.nu)) for kind in ("ctrl", "out")
        )
        """Places of each actuator's first control and first force. Before MuJoCo 4, each has one."""
        self.tops = self._choose(body)
        """The topmost bodies: several if equalities join them, and the world if it is chosen."""
        self.root = min(self.tops)
        first = model.body_jntadr[self.root]
        is_free = first >= 0 and model.jnt_type[first] == mujoco.mjtJoint.mjJNT_FREE
        self.is_floating = self.root > 0 and len(self.tops) == 1 and bool(is_free)
        self.bodies = [n for n in range(model.nbody) if self.root == 0 or int(model.body_rootid[n]) in self.tops]
        """The bodies of the robot, parents first. Without a free joint, the world is the first of them."""
        if not self.is_floating:
            self.bodies = list(dict.fromkeys([0, *self.bodies]))
        self.links = list[str]()
        """Names of all bodies; one without a name counts among the bodies of its parent."""
        given, parents = [self.name("body", number) for number in range(model.nbody)], list(model.body_parentid)
        taken = {*given}
        for number, parent in enumerate(parents):  # parents come before children
            count = parents[1 : number + 1].count(parent)
            self.links.append(given[number] or free_name(f"{self.links[parent]}_body{count}", taken))
        self.joints = list[str]()
        """Names of all joints; one without a name counts among the joints of its body."""
        given = [self.name("joint", number) for number in range(model.njnt)]
        taken = {*given}
        for number, holder in enumerate(map(int, model.jnt_bodyid)):
            suffix = number - model.body_jntadr[holder] + 1 if model.body_jntnum[holder] > 1 else ""
            self.joints.append(given[number] or free_name(f"{self.links[holder]}_joint{suffix}", taken))

    @functools.cached_property
    def ground(self) -> list[int]:
        """Geoms of the world that a floating robot can stand on: the planes, or all if none is a plane."""
        model = self.model
        fixed = np.flatnonzero(model.body_weldid[model.geom_bodyid] == 0) if self.is_floating else ()
        solid = [int(n) for n in fixed if model.geom_contype[n] | model.geom_conaffinity[n]]
        return [n for n in solid if model.geom_type[n] == mujoco.mjtGeom.mjGEOM_PLANE] or solid

    def grounds(self, geom: int) -> list[int]:
        """Return the geoms of the ground that a geom can touch."""
        types, affinities = self.model.geom_contype, self.model.geom_conaffinity
        return [n for n in self.ground if types[geom] & affinities[n] | types[n] & affinities[geom]]

    def touches(self, geom: int) -> bool:
        """Return whether a geom can touch the ground; in a model without ground, whether it can touch anything."""
        is_solid = bool(self.model.geom_contype[geom] | self.model.geom_conaffinity[geom])
        return geom in self.ground or (bool(self.grounds(geom)) if self.ground else is_solid)

    def line(self, kind: str, number: int) -> int:
        """Return the line of an element in the document's text; 0 if MuJoCo made the element."""
        if kind == "key":  # MuJoCo does not say it
            lines = [n for n, line in enumerate(self.document.text.split("\n"), 1) if line.startswith("<key ")]
            return lines[number] if number < len(lines) else 0
        return _line_in(getattr(self._elements[kind].get(number), "info", ""))

    def element(self, kind: str, number: int) -> Any:
        """Return an element of the `MjSpec`, or the options."""
        return self.model.opt if kind == "option" else self._elements[kind][number]

    def unusual(self, kind: str, number: int, others: Collection[str]) -> Iterator[str]:
        """Yield the attributes of an element that differ from MuJoCo's default, beside the `others`."""
        element, usual = self.element(kind, number), self._usual[kind]
        for name in dir(type(element)):
            if name[0] == "_" or name in others or not isinstance(value := getattr(element, name), _NUMBERS):
                continue
            # as texts, since "not a number" is a default
            if str(value) != str(getattr(usual, name)):
                yield name

    def name(self, kind: str, number: int) -> str:
        """Return the name of an element; empty for an element without a name."""
        return mujoco.mj_id2name(self.model, getattr(mujoco.mjtObj, f"mjOBJ_{kind.upper()}"), number) or ""

    def joints_of(self, body: int) -> Iterator[int]:
        """Yield the joints of a body that move it against its parent; the free joint of the root is none."""
        first = self.model.body_jntadr[body]
        for joint in range(first, first + self.model.body_jntnum[body]):
            if not (self.is_floating and body == self.root):
                yield joint

    def geoms_of(self, body: int) -> range:
        """Return the geoms of a body."""
        first = int(self.model.body_geomadr[body])
        return range(first, first + int(self.model.body_geomnum[body]))

    def ends(self, equality: int) -> tuple[int, ...]:
        """Return the bodies that an equality of bodies, sites or joints holds together."""
        model, is_of = self.model, int(self.model.eq_objtype[equality])
        if model.eq_type[equality] == mujoco.mjtEq.mjEQ_JOINT:
            bodies = model.jnt_bodyid
        else:  # other objects are tendons and flexes
            bodies = {_SITE: model.site_bodyid, _BODY: range(model.nbody)}.get(is_of, ())
        ids = (int(model.eq_obj1id[equality]), int(model.eq_obj2id[equality]))
        return tuple(int(bodies[number]) for number in ids if number >= 0 and len(bodies))

    def _join(self, tops: Iterable[int]) -> list[set[int]]:
        """Return groups of topmost bodies: active equalities join those of a group."""
        model, groups = self.model, [{top} for top in tops]
        for number in range(model.neq):
            pair = {int(model.body_rootid[end]) for end in self.ends(number)} if model.eq_active0[number] else set()
            joined = [group for group in groups if group & pair]
            if len(joined) > 1:
                groups = [group for group in groups if group not in joined] + [set().union(*joined)]
        return sorted(groups, key=min)

    def _choose(self, body: str) -> set[int]:
        """Return the robot's topmost bodies, or the world. Raises TranslationError."""
        model, place = self.model, self.document.place(0)
        tops = [number for number in range(1, model.nbody) if model.body_parentid[number] == 0]
        names = {self.name("body", top) or f"body number {top}": top for top in tops}
        if body:
            if body not in (names := {WORLD: 0, **names}):
                near = nearest(body, list(names))
                hint = f"perhaps {near!r} is meant" if near else f"choose one of {listed(list(names))}"
                raise TranslationError(f"there is no body {body!r} below the world", place, hint)
            return {names[body]}
        moved = model.body_rootid[model.jnt_bodyid]  # the topmost body of each joint
        moving = {name: top for name, top in names.items() if top in moved}
        inside = moved[model.jnt_type != mujoco.mjtJoint.mjJNT_FREE]
        articulated = {name: top for name, top in moving.items() if top in inside}
        candidates = articulated or moving
        if not candidates:
            message = "the model has no joint: nothing in it moves" if tops else "the model has no body"
            raise TranslationError(message, place, "name the file that has the robot")
        robots = self._join(candidates.values())
        if len(robots) > 1:
            firsts = [name for name, top in candidates.items() if top in map(min, robots)]
            message, first = f"the model has {len(robots)} robots: {listed(firsts)}", firsts[0]
            hint = (
                f'choose one by `arguments = {{ body = "{first}" }}` (`init FILE body:={first}`), or all by "{WORLD}"'
            )
            raise TranslationError(message, place, hint)
        return robots[0]


def read_scene(document: MjcfDocument, body: str = "", *, with_meshes: bool = False) -> MujocoScene:
    """Compile a document, and choose its robot; `with_meshes`: also those that no number follows from.

    Raises TranslationError.
    """
    # MuJoCo would write its warnings into a file of the working folder
    mujoco.set_mju_user_warning(lambda _: None)
    try:
        spec = mujoco.MjSpec.from_string(
            document.text,
            include={name: text.encode() for name, text in document.models.items()},
            assets=document.contents,
        )
        if (count := len(spec.bodies)) > _MOST_BODIES:
            message = f"the model has {count:,} bodies, and urdfsync reads up to {_MOST_BODIES:,}"
            raise TranslationError(message, document.place(0))
        if not with_meshes and not _needs_meshes(
            spec, document
        ):  # MuJoCo would find the hull of each: half of the time of a translation
            document = document._replace(meshes={f"{name}.obj": path for name, path in document.meshes.items()})
            spec.assets = dict.fromkeys(document.meshes, _CUBE)
            for mesh in spec.meshes:
                mesh.file += ".obj" if mesh.file else ""
        model = spec.compile()
    except (ValueError, mujoco.FatalError) as error:
        raise _in_words(document, str(error)) from None
    return MujocoScene(document, spec, model, body)


def _needs_meshes(spec: Any, document: MjcfDocument) -> bool:
    """Return whether a number of the robot follows from the content of a mesh: a mass, or the size of a shape."""
    if any(' inertiafromgeom="true"' in text for text in (document.text, *document.models.values())):
        return True
    fitted = any(geom.meshname and geom.type != mujoco.mjtGeom.mjGEOM_MESH for geom in spec.geoms)
    weighed = (body for body in spec.bodies if body.name != WORLD and not body.explicitinertial)
    return fitted or any(geom.meshname for body in weighed for geom in body.geoms)


def _line_in(text: str) -> int:
    """Return the number of a line in MuJoCo's words; 0 for none."""
    return next((int(found[2]) for found in _LINE.finditer(text) if found[2]), 0)


def _in_words(document: MjcfDocument, text: str) -> TranslationError:
    """Return MuJoCo's error with the user's file and line."""
    words = " ".join(_LINE.sub(lambda found: found[1] or "", text).split())
    words = words.removeprefix("XML Error: ").removeprefix("Error: ")
    words = words.replace(" Element ", ", element ").rstrip(" ,")
    for name, path in document.meshes.items():
        words = words.replace(f"'{name}'", path)
    hint = f"correct it: MuJoCo {mujoco.__version__} does not know it" if ": unrecognized" in text else ""
    return TranslationError(f"MuJoCo: {words}", document.place(_line_in(text)), hint)
