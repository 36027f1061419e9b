"""Compares the records of a package, and the first reading of the source, with the second reading.

The first reading has attributes that no record has, such as the parent of a joint. The statements of models are not
compared: golden texts hold them, and Pinocchio shows how the models move. So do numbers that urdfsync computes.
"""

from __future__ import annotations

import math
import re
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from urdfsync.common.diagnostics import SourceError
from urdfsync.common.spelling import counted
from urdfsync.domain import further_key
from urdfsync.domain.experiment import Mismatch, Numbers, Sample
from urdfsync.formats.urdf.robot import Robot, shape_numbers
from urdfsync.formats.urdf.second.attributes import first_attributes, second_attributes
from urdfsync.formats.urdf.second.plain import SHAPES
from urdfsync.formats.urdf.second.reading import (
    TENSOR,
    ZERO,
    SecondReading,
    Stated,
    read_again,
    same,
)
from urdfsync.modelica.literals import string
from urdfsync.modelica.values import Value, literals, read_values

_RECORDS = "UrdfSync.Records."
_SHAPE = re.compile(r"((?:visual|collision)\d+)(?:_\d+)?\.")
_DRAWN = frozenset(map(str.capitalize, SHAPES))
"""Records of shapes."""
_NO_MASS = {
    **dict.fromkeys(("inertial.origin.xyz", "inertial.origin.rpy"), ZERO),
    **{f"inertial.{path}": (0.0,) for path in ("mass", *(f"inertia.{part}" for part in TENSOR))},
}
"""Values in the record of a massless link."""


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
        for suffix, compare in (("Parameters", self._whole), ("Sensors", self._sensors)):
            if f"{self.name}{suffix}.mo" in self.values:
                compare(f"{self.name}{suffix}.mo")
        self._compare(f"{self.name}Stance.mo", "robot", self.values.get(f"{self.name}Stance.mo", ()), {})
        self._starts(f"{self.name}Start.mo")
        for kind, elements in self.elements.items():
            for name in sorted(elements.keys() - {name for of, name in self.components if of == kind}):
                if kind in ("link", "joint") or "package" in self.sample.options.approach:
                    element = f"{kind} {name}"
                    self._compare(f"{self.name}.mo", element, (), {"name": elements[name].state(name)})
        self._attributes()
        uncompared = [f"{path} of records ({counted(n, 'number')})" for path, n in sorted(self.uncompared.items())]
        if f"{self.name}Parameters.mo" in self.values:
            uncompared.append("the tables in the record of the whole robot, except by their motion with `--physics`")
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
        given = [value._replace(path=f"{s[1]}.{value.path[s.end() :]}") if s else value for value, s in shapes]
        forms = {f"{s[1]}.shape": value for value, s in shapes if s}
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
        elif not whole and element is self.massless_root:  # Modelica's frames need a body: its mass is 0
            del expected["hasInertial"]
            expected |= {path: Stated(number, element.line) for path, number in _NO_MASS.items()}
        uris = {path: self._uris(stated.value) for path, stated in expected.items() if path.endswith(".uri")}
        expected |= {path: Stated(parts[0], expected[path].line) for path, parts in uris.items()}
        for k, value in enumerate(given):
            if literals(value.text) in uris.get(value.path, ()):  # a mesh may have several parts
                given[k] = value._replace(text=string(uris[value.path][0]))
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
            if sensor := self.reading.sensors.get(name):
                self._compare(file, f"sensor {name}", values, sensor.values)
            else:
                self._compare(file, f"sensor {name}", [named], {"name": Stated("nothing", 0)})

    def _whole(self, file: str) -> None:
        """Compare the elements and the name in the record of the whole robot."""
        parts, types, owner = defaultdict[str, list[Value]](list), dict[str, str](), ""
        for value in self.values[file]:
            component, _, path = value.path.partition(".")
            type_ = value.type.removeprefix(_RECORDS)
            if type_ == "Robot" or type_.startswith("constant"):
                if value.path == "name":
                    self._compare(file, "robot", [value], {"name": Stated(self.reading.name, 0)})
            elif type_ in _DRAWN:
                number = re.match(r"Visual(\d+)", component.removeprefix(owner))
                parts[owner].append(value._replace(path=f"visual{number[1] if number else 0}.{path}"))
            else:
                owner = component
                types.setdefault(component, type_)
                parts[component].append(value._replace(path=path))
        for component, type_ in types.items():
            self._element(file, component, type_, parts[component], whole=True)

    def _starts(self, file: str) -> None:
        """Compare the start positions of joints, but those that close loops."""
        values = {value.path: value for value in self.values.get(file, ())}
        for name, joint in self.reading.joints.items():
            value = values.pop(self.components.get(("joint", name), ""), None)
            expected = {"start": joint.values["start"]} if "start" in joint.values and not joint.in_loop else {}
            self._compare(file, f"joint {name}", [value._replace(path="start")] if value else [], expected)
        self._compare(file, "robot", [value._replace(path="reach") for value in values.values()], {})

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


def _shown(value: Any) -> str:
    """Return a value in words. A rotation is shown by its angles."""
    if isinstance(value, str):
        return value
    if len(np.shape(value)) == 2:
        r = np.array(value)
        value = math.atan2(r[2, 1], r[2, 2]), math.asin(-r[2, 0]), math.atan2(r[1, 0], r[0, 0])
    return " ".join(f"{number:.9g}" for number in value)
