"""Compares the records of a package, and the first reading of the source, with the second reading.

The first reading has attributes that no record has, such as the parent of a joint. The statements of models are not
compared: golden texts hold them, and Pinocchio shows how the models move.
"""

from __future__ import annotations

import math
import re
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from urdfsync.diagnostics import SourceError
from urdfsync.domain import further_key
from urdfsync.domain.experiment import Mismatch, Numbers, Sample
from urdfsync.modelica.literals import string
from urdfsync.modelica.values import Value, literals, read_values
from urdfsync.spelling import counted
from urdfsync.urdf.robot import Robot, shape_numbers
from urdfsync.urdf.second.attributes import first_attributes, second_attributes
from urdfsync.urdf.second.reading import (
    INF,
    MOVES,
    TENSOR,
    ZERO,
    SecondElement,
    SecondReading,
    Stated,
    origin,
    poses,
    read_again,
    same,
)
from urdfsync.urdf.second.tables import DRAWN, expected_tables

_RECORDS = "UrdfSync.Records."
_SHAPE = re.compile(r"((?:visual|collision)\d+)(?:_\d+)?(\.|Corners)")
_NO_MASS = {
    **dict.fromkeys(("inertial.origin.xyz", "inertial.origin.rpy"), ZERO),
    **{f"inertial.{path}": (0.0,) for path in ("mass", *(f"inertia.{part}" for part in TENSOR))},
}
"""Values in the record of a massless link."""
_CLOSED = 1e-6
"""The greatest gap of a closed loop, in m."""


def compare_numbers(sample: Sample, robot: Robot, packages: Sequence[Mapping[str, bytes]]) -> list[Numbers]:
    """Compare the records of packages, and the first reading `robot`. Raises SourceError if the second reader fails."""
    with np.errstate(all="ignore"):  # source or edits may have infinite numbers
        try:
            reading = read_again(sample.content, sample.options, *sample.companions)
            _number_shapes(reading, robot)
            first = _Comparison(packages[0], reading, robot, sample).numbers()
            return [  # equal if there are no edits: saves 0.1 s with 70 links
                first if texts == packages[0] else _Comparison(texts, reading, robot, sample).numbers()
                for texts in packages
            ]
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


def _number_shapes(reading: SecondReading, robot: Robot) -> None:
    """Give the shapes of a reading, which has them by their places, the numbers that they have in a package."""
    for link in robot.links:
        kinds = {"visual": shape_numbers(link.visuals), "collision": shape_numbers(link.collisions)}
        names = {f"{kind}{k}": f"{kind}{n}" for kind, numbers in kinds.items() for k, n in enumerate(numbers, 1)}
        if link.name in reading.links and any(name != new for name, new in names.items()):
            values = ((path.partition("."), stated) for path, stated in reading.links[link.name].values.items())
            renamed = {f"{names.get(first, first)}{dot}{rest}": stated for (first, dot, rest), stated in values}
            reading.links[link.name].values = renamed


class _Comparison:
    """Counts the values of a package's texts in `right`, `total` and `uncompared`, and lists `differences`."""

    def __init__(self, texts: Mapping[str, bytes], reading: SecondReading, robot: Robot, sample: Sample) -> None:
        self.reading, self.robot, self.sample, self.name = reading, robot, sample, sample.target.name
        elements = reading.links, reading.joints, reading.loops, reading.sensors
        self.elements = dict(zip(("link", "joint", "loop", "sensor"), elements, strict=True))
        self.components = dict[tuple[str, str], str]()
        """Components of links, joints, loops and sensors, by kind and name."""
        self.places = dict[tuple[str, str], tuple[str, int]]()
        """Files and lines of their names."""
        whole = [f"{self.name}{suffix}.mo" for suffix in ("Parameters", "Start", "Sensors", "Stance")]
        parts = [path for path in texts if path.startswith(("Links/", "Joints/")) and path.endswith("Parameters.mo")]
        needed = sorted(texts.keys() & {*whole, *parts})
        self.values = {path: read_values(texts[path].decode(errors="replace")) for path in needed}
        self.right = self.total = 0
        self.differences, self.uncompared = list[Mismatch](), Counter[str]()
        roots = reading.links.keys() - {joint.child for joint in reading.joints.values()}
        has_masses = any("inertial.mass" in link.values for link in reading.links.values())
        self.massless_root = None if has_masses else reading.links[next(iter(roots))]

    def numbers(self) -> Numbers:
        """Compare all records, then the first reading."""
        for path, values in self.values.items():
            if path.startswith(("Links/", "Joints/")):
                type_ = next((value.type for value in values if value.path == "name"), "").removeprefix(_RECORDS)
                stem = path.rpartition("/")[2].removesuffix("Parameters.mo")
                self._element(path, stem[:1].lower() + stem[1:], type_, values)
        for suffix, compare in (("Parameters", self._whole), ("Sensors", self._sensors), ("Stance", self._stance)):
            if f"{self.name}{suffix}.mo" in self.values:
                compare(f"{self.name}{suffix}.mo")
        self._starts(f"{self.name}Start.mo")
        for kind, elements in self.elements.items():
            for name in sorted(elements.keys() - {name for of, name in self.components if of == kind}):
                if kind in ("link", "joint") or "package" in self.sample.options.approach:
                    element = f"{kind} {name}"
                    self._compare(f"{self.name}.mo", element, (), {"name": elements[name].state(name)})
        self._attributes()
        for contradiction in self.reading.contradictions:
            place = Value("elements", "", "", 0)
            self._differ(f"{self.name}.mo", "robot", place, Stated(contradiction, 0), "another one by yourdfpy")
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
        place = file, value.line, stated.file or self.sample.file, stated.line
        self.differences.append(Mismatch(element, value.path, *words, *place))

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
        self.places.setdefault((kind, name), (file, named.line))
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
            named = next((value for value in values if value.path == "name"), Value("name", "", '""', 0))
            name = str(literals(named.text))
            self.components["sensor", name], self.places["sensor", name] = component, (file, named.line)
            sensor = self.reading.sensors.get(name)
            self._compare(file, f"sensor {name}", values, sensor.values if sensor else {})

    def _whole(self, file: str) -> None:
        """Compare the record of the whole robot: first its elements, then its tables."""
        parts, types, owner = defaultdict[str, list[Value]](list), dict[str, str](), ""
        own, shapes = list[Value](), dict[str, tuple[str, int]]()
        for value in self.values[file]:
            component, _, path = value.path.partition(".")
            type_ = value.type.removeprefix(_RECORDS)
            if type_ == "Robot" or type_.startswith("constant"):
                own.append(value)
            elif type_ in DRAWN:
                number = re.match(r"Visual(\d+)", component.removeprefix(owner))
                shapes.setdefault(component, (type_, [*types.values()].count("Link")))
                parts[owner].append(value._replace(path=f"visual{number[1] if number else 0}.{path}"))
            else:
                owner = component
                types.setdefault(component, type_)
                parts[component].append(value._replace(path=path))
        for component, type_ in types.items():
            self._element(file, component, type_, parts[component], whole=True)
        elements = {component: self.elements[kind][name] for (kind, name), component in self.components.items()}
        tables = expected_tables([(elements[c], c) for c in types if c in elements], shapes.values())
        for value in own:
            # the name of a constant may have a number; tables without a column refer to the numbers of elements
            column = tables.get(re.sub(r"(?<=Axis)_\d+$", "", value.path))
            if value.path == "name":
                self._compare(file, "robot", [value], {"name": Stated(self.reading.name, 0)})
            elif value.path == "standingHeight":
                self._compare(file, "robot", [value], {value.path: self._height(value)})
            elif column is not None:
                items = [item for item in re.split("[,;]", re.sub(r"[\s{}]|^\[|\]$|fill.*", "", value.text)) if item]
                given = [value._replace(path=f"{value.path}[{k}]", text=item) for k, item in enumerate(items, 1)]
                expected = {each.path: Stated("nothing", 0) for each in given}
                expected |= {f"{value.path}[{k}]": Stated((float(n),), 0) for k, n in enumerate(column, 1)}
                self._compare(file, "robot", given, expected)

    # Values that follow from others

    def _joint(self, component: str) -> SecondElement | None:
        names = (name for (kind, name), other in self.components.items() if (kind, other) == ("joint", component))
        return next((self.reading.joints[name] for name in names), None)

    def _positions(self) -> dict[str, float]:
        """Return the joints' start positions: from the start record, else closest to zero within all limits."""
        joints = {name: joint for name, joint in self.reading.joints.items() if joint.type in MOVES}
        begin = {name: joint.number("start") for name, joint in joints.items() if "start" in joint.values}
        for value in self.values.get(f"{self.name}Start.mo", ()):
            if (joint := self._joint(value.path)) and isinstance(numbers := literals(value.text), tuple):
                begin[joint.name] = next(iter(numbers), 0.0)

        def limits(joint: SecondElement) -> tuple[float, float]:
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
        placed = poses(self.reading, self._positions()) if self.reading.loops else {}
        for loop in self.reading.loops.values():
            between = placed[loop.parent] @ origin(loop) - placed[loop.child] @ origin(loop, "childOrigin")
            gap = max(gap, float(np.linalg.norm(between[:3, 3])))
        for name, joint in self.reading.joints.items():
            value = values.pop(self.components.get(("joint", name), ""), None)
            expected = {"start": joint.values["start"]} if "start" in joint.values else {}
            if value and joint.in_loop:
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
                    case "ellipsoid":
                        below = np.linalg.norm(up * link.values[f"{shape}.radii"].value)
                    case kind_of_round:
                        width = math.hypot(up[0], up[1]) if kind_of_round == "cylinder" else 1.0
                        below = abs(up[2]) * link.number(f"{shape}.length") / 2
                        below += link.number(f"{shape}.radius") * width
                lowest = min(lowest, middle - below)
        number: Any = literals(given.text)
        is_near = isinstance(number, tuple) and np.allclose(number, [-lowest], rtol=0, atol=1e-9)
        return Stated(number if is_near else (float(-lowest),), 0)

    # The first reading

    def _attributes(self) -> None:
        """Compare the attributes that no record has; a difference has the place of the element's name in its record."""
        first = dict(first_attributes(self.robot, self.sample.options))
        for key, (file, line) in self.places.items():
            element = self.elements[key[0]].get(key[1])
            if element is None or key not in first:
                continue
            expected = second_attributes(key[0], element)
            given = [Value(path, "", string(first[key][path] or "nothing"), line) for path in expected]
            stated = {path: element.state(word or "nothing") for path, word in expected.items()}
            self._compare(file, " ".join(key), given, stated)


def _read(text: str) -> Any:
    """Return the value of a literal, or an expression in one line."""
    value = literals(text)
    return " ".join(text.split()) if value is None else value


def _bounds(corners: Value) -> tuple[float, ...]:
    """Return the least and the greatest coordinates of corners; empty if the text has other numbers."""
    numbers = literals(corners.text)
    if not isinstance(numbers, tuple) or not numbers or len(numbers) % 3:
        return ()
    points = np.reshape(numbers, (-1, 3))
    return tuple(map(float, (*points.min(axis=0), *points.max(axis=0))))


def _equations(loop: SecondElement, given: Mapping[str, Any]) -> dict[str, Stated]:
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
    return {key: loop.state(value) for key, value in right.items()}


def _shown(value: Any) -> str:
    """Return a value in words. A rotation is shown by its angles."""
    if isinstance(value, str):
        return value
    if len(np.shape(value)) == 2:
        r = np.array(value)
        value = math.atan2(r[2, 1], r[2, 2]), math.asin(-r[2, 0]), math.atan2(r[1, 0], r[0, 0])
    return " ".join(f"{number:.9g}" for number in value)
