"""Derives from the second reading the texts that a package must have in its robot model, benches, links and joints.

Each function returns the expected texts of each element by paths; `models` has the patterns of the texts.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

import msgspec

from urdfsync.checks.experiment import Sample
from urdfsync.config.paths import library_folder
from urdfsync.modelica.names import LIBRARY
from urdfsync.modelica.values import Value, Values, read_values
from urdfsync.urdf.second import models
from urdfsync.urdf.second.models import WORDS, pairs
from urdfsync.urdf.second.reading import COMMANDS, MOVES, TURNS, Element, Reading

Texts: TypeAlias = Mapping[str, tuple[int, Mapping[str, str]]]
"""For each element, its line in the source, and its texts by paths."""


class Edge(msgspec.Struct, frozen=True):
    """A connection of the robot model, and the element of the connection."""

    element: str
    line: int
    end: str
    other: str


class Classes:
    """The texts of a package's classes, with the components that its records name."""

    def __init__(self, read: dict[str, Values], reading: Reading, sample: Sample) -> None:
        self.read, self.reading, self.options, self.name = read, reading, sample.options, sample.target.name
        kinds = ("link", "joint", "loop", "sensor")
        all_elements = (reading.links, reading.joints, reading.loops, reading.sensors)
        self.elements = dict(zip(kinds, all_elements, strict=True))
        self.components = dict[tuple[str, str], str]()
        """Components of links, joints, loops and sensors, by kind and name."""
        self.record = read.get(f"{self.name}Parameters.mo", Values([], {}, []))
        start = read.get(f"{self.name}Start.mo", Values([], {}, []))
        self.begun = {value.path for value in start.values}
        """Components of the joints in the start record."""
        self.model = read.get(f"{self.name}.mo", Values([], {}, []))
        self.ends = _ends(self.model.values)
        """Connections in the robot model."""

    def of(self, kind: str, name: str) -> str:
        """Return the component of an element; empty if the package lacks the element."""
        return self.components.get((kind, name), "")

    def parts(self) -> Iterable[tuple[str, Element, str]]:
        """Return kind, element and component of all elements that both source and package have."""
        every = ((kind, self.elements[kind].get(name), c) for (kind, name), c in self.components.items())
        return [(kind, part, c) for kind, part, c in every if part]

    def bench(self, file: str) -> Texts:
        """Return the expected texts of Run or Test: the bench, the sources at the axes of joints, and the outputs."""
        texts, joints, is_run = self.texts(file), self.reading.joints, file.endswith("Run.mo")
        named = any(joint.is_named for joint in joints.values() if joint.in_loop and not joint.leader)
        tolerance = "1e-8" if self.reading.loops else "1e-6"
        whole = pairs(models.BENCH[self.options.base] + models.EXPERIMENT, name=self.name, tolerance=tolerance)
        if is_run:
            whole["robot.fixedStart"] = "false"
        else:
            whole["extends"] += ",Modelica.Icons.Example"
        if self.options.visualizer == "visualization2":
            whole["type of visualizationSetup"] = "innerVisualization2.VisualizationSetup"
        every = {"robot": (0, whole)}
        for kind, element, component in self.parts():
            expected = dict[str, str]()
            if kind == "sensor" and is_run:
                _, letters = models.SENSORS[element.type]
                for letter in letters:
                    text, unit = f"robot.{component}.{letter}", models.UNITS[letter]
                    expected |= pairs(models.OUTPUT, o=f"{component}_{letter}", value=text, unit=unit)
            elif kind == "joint" and element.type in MOVES and not element.leader:
                flanges = [self.flange(component, side) for side in ("axis", "support")]
                # in a loop, urdfsync chooses the driven joints: among the named joints, or among all joints
                is_free = flanges[0] in texts and (element.is_named or not named)
                is_driven = bool(element.command) and (is_free or not element.in_loop)
                expected, fixed = {flanges[0]: "nothing"}, f"robot.{component}.fixedStart"
                if is_driven:
                    expected = self._source(element, component, flanges, texts, is_run=is_run)
                is_pushed = not is_driven or element.command == "effort"
                if is_run and is_pushed and (fixed in texts or not element.in_loop):
                    expected[fixed] = "true"
            every[f"{kind} {element.name}"] = element.line, expected
        return every

    def generic(self) -> Texts:
        """Return the expected texts of the bench of the generic robot."""
        is_fixed = self.options.base == "fixed"
        experiment = models.EXPERIMENT.replace("10", "10" if is_fixed else "1", 1)
        expected = pairs(models.GENERIC[self.options.base] + experiment, name=self.name, tolerance="1e-6")
        for kind, is_turning, reach in (("rotational", True, 1), ("translational", False, 0.1)):
            words, titles = WORDS[is_turning], self.record.titles
            matches = [re.match(f'Number of joint "(.*)" in {kind}Axis', title) for title in titles.values()]
            axes = [self.components.get(("joint", match[1]), "") for match in matches if match]
            if axes:
                own = {"k": kind, "kind": kind.capitalize(), "n": len(axes), "reach": reach}
                expected |= pairs(models.GENERIC_AXES, **words, **own)
            if self.begun.intersection(axes):
                near = "UrdfSync.Functions.closestToZero(robot.{q}_min[{k}],robot.{q}_max[{k}])"
                starts = (
                    f"startPositions.{axis}" if axis in self.begun else near.format(k=k, **words)
                    for k, axis in enumerate(axes, 1)
                )
                expected[f"robot.{words['q']}_start"] = f"{{{','.join(starts)}}}"
                expected["type of startPositions"] = f"parameter{self.name}Start"
        return {"robot": (0, expected)}

    def shapes(self, link: Element, component: str) -> tuple[str, dict[str, Value], Texts]:
        """Return the file of a link's model, its texts about shapes and contacts, and the expected texts."""
        options = self.options
        file, record = (f"Links/{_class(component)}{ending}.mo" for ending in ("", "Parameters"))
        if file not in self.read or record not in self.read:
            return file, {}, {}
        expected, parts = dict[str, str](), {each.path for each in self.read[record].types}
        is_standard, is_mobile = options.visualizer == "standard", options.base == "floating"
        for part in sorted(parts):
            if stated := link.values.get(f"{part.partition('_')[0]}.shape"):
                kind, contact = stated.value.capitalize(), part.replace("collision", "contact")
                if is_standard:
                    shown = "animation" if part == contact else "showCollisions"
                    expected |= pairs(models.SHAPE, part=part, kind=kind, shown=shown)
                if part != contact and is_mobile and (kind != "Mesh" or f"{part}Corners" in parts):
                    form = "Points" if kind == "Mesh" else kind
                    expected |= pairs(models.CONTACT, c=contact, kind=form, part=part)
                    expected |= {f"{contact}.corners": f"parameters.{part}Corners"} if kind == "Mesh" else {}
                    numbers = {n: field for n, field in models.SURFACE.items() if f"contact.{n}" in link.values}
                    expected |= {f"{contact}.{field}": f"parameters.contact.{n}" for n, field in numbers.items()}
        texts = _about(rf"(contact{'|visual|collision' * is_standard})\d", self.texts(file))
        return file, texts, {f"link {link.name}": (link.line, expected)}

    def library(self) -> Iterable[tuple[str, dict[str, Value], Texts]]:
        """Yield the file, the texts and the expected texts of each library class that only this comparison looks at.

        Such classes draw the shapes of this robot, or give a planar joint its directions.
        """
        every = (stated for link in self.reading.links.values() for stated in link.values.items())
        kinds = {stated.value.capitalize() for path, stated in every if path.endswith(".shape")}
        classes = dict[str, dict[str, str]]()
        for kind in sorted(kinds if self.options.visualizer == "standard" else ()):
            expected = classes[f"Visualizers.{kind}"] = pairs(models.VISUALIZER, kind=kind)
            for s, words in models.DRAWINGS[kind].items():
                expected |= pairs(models.DRAWING, s=s, **words)
        if any(joint.type == "planar" for joint in self.reading.joints.values()):
            classes["Functions.normalTo"] = pairs(models.NORMAL)
        for name, expected in classes.items():
            path = library_folder() / LIBRARY / f"{name.replace('.', '/')}.mo"
            self.read[file := str(path)] = read_values(path.read_text("utf-8"))
            yield file, self.statements(file), {f"{LIBRARY}.{name}": (0, expected)}

    def laws(self, joint: Element, component: str) -> tuple[str, dict[str, Value], Texts]:
        """Return the file of a joint's model, its texts about friction and spring, and the expected texts."""
        file, expected = f"Joints/{_class(component)}.mo", dict[str, str]()
        if file not in self.read:
            return file, {}, {}
        words = WORDS[joint.type in TURNS] | {"kind": _kind(joint)}
        if joint.friction:
            suffix = {"smooth": "", "stiction": "Stiction", "lugre": "LuGre"}[joint.friction]
            expected |= pairs(models.FRICTION, law=f"{words['kind']}{suffix}", **words)
        run = self.texts(f"{self.name}Run.mo") if f"{self.name}Run.mo" in self.read else {}
        # in a loop, few joints have a drive; a joint without a drive has no spring
        if joint.is_elastic and (not joint.in_loop or self.flange(component, "axis") in run):
            expected |= pairs(models.SPRINGS[joint.is_saturated and joint.command != "effort"], **words)
        own = re.compile(r"(type of )?(FrictionLaw|friction|elasticity)\b")
        texts = {path: value for path, value in self.statements(file).items() if own.match(path)}
        return file, texts, {f"joint {joint.name}": (joint.line, expected)}

    def closing(self, loop: Element, component: str) -> tuple[str, dict[str, Value], Texts]:
        """Return the file of a loop's model, its texts about the constraint, and the expected texts."""
        file = f"Joints/{_class(component)}.mo"
        if file not in self.read:
            return file, {}, {}
        return (
            file,
            _about(r"constraint\b", self.statements(file)),
            {f"loop {loop.name}": (loop.line, pairs(models.CONSTRAINT))},
        )

    def free(self, joint: Element, component: str) -> tuple[str, dict[str, Value], Texts]:
        """Return the file of a planar or floating joint's model, its texts, and the expected texts."""
        file, has_losses = f"Joints/{_class(component)}.mo", "translation.damping" in joint.values
        if file not in self.read:
            return file, {}, {}
        expected = pairs(f"{models.FREE[joint.type]}; {models.PLACED}", C=_class(component))
        for j, (n, k, f, of) in models.FREEDOMS.items() if joint.type == "planar" else ():
            words = WORDS[j == "revolute"] | {"j": j, "n": n, "k": k, "f": f, "of": of, "axis": str(has_losses).lower()}
            words |= {"Joint": j.partition("_")[0].title(), "kind": f"{of.title()}al"}
            expected |= pairs(models.FREEDOM + models.LOSS * has_losses, **words)
        return file, self.texts(file), {f"joint {joint.name}": (joint.line, expected)}

    def texts(self, file: str) -> dict[str, Value]:
        """Return all texts of a class by paths: see `models`. A vector of inputs has a path for each item."""
        ends = {end: Value(end, "", *others[0]) for end, others in _ends(self.read[file].values).items()}
        return ends | self.statements(file)

    def statements(self, file: str) -> dict[str, Value]:
        """Return all texts of a class but connections, by paths."""
        read, texts = self.read[file], dict[str, Value]()
        for each in (*read.values, *read.types):
            path = each.path if each.type or each.path == "extends" else f"type of {each.path}"
            if each.type.endswith("RealInput") and each.text.startswith("{"):
                for k, item in enumerate(each.text.strip("{}").split(","), 1):
                    place = each.path.replace(".", f"[{k}].")
                    texts[place] = each._replace(path=place, text=item)
            elif path != "connect":
                before = f"{texts[path].text}," if path == "extends" and path in texts else ""
                texts[path] = Value(path, each.type, f"{before}{each.text}", each.line)
        return texts

    def flange(self, component: str, side: str) -> str:
        """Return the connector of the robot for the axis or the support of a joint."""
        return next((f"robot.{end}" for end, _ in self.ends[f"{component}.{side}"] if "." not in end), "")

    def _source(
        self, joint: Element, component: str, flanges: Sequence[str], texts: Mapping[str, Value], *, is_run: bool
    ) -> dict[str, str]:
        """Return the expected texts of a joint's source in Run or Test."""
        own, drive, command = f"robot.{component}", f"{component}Drive", joint.command
        words = WORDS[joint.type in TURNS] | {"axis": flanges[0], "support": flanges[1], "own": own, "d": drive}
        words |= {"kind": _kind(joint), "joint": component}
        if not is_run:
            more = {f"{drive}.reach": f"robot.startPositions.{component}Reach"} if f"{drive}.reach" in texts else {}
            return pairs(models.TEST, **words) | more
        place = f"{component}_{words['qvf'[COMMANDS.index(command)]]}"
        start = f"{own}.{words['q']}_start" if command == "position" and component in self.begun else ""
        if self.options.inputs == "vector":
            driven = self.read[f"{self.name}Run.mo"].titles
            order = [each.path for each in self.model.types if f"{each.path}Drive" in driven]
            vectors = (value.path.partition("[")[0] for value in texts.values() if value.type.endswith("RealInput"))
            place = f"{next(vectors, '')}[{order.index(component) + 1 if component in order else 0}]"
            start = start or "0" * bool(self.begun)
        words |= {"inputs": place.partition("[")[0], "input": place, "command": place}
        if command == "effort" and joint.is_saturated:
            limits = f"{own}.parameters.limits.effort,{own}.parameters.limits.velocity"
            words["command"] = f"UrdfSync.Functions.limitedEffort({place},{component}_{words['v']},{limits})"
        return pairs(models.RUN[command], **words) | ({f"{place}.start": start} if start else {})


class RobotModel:
    """The expected robot model: the parts with modifiers in `texts`, and the connections in `edges`."""

    def __init__(self, own: Classes, given: Mapping[str, Value]) -> None:
        self.own, self.given, self.edges = own, given, list[Edge]()
        self.part, self.element = Element("", 0), "robot"
        self.expected = self._whole()
        """The expected texts of `part`."""
        self.texts: dict[str, tuple[int, Mapping[str, str]]] = {"robot": (0, self.expected)}
        for kind, part, c in own.parts():
            self.part, self.element, self.expected = part, f"{kind} {part.name}", {}
            self.texts[self.element] = part.line, self.expected
            if kind == "link":
                self._state(models.LINK, c=c, C=_class(c))
                framed, inner = own.options.frames, {joint.parent for joint in own.reading.joints.values()}
                if part.name not in inner or framed == "all" or (framed != "leaves" and part.name in framed):
                    self._show("Frame", f"{c}.frame_a", c)
            elif kind == "sensor":
                self._sensor(c)
            else:
                self._state(models.JOINT, c=c, C=_class(c))
                self._connect(f"{c}.frame_a", f"{own.of('link', part.parent)}.frame_a")
                self._connect(f"{c}.frame_b", f"{own.of('link', part.child)}.frame_a")
                if kind == "joint" and part.type in MOVES:
                    self._axis(c)

    def _state(self, patterns: str, **words: object) -> None:
        self.expected |= pairs(patterns, **words)

    def _connect(self, end: str, other: str) -> None:
        self.edges.append(Edge(self.element, self.part.line, end, other))

    def _show(self, ending: str, end: str, component: str) -> None:
        """Connect an end with the connector of the robot that is named after a component."""
        others = (other for other, _ in self.own.ends[end])
        name = next((o for o in others if re.fullmatch(rf"{component}{ending}(_\d+)?", o)), component + ending)
        self._connect(end, name)
        self.expected[f"type of {name}"] = (
            f"Modelica.Mechanics.{models.CONNECTORS[ending].format(kind=_kind(self.part))}"
        )

    def _whole(self) -> dict[str, str]:
        own = self.own
        masses = [f"{c}.m" for (kind, _), c in own.components.items() if kind == "link"]
        given = re.sub(r"\s", "", self.given["m"].text).split("+") if "m" in self.given else []
        masses = given if sorted(given) == sorted(masses) else masses  # the order of a sum has no effect
        base = "Stationary" if own.options.base == "fixed" else "Mobile"
        expected = pairs(models.ROBOT, Base=base, masses="+".join(masses))
        if f"{own.name}Start.mo" in own.read:
            expected["type of startPositions"] = f"parameter{own.name}Start"
        if own.reading.sensors:
            expected["type of sensorParameters"] = f"parameter{own.name}Sensors"
        for root in own.reading.links.keys() - {joint.child for joint in own.reading.joints.values()}:
            self._connect(f"{own.of('link', root)}.frame_a", "frame_a")
        return expected

    def _sensor(self, c: str) -> None:
        kind, _ = models.SENSORS[self.part.type]
        self._state(models.SENSOR, c=c, kind=kind)
        if kind in ("Camera", "Lidar"):
            self._show("Frame", f"{c}.frame_b", c)
        if kind != "ForceTorque":
            self._connect(f"{c}.frame_a", f"{self.own.of('link', self.part.parent)}.frame_a")
            return
        (in_parent, is_reversed), joint = self.part.axes, self.own.of("joint", self.part.parent)
        for letter in "ft":
            vector = f"{joint}.frame_b.{letter}"
            vector = f"{joint}.frame_a.R.T*({vector}*{joint}.frame_b.R.T)" if in_parent else vector
            self.expected[f"{c}.{letter}_joint"] = f"{'-' * is_reversed}{vector}"

    def _axis(self, c: str) -> None:
        """State the modifiers, the coupling, the gear and the connections of a joint with one axis."""
        joint, own, joints = self.part, self.own, self.own.reading.joints
        words = WORDS[joint.type in TURNS] | {"c": c, "kind": _kind(joint)}
        followers = [
            self._coupling(own.of("joint", each.name)) for each in joints.values() if each.leader == joint.name
        ]
        if joint.leader:
            self._follow(c, words)
        else:
            self._show("Axis", f"{c}.axis", c)
            self._show("Support", f"{c}.support", c)
            fixed = self.given.get(f"{c}.fixedStart")
            # in a loop, `fixedStart` is true for one joint per degree of freedom
            is_guess = joint.in_loop and fixed and fixed.text == "false"
            self._state(models.AXIS, fixed="false" if is_guess else "fixedStart", **words)
            if c in own.begun:
                self.expected[f"{c}.{words['q']}_start"] = f"startPositions.{c}"
        if followers:
            order = [path for path in self.given if path.endswith(".parameters")]
            followers.sort(key=lambda m: order.index(f"{m}.parameters") if f"{m}.parameters" in order else -1)
            is_open = joint.type == "continuous"
            least, most = (f"{c}.parameters.limits.{end}" for end in ("lower", "upper"))
            least, most = ("-Modelica.Constants.inf", "Modelica.Constants.inf") if is_open else (least, most)
            lists = (f",{{m}}.{end}" for end in ("leader_min", "leader_max", "leaderSpeed_max"))
            mins, maxs, speeds = ("".join(item.format(m=m) for m in followers) for item in lists)
            self._state(models.LEADER, **words, least=least + mins, most=most + maxs, speeds=speeds)
        shared = {name for each in joints.values() if self._has_gear(each) for name in (each.name, each.shares)}
        if not joint.leader and (followers or joint.name in shared):
            self.expected[f"{c}.checkEffort"] = "false"
        has_motor = own.options.drives == "motor"
        if self._has_gear(joint):
            gear = self._beside(f"{c}.parameters.transmission", "UrdfSync.Drives.SharedGear", f"{c}Gear")
            self._state(models.GEAR, g=gear, c=c)
            self._connect(f"{gear}.flange_b", f"{c}.axis")
            self._connect(f"{gear}.flange_c", f"{own.of('joint', joint.shares)}.axis")
            if has_motor:
                self._show("Motor", f"{gear}.flange_a", c)
        elif has_motor and "transmission.reduction" in joint.values and not joint.leader:
            self._show("Motor", f"{c}.motor", c)

    def _follow(self, c: str, words: Mapping[str, str]) -> None:
        """State the coupling of a follower. A leader that never moves holds its follower."""
        coupling, leader = self._coupling(c), self.own.reading.joints.get(self.part.leader)
        start, kind = f"{c}.parameters.mimic.offset", f"Held{words['kind']}"
        self._connect(f"{coupling}.follower", f"{c}.axis")
        if leader and leader.type in MOVES:
            first = self.own.of("joint", leader.name)
            start = f"{c}.parameters.mimic.multiplier*{first}.{WORDS[leader.type in TURNS]['q']}_start+{start}"
            kind = f"{_kind(leader)}To{words['kind']}"
            self._connect(f"{coupling}.leader", f"{first}.axis")
            self._state(models.COUPLING, m=coupling, **words)
        self._state(models.FOLLOWER, **{**words, "kind": kind}, start=start, m=coupling)

    def _coupling(self, follower: str) -> str:
        return self._beside(f"{follower}.parameters.mimic", "UrdfSync.Couplings.", f"{follower}Mimic")

    def _beside(self, parameters: str, class_: str, name: str) -> str:
        """Return the component of a class with these parameters; `name` if the model has no such component."""
        given = (
            path for path, value in self.given.items() if value.text == parameters and value.type.startswith(class_)
        )
        return next(given, name).partition(".")[0]

    def _has_gear(self, joint: Element) -> bool:
        """Return whether the robot model has a gear for a joint that shares its motor."""
        return bool(joint.shares) and (
            self.own.options.drives == "motor" or "transmission.rotorInertia" in joint.values
        )


def _about(names: str, texts: Mapping[str, Value]) -> dict[str, Value]:
    """Return the texts about the components whose names match a pattern: values, types and conditions."""
    own = re.compile(f"((type|condition) of )?{names}")
    return {path: value for path, value in texts.items() if own.match(path)}


def _kind(joint: Element) -> str:
    return "Rotational" if joint.type in TURNS else "Translational"


def groups(edges: Iterable[tuple[str, ...]]) -> dict[str, set[str]]:
    """Return for each end all ends that connections join with it, directly or indirectly."""
    groups = dict[str, set[str]]()
    for first, second in edges:
        merged = groups.get(first, {first}) | groups.get(second, {second})
        groups |= dict.fromkeys(merged, merged)
    return groups


def _class(component: str) -> str:
    return f"{component[0].upper()}{component[1:]}"


def _ends(values: Sequence[Value]) -> defaultdict[str, list[tuple[str, int]]]:
    """Return for each end the connected ends, with the lines of the connections."""
    ends = defaultdict[str, list[tuple[str, int]]](list)
    for value in values:
        if value.path == "connect":
            first, second = value.text.split(" ")
            ends[first].append((second, value.line))
            ends[second].append((first, value.line))
    return ends
