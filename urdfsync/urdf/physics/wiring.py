"""Checks the connections of Run and Test by their texts: they are compiled, but Run is never driven."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence

from urdfsync.checks.experiment import Deviation, Part, Quantity
from urdfsync.domain import Target
from urdfsync.modelica.literals import string
from urdfsync.modelica.parser import parse
from urdfsync.modelica.syntax import Class, Component, Modifier, Name
from urdfsync.modelica.tree import SyntaxTree, read_tree
from urdfsync.urdf.connectors import Drive, connector_names, input_vector
from urdfsync.urdf.drives import assembly
from urdfsync.urdf.kinematics.tree import KinematicTree
from urdfsync.urdf.options import Options

_REFERENCES = {"position": ("phi_ref", "s_ref"), "velocity": ("w_ref", "v_ref"), "effort": ("tau", "f")}
"""Inputs of sources, by their quantity."""
_BENCHES = ("PartialBench", "PartialMobileBench")


def wiring(texts: Mapping[str, bytes], tree: KinematicTree, target: Target, options: Options) -> Iterator[Deviation]:
    """Yield whether each axis has its own source and input, and whether gravity is the bench's."""
    names, dependent, numbered = connector_names(tree, options), assembly(tree, options).dependent, 0
    classes = {bench: _read(texts, f"{target.name}{bench}") for bench in ("Run", "Test")}
    for bench, (definition, _) in classes.items():
        yield _deviation("robot", f"gravity of {bench}", definition is not None and _has_own_gravity(definition))
    used = defaultdict[str, set[str]](set)
    for joint, drive in names.drives.items():
        component = tree.joint(joint).component
        record = texts.get(f"Joints/{tree.joint(joint).record}.mo", b"").decode()
        is_named = f"name = {string(joint)}" in record
        yield Deviation(
            Quantity.WARNING, f"joint {joint}", float(not is_named), 1.0, 1.0, "", Part.LIMITS, "names the joint"
        )
        for bench, (_, ends) in classes.items() if joint in dependent else ():
            is_free = not ends.get(f"robot.{drive.axis}")
            yield _deviation(f"joint {joint}", f"axis of a dependent joint in {bench}", is_free)
        if drive.command is None:
            continue
        numbered += 1
        for bench, (definition, ends) in classes.items():
            source = _source(ends, drive)
            is_right = source not in used[bench] and source != "" and definition is not None
            used[bench].add(source)
            if bench == "Run":
                expected = f"{input_vector(names)}[{numbered}]" if options.inputs == "vector" else _input(drive)
                references = [f"{source}.{name}" for name in _REFERENCES[drive.command]]
                is_right = is_right and [e for name in references for e in ends.get(name, ())] == [expected]
            elif definition is not None:
                parts = [part for part in definition.components if str(part.name) == source]
                is_right = is_right and all(_moves(part, component) for part in parts)
            yield _deviation(f"joint {joint}", f"source in {bench}", is_right)


def _deviation(element: str, detail: str, is_right: bool) -> Deviation:
    return Deviation(Quantity.CONNECTION, element, float(not is_right), 1.0, 1.0, "", Part.BENCHES, detail)


def _read(texts: Mapping[str, bytes], name: str) -> tuple[Class | None, Mapping[str, Sequence[str]]]:
    """Return a class of the package, and the connections of each end in it."""
    text = texts.get(f"{name}.mo", b"").decode()
    ends = defaultdict[str, list[str]](list)
    tree = read_tree(text)
    body = tree.find("body") if tree else None
    for part in body.node.parts if body and isinstance(body.node, SyntaxTree) else ():
        kind, *pair = part.key.split()
        if kind == "connect":
            ends[pair[0]].append(pair[1])
            ends[pair[1]].append(pair[0])
    return next(iter(parse(text).classes), None), ends


def _has_own_gravity(definition: Class) -> bool:
    """Return whether a bench extends one of the library's, and keeps its world."""
    bases = [base for base in definition.extends if base.type.parts[-1] in _BENCHES]
    changed = [str(argument.name) for base in bases for argument in base.arguments]
    return len(bases) == 1 and "world" not in (*changed, *(str(part.name) for part in definition.components))


def _source(ends: Mapping[str, Sequence[str]], drive: Drive) -> str:
    """Return the only component that moves an axis against its own housing; empty if there is none."""
    flanges, supports = (ends.get(f"robot.{name}", ()) for name in (drive.axis, drive.support))
    if len(flanges) != 1 or len(supports) != 1:
        return ""
    source, _, connector = flanges[0].rpartition(".")
    return source if connector == "flange" and supports[0] == f"{source}.support" else ""


def _input(drive: Drive) -> str | None:
    return {"position": drive.position, "velocity": drive.velocity, "effort": drive.effort}[drive.command or ""]


def _moves(part: Component, component: str) -> bool:
    """Return whether the modifiers of a source concern only this joint."""

    def uses(arguments: Sequence[Modifier]) -> Iterator[Name]:
        for argument in arguments:
            yield from argument.uses
            yield from uses(argument.arguments)

    names = [name.parts[1:] for name in uses(part.arguments) if name.parts[0] == "robot"]
    # how far a joint in a loop moves is among the starts: startPositions.crank_pivotReach
    return {name[1].rpartition("Reach")[0] if name[0] == "startPositions" else name[0] for name in names} <= {component}
