"""The frames of an SDF: who is attached to whom, and which pose is given in which frame.

Rules are those of SDF 1.7 and newer (sdformat.org, "Pose Frame Semantics"), with the defaults of older versions: an
axis of SDF 1.4 is given in the frame of the model, and `pose/@frame` is an old word for `relative_to`. Poses are those
with all joints at zero. A name is looked up in the model of its element; `arm::wrist` is in the nested model `arm`.

An `<include>` is a nested model. With `merge="true"`, its elements have names in the model around it, and an own model
frame, as libsdformat's `_merged__NAME__model__`.
"""

from __future__ import annotations

from collections.abc import Container, Iterator
from xml.etree.ElementTree import Element

from urdfsync.sdf.document import SdfDocument, SdfVersion
from urdfsync.spelling import nearest
from urdfsync.translation.files import TranslationError
from urdfsync.urdf.kinematics.poses import IDENTITY, Pose, compose, inverse

WORLD = "world"
_MODEL = "__model__"
_NAMED = ("link", "frame", "joint")
_MOST_FRAMES = 20_000
"""The most links, joints, frames and models. The largest robots have 500."""


class Frame:
    """The frame of a link, joint, `<frame>`, model or world."""

    def __init__(self, kind: str, name: str, element: Element, scope: Scope) -> None:
        self.kind, self.element = kind, element
        self.name = name
        """The name in the whole model, such as `arm::wrist`."""
        self.scope = scope
        """The model around it: names in its element are looked up there."""
        self.inner: Scope | None = None
        """The elements of a model."""
        self.link: Frame | None = None
        """The link, or the world, with which it moves, once this is known."""
        self.base: tuple[Frame, Pose] | None = None
        """The frame in which its pose is given, and the pose, once these are known."""


class Scope:
    """The elements of a model, or of a world."""

    def __init__(self, element: Element, version: SdfVersion, prefix: str = "") -> None:
        self.element, self.version = element, version
        self.prefix = prefix
        """The names of the models around an element, such as `arm::`."""
        self.holder: Element = element
        """The element with pose and settings of the model: the model, or its `<include>`."""
        self.names: dict[str, Frame] = {}
        self.own: Frame
        """The model's frame."""
        self.parts: list[Frame] = []
        """Links, joints and frames."""
        self.models: list[Scope] = []

    @property
    def static_holder(self) -> Element:
        """The element that says whether the model is static: the `<include>` if it does, else the model."""
        return self.element if self.holder.find("static") is None else self.holder

    def each(self) -> Iterator[Scope]:
        """Yield this model and all models in it."""
        yield self
        for model in self.models:
            yield from model.each()

    def of_kind(self, kind: str) -> Iterator[Frame]:
        """Yield the links, joints or frames of the model and of all models in it."""
        for scope in self.each():
            yield from (part for part in scope.parts if part.kind == kind)


class Frames:
    """Reads the models of an SDF, and resolves their frames."""

    def __init__(self, document: SdfDocument) -> None:
        self.document = document
        self.missing: list[TranslationError] = []
        """Faults of includes in a world: scenery may be absent."""
        root, version = document.read(document.source)
        worlds = root.findall("world")
        holder = worlds[0] if worlds else root
        if len(worlds) > 1:
            message = f"the file has {len(worlds)} worlds"
            raise document.fault(worlds[1], message, "write each into a file of its own")
        self.top = Scope(holder, version)
        self.top.own = self.world = Frame("world", WORLD, holder, self.top)
        self._count, self._busy = 0, list[Frame]()
        self._known = {self.world}
        """Frames with a pose in the world."""
        self._read(self.top, (document.source,))

    def _add(self, scope: Scope, frame: Frame, name: str) -> None:
        """Give a frame its name in a scope. Raises TranslationError."""
        self._count += 1
        if self._count > _MOST_FRAMES:
            raise self.document.fault(frame.element, f"the model has more than {_MOST_FRAMES:,} elements with a name")
        is_special = name == WORLD or (len(name) > 3 and name.startswith("__") and name.endswith("__"))
        if is_special and scope.version >= (1, 7):
            raise self.document.fault(frame.element, f"the name {name!r} is reserved", f"rename the <{frame.kind}>")
        other = scope.names.setdefault(name, frame)
        # before SDF 1.7, a joint could have the name of a link: then the name stands for the link
        if other is not frame and (other.kind == frame.kind or scope.version >= (1, 7)):
            line = self.document.places[other.element][1]
            message = f"{frame.kind} {name!r} has the name of the {other.kind} in line {line}"
            raise self.document.fault(frame.element, message, "give each part of a model a name of its own")

    def _read(self, scope: Scope, around: tuple[str, ...]) -> None:
        """Read the elements of a model or world; `around` are the files that include it. Raises TranslationError."""
        for tag in _NAMED:
            for element in scope.element.iterfind(tag):
                name = self.document.name(element)
                frame = Frame(tag, scope.prefix + name, element, scope)
                self._add(scope, frame, name)
                scope.parts.append(frame)
            if tag == "link":
                for element in [child for child in scope.element if child.tag in ("model", "include")]:
                    self._read_model(scope, element, around)

    def _read_model(self, outer: Scope, element: Element, around: tuple[str, ...]) -> None:
        model, version, path = element, outer.version, ""
        if element.tag == "include":
            try:
                model, version, path = self._included(element, around)
            except TranslationError as error:
                fault = error.problem("")  # a fault inside of the file counts always
                if outer is not self.top or (fault.file, fault.line) != self.document.places[element]:
                    raise
                self.missing.append(error)
                return
        is_merged = element.get("merge", "").strip().lower() in ("true", "1") and outer is not self.top
        name = (element.findtext("name", "") if element.tag == "include" else "").strip() or self.document.name(model)
        inner = Scope(model, version, outer.prefix if is_merged else f"{outer.prefix}{name}::")
        inner.holder = element
        inner.own = Frame("model", outer.prefix + name, element, outer)
        inner.own.inner = inner
        if is_merged:
            inner.names = outer.names
            name = f"_merged__{name}__model__"
        if outer is self.top:  # a robot's own names need no prefix
            inner.prefix = ""
        self._add(outer, inner.own, name)
        outer.models.append(inner)
        self._read(inner, (*around, path) if path else around)

    def _included(self, element: Element, around: tuple[str, ...]) -> tuple[Element, SdfVersion, str]:
        """Return the model in the file of an `<include>`, its version and its file. Raises TranslationError."""
        uri = element.findtext("uri", "").strip()
        if not uri:
            raise self.document.fault(element, "<include> has no <uri>")
        path = self.document.find(element, uri)
        if path in around:
            raise self.document.fault(element, f"{path} includes itself", "take one <include> out")
        root, version = self.document.read(path, self.document.places[element])
        models = root.findall("model")
        if len(models) != 1:
            message = f"{path} has {len(models)} models, and <include> needs one"
            raise self.document.fault(element, message)
        return models[0], version, path

    def look_up(self, scope: Scope, name: str, element: Element) -> Frame:
        """Return the frame with a name in a scope; `element` has the name. Raises TranslationError."""
        # before SDF 1.7, a part could have one of the two names: then the name stands for the part
        found, rest = scope.names.get(name) or {_MODEL: scope.own, WORLD: self.world}.get(name), name
        inner: Scope | None = scope
        while found is None and inner is not None and "::" in rest:
            first, _, rest = rest.partition("::")
            step = inner.names.get(first)
            inner = step.inner if step else None
            if inner is not None:
                found = inner.own if rest == _MODEL else inner.names.get(rest)
        if found is None:
            near = nearest(name, list(scope.names))
            hint = f"perhaps {near!r} is meant" if near else "name a link, joint, frame or model of the same model"
            raise self.document.fault(element, f"there is no frame {name!r} in {self._shown(scope)}", hint)
        return found

    def _shown(self, scope: Scope) -> str:
        return "the world" if scope is self.top else f"model {scope.own.name!r}"

    def named(self, frame: Frame, tag: str) -> Frame:
        """Return the frame that the `<parent>` or `<child>` of a joint names. Raises TranslationError."""
        name = frame.element.findtext(tag, "").strip()
        if not name:
            raise self.document.fault(frame.element, f"joint {frame.name!r} has no <{tag}>")
        return self.look_up(frame.scope, name, frame.element)

    def given_in(self, scope: Scope, element: Element, default: Frame) -> Frame:
        """Return the frame in which the pose of an element is given. Raises TranslationError."""
        pose = element.find("pose")
        if pose is None:
            return default
        word = pose.get("relative_to") or (pose.get("frame") if scope.version < (1, 7) else "")
        return self.look_up(scope, word, pose) if word else default

    def link_of(self, frame: Frame) -> Frame:
        """Return the link, or the world, with which a frame moves. Raises TranslationError."""
        if frame.kind in ("link", "world"):
            return frame
        if frame.link is None:
            self._enter(frame, f"the frame of {frame.kind} {frame.name!r} is attached to itself")
            if frame.kind == "joint":
                base = self.named(frame, "child")
            elif frame.kind == "frame":
                base = self.look_up(frame.scope, frame.element.get("attached_to", "") or _MODEL, frame.element)
            else:
                base = self._canonical(frame)
            frame.link = self.link_of(base)
            self._busy.remove(frame)
        return frame.link

    def _canonical(self, frame: Frame) -> Frame:
        """Return the canonical link of a model, or a frame that moves with it. Raises TranslationError."""
        inner = frame.inner
        if inner is not None and (name := inner.element.get("canonical_link", "")):
            return self.look_up(inner, name, inner.element)
        links = {part.element: part for part in inner.parts if part.kind == "link"} if inner else {}
        models = inner.models if inner else []
        if inner is not None:  # links of a merged model count where its <include> stands
            links |= {model.holder: model.own for model in models if model.names is inner.names}
        first = next((links[element] for element in inner.element if element in links), None) if inner else None
        if first is None and not models:
            raise self.document.fault(frame.element, f"model {frame.name!r} has no link")
        return first or models[0].own

    def _enter(self, frame: Frame, message: str) -> None:
        if frame in self._busy:
            raise self.document.fault(frame.element, message)
        self._busy.append(frame)

    def _base(self, frame: Frame) -> tuple[Frame, Pose]:
        """Return the frame in which the pose of a frame is given, and the pose. Raises TranslationError."""
        if frame.base is None:
            self._enter(frame, f"the pose of {frame.kind} {frame.name!r} is given in its own frame, by a circle")
            frame.base = self._find_base(frame)
            self._busy.remove(frame)
        return frame.base

    def _find_base(self, frame: Frame) -> tuple[Frame, Pose]:
        scope, element = frame.scope, frame.element
        if frame.kind == "joint":
            default = self.named(frame, "child")
        elif frame.kind == "frame" and (name := element.get("attached_to", "")):
            default = self.look_up(scope, name, element)
        else:
            default = scope.own
        inner = frame.inner
        if inner is None:
            return self.given_in(scope, element, default), self.document.pose(element)
        # the pose of an `<include>` replaces that of its model
        is_silent = element is not inner.element and element.find("pose") is None
        base = default if is_silent else self.given_in(scope, element, default)
        place = self.document.pose(inner.element if is_silent else element)
        name = element.findtext("placement_frame", "").strip() or inner.element.get("placement_frame", "")
        if name:  # the pose is that of this frame
            place = compose(place, inverse(self.pose(self.look_up(inner, name, element), frame)))
        return base, place

    def pose(self, frame: Frame, base: Frame) -> Pose:
        """Return the pose of a frame in another frame, with all joints at zero. Raises TranslationError.

        Frames that both have in common are left out, so that numbers stay as written where one is given in the other.
        """
        passed = self._climb(frame, (base,))
        if base in passed:
            return passed[base]
        back = self._climb(base, passed)
        common = next(frame for frame in back if frame in passed)
        return compose(inverse(back[common]), passed[common])

    def check(self, frame: Frame) -> None:
        """Raise TranslationError if a frame has no pose in the world, even if nothing uses it."""
        self._known |= self._climb(frame, self._known).keys()

    def _climb(self, frame: Frame, ends: Container[Frame]) -> dict[Frame, Pose]:
        """Return the pose of a frame in itself, in the frame in which it is given, and so on up to one of the ends.

        Without a way to an end, the last frame is the world. Raises TranslationError.
        """
        place, poses = IDENTITY, dict[Frame, Pose]()
        while True:
            if frame in poses:
                message = f"the pose of {frame.kind} {frame.name!r} is given in its own frame, by a circle"
                raise self.document.fault(frame.element, message)
            poses[frame] = place
            if frame in ends or frame.kind == "world":
                return poses
            frame, step = self._base(frame)
            place = compose(step, place)
