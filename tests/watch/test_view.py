"""The pages that a daemon serves: they follow its builds, and answer nobody but a browser on this machine."""

from __future__ import annotations

import html
import http.client
import json
import math
import socket
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from support.browser import NEEDS_CHROMIUM, browser
from support.commands import Execute
from support.daemon import Watch, until

from urdfsync.commands import cli
from urdfsync.common.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.engine.build import build
from urdfsync.engine.options import BuildOptions
from urdfsync.project import config
from urdfsync.watch import events
from urdfsync.watch.daemon import WatchOptions
from urdfsync.watch.view import View

BOT = """<robot name="bot"><link name="base"><visual><geometry><box size="1 1 1"/></geometry></visual></link>
<link name="arm"><inertial><mass value="2"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<visual><geometry><box size="0.2 0.2 1"/></geometry></visual></link>
<joint name="turn" type="revolute"><parent link="base"/><child link="arm"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/>
<limit lower="-2" upper="2" effort="9" velocity="1"/></joint></robot>"""
FILE = Path("urdfsync.toml")


@pytest.fixture
def source(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The source of a robot `bot-1` in a project, which is the working folder."""
    monkeypatch.chdir(tmp_path)
    FILE.write_text('[robots."bot-1"]\nsource = "bot.urdf"\npackage = "Bot"\n')
    Path("bot.urdf").write_text(BOT)
    return Path("bot.urdf")


@pytest.fixture
def view(source: Path) -> Iterator[View]:
    """A view as it is when the first build has ended."""
    view = View(WatchOptions(FILE), 0)
    view.take(events.Started(FILE, ("bot-1",)))
    make(view)
    yield view
    view.close()


def make(view: View) -> None:
    loaded = config.load(FILE)
    for result in build(loaded, loaded.robots, BuildOptions()):
        view.take(events.Failed(result) if result.failed else events.Built(result))


def ask(view: View, path: str = "/bot-1/", method: str = "GET", **headers: str) -> tuple[int, str, dict[str, str]]:
    connection = http.client.HTTPConnection(view.hosts[0], timeout=60)
    connection.request(method, path, headers=headers)
    answer = connection.getresponse()
    return answer.status, answer.read().decode(), dict(answer.getheaders())


def connect(view: View) -> socket.socket:
    host, _, port = view.hosts[0].partition(":")
    return socket.create_connection((host, int(port)), timeout=30)


def data_of(text: str) -> Any:
    return json.loads(text.partition('id="data">')[2].partition("</script>")[0])


def test_a_page_is_served_that_may_connect_to_its_server_alone(view: View) -> None:
    assert ask(view, "/")[2]["Location"] == "/bot-1/"
    status, text, headers = ask(view)
    assert (status, headers["X-Frame-Options"]) == (200, "DENY")
    assert "default-src 'none'; script-src 'sha256-" in html.unescape(text)
    assert "; connect-src 'self'; " in html.unescape(text)
    assert ask(view, Host=view.hosts[1])[0] == 200
    assert [ask(view, path)[0] for path in ("/other/", "/bot-1/../..", "/bot-1", "/events")] == [
        404,
        404,
        200,
        404,
    ]


@pytest.mark.parametrize(
    "headers",
    [
        {"Host": "evil.example"},
        {"Host": "evil.example:{port}"},
        {"Host": ""},
        {"Origin": "http://evil.example"},
        {"Origin": "null"},
        {"Origin": "http://127.0.0.1"},
        {"Origin": "https://{host}"},
        {"Host": "localhost:{port}", "Origin": "http://{host}"},
    ],
    ids=str,
)
@pytest.mark.parametrize("path", ["/", "/bot-1/", "/bot-1/events"])
def test_another_host_or_origin_is_refused(view: View, path: str, headers: dict[str, str]) -> None:
    host = view.hosts[0]
    filled = {key: value.format(host=host, port=host.partition(":")[2]) for key, value in headers.items()}
    status, text, _ = ask(view, path, **filled)
    assert status == 403
    assert "bot" not in text
    assert ask(view, method="POST")[0] == 501


def test_it_listens_on_the_loopback_alone(view: View) -> None:
    assert view._server.server_address[0] == "127.0.0.1"


def test_a_connection_that_asks_nothing_is_closed(view: View, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("urdfsync.watch.view._Handler.timeout", 0.1)
    with connect(view) as idle:
        assert idle.recv(1) == b""


def test_connections_that_are_too_many_are_refused(view: View) -> None:
    places = [connect(view) for _ in range(50)]
    status, text, _ = ask(view)
    assert (status, text) == (503, "There are 50 connections: close a page.\n")
    places.pop().close()
    until(lambda: ask(view)[0] == 200)
    for place in places:
        place.close()


def test_what_changed_since_the_picture_before_is_told_until_the_next_change(view: View, source: Path) -> None:
    assert data_of(ask(view)[1])["before"] is None
    source.write_text(BOT.replace('xyz="0 0 1"', 'xyz="0 0 1.5"'))
    make(view)
    values = data_of(ask(view)[1])
    assert values["statuses"] == {"joint turn": "changed"}
    assert values["before"]["hinges"][0]["pose"][14] == 1
    make(view)  # which has nothing to do
    assert data_of(ask(view)[1])["statuses"] == {"joint turn": "changed"}
    source.write_text(BOT.replace('xyz="0 0 1"', 'xyz="0 0 1.5"').replace('mass value="2"', 'mass value="3"'))
    make(view)
    assert data_of(ask(view)[1])["statuses"] == {"link arm": "changed"}


def test_a_page_hears_of_builds_and_problems_and_keeps_its_picture(view: View, source: Path) -> None:
    heard = view.messages("bot-1")

    def hear() -> list[Any]:
        return json.loads(next(heard).removeprefix(b"data: "))  # type: ignore[no-any-return]

    assert hear() == [1, "", {}]
    picture = data_of(ask(view)[1])["now"]
    source.write_text("<robot>")
    make(view)
    build_, problem, _ = hear()
    assert build_ == 1
    assert problem.startswith("bot.urdf:1:")
    assert data_of(ask(view)[1])["now"] == picture
    view.take(events.Waiting("bot-1", "waiting", (Diagnostic(Severity.ERROR, "odd", "this is odd"),)))
    assert "waiting: error: this is odd" in hear()[1]
    source.write_text(BOT)
    make(view)
    assert hear() == [2, "", {}]
    view.take(events.Started(FILE, ("bot-1", "two")))
    assert hear() == [2, "", {"two": "/two/"}]
    view.take(events.Started(FILE, ()))
    assert list(heard) == []


def test_a_robot_without_a_picture_says_why_and_asks_again(view: View, source: Path) -> None:
    source.write_text("<robot>")
    status, text, headers = ask(view)
    assert (status, headers["Refresh"], headers["Content-Type"]) == (200, "2", "text/plain; charset=utf-8")
    assert "bot-1: bot.urdf:1:" in text


def test_a_port_that_is_taken_is_one_line(view: View, execute: Execute) -> None:
    port = view.hosts[0].partition(":")[2]
    with pytest.raises(OutputError, match="Address already in use"):
        View(WatchOptions(FILE), int(port))
    (line,) = execute("watch", "--view", "--port", port, code=2).err.splitlines()
    assert f"port {port} can't be used for the view" in line
    assert "--port" in line


def test_the_end_of_the_daemon_ends_it_and_a_missing_browser_is_told(source: Path) -> None:
    with Watch(Path(), "--open", "--port", "0", BROWSER="", DISPLAY="", WAYLAND_DISPLAY="") as watch:
        address = watch.wait("viewing")["address"].removeprefix("http://").rstrip("/")
        told = watch.wait("noted")["diagnostics"][0]
        assert told["code"] == "no-browser"
        watch.wait("built")
        connection = http.client.HTTPConnection(address, timeout=60)
        connection.request("GET", "/bot-1/events")
        answer = connection.getresponse()
        assert answer.readline().startswith(b"data: [")
        assert watch.stop() == 0
        answer.read()  # which ends
        with pytest.raises(ConnectionRefusedError):
            http.client.HTTPConnection(address, timeout=60).connect()


@NEEDS_CHROMIUM
@pytest.mark.slow
def test_a_save_moves_the_picture_and_camera_and_axes_stay(source: Path) -> None:
    cli.main(["build", "--quiet"])
    ready = "page.ready.then(() => true)"
    with Watch(Path(), "--view", "--port", "0") as watch, browser() as page:
        address = watch.wait("viewing")["address"]
        watch.rest()
        page.open(address, ready=ready)
        page.run("move('joint turn', 0.5), stage.orbit.turn(0.7, 0), toggle('collision'), select('link arm')")
        azimuth = page.run("stage.orbit.azimuth")
        source.write_text(BOT.replace('xyz="0 0 1"', 'xyz="0 0 1.5"'))
        pulses = "performance.getEntriesByName('pulse').length"
        until(lambda: page.run(f"typeof page === 'object' && {pulses} && page.light === 0"), 0.2)
        assert math.isclose(page.run("page.pose('link arm')[14]"), 1.5)
        assert page.run("[page.positions.get('joint turn'), page.layers.collision, page.selected]") == [
            0.5,
            True,
            "link arm",
        ]
        assert math.isclose(page.run("stage.orbit.azimuth"), azimuth)
        lit = "page.now.bodies.get('link arm').layers.visual[0].material.emissive.getHex()"
        assert page.run(f"[{lit} === 0x000000, page.light = 0.5, paint(), {lit} > 0, {pulses}]") == [
            False,  # it is selected
            0.5,
            None,
            True,
            1,
        ]
        source.write_text("<robot>")
        until(lambda: "bot.urdf:1:" in page.run("element('daemon').textContent"), 0.2)
        assert math.isclose(page.run("page.pose('link arm')[14]"), 1.5)
        assert page.problems == []
        watch.stop()
        until(lambda: "has ended" in page.run("element('daemon').textContent"), 0.2)
