"""Reads the text of an MJCF with MuJoCo, chooses the robot in it, and names its parts."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import mujoco

from urdfsync.mjcf.document import MjcfDocument
from urdfsync.spelling import nearest
from urdfsync.translation.files import TranslationError
from urdfsync.translation.writer import free_name

WORLD = "world"
_MOST_BODIES = 2_000
"""The most bodies of a robot: a package has two files for each."""
_LINE = re.compile(r"('[^']*')|\(?\bline (\d+)\)?")
"""A name in quotes, or the number of a line."""
_KINDS = {
    "body": (mujoco.mjtObj.mjOBJ_BODY, "bodies"),
    "joint": (mujoco.mjtObj.mjOBJ_JOINT, "joints"),
    "geom": (mujoco.mjtObj.mjOBJ_GEOM, "geoms"),
    "site": (mujoco.mjtObj.mjOBJ_SITE, "sites"),
    "equality": (mujoco.mjtObj.mjOBJ_EQUALITY, "equalities"),
    "tendon": (mujoco.mjtObj.mjOBJ_TENDON, "tendons"),
    "actuator": (mujoco.mjtObj.mjOBJ_ACTUATOR, "actuators"),
    "sensor": (mujoco.mjtObj.mjOBJ_SENSOR, "sensors"),
    "key": (mujoco.mjtObj.mjOBJ_KEY, "keys"),
    "pair": (mujoco.mjtObj.mjOBJ_PAIR, "pairs"),
    "plugin": (mujoco.mjtObj.mjOBJ_PLUGIN, "plugins"),
    "flex": (mujoco.mjtObj.mjOBJ_FLEX, "flexes"),
}
"""Kinds of elements, with MuJoCo's type of object and the list of a `MjSpec`."""
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
        self._elements = {kind: {one.id: one for one in getattr(spec, name)} for kind, (_, name) in _KINDS.items()}
        self.root = self._choose(body)
        self.is_floating = self.root > 0 and bool(model.body_jntnum[self.root]) and self._is_free(self.root)
        self.bodies = [number for number in range(model.nbody) if self._is_below(number)]
        """The bodies of the robot, parents first. Without a free joint, the world is the first of them."""
        if not self.is_floating:
            self.bodies = list(dict.fromkeys([0, *self.bodies]))
        self.links = self._name_all("body", model.nbody, self._name_of_body)
        """Names of all bodies."""
        self.joints = self._name_all("joint", model.njnt, self._name_of_joint)
        """Names of all joints."""

    def line(self, kind: str, number: int) -> int:
        """Return the line of an element in the document's text; 0 if MuJoCo made the element."""
        return _line_in(getattr(self._elements[kind].get(number), "info", ""))

    def element(self, kind: str, number: int) -> Any:
        """Return an element of the `MjSpec`."""
        return self._elements[kind][number]

    def name(self, kind: str, number: int) -> str:
        """Return the name of an element; empty for an element without a name."""
        of_mujoco, _ = _KINDS[kind]
        return mujoco.mj_id2name(self.model, of_mujoco, number) or ""

    def joints_of(self, body: int) -> Iterator[int]:
        """Yield the joints of a body that move it against its parent; the free joint of the root is none."""
        first = self.model.body_jntadr[body]
        for joint in range(first, first + self.model.body_jntnum[body]):
            if not (self.is_floating and body == self.root):
                yield joint

    def _choose(self, body: str) -> int:
        """Return the robot's topmost body, or the world. Raises TranslationError."""
        model, place = self.model, self.document.place(0)
        tops = [number for number in range(1, model.nbody) if model.body_parentid[number] == 0]
        names = {self.name("body", top) or f"body number {top}": top for top in tops}
        if body:
            if body not in (names := {WORLD: 0, **names}):
                near = nearest(body, list(names))
                hint = f"perhaps {near!r} is meant" if near else f"choose one of {_listed(list(names))}"
                raise TranslationError(f"there is no body {body!r} below the world", place, hint)
            return names[body]
        moving = {name: top for name, top in names.items() if self._moves(top)}
        articulated = {name: top for name, top in moving.items() if self._moves(top, beyond_free=True)}
        candidates = articulated or moving
        if not candidates:
            message = "the model has no joint: nothing in it moves" if tops else "the model has no body"
            raise TranslationError(message, place, "name the file that has the robot")
        if len(candidates) > 1:
            message = f"the model has {len(candidates)} robots: {_listed(list(candidates))}"
            first = next(iter(candidates))
            hint = (
                f'choose one by `arguments = {{ body = "{first}" }}` (`init FILE body:={first}`), or all by "{WORLD}"'
            )
            raise TranslationError(message, place, hint)
        return next(iter(candidates.values()))

    def _moves(self, top: int, *, beyond_free: bool = False) -> bool:
        """Return whether a joint moves a body, or one below it; `beyond_free`: a joint that is not free."""
        model = self.model
        for joint in range(model.njnt):
            body = model.jnt_bodyid[joint]
            if model.body_rootid[body] == top and not (
                beyond_free and model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_FREE
            ):
                return True
        return False

    def _is_free(self, body: int) -> bool:
        return bool(self.model.jnt_type[self.model.body_jntadr[body]] == mujoco.mjtJoint.mjJNT_FREE)

    def _is_below(self, body: int) -> bool:
        return self.root in (0, self.model.body_rootid[body])

    def _name_all(self, kind: str, count: int, made: Callable[[int, Sequence[str]], str]) -> Sequence[str]:
        """Return the names of all elements of a kind; `made` names one by its place, after those before it."""
        given = [self.name(kind, number) for number in range(count)]
        taken, names = {*given}, list[str]()
        for number in range(count):  # parents come before children
            names.append(given[number] or free_name(made(number, names), taken))
        return names

    def _name_of_body(self, number: int, names: Sequence[str]) -> str:
        parents = self.model.body_parentid
        place = sum(parents[other] == parents[number] for other in range(1, number + 1))
        return f"{names[parents[number]]}_body{place}"

    def _name_of_joint(self, number: int, _: Sequence[str]) -> str:
        body = self.model.jnt_bodyid[number]
        place = number - self.model.body_jntadr[body] + 1
        return f"{self.links[body]}_joint{place if self.model.body_jntnum[body] > 1 else ''}"


def read_scene(document: MjcfDocument, body: str = "") -> MujocoScene:
    """Compile a document, and choose its robot. Raises TranslationError."""
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
        if not _needs_meshes(spec):  # MuJoCo would find the hull of each: half of the time of a translation
            document = document._replace(meshes={f"{name}.obj": path for name, path in document.meshes.items()})
            spec.assets = dict.fromkeys(document.meshes, _CUBE)
            for mesh in spec.meshes:
                mesh.file += ".obj" if mesh.file else ""
        model = spec.compile()
    except (ValueError, mujoco.FatalError) as error:
        raise _in_words(document, str(error)) from None
    return MujocoScene(document, spec, model, body)


def _needs_meshes(spec: Any) -> bool:
    """Return whether a number of the robot follows from the content of a mesh: a mass, or the size of a shape."""
    if spec.compiler.inertiafromgeom == mujoco.mjtInertiaFromGeom.mjINERTIAFROMGEOM_TRUE:
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
    hint = f"correct it, or install a newer MuJoCo than {mujoco.__version__}" if "Schema violation" in text else ""
    return TranslationError(f"MuJoCo: {words}", document.place(_line_in(text)), hint)


def _listed(names: Sequence[str]) -> str:
    """Return names in quotes, the first eight of them."""
    return ", ".join(map(repr, names[:8])) + (", …" if len(names) > 8 else "")
