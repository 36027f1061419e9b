"""Choices about files in conflict, as `resolve` makes them for the texts that it has read."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from urdfsync.engine.actions import Choice, UsersChoice
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.project.config import Config


def options(loaded: Config, *, choices: Mapping[str, Choice] | None = None, **request: Any) -> BuildOptions:
    """Return build options with choices for the present texts, by path."""
    if not choices:
        return BuildOptions(**request)
    looked = build(loaded, loaded.robots, BuildOptions(**{**request, "dry": True}))
    sides = {action.path: action.sides for result in looked for action in result.actions}
    made = {path: UsersChoice(choice, sides[path]) for path, choice in choices.items() if path in sides}
    return BuildOptions(choices=made, **request)
