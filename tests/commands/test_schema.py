"""`urdfsync schema`: each command has one, which refuses other documents."""

from __future__ import annotations

import jsonschema_rs
import pytest
from support.commands import Execute
from support.documents import is_described

from urdfsync import cli
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
