"""Configurations as texts, messages about them, and a comparison of the schema with the program."""

from __future__ import annotations

import functools
import importlib
import os
import sys
import tomllib
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from unittest import mock

import jsonschema_rs
import pytest

from urdfsync.common.dependencies.reads import Reads
from urdfsync.common.diagnostics import ConfigError, Diagnostic
from urdfsync.domain import registry
from urdfsync.project import config
from urdfsync.project.config import Config
from urdfsync.project.config.schema import config_schema

ROOT = Path(os.path.abspath("/project"))  # noqa: PTH100 - a drive on Windows


def parse(text: str) -> Config:
    return config.parse(text, ROOT / "urdfsync.toml", "urdfsync.toml")


def robot(more: str = "", name: str = "arm", package: str = "Arm") -> str:
    return f'[robots.{name}]\nsource = "arm.json"\npackage = "{package}"\ndomain = "rcnetwork"\n{more}'


def failures(text: str) -> list[str]:
    with pytest.raises(ConfigError) as caught:
        parse(text)
    return [str(diagnostic) for diagnostic in caught.value.diagnostics]


_BEYOND = {"clash", "wrong-rename", "toml-syntax"}
"""Codes of mistakes that no schema can find: they concern several tables, or the file is no document."""


def is_valid(text: str) -> bool:
    """Whether a configuration obeys the schema."""
    return _is_valid(text, tuple(sys.path))


@functools.lru_cache(maxsize=100)
def _is_valid(text: str, path: tuple[str, ...]) -> bool:
    return bool(_validator(path).is_valid(tomllib.loads(text)))


@functools.cache
def _validator(path: tuple[str, ...]) -> jsonschema_rs.Validator:
    """Return the validator for the domains that are installed on Python's path."""
    with Reads():  # no record depends on these reads
        schema = config_schema()
    jsonschema_rs.meta.validate(schema)
    return jsonschema_rs.validator_for(schema)


def _is_beyond(problem: Diagnostic) -> bool:
    """Whether no schema can find the mistake: also an output in a state folder, nan, and a code of another domain."""
    others = registry.domain("urdf").warnings
    is_others = problem.code == "unknown-code" and any(f"`{code}`" in problem.message for code in others)
    words = ("`output` can't be in", "must be finite numbers")
    return is_others or problem.code in _BEYOND or any(each in problem.message for each in words)


@contextmanager
def compared(seen: list[str]) -> Iterator[None]:
    """Compare each configuration that is read meanwhile with the schema; add differences to `seen`."""
    module = importlib.import_module("urdfsync.project.config.load")
    parse: Callable[[str, Path, str], Config] = module.parse

    def hold(text: str, file: Path, name: str) -> Config:
        try:
            loaded = parse(text, file, name)
        except ConfigError as error:
            if not all(map(_is_beyond, error.diagnostics)) and is_valid(text):
                seen.append(f"the schema takes:\n{text}\n{error}")
            raise
        if loaded.robots and not is_valid(text):  # without a robot, nothing reads the defaults
            seen.append(f"the schema refuses:\n{text}")
        return loaded

    with mock.patch.object(module, "parse", hold), mock.patch.object(config, "parse", hold):
        yield
