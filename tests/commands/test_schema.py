"""`urdfsync schema`: each command has one, which refuses other documents."""

from __future__ import annotations

import jsonschema_rs
import pytest
from support.commands import Execute
from support.documents import is_described

from urdfsync.commands import cli
from urdfsync.output.documents import JSON_VERSION


@pytest.mark.parametrize("command", [name for name in cli._COMMANDS if name not in ("schema", "completion")])
def test_each_command_has_a_schema(execute: Execute, command: str) -> None:
    schema = execute("schema", command).json
    assert schema["title"] == command
    assert schema["$defs"]["Diagnostic"]["properties"]["severity"]
    document = {"version": JSON_VERSION, "command": command, "exit": 0, "results": [], "diagnostics": []}
    with pytest.raises(jsonschema_rs.ValidationError):
        is_described({**document, "other": 1}, command)
    del document["exit"]
    with pytest.raises(jsonschema_rs.ValidationError):
        is_described(document, command)


PLAIN = set(
    """action actions address after against agrees arguments base before bytes change_class checked code column
    command compiled condition config diagnostics differences edits effort element event exit exported failed file
    files greatest hint joints kind least limit line log loops lower measured median message mine model name new
    numbers old option options owner package part passed path paths position quantity reason result results right
    robot robots role samples seconds severity signal source source_line speed status step stop summary text time
    tolerance total unit value version within""".split()
)
"""Keys whose name says enough beside their type and the description of their object."""


@pytest.mark.parametrize("command", "build diff watch check simulate identify fmu init record".split())
def test_a_schema_describes_each_object_and_each_key(execute: Execute, command: str) -> None:
    for name, part in execute("schema", command).json["$defs"].items():
        properties = part.get("properties", {})
        assert part.get("description") or not properties, name
        assert {key for key, value in properties.items() if "description" not in value} <= PLAIN, name
