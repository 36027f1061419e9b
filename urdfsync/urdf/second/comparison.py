"""Compares the texts of a package with the second reading of its source."""

from __future__ import annotations

import math
import re
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from urdfsync.checks.experiment import Difference, Numbers, Sample
from urdfsync.diagnostics import SourceError
from urdfsync.domain import further_key
from urdfsync.modelica.literals import string
from urdfsync.modelica.values import Value, literals, read_values
from urdfsync.spelling import counted
from urdfsync.urdf.second.classes import Classes, RobotModel, Texts, groups
from urdfsync.urdf.second.models import FREE
from urdfsync.urdf.second.reading import (
    INF,
    MOVES,
    TENSOR,
    ZERO,
    Element,
    Reading,
    Stated,
    origin,
    poses,
    read_again,
    same,
)
from urdfsync.urdf.second.tables import expected_tables

_RECORDS = "UrdfSync.Records."
_SHAPE = re.compile(r"((?:visual|collision)\d+)(?:_\d+)?(\.|Corners)")
_NO_MASS = {
    **dict.fromkeys(("inertial.origin.xyz", "inertial.origin.rpy"), ZERO),
    **{f"inertial.{path}": (0.0,) for path in ("mass", *(f"inertia.{part}" for part in TENSOR))},
}
"""Values in the record of a massless link."""
_CLOSED = 1e-6
"""The greatest gap of a closed loop, in m."""


def compare_numbers(sample: Sample, packages: Sequence[Mapping[str, bytes]]) -> list[Numbers]:
    """Compare records, robot model and benches of packages. Raises SourceError if the second reader fails."""
    with np.errstate(all="ignore"):  # source or edits may have infinite numbers
        try:
            content = sample.content
            if sample.parts:
                from urdfsync.urdf.second.beside import join_again  # saves most robots 40 ms

                content = join_again(sample.parts, sample.options)
            reading = read_again(content, sample.options)
            first = _Comparison(packages[0], reading, sample).numbers()
            others = packages[1:]  # equal if there are no edits: saves 0.1 s with 70 links
            return [first, *[first if o == packages[0] else _Comparison(o, reading, sample).numbers() for o in others]]
        except (
            ArithmeticError,
            AttributeError,
            LookupError,
            RuntimeError,
            StopIteration,
            TypeError,
            ValueError,
        ) as error:
            message = f"the second reader fails: {type(error).__name__}: {error}"
            raise SourceError.of("second-reader", message, sample.file) from None


class _Comparison:
    """Counts the values of a package's texts in `right`, `total` and `uncompared`, and lists `differences`."""

    def __init__(self, texts: Mapping[str, bytes], reading: Reading, sample: Sample) -> None:
        self.reading, self.sample, self.name = reading, sample, sample.target.name
        suffixes = ("", "Run", "Test", "Parameters", "Start", "Sensors", "Stance", "Generic")
        needed = {f"{self.name}{suffix}.mo" for suffix in suffixes}
        needed |= {path for path in texts if path.startswith("Links/") and path != "Links/package.mo"}
        needed |= {path for path in texts if path.startswith("Joints/") and path.endswith("Parameters.mo")}
        joints = reading.joints.values()
        # Pinocchio compares joints with one axis, smooth friction and rigid drives, the second reading all others
        self.has_laws = any(joint.friction not in ("", "smooth") or joint.is_elastic for joint in joints)
        if self.has_laws or reading.loops or any(joint.type in FREE for joint in joints):
            needed |= {path for path in texts if path.startswith("Joints/") and path != "Joints/package.mo"}
        self.read = {path: read_values(texts[path].decode(errors="replace")) for path in sorted(needed & texts.keys())}
        self.values = {path: each.values for path, each in self.read.items()}
        self.titles = {path: each.titles for path, each in self.read.items()}
        self.classes = Classes(self.read, reading, sample)
        self.elements, self.components = self.classes.elements, self.classes.components
        self.right = self.total = 0
        self.differences, self.uncompared = list[Difference](), Counter[str]()
        roots = reading.links.keys() - {joint.child for joint in joints}
        has_masses = any("inertial.mass" in link.values for link in reading.links.values())
        self.massless_root = None if has_masses else reading.links[next(iter(roots))]

    def numbers(self) -> Numbers:
        """Compare all files."""
        model = f"{self.name}.mo"
        for path, values in self.values.items():
            if path.startswith(("Links/", "Joints/")) and path.endswith("Parameters.mo"):
                type_ = next((value.type for value in values if value.path == "name"), "").removeprefix(_RECORDS)
                stem = path.rpartition("/")[2].removesuffix("Parameters.mo")
                self._element(path, stem[:1].lower() + stem[1:], type_, values)
        for suffix, compare in (
            *(("Parameters", self._whole), ("Sensors", self._sensors), ("Start", self._starts)),
            *(("Stance", self._stance), ("", self._model)),
        ):
            if f"{self.name}{suffix}.mo" in self.values or suffix == "Start":
                compare(f"{self.name}{suffix}.mo")
        own = self.classes
        for suffix in ("Run", "Test", "Generic"):
            if (file := f"{self.name}{suffix}.mo") in self.values:
                self._complete(file, own.texts(file), own.generic() if suffix == "Generic" else own.bench(file))
        for kind, part, component in own.parts():
            if kind == "link":
                self._complete(*own.shapes(part, component))
            elif kind == "joint" and part.type in MOVES and self.has_laws:
                self._complete(*own.laws(part, component))
            elif kind == "joint" and part.type in FREE:
                self._complete(*own.free(part, component))
            elif kind == "loop":
                self._complete(*own.closing(part, component))
        for class_ in own.library():
            self._complete(*class_)
        for kind, elements in self.elements.items():
            for name in sorted(elements.keys() - {name for of, name in self.components if of == kind}):
                if kind in ("link", "joint") or "package" in self.sample.options.approach:
                    self._compare(model, f"{kind} {name}", (), {"name": Stated(name, elements[name].line)})
        for contradiction in self.reading.contradictions:
            place = Value("elements", "", "", 0)
            self._differ(model, "robot", place, Stated(contradiction, 0), "another one by yourdfpy")
        uncompared = [f"{path} of records ({counted(n, 'number')})" for path, n in sorted(self.uncompared.items())]
        if unread := self.reading.unread:
            uncompared.insert(0, f"the reading by yourdfpy, which can't read {self.sample.file} ({unread})")
        return Numbers(self.right, self.total, tuple(self.differences), uncompared=tuple(uncompared))

    def _compare(self, file: str, element: str, values: Sequence[Value], expected: Mapping[str, Stated]) -> None:
        """Count values and compare each one. A missing value is a difference; an unexpected value is not compared."""
        given, line = {value.path for value in values}, values[0].line if values else 0
        for value in (*values, *(Value(path, "", "nothing", line) for path in expected if path not in given)):
            own, stated = _read(value.text), expected.get(value.path)
            count = len(own) if isinstance(own, tuple) else 1
            self.total += count
            if stated is None:
                self.uncompared[re.sub(r"[\d_\[\]]+", "", value.path)] += count
            elif same(stated.value, own):
                self.right += count
            else:
                if isinstance(own, tuple) and np.shape(stated.value) == np.shape(own):
                    self.right += sum(same(a, b) for a, b in zip(stated.value, own, strict=True))
                self._differ(file, element, value, stated, own)

    def _differ(self, file: str, element: str, value: Value, stated: Stated, given: Any) -> None:
        words = _shown(stated.value), _shown(given)
        place = file, value.line, self.sample.file, stated.line
        self.differences.append(Difference(element, value.path, *words, *place))

    def _element(self, file: str, component: str, type_: str, values: Sequence[Value], *, whole: bool = False) -> None:
        """Compare the record of a link, joint or loop, or its part in the record of the `whole` robot."""
        kind = {"Link": "link", "Loop": "loop"}.get(type_, "joint")
        named = next((value for value in values if value.path == "name"), Value("name", "", "", 0))
        name = str(literals(named.text))
        element = self.elements[kind].get(name)
        if element is None:
            self._compare(file, f"{kind} {name}", [named], {"name": Stated("nothing", 0)})
            return
        self.components[kind, name] = component
        shapes = [(value, _SHAPE.match(value.path)) for value in values]
        given = [value._replace(path=f"{s[1]}{s[2]}{value.path[s.end() :]}") if s else value for value, s in shapes]
        forms = {f"{s[1]}.shape": value for value, s in shapes if s and s[2] == "."}
        given += [v._replace(path=path, text=v.type.removeprefix(_RECORDS).lower()) for path, v in forms.items()]
        owners = {value.path.partition(".")[0] for value in given}
        elsewhere = ("start", "contact", "collision") if whole else ("start",)
        elsewhere = elsewhere if self.sample.options.collisions else (*elsewhere, "collision")
        expected = dict[str, Stated]()
        for path, stated in element.values.items():
            owner = path.partition(".")[0]
            # the package leaves out unreadable meshes
            is_drawn = owner in owners or f"{owner}.uri" not in element.values
            if is_drawn and not path.startswith(elsewhere):
                expected[path] = stated
        if kind == "joint":
            given.append(Value("type", "", type_, named.line))
            expected["type"] = Stated(f"{element.type.capitalize()}Joint", element.line)
        elif kind == "loop":
            expected |= _equations(element, {value.path: literals(value.text) for value in values})
        elif not whole and element is self.massless_root:  # Modelica's frames need a body: its mass is 0
            del expected["hasInertial"]
            expected |= {path: Stated(number, element.line) for path, number in _NO_MASS.items()}
        uris = {path: self._uris(stated.value) for path, stated in expected.items() if path.endswith(".uri")}
        expected |= {path: Stated(parts[0], expected[path].line) for path, parts in uris.items()}
        for k, value in enumerate(given):
            if literals(value.text) in uris.get(value.path, ()):  # a mesh may have several parts
                given[k] = value._replace(text=string(uris[value.path][0]))
        read = ((value.path, literals(value.text)) for value in given if value.path.endswith((".lower", ".upper")))
        ends = {path: numbers for path, numbers in read if isinstance(numbers, tuple)}
        for k, value in enumerate(given):  # the corners of a mesh have its bounds, to 1e-6 m and eight digits
            shape = value.path.removesuffix("Corners")
            bounds = *(ends.get(f"{shape}.lower", ())), *(ends.get(f"{shape}.upper", ()))
            if shape != value.path and len(bounds) == 6:
                box = _bounds(value)
                given[k] = value._replace(text=f"{{{', '.join(map(repr, box))}}}" if box else '"no numbers"')
                is_near = box and np.allclose(box, bounds, rtol=0, atol=1e-6 + 1e-8 * max(map(abs, bounds)))
                expected[value.path] = Stated(box if is_near else bounds, element.line)
        self._compare(file, f"{kind} {name}", given, expected)

    def _uris(self, mesh: tuple[str, Sequence[float]]) -> Sequence[str]:
        """Return the URIs of the parts of an imported mesh; for a mesh that is not imported, its key."""
        key = f"{mesh[0]} scale {' '.join(repr(float(number)) for number in mesh[1])}"
        keys, imports = [key, *(further_key(key, number) for number in range(1, 100))], self.sample.imports
        return [f"modelica://{self.sample.target.package}/{imports[k].target}" for k in keys if k in imports] or [key]

    # Records of several elements

    def _sensors(self, file: str) -> None:
        parts = defaultdict[str, list[Value]](list)
        for value in self.values[file]:
            component, _, path = value.path.partition(".")
            parts[component].append(value._replace(path=path))
        for component, values in parts.items():
            name = next((str(literals(value.text)) for value in values if value.path == "name"), "")
            self.components["sensor", name] = component
            sensor = self.reading.sensors.get(name)
            self._compare(file, f"sensor {name}", values, sensor.values if sensor else {})

    def _whole(self, file: str) -> None:
        """Compare the record of the whole robot: first its elements, then its tables."""
        parts, types, owner = defaultdict[str, list[Value]](list), dict[str, str](), ""
        own, shapes, titles = list[Value](), dict[str, tuple[str, int]](), self.titles[file]
        for value in self.values[file]:
            component, _, path = value.path.partition(".")
            type_, number = value.type.removeprefix(_RECORDS), re.match(r"Visual (\d+)", titles.get(component, ""))
            if type_ == "Robot" or type_.startswith("constant"):
                own.append(value)
            elif number:
                shapes.setdefault(component, (type_, [*types.values()].count("Link")))
                parts[owner].append(value._replace(path=f"visual{number[1]}.{path}"))
            else:
                owner = component
                types.setdefault(component, type_)
                parts[component].append(value._replace(path=path))
        for component, type_ in types.items():
            self._element(file, component, type_, parts[component], whole=True)
        elements = {component: self.elements[kind][name] for (kind, name), component in self.components.items()}
        tables = expected_tables([(elements[c], c) for c in types if c in elements], shapes)
        for value in own:
            expected = {"name": Stated(self.reading.name, 0)}
            if value.path == "standingHeight":
                expected[value.path] = self._height(value)
            if value.path in ("name", "standingHeight"):
                self._compare(file, "robot", [value], {value.path: expected[value.path]})
                continue
            items = [item for item in re.split("[,;]", re.sub(r"[\s{}]|^\[|\]$|fill.*", "", value.text)) if item]
            match = re.match('Number of joint "(.*)" in', titles.get(value.path, ""))
            column = tables.get(f"{self.components.get(('joint', match[1]))}Axis" if match else value.path)
            places = [f"{value.path}[{k}]" for k in range(1, max(len(items), len(column or ())) + 1)]
            texts = (*(column or ()), *["nothing"] * len(items))
            expected = {place: Stated(_read(text), 0) for place, text in zip(places, texts, strict=False)}
            given = [value._replace(path=place, text=item) for place, item in zip(places, items, strict=False)]
            self._compare(file, "robot", given, expected if column is not None else {})

    # Values that follow from others

    def _joint(self, component: str) -> Element | None:
        names = (name for (kind, name), other in self.components.items() if (kind, other) == ("joint", component))
        return next((self.reading.joints[name] for name in names), None)

    def _positions(self) -> dict[str, float]:
        """Return the joints' start positions: from the start record, else closest to zero within all limits."""
        joints = {name: joint for name, joint in self.reading.joints.items() if joint.type in MOVES}
        begin = {name: joint.number("start") for name, joint in joints.items() if "start" in joint.values}
        for value in self.values.get(f"{self.name}Start.mo", ()):
            if (joint := self._joint(value.path)) and isinstance(numbers := literals(value.text), tuple):
                begin[joint.name] = next(iter(numbers), 0.0)

        def limits(joint: Element) -> tuple[float, float]:
            lower, upper = joint.number("limits.lower"), joint.number("limits.upper")
            for other in joints.values():
                if other.leader == joint.name and abs(factor := other.number("mimic.multiplier")) > math.ulp(1):
                    ends = sorted((end - other.number("mimic.offset")) / factor for end in limits(other))
                    lower, upper = max(lower, ends[0]), min(upper, ends[1])
            return lower, upper

        def position(name: str) -> float:
            joint = joints.get(name)
            if joint is None:
                return 0.0
            if joint.leader:
                return joint.number("mimic.multiplier") * position(joint.leader) + joint.number("mimic.offset")
            lower, upper = limits(joint)
            return begin.get(name, min(max(0.0, lower), upper))

        return {name: position(name) for name in joints}

    def _starts(self, file: str) -> None:
        """Compare the start positions of joints. Joints in loops must close the loops."""
        values, gap = {value.path: value for value in self.values.get(file, ())}, 0.0
        model = self.classes.statements(f"{self.name}.mo") if f"{self.name}.mo" in self.read else {}
        placed = poses(self.reading, self._positions()) if self.reading.loops else {}
        for loop in self.reading.loops.values():
            between = placed[loop.parent] @ origin(loop) - placed[loop.child] @ origin(loop, "childOrigin")
            gap = max(gap, float(np.linalg.norm(between[:3, 3])))
        for name, joint in self.reading.joints.items():
            value = values.pop(component := self.classes.of("joint", name), None)
            expected = {"start": joint.values["start"]} if "start" in joint.values else {}
            fixed = model.get(f"{component}.fixedStart")
            is_chosen = joint.command and expected and not (fixed and fixed.text == "false")
            if value and joint.in_loop and not is_chosen:
                closed = literals(value.text) or value.text
                opened = f"a position that closes the loops, open by {1000 * gap:.3g} mm"
                expected = {"start": Stated(closed if gap < _CLOSED else opened, joint.line)}
            if value or expected:
                self._compare(file, f"joint {name}", [value._replace(path="start")] if value else [], expected)
        self._compare(file, "robot", [value._replace(path="reach") for value in values.values()], {})

    def _stance(self, file: str) -> None:
        for value in self.values[file]:
            self._compare(file, "robot", [value], {value.path: self._height(value)})

    def _height(self, given: Value) -> Stated:
        """Return the height of the root when the lowest collision shape begins to press on the ground."""
        lowest, placed = INF, poses(self.reading, self._positions())
        for (kind, name), component in self.components.items():
            link = self.reading.links.get(name)
            if kind != "link" or link is None:
                continue
            file = f"Links/{component[0].upper()}{component[1:]}Parameters.mo"
            corners = {value.path: literals(value.text) for value in self.values.get(file, ())}
            for path in [path for path in link.values if re.match(r"collision\d+\.shape", path)]:
                shape = path.partition(".")[0]
                at = placed[name] @ origin(link, f"{shape}.origin")
                up, middle = at[2, :3], at[2, 3]
                if "contact.minDepth" in link.values:
                    middle += link.number("contact.minDepth")
                match link.values[path].value:
                    case "mesh":
                        points: Any = corners.get(f"{shape}Corners")
                        points = points if isinstance(points, tuple) and len(points) % 3 == 0 else ()
                        below = max(-np.reshape(points, (-1, 3)) @ up, default=-INF)
                    case "box":
                        below = np.abs(up) @ link.values[f"{shape}.size"].value / 2
                    case "sphere":
                        below = link.number(f"{shape}.radius")
                    case kind_of_round:
                        width = math.hypot(up[0], up[1]) if kind_of_round == "cylinder" else 1.0
                        below = abs(up[2]) * link.number(f"{shape}.length") / 2
                        below += link.number(f"{shape}.radius") * width
                lowest = min(lowest, middle - below)
        number: Any = literals(given.text)
        is_near = isinstance(number, tuple) and np.allclose(number, [-lowest], rtol=0, atol=1e-9)
        return Stated(number if is_near else (float(-lowest),), 0)

    # The robot model, Run and Test

    def _model(self, file: str) -> None:
        """Compare the robot model: first its parts, then its connections in any order."""
        given = self.classes.statements(file)
        model = RobotModel(self.classes, given)
        self._complete(file, given, model.texts)
        ends = self.classes.ends
        sets = groups((end, other) for end, others in ends.items() for other, _ in others)
        stated = groups((edge.end, edge.other) for edge in model.edges)
        moved = set[str]()
        for edge in model.edges:
            joined = sets.get(edge.end, set()) - {edge.end}
            if edge.other not in joined:
                moved.add(edge.end)
            text = edge.other if edge.other in joined else ", ".join(sorted(joined)) or "nothing"
            value = Value(edge.end, "", text, next((line for _, line in ends[edge.end]), 0))
            self._compare(file, edge.element, [value], {edge.end: Stated(edge.other, edge.line)})
        for end, other, line in ((end, *place) for end, others in ends.items() for place in others):
            if end < other and other not in stated.get(end, ()) and moved.isdisjoint((end, other)):
                self._compare(file, "robot", [Value(end, "", other, line)], {end: Stated("nothing", 0)})

    def _complete(self, file: str, texts: Mapping[str, Value], every: Texts) -> None:
        """Compare the texts of a class with the expected texts of each element. Unexpected texts are differences."""
        known = {path for _, expected in every.values() for path in expected}
        owner = next(iter(every), "robot")  # the first element: of several, it is the robot
        for element, (line, expected) in every.items():
            given = [texts.get(path, Value(path, "", "nothing", 0)) for path in expected]
            self._compare(file, element, given, {path: Stated(_read(text), line) for path, text in expected.items()})
        for path, value in texts.items():
            is_other_end = value.text in texts and texts[value.text].text == path
            if path not in known and not (is_other_end and (value.text in known or value.text < path)):
                self._compare(file, owner, [value], {path: Stated("nothing", 0)})


def _read(text: str) -> Any:
    """Return the value of a literal, or an expression without blanks."""
    value = literals(text)
    return re.sub(r"\s", "", text) if value is None else value


def _bounds(corners: Value) -> tuple[float, ...]:
    """Return the least and the greatest coordinates of corners; empty if the text has other numbers."""
    numbers = literals(corners.text)
    if not isinstance(numbers, tuple) or not numbers or len(numbers) % 3:
        return ()
    points = np.reshape(numbers, (-1, 3))
    return tuple(map(float, (*points.min(axis=0), *points.max(axis=0))))


def _equations(loop: Element, given: Mapping[str, Any]) -> dict[str, Stated]:
    """Return the expected equations of a loop: the given equations, if they are possible for the kind of the loop."""
    keys = ("translations", "rotations", "childRotations")
    numbers = [given.get(key) for key in keys]
    whole = [each if isinstance(each, tuple) and len(each) % 3 == 0 else (math.nan,) * 3 for each in numbers]
    moves, u, v = (np.reshape(each, (-1, 3)) for each in whole)
    axis, child_axis = loop.axes
    is_right = len(moves) + len(u) > 0 and len(u) == len(v) and np.allclose(moves @ moves.T, np.eye(len(moves)))
    match loop.type if is_right else "":
        case "revolute":
            is_right = len(u) <= 2 and np.allclose(v, axis) and np.allclose(u @ axis, 0)
        case "universal":
            is_right = len(u) <= 1 and np.allclose(u, axis) and (child_axis is None or np.allclose(v, child_axis))
        case "fixed":
            is_right = len(u) <= 3 and np.allclose((u * v).sum(axis=1), 0)
        case _:
            is_right = is_right and not len(u)
    right = dict(zip(keys, numbers if is_right else [f"those of a {loop.type} joint"] * 3, strict=True))
    return {key: Stated(value, loop.line) for key, value in right.items()}


def _shown(value: Any) -> str:
    """Return a value in words. A rotation is shown by its angles."""
    if isinstance(value, str):
        return value
    if len(np.shape(value)) == 2:
        r = np.array(value)
        value = math.atan2(r[2, 1], r[2, 2]), math.asin(-r[2, 0]), math.atan2(r[1, 0], r[0, 0])
    return " ".join(f"{number:.9g}" for number in value)
