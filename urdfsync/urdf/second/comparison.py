"""Compares the numbers and names in the texts of a package with the second reading of its source."""

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
from urdfsync.modelica.values import Value, literals, read_values
from urdfsync.spelling import counted
from urdfsync.urdf.second.reading import (
    COMMANDS,
    INF,
    MOVES,
    TURNS,
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
_LETTERS = {True: ("phi", "w", "tau"), False: ("s", "v", "f")}
"""Position, speed and effort in Modelica, of joints that turn and of joints that slide, as `COMMANDS`."""
_TENSOR = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
_CLOSED = 1e-6
"""The greatest gap of a closed loop, in m."""


def compare_numbers(sample: Sample, packages: Sequence[Mapping[str, bytes]]) -> list[Numbers]:
    """Compare all literals in the records of packages, and the names in the robot model and in Run.

    Raises SourceError if the source can't be read again.
    """
    try:
        reading = read_again(sample.content, sample.options)
    except (ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
        message = f"the second reader fails: {type(error).__name__}: {error}"
        raise SourceError.of("second-reader", message, sample.file) from None
    comparisons = [_Comparison(texts, reading, sample) for texts in packages]
    by_yourdfpy = f"the reading by yourdfpy, which can't read {sample.file} ({reading.unread})"
    numbers = list[Numbers]()
    for each in comparisons:
        each.run()
        counts = sorted(each.uncompared.items())
        uncompared = [by_yourdfpy] * bool(reading.unread)
        uncompared += [f"{path} of records ({counted(count, 'number')})" for path, count in counts]
        numbers.append(Numbers(each.right, each.total, tuple(each.differences), uncompared=tuple(uncompared)))
    return numbers


class _Comparison:
    """Counts the values of the texts in `right`, `total` and `uncompared`, and tells `differences`."""

    def __init__(self, texts: Mapping[str, bytes], reading: Reading, sample: Sample) -> None:
        self.reading, self.sample, self.name = reading, sample, sample.target.name
        suffixes = ("", "Run", "Test", "Parameters", "Start", "Sensors", "Stance")
        needed = {f"{sample.target.name}{suffix}.mo" for suffix in suffixes}
        needed |= {path for path in texts if path.startswith(("Links/", "Joints/")) and path.endswith("Parameters.mo")}
        read = {path: read_values(texts[path].decode(errors="replace")) for path in sorted(needed & texts.keys())}
        self.values = {path: each.values for path, each in read.items()}
        self.titles = {path: each.titles for path, each in read.items()}
        self.ends = _ends(self.values.get(f"{self.name}.mo", ()))
        """Connections in the robot model."""
        self.right = self.total = 0
        self.differences = list[Difference]()
        self.uncompared = Counter[str]()
        self.components: dict[tuple[str, str], str] = {}
        """Components of links, joints, loops and sensors, by kind and name."""
        self.elements = {
            "link": reading.links,
            "joint": reading.joints,
            "loop": reading.loops,
            "sensor": reading.sensors,
        }

        roots = reading.links.keys() - {joint.child for joint in reading.joints.values()}
        has_masses = any("inertial.mass" in link.values for link in reading.links.values())
        self.massless_root = None if has_masses else reading.links[next(iter(roots))]

    def run(self) -> None:
        """Compare all files."""
        for path, values in self.values.items():
            if path.startswith(("Links/", "Joints/")):
                type_ = next((value.type for value in values if value.path == "name"), "").removeprefix(_RECORDS)
                stem = path.rpartition("/")[2].removesuffix("Parameters.mo")
                self._element(path, stem[:1].lower() + stem[1:], type_, values)
        for suffix, compare in (("Parameters", self._whole), ("Start", self._starts), ("Sensors", self._sensors)):
            if f"{self.name}{suffix}.mo" in self.values:
                compare(f"{self.name}{suffix}.mo")
        begun = {value.path for value in self.values.get(f"{self.name}Start.mo", ())}
        for name, joint in self.reading.joints.items():
            if "start" in joint.values and self.components.get(("joint", name)) not in begun:
                stated = joint.values["start"]
                self._lack(f"joint {name}", "start", stated.value, f"{self.name}Start.mo", 0, stated.line)
        for value in self.values.get(f"{self.name}Stance.mo", ()):
            self._judge(f"{self.name}Stance.mo", value, "robot", self._height(literals(value.text)))
        if f"{self.name}.mo" in self.values:
            self._connections(f"{self.name}.mo")
        for bench in (f"{self.name}Run.mo", f"{self.name}Test.mo"):
            if bench in self.values:
                self._bench(bench)
        for kind, elements in self.elements.items():
            for name in elements.keys() - {name for of, name in self.components if of == kind}:
                if kind != "sensor" or "package" in self.sample.options.approach:
                    self._lack(f"{kind} {name}", "name", name, f"{self.name}.mo", 0, elements[name].line)
        for contradiction in self.reading.contradictions:
            self._differ("robot", "elements", contradiction, "another one by yourdfpy", f"{self.name}.mo", 0, 0)

    def _lack(self, element: str, quantity: str, expected: Any, file: str, line: int, at: int) -> None:
        self.total += 1
        self._differ(element, quantity, expected, "nothing", file, line, at)

    def _differ(self, element: str, quantity: str, expected: Any, given: Any, file: str, line: int, at: int) -> None:
        words = _shown(expected), _shown(given)
        self.differences.append(Difference(element, quantity, *words, file, line, self.sample.file, at))

    def _judge(
        self, file: str, value: Value, element: str, expected: Any, at: int = 0, path: str = "", given: Any = None
    ) -> None:
        """Count a value, and compare it; with nothing expected it is not compared."""
        given, path = literals(value.text) if given is None else given, path or value.path
        given = value.text if given is None else given  # an expression of the user's
        count = len(given) if isinstance(given, tuple) else 1
        self.total += count
        if expected is None:
            self.uncompared[re.sub(r"[\d_]+", "", path)] += count
        elif same(expected, given):
            self.right += count
        else:
            if isinstance(given, tuple) and np.shape(expected) == np.shape(given):
                self.right += sum(same(a, b) for a, b in zip(expected, given, strict=True))
            self._differ(element, path, expected, given, file, value.line, at)

    def _element(self, file: str, component: str, type_: str, values: Sequence[Value], *, whole: bool = False) -> None:
        """Compare the record of a link, joint or loop, or its part of the `whole` robot's record."""
        kind = {"Link": "link", "Loop": "loop"}.get(type_, "joint")
        name = next((str(literals(value.text)) for value in values if value.path == "name"), "")
        element, label, line = self.elements[kind].get(name), f"{kind} {name}", values[0].line if values else 0
        if element is None:
            self.total += 1
            self._differ(label, "name", "nothing", name, file, line, 0)
            return
        self.components[kind, name] = component
        expected = dict(element.values)
        if kind == "joint":
            place, stated_type = Value("type", "", "", line), f"{element.type.capitalize()}Joint"
            self._judge(file, place, label, stated_type, element.line, given=type_)
        elif kind == "loop":
            expected |= _equations(element, {value.path: literals(value.text) for value in values})
        elif not whole and element is self.massless_root:  # Modelica's frames need a body there
            del expected["hasInertial"]
            numbers: dict[str, Any] = {"mass": (0.0,), "origin.xyz": ZERO, "origin.rpy": ZERO}
            numbers |= {f"inertia.{part}": (0.0,) for part in _TENSOR}
            expected |= {f"inertial.{path}": Stated(number, element.line) for path, number in numbers.items()}
        given = set[str]()
        for value in values:
            shape = _SHAPE.match(value.path)
            path = f"{shape[1]}{shape[2]}{value.path[shape.end() :]}" if shape else value.path
            given |= {path, path.partition(".")[0]}
            stated: Any = None
            stated, at = expected.get(path) or (None, 0)
            if stated is not None and path.endswith(".uri"):
                stated = self._uri(stated, str(literals(value.text)))
            self._judge(file, value, label, stated, at, path)
        for path, (stated, at) in expected.items():
            owner = path.partition(".")[0]
            is_elsewhere = path == "start" or path.endswith(".shape") or (whole and path.startswith("contact"))
            is_elsewhere |= path.startswith("collision") and (whole or not self.sample.options.collisions)
            if path not in given and not is_elsewhere and (owner in given or f"{owner}.uri" not in expected):
                self._lack(label, path, stated, file, line, at)

    def _uri(self, mesh: tuple[str, Sequence[float]], given: str) -> str:
        """Return the URI of an imported mesh; the given one if it is that of one of its parts."""
        key = f"{mesh[0]} scale {' '.join(repr(float(number)) for number in mesh[1])}"
        keys, imports = [key, *(further_key(key, number) for number in range(1, 100))], self.sample.imports
        uris = [f"modelica://{self.sample.target.package}/{imports[k].target}" for k in keys if k in imports]
        return given if given in uris else next(iter(uris), key)

    # Values that follow from others

    def _positions(self) -> dict[str, float]:
        """Return where the joints begin: by the start record, or as near to zero as all limits allow."""
        joints = {name: joint for name, joint in self.reading.joints.items() if joint.type in MOVES}
        begin = {name: joint.number("start") for name, joint in joints.items() if "start" in joint.values}
        for value in self.values.get(f"{self.name}Start.mo", ()):
            if (joint := self._joint(value.path)) and isinstance(numbers := literals(value.text), tuple):
                begin[joint.name] = numbers[0]

        def limits(joint: Element) -> tuple[float, float]:
            lower, upper = joint.number("limits.lower"), joint.number("limits.upper")
            for other in joints.values():
                if other.leader == joint.name and abs(factor := other.number("mimic.multiplier")) > math.ulp(1):
                    factor = other.number("mimic.multiplier")
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

    def _joint(self, component: str) -> Element | None:
        names = (name for (kind, name), other in self.components.items() if (kind, other) == ("joint", component))
        return next((self.reading.joints[name] for name in names), None)

    def _starts(self, file: str) -> None:
        """Compare where joints begin: those in loops close these, all others begin where the source says."""
        placed, gap = poses(self.reading, self._positions()), 0.0
        for loop in self.reading.loops.values():
            between = placed[loop.parent] @ origin(loop) - placed[loop.child] @ origin(loop, "childOrigin")
            gap = max(gap, float(np.linalg.norm(between[:3, 3])))
        for value in self.values[file]:
            joint, given = self._joint(value.path), literals(value.text)
            stated = joint.values.get("start") if joint else None
            expected: Any = stated.value if stated else None
            if joint and joint.in_loop and not (joint.command and stated):
                expected = given if gap < _CLOSED else f"a position that closes the loops, open by {1000 * gap:.3g} mm"
            label, path = (f"joint {joint.name}", "start") if joint else ("robot", "reach")
            self._judge(file, value, label, expected, joint.line if joint else 0, path)

    def _height(self, given: Any) -> Any:
        """Return the height of the root at which the lowest collision shape begins to carry the robot."""
        lowest, placed = INF, poses(self.reading, self._positions())
        for (kind, name), component in self.components.items():
            link = self.reading.links.get(name)
            if kind != "link" or link is None:
                continue
            file = f"Links/{component[0].upper()}{component[1:]}Parameters.mo"
            shapes = [path.partition(".")[0] for path in link.values if re.match(r"collision\d+\.shape", path)]
            corners = {value.path: literals(value.text) for value in self.values.get(file, ())}
            for shape in shapes:
                at = placed[name] @ origin(link, f"{shape}.origin")
                up, middle = at[2, :3], at[2, 3]
                if "contact.minDepth" in link.values:
                    middle += link.number("contact.minDepth")
                match link.values[f"{shape}.shape"].value:
                    case "mesh":
                        points: Any = corners.get(f"{shape}Corners") or ()
                        below = max(-np.reshape(points, (-1, 3)) @ up, default=-INF)
                    case "box":
                        below = np.abs(up) @ link.values[f"{shape}.size"].value / 2
                    case "sphere":
                        below = link.number(f"{shape}.radius")
                    case kind:
                        width = math.hypot(up[0], up[1]) if kind == "cylinder" else 1.0
                        below = abs(up[2]) * link.number(f"{shape}.length") / 2
                        below += link.number(f"{shape}.radius") * width
                lowest = min(lowest, middle - below)
        return given if given and np.allclose(given, -lowest, rtol=0, atol=1e-9) else (float(-lowest),)

    # The robot model and Run

    def _connections(self, file: str) -> None:
        """Compare which links the model connects with joints, loops and sensors, and who leads whom."""
        ends, pairs = self.ends, list[tuple[Element, str, str, str, str, str]]()
        for kind in ("joint", "loop", "sensor"):
            for name, element in self.elements[kind].items():
                own = self.components.get((kind, name))
                sides = (("frame_a", "parent", element.parent), ("frame_b", "child", element.child))
                for side, word, link in sides[: 1 if kind == "sensor" else 2] if own else ():
                    if element.type != "force_torque":
                        pairs.append((element, f"{kind} {name}", word, f"{own}.{side}", link, "link"))
        for value in self.values.get(file, ()):
            component, _, path = value.path.partition(".")
            if value.type.startswith("UrdfSync.Couplings.") and path == "parameters":
                follower = self._joint(value.text.partition(".")[0])
                leader = self.reading.joints.get(follower.leader) if follower else None
                if follower and leader and leader.type in MOVES:
                    pairs.append(
                        (follower, f"joint {follower.name}", "mimic", f"{component}.leader", leader.name, "joint")
                    )
            elif value.type.startswith("UrdfSync.Sensors.Force") and path in ("f_joint", "t_joint"):
                self._wrench(file, value, component, path[0])
        for element, label, word, end, expected, kind in pairs:
            names = {component: name for (of, name), component in self.components.items() if of == kind}
            near = [
                (names[c], line) for c, line in ((o.partition(".")[0], line) for o, line in ends[end]) if c in names
            ]
            given, line = ", ".join(name for name, _ in near) or "nothing", near[0][1] if near else 0
            self._judge(file, Value(word, "", "", line), label, expected, element.line, given=given)

    def _wrench(self, file: str, value: Value, component: str, letter: str) -> None:
        """Compare the joint, the axes and the direction of a force-torque sensor."""
        for (kind, name), other in self.components.items():
            if (kind, other) == ("sensor", component):
                sensor = self.reading.sensors[name]
                (in_parent, is_reversed), joint = sensor.axes, self.components.get(("joint", sensor.parent))
                vector = f"{joint}.frame_b.{letter}"
                vector = f"{joint}.frame_a.R.T*({vector}*{joint}.frame_b.R.T)" if in_parent else vector
                expected, given = f"{'-' * is_reversed}{vector}", re.sub(r"\s", "", value.text)
                self._judge(file, value, f"sensor {name}", expected, sensor.line, f"{letter}_joint", given)

    def _bench(self, file: str) -> None:
        """Compare what Run or Test connects with the axis of each joint, and the outputs of sensors."""
        values, joints = self.values[file], self.reading.joints
        texts = {end: Value(end, "", *others[0]) for end, others in _ends(values).items()}
        texts |= {value.path: value for value in values if value.path != "connect"}
        for value in values:
            if value.path.startswith("world."):
                self._judge(file, value, "robot", "that of the bench", given=value.text)
        named = any(joint.is_named for joint in joints.values() if joint.in_loop and not joint.leader)
        for (kind, name), component in self.components.items():
            expected, element = dict[str, str](), self.elements[kind][name]
            if kind == "sensor":
                expected = {f"{component}_{output}": f"robot.{component}.{output}" for output in "awft"}
                expected = {path: text for path, text in expected.items() if path in texts}
            elif kind == "joint" and element.type in MOVES and not element.leader:
                flanges = [self._flange(component, side) for side in ("axis", "support")]
                # which joints of a loop are driven may be left to urdfsync
                is_driven = not element.in_loop or (element.is_named if named else flanges[0] in texts)
                expected = {flanges[0]: "nothing"}
                if element.command and is_driven:
                    expected = self._source(element, component, flanges, texts, is_run=file.endswith("Run.mo"))
            for path, text in expected.items():
                value = texts.get(path, Value(path, "", "nothing", 0))
                given = re.sub(r"\s", "", value.text)
                self._judge(file, value, f"{kind} {name}", text, element.line, given=given)

    def _flange(self, component: str, side: str) -> str:
        """Return the connector of the robot for the axis or the support of a joint."""
        return next((f"robot.{end}" for end, _ in self.ends[f"{component}.{side}"] if "." not in end), "")

    def _source(
        self, joint: Element, component: str, flanges: Sequence[str], texts: Mapping[str, Value], *, is_run: bool
    ) -> dict[str, str]:
        """Return what moves a joint in Run or Test: texts by the ends of connections, outputs and modifiers."""
        source, (q, speed, effort) = f"{component}Drive", _LETTERS[joint.type in TURNS]
        (axis, _), own = flanges, f"robot.{component}"
        expected = {flange: f"{source}.{end}" for flange, end in zip(flanges, ("flange", "support"), strict=True)}
        if not is_run:
            expected |= {f"{source}.{field}": f"{own}.{field}" for field in (f"{q}_start", f"{q}_min", f"{q}_max")}
            expected[f"{source}.{speed}_max"] = f"{own}.{speed}_max"
            reach = f"{source}.reach"
            return expected | ({reach: f"robot.startPositions.{component}Reach"} if reach in texts else {})
        variable = (q, speed, effort)[COMMANDS.index(joint.command)]
        end, command = f"{source}.{variable}{'_ref' * (joint.command != 'effort')}", f"{component}_{variable}"
        if self.sample.options.inputs == "vector":
            order = [name.removesuffix("Drive") for name in self.titles[f"{self.name}Run.mo"] if name.endswith("Drive")]
            vectors = (v.path.partition(".")[0] for v in texts.values() if v.type.endswith("RealInput"))
            command = f"{next(vectors, '')}[{order.index(component) + 1 if component in order else 0}]"
        if end in texts and "limitedEffort" in texts[end].text:  # a drive that keeps its limits
            limits = f"{own}.parameters.limits.effort,{own}.parameters.limits.velocity"
            command = f"UrdfSync.Functions.limitedEffort({command},{component}_{speed},{limits})"
        expected[end] = command
        if joint.command == "effort":
            place = f"{component}_{q}"
            return expected | {place: f"{axis}.{q}-{flanges[1]}.{q}", f"{component}_{speed}": f"der({place})"}
        return expected | {f"{component}_{effort}": f"{axis}.{effort}"}

    # Records of several elements

    def _sensors(self, file: str) -> None:
        names = {v.path.partition(".")[0]: str(literals(v.text)) for v in self.values[file] if v.path.endswith(".name")}
        self.components |= {("sensor", name): component for component, name in names.items()}
        for value in self.values[file]:
            component, _, path = value.path.partition(".")
            sensor = self.reading.sensors.get(names.get(component, ""))
            stated = sensor.values.get(path) if sensor else None
            label = f"sensor {names.get(component, component)}"
            self._judge(file, value, label, stated.value if stated else None, stated.line if stated else 0, path)

    def _whole(self, file: str) -> None:
        """Compare the record of the whole robot: its elements, then the tables that count these."""
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
            text = (
                re.sub(r"[\s{}]|^\[|\]$|fill.*", "", value.text)
                if value.text[:1] in "[f"
                else re.sub(r"[\s{}]", "", value.text)
            )
            items = [item for item in re.split("[,;]", text) if item]
            if value.path == "name":
                self._judge(file, value, "robot", self.reading.name)
            elif value.path == "standingHeight":
                self._judge(file, value, "robot", self._height(literals(value.text)))
            else:
                match = re.match('Number of joint "(.*)" in', titles.get(value.path, ""))
                expected = tables.get(f"{self.components.get(('joint', match[1]))}Axis" if match else value.path)
                self.total += len(items)
                if expected is None:
                    self.uncompared[value.path] += len(items)
                    continue
                wrong = [k for k in range(max(len(items), len(expected))) if items[k : k + 1] != expected[k : k + 1]]
                self.right += len(items) - len(wrong)
                if wrong:
                    shown = [next(iter(side[wrong[0] : wrong[0] + 1]), "nothing") for side in (expected, items)]
                    self._differ("robot", f"{value.path}[{wrong[0] + 1}]", shown[0], shown[1], file, value.line, 0)


def _ends(values: Sequence[Value]) -> defaultdict[str, list[tuple[str, int]]]:
    """Return the connections of each end, with their lines."""
    ends = defaultdict[str, list[tuple[str, int]]](list)
    for value in values:
        if value.path == "connect":
            first, second = value.text.split(",")
            ends[first].append((second, value.line))
            ends[second].append((first, value.line))
    return ends


def _equations(loop: Element, given: Mapping[str, Any]) -> dict[str, Stated]:
    """Return the equations of a loop: the given ones, if they are some of those that a joint of its kind has."""
    keys = ("translations", "rotations", "childRotations")
    moves, u, v = (np.reshape(given.get(key) or (), (-1, 3)) for key in keys)
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
    return {key: Stated(given.get(key) if is_right else f"those of a {loop.type} joint", loop.line) for key in keys}


def _shown(value: Any) -> str:
    """Return a value in words; a rotation by its angles."""
    if isinstance(value, str):
        return value
    if len(np.shape(value)) == 2:
        r = np.array(value)
        value = math.atan2(r[2, 1], r[2, 2]), math.asin(-r[2, 0]), math.atan2(r[1, 0], r[0, 0])
    return " ".join(f"{number:.9g}" for number in value)
