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

from urdfsync.common.spelling import nearest
from urdfsync.formats.sdf.document import SdfDocument, SdfVersion
from urdfsync.formats.translation.files import TranslationError
from urdfsync.formats.urdf.kinematics.poses import IDENTITY, Pose, compose, inverse

WORLD = "world"
_MODEL = "__model__"
_NAMED = ("link", "frame", "joint")
_MOST_FRAMES = 20_000
"""The most links, joints, frames and models. The largest robots have 500."""


class Frame:
    """The frame of a link, joint, `<frame>`, model or world. Models and worlds have parts, and names of these."""

    def __init__(self, kind: str, name: str, element: Element, scope: Frame | None, version: SdfVersion = ()) -> None:
        self.kind = kind
        self.name = name
        """The name in the whole model, such as `arm::wrist`."""
        self.element: Element = element
        """The element with the pose: of an included model the `<include>`."""
        self.content = element
        """The element with the parts."""
        self.scope = scope or self
        """The model or world around it: names in its element are looked up there."""
        self.version = version
        self.prefix = ""
        """The names of the models around an element in it, such as `arm::`."""
        self.names: dict[str, Frame] = {}
        self.parts: list[Frame] = []
        """Links, joints and frames."""
        self.models: list[Frame] = []
        self.link: Frame | None = None
        """The link, or the world, with which it moves, once this is known."""
        self.base: tuple[Frame, Pose] | None = None
        """The frame in which its pose is given, and the pose, once these are known."""

    @property
    def static_holder(self) -> Element:
        """The element that says whether the model is static: the `<include>` if it does, else the model."""
        return self.content if self.element.find("static") is None else self.element

    def each(self) -> Iterator[Frame]:
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
        if len(worlds) > 1:
            message = f"the file has {len(worlds)} worlds"
            raise document.fault(worlds[1], message, "write each into a file of its own")
        self.world = Frame("world", WORLD, worlds[0] if worlds else root, None, version)
        self._count, self._busy = 0, set[Frame]()
        self._known = {self.world}
        """Frames with a pose in the world."""
        self._read(self.world, (document.source,))

    def _add(self, scope: Frame, frame: Frame, name: str) -> None:
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

    def _read(self, scope: Frame, around: tuple[str, ...]) -> None:
        """Read the elements of a model or world; `around` are the files that include it. Raises TranslationError."""
        for tag in _NAMED:
            for element in scope.content.iterfind(tag):
                name = self.document.name(element)
                frame = Frame(tag, scope.prefix + name, element, scope)
                self._add(scope, frame, name)
                scope.parts.append(frame)
            if tag == "link":
                for element in [child for child in scope.content if child.tag in ("model", "include")]:
                    self._read_model(scope, element, around)

    def _read_model(self, outer: Frame, element: Element, around: tuple[str, ...]) -> None:
        content, version, path = element, outer.version, ""
        if element.tag == "include":
            try:
                content, version, path = self._included(element, around)
            except TranslationError as error:
                fault = error.problem("")  # a fault inside of the file counts always
                if outer is not self.world or (fault.file, fault.line) != self.document.places[element]:
                    raise
                self.missing.append(error)
                return
        is_merged = element.get("merge", "").strip().lower() in ("true", "1") and outer is not self.world
        name = (element.findtext("name", "") if element.tag == "include" else "").strip() or self.document.name(content)
        model = Frame("model", outer.prefix + name, element, outer, version)
        model.content = content
        if outer is not self.world:  # a robot's own names need no prefix
            model.prefix = outer.prefix if is_merged else f"{outer.prefix}{name}::"
        if is_merged:
            model.names = outer.names
            name = f"_merged__{name}__model__"
        self._add(outer, model, name)
        outer.models.append(model)
        self._read(model, (*around, path) if path else around)

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

    def look_up(self, scope: Frame, name: str, element: Element) -> Frame:
        """Return the frame with a name in a scope; `element` has the name. Raises TranslationError."""
        # before SDF 1.7, a part could have one of the two names: then the name stands for the part
        found, rest = scope.names.get(name) or {_MODEL: scope, WORLD: self.world}.get(name), name
        inner: Frame | None = scope
        while found is None and inner is not None and "::" in rest:
            first, _, rest = rest.partition("::")
            inner = inner.names.get(first)
            if inner is not None and inner.kind == "model":
                found = inner if rest == _MODEL else inner.names.get(rest)
        if found is None:
            near = nearest(name, list(scope.names))
            hint = f"perhaps {near!r} is meant" if near else "name a link, joint, frame or model of the same model"
            place = "the world" if scope is self.world else f"model {scope.name!r}"
            raise self.document.fault(element, f"there is no frame {name!r} in {place}", hint)
        return found

    def named(self, frame: Frame, tag: str) -> Frame:
        """Return the frame that the `<parent>` or `<child>` of a joint names. Raises TranslationError."""
        name = frame.element.findtext(tag, "").strip()
        if not name:
            raise self.document.fault(frame.element, f"joint {frame.name!r} has no <{tag}>")
        return self.look_up(frame.scope, name, frame.element)

    def given_in(self, scope: Frame, element: Element, default: Frame) -> Frame:
        """Return the frame in which the pose of an element is given. Raises TranslationError."""
        pose = element.find("pose")
        if pose is None:
            return default
        word = pose.get("relative_to") or (pose.get("frame") if scope.version < (1, 7) else "")
        return self.look_up(scope, word, pose) if word else default

    def link_of(self, frame: Frame) -> Frame:
        """Return the link, or the world, with which a frame moves. Raises TranslationError."""
        passed, end = dict[Frame, None](), frame
        while end.kind not in ("link", "world") and end.link is None:
            if end in passed:
                message = f"the frame of {end.kind} {end.name!r} is attached to itself"
                raise self.document.fault(end.element, message)
            passed[end] = None
            if end.kind == "joint":
                end = self.named(end, "child")
            elif end.kind == "frame":
                end = self.look_up(end.scope, end.element.get("attached_to", "") or _MODEL, end.element)
            else:
                end = self._canonical(end)
        for each in passed:
            each.link = end.link or end
        return end.link or end

    def _canonical(self, model: Frame) -> Frame:
        """Return the canonical link of a model, or a frame that moves with it. Raises TranslationError."""
        if name := model.content.get("canonical_link", ""):
            return self.look_up(model, name, model.content)
        links = {part.element: part for part in model.parts if part.kind == "link"}
        # links of a merged model count where its <include> stands
        links |= {inner.element: inner for inner in model.models if inner.names is model.names}
        first = next((links[element] for element in model.content if element in links), None)
        if first is None and not model.models:
            raise self.document.fault(model.element, f"model {model.name!r} has no link")
        return first or model.models[0]

    def _base(self, frame: Frame) -> tuple[Frame, Pose]:
        """Return the frame in which the pose of a frame is given, and the pose. Raises TranslationError."""
        if frame.base is not None:
            return frame.base
        if frame in self._busy:
            raise self._circle(frame)
        self._busy.add(frame)
        scope, element, content = frame.scope, frame.element, frame.content
        default = scope
        if frame.kind == "joint":
            default = self.named(frame, "child")
        elif frame.kind == "frame" and (name := element.get("attached_to", "")):
            default = self.look_up(scope, name, element)
        # the pose of an `<include>` replaces that of its model
        is_silent = element is not content and element.find("pose") is None
        base = default if is_silent else self.given_in(scope, element, default)
        place = self.document.pose(content if is_silent else element)
        name = element.findtext("placement_frame", "").strip() or content.get("placement_frame", "")
        if name and frame.kind == "model":  # the pose is that of this frame
            place = compose(place, inverse(self.pose(self.look_up(frame, name, element), frame)))
        frame.base = base, place
        return frame.base

    def _circle(self, frame: Frame) -> TranslationError:
        message = f"the pose of {frame.kind} {frame.name!r} is given in its own frame, by a circle"
        return self.document.fault(frame.element, message)

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
                raise self._circle(frame)
            poses[frame] = place
            if frame in ends or frame.kind == "world":
                return poses
            frame, step = self._base(frame)
            place = compose(step, place)
