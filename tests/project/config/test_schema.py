"""The schema of `urdfsync.toml`, which editors read; `tests/conftest.py` holds it against all that the tests read."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import jsonschema_rs
import msgspec
import pytest
from support.commands import Execute

from urdfsync.domain import registry
from urdfsync.project.config.schema import config_schema, text
from urdfsync.project.config.settings import CheckConfig, Keys

REPOSITORY = Path(__file__).parents[3]


def test_each_key_is_in_it_with_its_meaning() -> None:
    schema = config_schema()
    kinds = (Keys, registry.domain("urdf").options)
    names = {field.encode_name for kind in kinds for field in msgspec.structs.fields(kind)}
    properties = schema["$defs"]["urdf"]["properties"]
    assert properties.keys() == names
    assert schema["properties"]["check"]["properties"].keys() == set(CheckConfig.__struct_encode_fields__)
    assert all(key.get("description") for key in properties.values())
    assert "bolted down" in properties["base"]["description"]
    assert properties["output"]["default"] == "modelica"


def test_what_init_writes_names_the_schema_beside_it(folder: Path, execute: Execute) -> None:
    Path("arm.urdf").write_text('<robot name="arm"><link name="base"/></robot>')
    execute("init", "arm.urdf")
    written_text = Path("urdfsync.toml").read_text()
    assert written_text.startswith("#:schema .urdfsync/schema.json\n")
    written = json.loads(Path(".urdfsync/schema.json").read_text())
    jsonschema_rs.validate(written, tomllib.loads(written_text))
    assert written == execute("schema", "config").json
    with pytest.raises(jsonschema_rs.ValidationError, match="'bse' was unexpected"):
        jsonschema_rs.validate(written, tomllib.loads(f"{written_text}\nbse = 'fixed'\n"))


def test_a_faulty_key_of_a_table_is_named() -> None:
    table = {"source": "a.csv", "package": "A", "domain": "table", "kinds": "kind"}
    with pytest.raises(jsonschema_rs.ValidationError, match="'kinds' was unexpected"):
        jsonschema_rs.validate(config_schema(), {"robots": {"a": table}})


def test_the_schema_of_the_examples_is_that_of_the_program() -> None:
    assert (REPOSITORY / ".urdfsync/schema.json").read_text() == text()
