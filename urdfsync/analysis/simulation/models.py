"""Finds the simulated model: its file, its base classes, its inputs and its settings."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import msgspec

from urdfsync.analysis.simulation.results import STEPS
from urdfsync.common.diagnostics import ConfigError
from urdfsync.common.files import shown
from urdfsync.common.spelling import nearest
from urdfsync.modelica.classes import OPAQUE, ClassNode, Type
from urdfsync.modelica.files import text_of
from urdfsync.modelica.lexer import Lexer
from urdfsync.modelica.scopes import Scopes
from urdfsync.modelica.syntax import Component

_EXPERIMENT = re.compile(r"\bexperiment\s*\(((?:[^()]|\([^()]*\))*)\)")
_SETTING = re.compile(r"\b(StopTime|Interval|Tolerance|NumberOfIntervals)\s*=\s*(\d[.\deE+-]*)\s*(?=,|$)")
_SIZE = re.compile(r"\s*\[\s*(\d+)\s*\]")
_ARRAY = re.compile(r"\s*\[")
_INPUT = re.compile(r"(Real|Integer|Boolean)(Vector)?Input")
"""The names of the connectors of the Modelica Standard Library for inputs."""
_UNIT = re.compile(r"\bunit\s*=\s*(\"[^\"]*\"|\{[^{}]*\})")
_OPENING, _CLOSING = ("(", "{", "["), (")", "}", "]")
_KINDS = ("model", "block", "class")
_FILTERED = (("Sources", "Position"), ("Sources", "Speed"))
"""Endings of the names of drives of the Modelica Standard Library that filter their input."""


class Input(msgspec.Struct, frozen=True):
    """An input of a model, or one element of a vector of inputs."""

    name: str
    unit: str
    """The unit as Modelica writes it; empty if unknown."""


class Driven(msgspec.Struct, frozen=True):
    """The changes that let the inputs of a model follow a table."""

    changed: Mapping[Path, bytes]
    """Contents of files in which the inputs are outputs, so that equations of the model may set them."""
    modifiers: tuple[str, ...]
    """Modifiers that switch the filters of drives off."""


class Model:
    """A class that can be simulated, with its base classes."""

    def __init__(self, scopes: Scopes, node: ClassNode, content: Callable[[str], bytes]) -> None:
        """`content` reads a Modelica file."""
        self.node, self.name = node, str(node)
        # the parser's text, since components have positions in it
        self._text = functools.cache(lambda file: text_of(content(file)))
        self._nodes = [base for base in _with_bases(scopes, node) if base.file]

    @functools.cached_property
    def settings(self) -> dict[str, float]:
        """The numbers in the model's annotation `experiment`, by their names in Modelica."""
        name = self.node.definition.name
        text = self._text(self.node.file)[name.starts[0] :] if self.node.file and name.starts else ""
        experiment = _EXPERIMENT.search(re.split(rf"\bend\s+{re.escape(str(name))}\s*;", text)[0])
        numbers = {name: float(number) for name, number in _SETTING.findall(experiment[1])} if experiment else {}
        return {name: number for name, number in numbers.items() if number > 0}

    def step(self, stop: float, wanted: float | None) -> float:
        """Return the interval of results of a simulation until `stop`, in s: the `wanted` one, else the model's."""
        return wanted or self.settings.get("Interval") or stop / self.settings.get("NumberOfIntervals", STEPS)

    def inputs(self) -> list[Input]:
        """Return all inputs, the inputs of base classes first. Raises ConfigError for an input that can't be driven."""
        inputs: list[Input] = []
        for node, component in self._components():
            if not _INPUT.fullmatch(component.type.parts[-1]) and "input" not in component.prefixes:
                continue
            name, text = str(component.name), self._text(node.file)
            after = _declaration(text, component.name.starts[0] + len(name))
            if component.type.parts[-1] != "RealInput" and re.search(r"\bif\b", after):
                continue  # most models need no such input, and its condition is false
            size, type_end = _SIZE.match(after), component.type.starts[-1] + len(component.type.parts[-1])
            is_sized = _ARRAY.match(after) or _ARRAY.match(text, type_end)
            if component.type.parts[-1] != "RealInput" or (is_sized and not size):
                message = f"the input `{name}` can't be driven: it is no RealInput, or its size is not after its name"
                file, line = shown(Path(node.file)), component.name.line
                raise ConfigError.of("inputs", message, file, line)
            units = re.findall(r'"([^"]*)"', unit[1]) if (unit := _UNIT.search(after)) else []
            count = int(size[1]) if size else 1
            units = units if len(units) == count else units[:1] * count or [""] * count
            names = [f"{name}[{number}]" for number in range(1, count + 1)] if size else [name]
            inputs += map(Input, names, units)
        return inputs

    def driven(self, package: str) -> Driven:
        """Return the changes that let inputs follow a table, and that switch off the filters of the package's drives.

        Drives of the user's own models keep their filters: without a filter, start values may contradict the motion.
        """
        changed: dict[str, list[int]] = {}
        modifiers = []
        for node, component in self._components():
            if component.type.parts[-1] == "RealInput":
                changed.setdefault(node.file, []).append(component.type.starts[-1])
            elif str(node).startswith(f"{package}.") and component.type.parts[-2:] in _FILTERED:
                start = component.name.starts[0] + len(str(component.name))
                each = "each " if _ARRAY.match(self._text(node.file), start) else ""
                modifiers.append(f"{component.name}({each}exact = true)")
        texts = {}
        for file, places in changed.items():
            text = self._text(file)
            for place in sorted(set(places), reverse=True):
                text = f"{text[:place]}RealOutput{text[place + len('RealInput') :]}"
            texts[Path(file)] = text.encode(errors="surrogateescape")
        return Driven(texts, tuple(modifiers))

    def _components(self) -> Iterator[tuple[ClassNode, Component]]:
        for node in reversed(self._nodes):
            for component in node.components.values():
                yield node, component


def _declaration(text: str, start: int) -> str:
    """Return a declaration from the end of its name on; in `Real a, b(unit = "m");` that of `a` is empty."""
    lexer, depth = Lexer(text[start:]), 0
    lexer.read_statement()
    for word, place in zip(lexer.words, lexer.starts, strict=True):
        depth += (word in _OPENING) - (word in _CLOSING)
        if word in (",", ";") and depth == 0:
            return lexer.text[:place]
    return lexer.text


def find_model(scopes: Scopes, package: str, name: str, content: Callable[[str], bytes]) -> Model:
    """Return the model of a full name, or of a name below the package. Raises ConfigError."""
    for full in dict.fromkeys((f"{package}.{name}", name)):
        node = scopes.node(full.split("."))
        if node is not None:
            kind = node.definition.kind
            if kind not in _KINDS or "partial" in node.definition.prefixes:
                what = "partial: other models extend it" if kind in _KINDS else f"a {kind}"
                message = f"`{name}` can't be simulated: it is {what}"
                raise ConfigError.of("no-model", message, shown(Path(node.file)))
            return Model(scopes, node, content)
    near = _near(scopes, package, name)
    hint = f"did you mean `{near}`?" if near else "give its full name; libraries have to be beside the package, "
    hint = hint if near else f"{hint}in the folders of `users` and on MODELICAPATH"
    raise ConfigError.of("no-model", f"there is no model `{name}`", hint=hint)


def _near(scopes: Scopes, package: str, name: str) -> str:
    """Return the name most similar to a missing one, in the deepest existing package around it; empty without one."""
    around, _, last = name.rpartition(".")
    for place in dict.fromkeys((around or package, package)):
        node = scopes.node(place.split("."))
        if node is not None and (near := nearest(last, scopes.names_in((Type(node),)))):
            return f"{place}.{near}" if place != package else near
    return ""


def _with_bases(scopes: Scopes, node: ClassNode) -> Iterator[ClassNode]:
    """Yield a class, and then its base classes, each once."""
    waiting, seen = [node], {OPAQUE}
    while waiting:
        current = waiting.pop(0)
        if current not in seen:
            seen.add(current)
            yield current
            waiting += [base.node for base in scopes.bases(current)]
