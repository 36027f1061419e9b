"""Reads a water network in EPANET's format by wntr: nodes and links are elements, each end of a link is a connection.

Numbers are in SI. A number that changes over time has its first value.
"""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from urdfsync.common.diagnostics import SourceError
from urdfsync.common.extras import install_command
from urdfsync.formats.table.model import Sheet

_COLUMNS = (
    "name kind elevation[m] demand[m3/s] head[m] level[m] diameter[m] length[m] roughness[1] minor_loss[1] "
    "status setting[1] shutoff_head[m] head_loss[1] exponent[1]"
).split()
_KINDS = {
    "junction": "JUNCTIONS",
    "reservoir": "RESERVOIRS",
    "tank": "TANKS",
    "pipe": "PIPES",
    "pump": "PUMPS",
    "valve": "VALVES",
}
"""Kinds of elements, with their sections in the file."""


def read(content: bytes, file: str) -> tuple[Sheet, Sheet]:
    """Return elements and connections. Raises SourceError. `file` is the name in diagnostics.

    wntr reads only files, so this writes the content to a temporary folder.
    """
    try:
        import wntr
    except ImportError:
        hint = install_command("epanet")
        raise SourceError.of("no-wntr", "a water network needs wntr, which is not installed", file, hint=hint) from None
    with tempfile.TemporaryDirectory(prefix="urdfsync-") as folder:
        path = Path(folder, "network.inp")
        path.write_bytes(content)
        try:
            network = wntr.network.WaterNetworkModel(str(path))
            found = _elements(network)
        except Exception as error:  # noqa: BLE001 - wntr may raise any error for a damaged file
            reason = " ".join(str(error).replace(str(path), file).split()) or type(error).__name__
            hint = "correct the file until EPANET reads it"
            raise SourceError.of("table-file", f"this is no water network: {reason}", file, hint=hint) from None
    lines = _lines(content.decode(errors="replace"))
    elements, connections = list[tuple[int, list[object]]](), list[tuple[int, list[object]]]()
    names = [column.partition("[")[0] for column in _COLUMNS]
    for kind, values in found:
        values["kind"], line = kind, lines.get((_KINDS[kind], values["name"]), 0)
        key = values["name"] = f"{kind} {values['name']}"
        elements.append((line, [values.get(name) for name in names]))
        for port, node in values.get("ends", {}).items():
            connections.append((line, [key, f"{_kind(network.get_node(node))} {node}", port]))
    counts = {"controls": network.num_controls, "patterns": network.num_patterns, "sources": network.num_sources}
    emitters = sum(bool(junction.emitter_coefficient) for _, junction in network.junctions())
    notes = [f"{number} {noun}" for noun, number in (counts | {"emitters": emitters}).items() if number]
    return Sheet(_COLUMNS, elements, [", ".join(notes)] if notes else []), Sheet(("from", "to", "port"), connections)


def _elements(network: Any) -> list[tuple[str, dict[str, Any]]]:
    """Return kind and values of each node and link."""
    found = list[tuple[str, dict[str, Any]]]()
    multiplier = network.options.hydraulic.demand_multiplier
    for name, node in network.nodes():
        values: dict[str, Any] = {"name": name}
        if _kind(node) == "junction":
            demand = node.demand_timeseries_list.at(0, multiplier=multiplier)
            values |= {"elevation": node.elevation, "demand": float(demand)}
        elif _kind(node) == "tank":
            values |= {"elevation": node.elevation, "level": node.init_level, "diameter": node.diameter}
        else:
            values["head"] = float(node.head_timeseries.at(0))
        found.append((_kind(node), values))
    for name, link in network.links():
        values = {"name": name, "status": str(link.initial_status).rpartition(".")[2].lower()}
        values["ends"] = {"port_a": link.start_node_name, "port_b": link.end_node_name}
        if _kind(link) == "pipe":
            values |= {key: getattr(link, key) for key in ("length", "diameter", "roughness", "minor_loss")}
        elif _kind(link) == "valve":
            values |= {"diameter": link.diameter, "minor_loss": link.minor_loss, "setting": link.initial_setting}
        elif link.pump_type == "HEAD":
            try:
                coefficients = map(float, link.get_head_curve_coefficients())
            except Exception as error:
                raise ValueError(f"the curve of pump `{name}` is no head that falls with the flow: {error}") from error
            values |= dict(zip(("shutoff_head", "head_loss", "exponent"), coefficients, strict=True))
        found.append((_kind(link), values))
    return found


def _kind(element: Any) -> str:
    """Return the kind of a node or a link."""
    return str(getattr(element, "node_type", None) or element.link_type).lower()


def _lines(text: str) -> Mapping[tuple[str, str], int]:
    """Return the line of each element, by section and name."""
    lines, section = dict[tuple[str, str], int](), ""
    for number, line in enumerate(text.split("\n"), 1):
        first = (line.split() or [""])[0]
        if first.startswith("["):
            section = first.strip("[]").upper()
        elif first and not first.startswith(";"):
            lines.setdefault((section, first), number)
    return lines
