"""The table domain; `urdfsync.domain.Domain` describes its functions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import msgspec

from urdfsync.domain import (
    Artifact,
    Companion,
    CompanionKind,
    Domain,
    ElementKey,
    Features,
    Import,
    LazyModule,
    Order,
    Reading,
    Role,
    Target,
)
from urdfsync.formats.table.model import FROM, SHEETS, TO, Table, TableOptions, column_name, component_names, shown_unit
from urdfsync.modelica.literals import capitalize_first

_FOLDERS = {
    "Records": (Role.RECORD, "record", "Numbers of the elements"),
    "Models": (Role.MODEL, "model", "Models of the elements"),
}
_MODELICA = {"text": "String", "integer": "Integer", "boolean": "Boolean"}


class TableDomain(Domain):
    """Turns tables of elements into Modelica packages."""

    name = "table"
    warnings = ("not-modelled", "unit-jump")
    model = Table
    options = TableOptions
    companions = (CompanionKind("connections", ".connections.csv"),)
    judgements = parts = LazyModule("urdfsync.formats.table.columns")
    advice = simulation = LazyModule("urdfsync.formats.table.starter")
    pictures = LazyModule("urdfsync.formats.table.scene")

    def starter(self, snapshot: Table) -> Mapping[str, str]:
        """Return templates for a table. The user edits these templates."""
        from urdfsync.formats.table.starter import templates
        from urdfsync.project.config import templates_folder

        return templates(snapshot, templates_folder(self))

    def uses(self, options: TableOptions) -> Sequence[tuple[str, str]]:
        """Return the libraries in the configuration."""
        return tuple(options.uses.items())

    def read(self, content: bytes, file: str, options: TableOptions, *companions: Companion) -> Reading:
        """Read a source, and the connections in a CSV such as `rooms.connections.csv` beside `rooms.csv`."""
        from urdfsync.formats.table.reading import read

        return read(content, file, options, *companions)

    def names(self, snapshot: Table, target: Target) -> Mapping[str, Mapping[str, str]]:
        """Return the parameters of the columns in records, and the components of the elements."""
        columns = {column: column_name(column) for column in snapshot.columns}
        return {"columns": columns, "elements": component_names(snapshot.elements, target)}

    def artifacts(
        self,
        snapshot: Table,
        imports: Mapping[str, Import],  # noqa: ARG002 - a table refers to no files
        target: Target,
        options: TableOptions,
    ) -> Iterator[Artifact | Order]:
        """Yield the files that the options choose. Templates decide on the content."""
        parent = target.package.rpartition(".")[0]
        folders = {folder: role for folder, (role, file, _) in _FOLDERS.items() if file in options.files}
        of_package: dict[str, Any] = {"within": target.package}
        elements, units = dict[str, dict[str, Any]](), dict(sorted(snapshot.columns.items()))
        columns = {
            column: {"name": column_name(column), "title": column, "type": _MODELICA.get(unit, "Real"), "unit": unit}
            for column, unit in units.items()
        }
        components = component_names(snapshot.elements, target)
        for key, row in snapshot.elements.items():
            cells = dict(sorted(row.items()))  # the order of a recorded table
            names = {"name": key, "class": capitalize_first(components[key]), "component": components[key]}
            element = elements[key] = {**names, "units": units, "kind": cells.get(options.kind, ""), "row": cells}
            for folder, role in folders.items():
                data = {"within": f"{target.package}.{folder}", "root": target.package, **element}
                template = "record.mo.jinja"
                if role is Role.MODEL:
                    template = f"model/{element['kind']}.mo.jinja" if options.kind else "model.mo.jinja"
                else:
                    data["columns"] = [columns[column] | {"value": value} for column, value in cells.items()]
                yield Artifact(f"{folder}/{element['class']}.mo", role, template, data, f"element {key}")
        name, classes = target.package.rpartition(".")[2], tuple(element["class"] for element in elements.values())
        title, uses = f"Made by urdfsync from the table {target.name}", {} if parent else options.uses
        package = {"within": parent, "name": name, "title": title, "uses": uses}
        yield Artifact("package.mo", Role.PACKAGE, "package.mo.jinja", package, "table")
        system = [target.name] if "system" in options.files else []
        yield Order("package.order", (*system, *options.classes, *folders))
        for name in options.classes:
            yield Artifact(f"{name}.mo", Role.MODEL, f"{name}.mo.jinja", of_package | {"class": name}, "table")
        if system:
            placed = {key: element | {"number": number} for number, (key, element) in enumerate(elements.items())}
            connections = [
                {"name": key, "start": placed[str(row[FROM])], "end": placed[str(row[TO])]}
                | {"row": dict(sorted(row.items()))}
                for key, row in snapshot.connections.items()
            ]
            data = of_package | {"class": target.name, "elements": [*placed.values()], "connections": connections}
            yield Artifact(f"{target.name}.mo", Role.MODEL, "system.mo.jinja", data, "table")
        for folder in folders:
            package = of_package | {"name": folder, "title": _FOLDERS[folder][2], "uses": {}}
            yield Artifact(f"{folder}/package.mo", Role.PACKAGE, "package.mo.jinja", package, "table")
            yield Order(f"{folder}/package.order", classes)

    def features(self, snapshot: Table) -> Mapping[ElementKey, Features]:
        """Return the cells of elements, the ends of connections, and columns, which match as `Parts` say."""
        features = {("element", key): Features(row, {}) for key, row in snapshot.elements.items()}
        for kind, (types, _) in SHEETS.items():
            features |= {(kind, column): Features({}, {}) for column in getattr(snapshot, types)}
        for key, row in snapshot.connections.items():
            ends = {end: ("element", str(row[end])) for end in (FROM, TO)}
            existing = {end: one for end, one in ends.items() if one in features}
            contents = {column: value for column, value in row.items() if column not in (FROM, TO)}
            features["connection", key] = Features(contents, existing)
        return features

    def arranged(self, old: Table, new: Table) -> Table:
        """Return an old table with its rows in the order of the new one."""

        def in_order(rows: dict[str, Any], others: Mapping[str, Any]) -> dict[str, Any]:
            places = {key: place for place, key in enumerate(others)}
            return dict(sorted(rows.items(), key=lambda row: places.get(row[0], len(places))))

        elements, links = in_order(old.elements, new.elements), in_order(old.connections, new.connections)
        return msgspec.structs.replace(old, elements=elements, connections=links)

    def unit(self, snapshot: Table, path: Sequence[str]) -> str:
        """Return the unit of a value at a path such as `elements`, `motor`, `mass`."""
        columns = {"elements": snapshot.columns, "connections": snapshot.connection_columns}.get(path[0], {})
        return shown_unit(columns.get(path[-1], "1"))


DOMAIN = TableDomain()
