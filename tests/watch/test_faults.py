"""What happens to a daemon at a certain moment, and what goes wrong in it: in a thread of the test."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import pytest
from support import xacros
from support.daemon import MODEL, NEVER, RECORD, Daemons, holds, save, until
from support.networks import configure, edit
from support.urdfs import link

from urdfsync.domain import registry
from urdfsync.engine.plan import plan_robot
from urdfsync.engine.stage.writes import Plan
from urdfsync.watch import events
from urdfsync.watch.observer import Observer

KEEP = [("keep", str(MODEL))]


@pytest.fixture
def without_events(monkeypatch: pytest.MonkeyPatch) -> None:
    """As on a network mount, or a mount of a container."""
    monkeypatch.setattr(Observer, "dispatch", lambda *_: None)


@pytest.mark.usefixtures("without_events")
def test_an_edit_during_a_build_is_seen_without_its_event(running: list[Daemons]) -> None:
    """The daemon waits for whoever is told of a build, before it looks at what the build left."""

    def edit(event: events.Event) -> None:
        if isinstance(event, events.Built) and not MODEL.read_text().endswith("// mine\n"):
            MODEL.write_text(MODEL.read_text() + "// mine\n")

    daemon = Daemons(edit, rescan=NEVER)
    running.append(daemon)
    result = daemon.wait(events.Built, 3).result
    assert [(one.reason, one.path) for one in result.actions.decided] == KEEP


@pytest.mark.usefixtures("without_events")
def test_without_events_rescans_find_what_changed(running: list[Daemons]) -> None:
    daemon = Daemons(rescan=0.1)
    running.append(daemon)
    daemon.after(lambda: save(330), events.Built)
    assert holds(330)


@pytest.mark.usefixtures("without_events")
def test_without_events_a_file_that_still_changes_is_waited_for(running: list[Daemons]) -> None:
    daemon = Daemons(rescan=0.8, settle=0.6)
    running.append(daemon)
    daemon.wait(events.Built)
    since = daemon.mark
    for ohm in range(281, 331):
        save(ohm)
        time.sleep(0.05)
    daemon.wait(events.Built, since, lambda event: bool(event.files))
    assert holds(330)


@pytest.mark.parametrize("place", ["read", "artifacts"])
def test_a_bug_of_a_domain_is_one_error_and_the_daemon_goes_on(
    running: list[Daemons], monkeypatch: pytest.MonkeyPatch, place: str
) -> None:
    daemon, domain = Daemons(rescan=NEVER), registry.domain("rcnetwork")
    running.append(daemon)
    real = getattr(type(domain), place)

    def broken(self: Any, *arguments: Any, **options: Any) -> Any:
        if b"330" in Path("ladder.json").read_bytes():
            raise ZeroDivisionError("by nothing")
        return real(self, *arguments, **options)

    monkeypatch.setattr(type(domain), place, broken)
    (found,) = daemon.after(lambda: save(330), events.Failed).result.diagnostics
    assert found.code == "internal"
    assert "ZeroDivisionError in test_faults.py" in found.message
    assert "by nothing" in found.message
    assert daemon.after(lambda: save(331), events.Built).recovered


def test_a_fault_that_is_saved_again_is_reported_again(running: list[Daemons]) -> None:
    daemon = Daemons(rescan=NEVER, give_up_after=0.1)
    running.append(daemon)
    assert not daemon.after(lambda: Path("ladder.json").write_text('{"a" 1}'), events.Failed).again
    assert daemon.after(lambda: Path("ladder.json").write_text('{"a" 2}'), events.Failed).again


def test_a_refused_export_is_told_once_until_the_source_or_the_list_changes(
    running: list[Daemons], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each rescan plans the robot again."""
    planned = list[Plan]()

    def plan(*given: Any) -> Plan:
        planned.append(plan_robot(*given))
        return planned[-1]

    monkeypatch.setattr("urdfsync.engine.build.plan_robot", plan)
    daemon = Daemons(rescan=0.05)
    running.append(daemon)
    configure('refuse = ["no-ground"]\n')
    failed = daemon.after(lambda: edit("ladder.json", '"ground"', '"earth"'), events.Failed)
    assert "to accept it, take the code out of `refuse` [no-ground]" in str(failed.result.diagnostics[0])
    before, since = RECORD.read_bytes(), daemon.mark
    known = len(planned)
    until(lambda: len(planned) > known + 3)
    assert daemon.kinds(since) == []
    assert RECORD.read_bytes() == before
    assert daemon.after(lambda: edit("urdfsync.toml", '["no-ground"]', "[]"), events.Built).recovered


def test_a_package_that_comes_to_a_place_where_none_was_found_is_built(running: list[Daemons]) -> None:
    """It is missing at first, then there is one below a search path, then one beside the source."""
    robot = xacros.HEAD.format("arm") + '<xacro:include filename="$(find pk)/arm.xacro"/></robot>'
    xacros.write(
        Path(), {"arm.urdf.xacro": robot}, f'{xacros.CONFIG.replace("{ length = 0.5 }", "{}")}package_paths = ["ws"]\n'
    )
    Path("ws/deep").mkdir(parents=True)

    def arrive(folder: str, mass: float) -> None:
        place = Path(folder)
        place.mkdir(parents=True)
        (place / "arm.xacro").write_text(f"{xacros.HEAD.format('arm')}{link('hand', mass)}</robot>")
        (place / "package.xml").write_text("<package><name>pk</name></package>")

    daemon = Daemons(rescan=NEVER)
    running.append(daemon)
    assert daemon.wait(events.Failed).result.diagnostics[0].code == "no-package"
    for folder, mass in (("ws/deep/pk-2.0", 2.625), ("urdf/pk", 3.375)):
        since = daemon.mark
        arrive(folder, mass)
        daemon.wait(events.Built, since, lambda event: bool(event.files))
        assert f"{mass}" in Path("modelica/Arm/Links/HandParameters.mo").read_text()
