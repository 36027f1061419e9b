"""A second domain: networks of resistors and capacitors in JSON, to Modelica.Electrical.Analog.

It shows what a domain needs, and that the core knows none: the entry point is made by a fixture.
"""

from __future__ import annotations

import csv
import io
import json
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import msgspec
from msgspec.structs import replace

from urdfsync.common.diagnostics import Diagnostic, Severity, SourceError
from urdfsync.domain import (
    Artifact,
    ChangeClass,
    Companion,
    Conversion,
    Dependency,
    Domain,
    ElementKey,
    Features,
    Import,
    Lookup,
    Order,
    Reading,
    Role,
    Target,
    Version,
    displaced,
    plain,
)
from urdfsync.domain.advice import Advice, Proposal
from urdfsync.domain.changes import Change
from urdfsync.domain.comparison import find_differences
from urdfsync.project.state.record import as_recorded

GROUND = "ground"
_NAME = re.compile(r"[A-Z][A-Za-z0-9]*", re.ASCII)


class Options(msgspec.Struct, frozen=True):
    """How a network becomes a model."""

    ground: bool = True
    """Whether the node `ground` is connected to a ground component."""
    prefix: str = "node"


class Element(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A resistor (`ohm`) or a capacitor (`farad`) between two nodes."""

    name: str
    between: tuple[str, str]
    ohm: float | None = None
    farad: float | None = None


class Network(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The whole file; `signal` is a CSV file with times and voltages against ground, for node `drives`."""

    name: str
    elements: tuple[Element, ...]
    signal: str | None = None
    drives: str = "in"


class RcAdvice(Advice):
    def propose(
        self,
        snapshot: Network,
        diagnostics: Sequence[Diagnostic],
    ) -> Sequence[Proposal]:
        nodes = {node for element in snapshot.elements for node in element.between}
        has = GROUND in nodes
        return (Proposal("ground", has, f"{'a' if has else 'no'} node is named {GROUND}"),)

    def option_for(self, name: str, snapshot: Network, target: Target, options: Options) -> str:
        return ""


class RcNetwork(Domain):
    """The domain object."""

    name = "rcnetwork"
    advice = RcAdvice()
    templates = Path(__file__).parent / "templates"
    model = Network
    options = Options
    warnings = ("no-ground",)

    def uses(self, options: Options) -> Sequence[tuple[str, str]]:
        return (("Modelica", "4.0.0"),)

    def read(self, content: bytes, file: str, options: Options, *companions: Companion) -> Reading:
        text = content.decode(errors="replace")
        try:
            network = msgspec.json.decode(content, type=Network)
        except msgspec.DecodeError as error:
            return Reading(None, (Diagnostic(Severity.ERROR, "json", str(error), file, _line(error, text)),))
        problems = tuple(_check(network, file, text))
        if problems:
            return Reading(None, problems)
        network = replace(network, elements=tuple(sorted(network.elements, key=lambda element: element.name)))
        lines = {element.name: _line_of_name(text, element.name) for element in network.elements}
        lines["signal"] = _line_of_name(text, network.signal or "")
        return Reading(network, (), lines, option_findings=tuple(_check_options(network, options)))

    def dependencies(
        self, snapshot: Network, lookup: Lookup, options: Options, lines: Mapping[str, int]
    ) -> Sequence[Dependency]:
        signal = snapshot.signal
        if signal is None:
            return ()
        folders = (lookup.source.parent, *lookup.package_paths)
        candidates = tuple(folder / signal for folder in folders)
        target = f"Resources/{Path(signal).stem}.txt"
        return (Dependency(signal, signal, candidates, target, "table", lines.get("signal", 0)),)

    def convert(self, dependency: Dependency, file: Path, content: bytes, others: Mapping[str, bytes]) -> Conversion:
        try:
            rows = [[float(cell) for cell in row] for row in csv.reader(io.StringIO(content.decode()))]
        except ValueError as error:
            raise SourceError(Diagnostic(Severity.ERROR, "csv", str(error), str(file))) from error
        lines = ["#1", f"double signal({len(rows)}, 2)", *(" ".join(map(repr, row)) for row in rows)]
        return Conversion(("\n".join(lines) + "\n").encode(), {"rows": len(rows), "end": rows[-1][0]})

    def names(self, snapshot: Network, target: Target) -> Mapping[str, Mapping[str, str]]:
        return {"elements": {element.name: element.name for element in snapshot.elements}}

    def artifacts(
        self, snapshot: Network, imports: Mapping[str, Import], target: Target, options: Options
    ) -> Sequence[Artifact | Order]:
        elements = snapshot.elements
        nodes = sorted({node for element in elements for node in element.between} - {GROUND})
        common = {"package": target.package, "class": target.name, "network": snapshot.name}
        signal = imports.get(snapshot.signal or "")
        whole = common | {"elements": elements, "nodes": nodes, "ground": options.ground, "prefix": options.prefix}
        whole |= {"signal": signal and {"target": signal.target, **signal.facts, "drives": snapshot.drives}}
        records = [f"{element.name}Parameters" for element in elements]
        classes = [element.name for element in elements]
        return (
            Artifact("package.mo", Role.PACKAGE, "network/package.mo.jinja", whole, "network"),
            Artifact("Elements/package.mo", Role.PACKAGE, "element/package.mo.jinja", common, "network"),
            *(artifact for element in elements for artifact in _element(element, common)),
            Artifact(f"{target.name}.mo", Role.MODEL, "network/network.mo.jinja", whole, "network"),
            Order("package.order", ("Elements", target.name)),
            Order("Elements/package.order", (*records, *classes)),
        )

    def features(self, snapshot: Network) -> Mapping[ElementKey, Features]:
        return {
            ("element", element.name): Features({"value": plain(replace(element, name=""))}, {})
            for element in snapshot.elements
        }

    def describe(
        self, old: Version, new: Version, renames: Mapping[ElementKey, str], options: Options
    ) -> Iterator[Change]:
        gone, units = {name for _, name in displaced(renames)}, {"ohm": "Ω", "farad": "F"}
        before = replace(
            old.snapshot,
            elements=tuple(
                replace(element, name=renames.get(("element", element.name), element.name))
                for element in old.snapshot.elements
                if element.name not in gone
            ),
        )
        for difference in find_differences(old, new, as_recorded(before), as_recorded(new.snapshot)):
            _, *fields = map(str, difference.path)
            unit = units.get(fields[-1], "") if fields else ""
            yield difference.change(
                tuple(fields) or ("network",), ChangeClass.PARAMETER if unit else ChangeClass.STRUCTURAL, unit
            )

    def drawing(
        self,
        snapshot: Network,
        imports: Mapping[str, Import],
        target: Target,
        options: Options,
        differing: Mapping[str, tuple[str, str]],
    ) -> str | None:
        texts = [
            f'<text y="{20 * (y + 1)}">{name}</text>'
            for y, name in enumerate(element.name for element in snapshot.elements)
        ]
        return f'<svg xmlns="http://www.w3.org/2000/svg">{"".join(texts)}</svg>\n'


def _element(element: Element, common: Mapping[str, Any]) -> Iterator[Artifact]:
    kind = "resistor" if element.ohm is not None else "capacitor"
    owner, data = f"element {element.name}", {**common, "element": element, "kind": kind}
    path = f"Elements/{element.name}"
    yield Artifact(f"{path}Parameters.mo", Role.RECORD, "element/parameters.mo.jinja", data, owner)
    yield Artifact(f"{path}.mo", Role.MODEL, "element/model.mo.jinja", data, owner)


def _check(network: Network, file: str, text: str) -> Iterator[Diagnostic]:
    def problem(code: str, message: str, name: str) -> Diagnostic:
        return Diagnostic(Severity.ERROR, code, message, file, _line_of_name(text, name))

    for name, count in Counter(element.name for element in network.elements).items():
        if count > 1:
            yield problem("duplicate-element", f"there are {count} elements `{name}`", name)
    for element in network.elements:
        if not _NAME.fullmatch(element.name):
            yield problem("element-name", f"{element.name!r} is no class name", element.name)
        if (element.ohm is None) == (element.farad is None):
            yield problem("element-value", f"element `{element.name}` needs either `ohm` or `farad`", element.name)


def _check_options(network: Network, options: Options) -> Iterable[tuple[str, Diagnostic]]:
    nodes = {node for element in network.elements for node in element.between}
    if options.prefix in nodes:
        message, hint = f"`prefix` names `{options.prefix}`, which is a node", "choose another one"
        yield "prefix", Diagnostic(Severity.ERROR, "prefix-is-node", message, hint=hint)
    if options.ground and GROUND not in nodes:
        yield "ground", Diagnostic(Severity.NOTE, "no-ground", "no node is called `ground`")


def _line_of_name(text: str, name: str) -> int:
    place = text.find(json.dumps(name))
    return text.count("\n", 0, place) + 1 if place >= 0 else 0


def _line(error: msgspec.DecodeError, text: str) -> int:
    place = re.search(r"byte (\d+)", str(error))
    return text.count("\n", 0, int(place[1]) if place else len(text)) + 1


DOMAIN = RcNetwork()
