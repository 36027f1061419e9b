"""Random hostile configurations and states, then a random command, which ends with one line, or does its allowed work.

There is no traceback, no odd exit code and no hang, nothing outside of the project changes, and no edit is lost.
`URDFSYNC_CASES=2000` runs 2000 fresh cases of each.
"""

from __future__ import annotations

import contextlib
import json
import os
import shutil
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from random import Random
from typing import Any, cast

import pytest
import tomli_w
from hypothesis import given
from hypothesis import strategies as st
from support import crashes
from support.cases import SMALL_ROBOTS, damaged, often, seldom, small_robot
from support.git import NEEDS_GIT, Repository
from support.urdfs import joint, link, robot
from support.workplace import WATCH, Workplace, changes, contents

from urdfsync.common.files import digest

pytestmark = [
    NEEDS_GIT,
    pytest.mark.slow,
    pytest.mark.skipif(sys.platform == "win32", reason="no such signals and FIFOs"),
]

CONFIGURATION = '[robots.bot]\nsource = "bot.urdf"\npackage = "Bot"\n'
MODEL = "modelica/Bot/Links/Arm.mo"
RECORD = "modelica/Bot/Links/ArmParameters.mo"
EDITED = (MODEL, RECORD, "modelica/Bot/Bench.mo", "modelica/notes.txt")
"""Files with an edit of the user's."""
MINE = b"\n// mine\n"
COMMANDS = st.sampled_from(
    [
        *map(str.split, ("build", "build", "build", "build --full", "build --check", "build --dry-run", "build --svg")),
        *map(
            str.split,
            ("build --format=json", "build bot", "status", "status --verbose", "status --format=json", "diff"),
        ),
        *map(str.split, ("diff --since-build", "hook check", "hook build", "resolve --all --keep", "init bot.urdf")),
        *map(str.split, ("resolve --all --merge", f"resolve {MODEL} --keep", "remove bot --yes", "adopt bot")),
        WATCH,
    ]
)
OUTSIDE = "{outside}"
"""Stands for the folder beside the project. Cases use no other absolute path, since a fault would harm it."""
PATHS = (
    *("bot.urdf", "bot.urdf", "modelica", "modelica", "templates", "templates", ".", "..", "", "../outside", "~"),
    *("../outside/victim.mo", OUTSIDE, f"{OUTSIDE}/folder", "/dev/zero", "/dev/tty", "fifo", "modelica/Bot", ".git"),
    *(".git/hooks", ".urdfsync", ".URDFSYNC", ".urdfsync/robots", "a/../../outside", "link", "link/x", "file.txt"),
    *("file.txt/x", "x" * 300, "a\\b", "C:\\x", "é", "\u202e", "-x", "--help", "http://127.0.0.1:9/a.urdf"),
    *("$(touch x)", "`touch x`", "a\nb", "/", "urdfsync.toml", ".git/hooks/pre-commit", ".git/config", MODEL, RECORD),
    *("modelica/../../outside/victim.mo", "modelica/Bot/Resources/../../../urdfsync.toml", "modelica/Bot/Bench.mo"),
    *("modelica//Bot/Bot.mo", "\u202ex.mo", "\x1b[31m.mo", "a" * 300 + ".mo", "é.mo", "Bot.mo", "con.mo"),
    *("modelica/notes.txt", "modelica/Other/package.mo", "modelica/package.order", "Links/Arm.mo", ".urdfsync/lock"),
)
VALUES: tuple[Any, ...] = (
    *("Bot", "Plant.Bot", "Modelica", "Modelica.Bot", "UrdfSync.Bot", "end", "time", "a b", "7", "A.", ".A", "A..B"),
    *("'q'", "Bot;", 'Bot"', "Bot\\n", "package", "record", "fixed", "floating", "keep", "merge", "check", "user"),
    *("import", "all", "leaves", "names", "vector", "urdf", "rcnetwork", "os", "os:system", "base", "arm", "link"),
    *("\x1b[31m", "0" * 64, "f" * 64, 0, 1, -1, 2**31, 2**63 - 1, 1.5, 1e308, float("inf"), float("nan"), True, False),
    *([], {}, [[]], [[[[]]]], [""], ["record"], {"a": 1}, {"a": {}}, ["x"] * 1000, [1, "a"], [{"a": []}]),
)
ODD = st.sampled_from((*PATHS, *VALUES))


def urdf(mass: float) -> str:
    shape = '<visual><geometry><mesh filename="bot.stl"/></geometry></visual></link>'
    arm = link("arm", mass).replace("</link>", shape)
    turning, hold = joint("turn", "revolute", "base", "arm", axis="0 0 1"), joint("hold", "fixed", "arm", "hand")
    return robot(link("base"), arm, turning, link("hand", mass), hold)


def built(work: Workplace, source: str) -> None:
    """Make a project that is built, edited, built again and committed."""
    new = work.folder / "new"
    (new / "templates/joint").mkdir(parents=True)
    (new / "templates/joint/fixed.mo.jinja").write_text("<< cycler.__init__.__globals__.os.popen('touch x') >>")
    (new / "urdfsync.toml").write_text(CONFIGURATION)
    (new / "bot.urdf").write_text(source)
    (new / "file.txt").write_text("mine")
    (new / "bot.stl").write_bytes(bytes(80) + (1).to_bytes(4, "little") + bytes(50))
    work.fill(new)
    assert work.run(["build"])[0] == 0
    for name in EDITED:
        path = work.project / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes((path.read_bytes() if path.exists() else b"within Bot;\nmodel Bench\nend Bench;\n") + MINE)
    work.run(["build"])
    with pytest.MonkeyPatch.context() as monkeypatch:
        Repository(work.project, monkeypatch).commit()


def run_one(work: Workplace, command: Sequence[str]) -> None:
    """Run a command: every edit stays in its place, and all files but outputs stay unchanged.

    `Workplace.run` forbids more.
    """
    before = contents(work.project)
    work.run(command)
    after = contents(work.project)
    for name in EDITED:
        found = after.get(name)
        assert isinstance(found, bytes), (command, name)
        assert MINE.strip() in found, (command, name)
    for name in changes(before, after):
        is_output = name.endswith((".mo", "package.order")) or "/Resources/" in name or after.get(name) == "folder"
        is_state = f"{name}/".startswith((".urdfsync/", "modelica/Bot/", ".git/index", ".git/urdfsync/"))
        is_configuration = command[0] == "remove" and name == "urdfsync.toml"
        assert is_state or is_configuration or (is_output and not name.startswith(".git/")), (command, name)


# Configurations

FITTING: Mapping[str, Sequence[Any]] = {
    "source": ("bot.urdf", "./bot.urdf", "link/../bot.urdf"),
    "package": ("Bot", "Plant.Bot", "Other"),
    "class": ("Bot", "Robot"),
    "output": ("modelica", "out", ".", "a/b"),
    "domain": ("urdf",),
    "templates": ("templates",),
    "package_paths": (["."], [OUTSIDE], ["link", "modelica"], []),
    "users": (["."], [OUTSIDE], ["link", "bot.urdf"], []),
    "create_parents": (True, False),
    "on_conflict": ("keep", "merge"),
    "base": ("fixed", "floating"),
    "collisions": (True, False),
    "meshes": ("import", "skip"),
    "approach": (["package"], ["record"], ["package", "record"]),
    "frames": ("leaves", "all", ["arm"]),
    "driven": ([], ["arm"]),
    "inputs": ("names", "vector"),
}
"""Values of keys, valid or nearly valid."""
KEYS = (*FITTING, "on_build", "command", "library", "sources", "name", "", "x.y", "é")
OF_PATHS = ("source", "output", "templates", "package_paths", "users", "library", "command")
NAMES = (
    *("bot", "Bot", "BOT", "other", "a.b", "-x", "..", ".", "", "con", "a/b", "é", "x" * 300, "\u202e", "a b"),
    *("__proto__", "\x1b[2J"),
)
DEEP = st.sampled_from((60, 5000))
LITERALS = (
    "1" * 5000,
    "0x" + "f" * 5000,
    "1e999",
    "nan",
    "1979-05-27T07:32:00Z",
    "07:32:00",
    '"""',
    "'''",
    '"\\u0000"',
)


@st.composite
def entries(draw: st.DrawFn) -> tuple[str, Any]:
    key = draw(st.sampled_from(KEYS if seldom(draw) else list(FITTING)))
    if key in FITTING and not seldom(draw):
        return key, draw(st.sampled_from(FITTING[key]))
    values = st.sampled_from(PATHS) if key in OF_PATHS and not seldom(draw) else ODD
    return key, draw(values | st.lists(values, max_size=2))


def tables(most: int) -> st.SearchStrategy[dict[str, Any]]:
    return st.lists(entries(), max_size=most).map(dict)


@st.composite
def configurations(draw: st.DrawFn) -> bytes:
    """Valid tables and keys, with valid, wrong or hostile values, and then some damage to the text."""
    document: dict[str, Any] = {"defaults": draw(tables(3))}
    if seldom(draw):
        document["check"] = draw(tables(1)) | {"library": draw(st.sampled_from(PATHS))}
    document["robots"] = {}
    for number in range(draw(st.sampled_from((1, 1, 1, 2, 8)))):
        name = draw(st.sampled_from(NAMES)) if seldom(draw) else f"bot{number or ''}"
        package = draw(st.sampled_from((f"Bot{number or ''}", f"Plant.Bot{number}")))
        document["robots"][name] = {"source": "bot.urdf", "package": package} | draw(tables(4))
    if seldom(draw):
        document[draw(st.sampled_from(("robots", "defaults", "check", *KEYS)))] = draw(ODD)
    text = tomli_w.dumps(document)
    if seldom(draw):
        text = draw(damaged_text(text))
    if seldom(draw):
        return text.encode(draw(st.sampled_from(("utf-16", "latin-1", "utf-8-sig", "utf-32"))), errors="replace")
    content = text.encode(errors="surrogatepass")
    return draw(damaged(content)) if seldom(draw) else content


def damaged_text(text: str) -> st.SearchStrategy[str]:
    lines = st.sampled_from(text.splitlines())
    return st.one_of(
        st.lists(lines, min_size=1, max_size=2).map(lambda again: "\n".join([text, *again])),
        DEEP.map(lambda deep: f"{text}\na = {'[' * deep}{']' * deep}"),
        DEEP.map(lambda deep: f"{text}\na = {'{a = ' * deep}1{'}' * deep}"),
        DEEP.map(lambda deep: f"{text}\n{'.'.join(['a'] * deep)} = 1"),
        st.sampled_from(LITERALS).map(lambda literal: f"{text}\nx = {literal}\n"),
        st.just(f"<<<<<<< mine\n{text}=======\n{text}>>>>>>> theirs\n"),
        st.integers(0, len(text)).map(lambda end: text[:end]),
    )


SOURCES = SMALL_ROBOTS.map(str.encode) | SMALL_ROBOTS.flatmap(lambda source: damaged(source.encode()))


@pytest.fixture(scope="module")
def of_random(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A project of a random robot, in step."""
    work = Workplace(tmp_path_factory.mktemp("random"))
    built(work, small_robot(Random(11)))
    return work.project


@often(20)
@given(configurations(), SOURCES, st.lists(COMMANDS, min_size=1, max_size=2))
def test_a_hostile_configuration(
    of_random: Path, tmp_path: Path, text: bytes, source: bytes, commands: Sequence[Sequence[str]]
) -> None:
    work = Workplace(tmp_path)
    work.fill(of_random)
    (work.project / "link").symlink_to(work.outside)
    os.mkfifo(work.project / "fifo")
    (work.project / "urdfsync.toml").write_bytes(text.replace(OUTSIDE.encode(), os.fsencode(work.outside)))
    (work.project / "bot.urdf").write_bytes(source)
    for command in commands:
        run_one(work, command)


# States

DAMAGES = (
    *(*["values"] * 8, "noise", "noise", "cut", "swap", "swap", "large", "delete", "folder", "link", "link"),
    *("hard link", "fifo", "copy"),
)
LARGE = (b"[" * 100_000, b"a = [" * 50_000, b"{" * 100_000, b'{"a":' * 100_000, bytes(1_000_000), b"x." * 100_000)
STATE_NAMES = (
    *("deps", "lock", "watch.lock", ".gitignore"),
    *("robots/other.state", "robots/bot.state", "robots/BOT.state", "robots/-x.state", "robots/.state", "config"),
    *("robots/\x1b[2J.state", "robots/a.b.state", "conflicts/bot/x", "svg/bot.svg", "robots/bot.state.urdfsync-tmp"),
    *("conflicts/bot/Links/Arm.merge.mo.txt", f"base/bot/{'0' * 64}", ".gitattributes"),
    *(f"robots/.bot.state.none-{'0' * 12}.abcdef.urdfsync-tmp", f".lock.{'0' * 12}-none.abcdef.urdfsync-tmp~"),
)


def damage_one(draw: st.DrawFn, work: Workplace) -> None:
    """Damage, or add, one file or folder of the state."""
    state = work.project / ".urdfsync"
    if not state.is_dir() or state.is_symlink():
        return
    there = sorted(path.relative_to(state).as_posix() for path in state.rglob("*"))
    path = state / draw(st.sampled_from([".", *there, *there, *STATE_NAMES]))
    with contextlib.suppress(OSError, ValueError, RecursionError):  # earlier damage has left another kind of file
        path.parent.mkdir(parents=True, exist_ok=True)
        damage_place(draw, path, work)


def damage_place(draw: st.DrawFn, path: Path, work: Workplace) -> None:
    damage = draw(st.sampled_from(DAMAGES))
    content = path.read_bytes() if path.is_file() and not path.is_symlink() else b""
    if damage == "copy":  # the unchanged file with another inode
        shutil.copy2(path, path.with_name("copied"))
        path.with_name("copied").replace(path)
        return
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)
    match damage:
        case "values" if path.suffix == ".state" and content:
            path.write_text(draw(with_other_facts(content.decode())))
        case "values" if path.suffix == ".json":
            document = json.loads(content or "{}")
            for _ in range(draw(st.sampled_from((1, 1, 3)))):
                change_value(draw, document)
            path.write_text(json.dumps(document), errors="replace")
        case "values" | "noise":
            path.write_bytes(draw(damaged(content or b"{}")))
        case "cut":
            path.write_bytes(content[: draw(st.integers(0, len(content)))])
        case "swap":
            files = sorted(other for other in work.project.rglob("*") if other.is_file() and ".git" not in other.parts)
            path.write_bytes(draw(st.sampled_from(files)).read_bytes())
        case "large":
            path.write_bytes(draw(st.sampled_from(LARGE)))
        case "folder":
            path.mkdir()
            if draw(st.booleans()):
                (path / draw(st.sampled_from(("x", "bot.state")))).write_text("precious")
        case "link":
            places = [work.outside / name for name in ("victim.mo", "folder", "", "new")]
            path.symlink_to(draw(st.sampled_from([*places, path, *map(Path, ("/dev/zero", "/dev/tty", "/"))])))
        case "hard link":
            path.hardlink_to(work.outside / "victim.mo")
        case "fifo":
            os.mkfifo(path)


@st.composite
def with_other_facts(draw: st.DrawFn, text: str) -> str:
    """A state in which some lines are changed, removed or repeated, mostly with a corrected checksum."""
    lines = [line for line in text.splitlines() if line and not line.startswith(("#", "sum "))]
    for _ in range(draw(st.sampled_from((1, 1, 3)))):
        at = draw(st.integers(0, len(lines) - 1))
        word, _, rest = lines[at].partition(" ")
        if word == "file":
            sha256, _, path = rest.partition("  ")
            kept = draw(st.booleans())
            other = draw(st.sampled_from(lines)).removeprefix("file ").partition("  ")[0]
            line = f"file {sha256}  {draw(st.sampled_from(PATHS))}" if kept else f"file {other}  {path}"
        else:
            document = [json.loads(rest)]
            change_value(draw, document)
            line = "\n".join(f"{word} {json.dumps(one)}" for one in document)
        lines[at : at + draw(st.integers(0, 1))] = [line]
    if not seldom(draw):
        total = digest("\n".join(sorted(lines)).encode())
        lines.append(f'sum "{total}"')
    return "".join(f"{line}\n" for line in lines)


def change_value(draw: st.DrawFn, document: Any) -> None:
    """Change a value, a key or the number of entries somewhere in a document."""
    if not (places := value_places(document)):
        return
    holder, key = places[draw(st.integers(0, len(places) - 1))]
    match draw(st.sampled_from(("delete", "rename", "rename", "append", "set", "set", "set", "set"))):
        case "delete":
            del holder[key]
        case "rename" if isinstance(holder, dict):
            holder[draw(st.sampled_from(PATHS))] = holder.pop(key)
        case "append" if isinstance(holder[key], list):
            holder[key].append(draw(ODD))
        case _:
            holder[key] = draw(ODD)


def value_places(document: Any) -> list[tuple[Any, Any]]:
    """Holder and key of every value."""
    if not isinstance(document, dict | list):
        return []
    found = []
    for key, value in list(document.items() if isinstance(document, dict) else enumerate(document)):
        found += [(document, key), *value_places(value)]
    return found


@pytest.fixture(scope="module")
def projects(tmp_path_factory: pytest.TempPathFactory) -> Mapping[str, Path]:
    """The projects before the damage: in step, in conflict, and with a build that was killed halfway."""
    work = Workplace(tmp_path_factory.mktemp("states"))
    built(work, urdf(1.0))
    found = {"in step": shutil.copytree(work.project, work.folder / "in-step")}
    (work.project / "bot.urdf").write_text(urdf(2.0))
    found["killed"] = shutil.copytree(work.project, work.folder / "killed")
    with contextlib.chdir(found["killed"]):
        swaps = crashes.operations(crashes.copy(found["killed"], work.folder / "copy"), ["exchange"])
        crashes.kill(found["killed"], swaps[len(swaps) // 2].number)
    work.run(["build"])
    return found | {"conflict": work.project}


@often(15)
@given(st.data())
def test_a_hostile_state(projects: Mapping[str, Path], tmp_path: Path, data: st.DataObject) -> None:
    work, draw = Workplace(tmp_path), cast(st.DrawFn, data.draw)
    work.fill(projects[draw(st.sampled_from(sorted(projects)))])
    for _ in range(draw(st.sampled_from((1, 1, 2, 4)))):
        damage_one(draw, work)
    for command in draw(st.lists(COMMANDS, min_size=1, max_size=2)):
        run_one(work, command)
