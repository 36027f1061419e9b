"""Random `urdfsync.toml`, then a random command: it is refused with a line, or does what it may.

A configuration has the right tables and keys, with values that fit, that do not, or that mean harm; then its text is
damaged. Whatever it says, nothing outside of the project changes, and nothing of it runs.
"""

from __future__ import annotations

import functools
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from random import Random
from typing import Any

import tomli_w
from support.workplace import Fault, Workplace, changes, contents

from fuzzing import state
from fuzzing.cases import run_cases
from fuzzing.state import commit, edit, require_edits
from fuzzing.urdf import damaged, small_robot

CONFIGURATION = '[robots.bot]\nsource = "bot.urdf"\npackage = "Bot"\n'
COMMANDS = (*state.COMMANDS, ["status", "--json"], ["build", "bot"], ["init", "bot.urdf"])
NAMES = (
    *("bot", "Bot", "BOT", "other", "a.b", "-x", "..", ".", "", "con", "a/b", "é", "x" * 300, "\u202e", "a b"),
    *("__proto__", "\x1b[2J"),
)
OUTSIDE = "{outside}"
"""Stands for the folder beside the project, as an absolute path: no other absolute folder, or a fault would harm it."""
PATHS = (
    *("bot.urdf", "bot.urdf", "modelica", "modelica", "templates", "templates", ".", "..", "", "../outside", "~"),
    *("../outside/victim.mo", OUTSIDE, f"{OUTSIDE}/folder", "/dev/zero", "/dev/tty", "fifo", "modelica/Bot", ".git"),
    *(".git/hooks", ".urdfsync", ".URDFSYNC", ".urdfsync/robots", "a/../../outside", "link", "link/x", "file.txt"),
    *("file.txt/x", "x" * 300, "a\\b", "C:\\x", "é", "\u202e", "-x", "--help", "http://127.0.0.1:9/a.urdf"),
    *("$(touch x)", "`touch x`", "a\nb"),
)
TEXTS = (
    *("Bot", "Plant.Bot", "Modelica", "Modelica.Bot", "UrdfSync.Bot", "end", "time", "a b", "7", "A.", ".A", "A..B"),
    *("'q'", "Bot;", 'Bot"', "Bot\\n", "x" * 300, "package", "record", "fixed", "floating", "keep", "merge", "check"),
    *("import", "all", "leaves", "names", "vector", "urdf", "rcnetwork", "os", "os:system", "base", "arm", "\u202e"),
    "\x1b[31m",
)
OTHERS: tuple[Any, ...] = (
    *(0, 1, -1, 2**63 - 1, 1.5, float("inf"), float("nan"), True, False, [], {}, [[]], [""], ["record"], {"a": 1}),
    *(["package", "record"], ["x"] * 1000, [1, "a"], [{"a": []}]),
)
KEYS = (
    *("source", "package", "class", "output", "domain", "templates", "package_paths", "create_parents", "on_conflict"),
    *("on_build", "base", "visualizer", "collisions", "meshes", "approach", "driven", "frames"),
    *("inputs", "command", "library", "sources", "name", "", "x.y", "é"),
)
FITTING: Mapping[str, Sequence[Any]] = {
    "source": ("bot.urdf", "./bot.urdf", "link/../bot.urdf"),
    "package": ("Bot", "Plant.Bot", "Other"),
    "class": ("Bot", "Robot"),
    "output": ("modelica", "out", ".", "a/b"),
    "domain": ("urdf",),
    "templates": ("templates",),
    "package_paths": (["."], [OUTSIDE], ["link", "modelica"], []),
    "create_parents": (True, False),
    "on_conflict": ("keep", "merge"),
    "base": ("fixed", "floating"),
    "visualizer": ("standard", "visualization2"),
    "collisions": (True, False),
    "meshes": ("import", "skip"),
    "approach": (["package"], ["record"], ["package", "record"]),
    "frames": ("leaves", "all", ["arm"]),
    "driven": ([], ["arm"]),
    "inputs": ("names", "vector"),
}
"""Values of keys that are right, or nearly."""
PATH_KEYS = ("source", "output", "templates", "package_paths", "library", "command")


def run(count: int, seed: int) -> int:
    """Run cases; returns the number of faults."""
    folder = Path.cwd() / "work"
    return run_cases("config", functools.partial(_case, Workplace(folder), _template(folder)), count, seed)


def _case(work: Workplace, template: Path, random: Random) -> str:
    work.fill(template)
    (work.project / "link").symlink_to(work.outside)
    os.mkfifo(work.project / "fifo")
    text = _configuration(random).replace(OUTSIDE.encode(), os.fsencode(work.outside))
    (work.project / "urdfsync.toml").write_bytes(text)
    (work.project / "bot.urdf").write_text(small_robot(random))
    code = 0
    for _ in range(random.choice((1, 1, 2))):
        before = contents(work.project)
        code, _said = work.run(random.choice(COMMANDS))
        _check(before, contents(work.project))
    return f"exit {code}"


def _check(before: dict[str, bytes | str], after: dict[str, bytes | str]) -> None:
    """No file that was there has changed, but outputs that nobody edited; no other than outputs are new."""
    require_edits(after)
    for name in changes(before, after):
        is_output = name.endswith((".mo", "package.order")) or "/Resources/" in name or after.get(name) == "folder"
        if name.startswith(".git/") and not name.startswith(".git/index"):
            raise Fault(f"{name} has changed")
        if not is_output and not f"{name}/".startswith((".urdfsync/", "modelica/Bot/")) and ".git/index" not in name:
            raise Fault(f"{name} has changed")


def _template(folder: Path) -> Path:
    """A project that is built, committed and edited."""
    work, template = Workplace(folder), folder / "templates/built"
    template.mkdir(parents=True)
    (template / "urdfsync.toml").write_text(CONFIGURATION)
    (template / "bot.urdf").write_text(small_robot(Random(11)))
    (template / "file.txt").write_text("mine")
    (template / "templates/joint").mkdir(parents=True)
    (template / "templates/joint/fixed.mo.jinja").write_text("<< cycler.__init__.__globals__.os.popen('touch x') >>")
    work.fill(template)
    work.run(["build"])
    edit(work.project)
    commit(work.project)
    return work.project.rename(folder / "templates/project")


# --- configurations ---------------------------------------------------------------------------------------------------


def _configuration(random: Random) -> bytes:
    document: dict[str, Any] = {}
    if random.random() < 0.6:
        document["defaults"] = _table(random, random.choice((0, 1, 3)))
    if random.random() < 0.2:
        document["check"] = _table(random, 1) | ({"library": random.choice(PATHS)} if random.random() < 0.5 else {})
    robots = {}
    for number in range(random.choice((1, 1, 1, 1, 2, 8))):
        name = f"bot{number or ''}" if random.random() < 0.95 else random.choice(NAMES)
        required = {
            "source": "bot.urdf",
            "package": random.choice((f"Bot{number}", f"Plant.Bot{number}")),
        }
        robots[name] = required | _table(random, random.choice((0, 1, 1, 2, 4)))
    document["robots"] = robots
    if random.random() < 0.1:
        document[random.choice(("robots", "defaults", "check", *KEYS))] = random.choice((*OTHERS, *TEXTS))
    text = tomli_w.dumps(document)
    if random.random() < 0.1:
        text = _damage(text, random)
    content = text.encode(errors="surrogatepass")
    if random.random() < 0.05:
        content = damaged(content, random)
    if random.random() < 0.03:
        content = text.encode(random.choice(("utf-16", "latin-1", "utf-8-sig", "utf-32")), errors="replace")
    return content


def _table(random: Random, count: int) -> dict[str, Any]:
    table: dict[str, Any] = {}
    for key in random.sample(KEYS if random.random() < 0.1 else tuple(FITTING), count):
        if key in FITTING and random.random() < 0.9:
            table[key] = random.choice(FITTING[key])
            continue
        values: Sequence[Any] = PATHS if key in PATH_KEYS and random.random() < 0.8 else (*TEXTS, *OTHERS, *PATHS)
        table[key] = random.choice(values)
        if key in ("package_paths", "approach", "driven", "frames") and random.random() < 0.7:
            table[key] = random.choices(values, k=random.choice((0, 1, 2)))
    return table


def _damage(text: str, random: Random) -> str:
    lines, deep = text.splitlines(), random.choice((60, 5000))
    nested = ("[" * deep + "]" * deep, "{a = " * deep + "1" + "}" * deep)
    literals = (
        *("1" * 5000, "0x" + "f" * 5000, "1e999", "nan", "1979-05-27T07:32:00Z", "07:32:00", '"""', "'''"),
        '"\\u0000"',
    )
    damages = (
        "\n".join([*lines, random.choice(lines), random.choice(lines)]),
        f"{text}\na = {random.choice(nested)}",
        f"{text}\n{'.'.join(['a'] * deep)} = 1",
        f"{text}\nx = {random.choice(literals)}\n",
        f"<<<<<<< mine\n{text}=======\n{text}>>>>>>> theirs\n",
        text[: random.randint(0, len(text))],
    )
    return random.choice(damages)
