"""Files that are no longer generated stay as long as a text of the user's needs them."""

from __future__ import annotations

from collections.abc import Collection
from pathlib import Path
from types import SimpleNamespace
from typing import cast

from support.networks import C1, LADDER, R2, RECORD, conflicts, drop, edit, inner_kinds, rename, run, source

from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Choice, Reason
from urdfsync.engine.decide.package_after import PackageAfter, keep_needed
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.package.generate import Package


def test_the_record_of_an_element_that_is_renamed_and_then_goes_is_kept_where_it_is_mentioned(project: Path) -> None:
    run()
    record = Path(RECORD)
    Path("modelica/Bench.mo").write_text("model Bench\n  Ladder.Elements.R1Parameters numbers;\nend Bench;\n")
    other = R2.replace(".mo", "Parameters.mo")
    edit(other, "220.5", "220.5 + 1")
    source('"ohm": 220.5', '"ohm": 300')
    rename("R1", "Shunt")
    assert conflicts() == [other]
    drop("Shunt")
    run()
    run(choices={other: Choice.TAKE})
    assert record.exists()


def test_a_record_that_is_needed_stays_when_its_element_gets_another_name_later(project: Path) -> None:
    run()
    bench, record = Path("modelica/Bench.mo"), Path(C1.replace(".mo", "Parameters.mo"))
    bench.write_text("model Bench\n  parameter Ladder.Elements.C1Parameters numbers;\nend Bench;\n")
    network = Path("ladder.json").read_text()
    drop("C1")
    run()
    Path("ladder.json").write_text(network)
    rename("C1", "Tank")
    run()
    assert record.exists()


def test_an_edited_model_that_is_no_longer_generated_keeps_its_record(project: Path) -> None:
    run()
    elements = project / LADDER / "Elements"
    edit(elements / "R2.mo", "end R2;", "// mine\nend R2;")
    source('"R2"', '"R3"')
    source("220.5", "330")
    orphans = {"Elements/R2.mo": Reason.ORPHAN, "Elements/R2Parameters.mo": Reason.NEEDED}
    assert inner_kinds(run()).items() >= orphans.items()
    assert "R2Parameters" in (elements / "R2.mo").read_text()
    assert (elements / "R2Parameters.mo").exists()
    lines = (elements / "package.order").read_text().split()
    assert {"R2", "R2Parameters", "R3", "R3Parameters"} <= set(lines), "a class that stays keeps its line"
    for request in ({}, {"full": True}):
        assert inner_kinds(run(**request)) == orphans
        assert run(**request).in_step
    (elements / "R2.mo").unlink()
    gone = {"Elements/R2.mo": Reason.FORGET, "Elements/R2Parameters.mo": Reason.DELETE}
    assert inner_kinds(run()) == {**gone, "Elements/package.order": Reason.UPDATE}
    assert inner_kinds(run()) == {}


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
    assert [one.path for one in kept if one.reason is Reason.NEEDED] == ["P/package.mo", "P/Q/package.mo"]
