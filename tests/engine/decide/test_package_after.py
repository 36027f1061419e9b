"""Packages that stay for the files inside; `tests/scenarios/edits.txt` has records that stay for a text."""

from __future__ import annotations

from collections.abc import Collection
from types import SimpleNamespace
from typing import cast

from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Reason
from urdfsync.engine.decide.package_after import PackageAfter, keep_needed
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.package.generate import Package


def test_a_package_stays_for_the_one_inside_that_stays() -> None:
    packages = ("P/package.mo", "P/Q/package.mo", "P/R/package.mo")
    inside = {"P/package.mo": {"P/A.mo", *packages[1:]}, "P/Q/package.mo": {"P/Q/Mine.mo"}, "P/R/package.mo": set()}

    def has_classes(path: str, gone: Collection[str]) -> bool:
        return bool(inside[path] - set(gone))

    files = SimpleNamespace(has_classes=has_classes)
    inputs, package = cast("Inputs", SimpleNamespace(files=files)), cast("Package", None)
    actions = [Action(path, Reason.DELETE, Role.PACKAGE) for path in packages]
    actions.append(Action("P/A.mo", Reason.DELETE, Role.MODEL))
    kept = keep_needed(PackageAfter(inputs, package, actions, {}), ())
    assert {one.path for one in kept if one.reason is Reason.NEEDED} == {"P/package.mo", "P/Q/package.mo"}
