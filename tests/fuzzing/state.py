"""Random damage to `.urdfsync/`, then a random command: nothing outside changes, and no edit is lost.

The projects that are damaged are one in step, one with a conflict and one whose build was killed halfway. In each the
user has edited files. Damage is noise, other kinds of files in the place of files, texts of other files, and values
that fit their format and mean harm.
"""

from __future__ import annotations

import contextlib
import functools
import json
import os
import shutil
import subprocess
import tomllib
from collections.abc import Sequence
from pathlib import Path
from random import Random
from typing import Any

import tomli_w
from support import crashes
from support.urdfs import joint, limit, link, robot
from support.workplace import WATCH, Fault, Workplace, changes, contents

from fuzzing.cases import run_cases
from fuzzing.urdf import damaged

MODEL = "modelica/Bot/Links/Arm.mo"
RECORD = "modelica/Bot/Links/ArmParameters.mo"
MINE = b"\n// mine\n"
EDITED = (MODEL, RECORD, "modelica/Bot/Bench.mo", "modelica/notes.txt")
"""Files with an edit of the user's."""
GENERATED = "modelica/Bot/"
CONFIGURATION = '[robots.bot]\nsource = "bot.urdf"\npackage = "Bot"\n'
COMMANDS = (
    *(["build"], ["build"], ["build", "--full"], ["build", "--check"], ["build", "--dry-run"]),
    *(["build", "--svg"], ["status"], ["status", "--verbose"], ["diff"], ["diff", "--since-build"], ["hook", "check"]),
    *(["hook", "build"], ["resolve", "--all", "--keep"], ["resolve", "--all", "--merge"], ["build", "--json"], WATCH),
    ["resolve", MODEL, "--keep"],
)
PATHS = (
    *("../outside/victim.mo", "../outside/folder", "/etc/passwd", "/", "..", ".", "", "urdfsync.toml", "bot.urdf"),
    *(".git/hooks/pre-commit", ".git/config", ".urdfsync/stamp", ".urdfsync/lock", "modelica/notes.txt", MODEL, RECORD),
    *("modelica/../../outside/victim.mo", "modelica/Bot/Resources/../../../urdfsync.toml", "modelica/Bot/Bench.mo"),
    *(
        "modelica//Bot/Bot.mo",
        "a\\b",
        "\u202ex.mo",
        "\x1b[31m.mo",
        "a" * 300 + ".mo",
        "é.mo",
        "modelica/Bot",
        "C:\\x.mo",
    ),
    *("~/x.mo", "modelica/Other/package.mo", "modelica/package.order", "Bot.mo", "Links/Arm.mo", "con.mo"),
)
VALUES: tuple[Any, ...] = (
    *(0, -1, 1, 2**31, 2**63 - 1, -(2**63), 1e308, 0.5, True, False, "", "x", [], {}, [[[[]]]], {"a": {}}, "0" * 64),
    *("f" * 64, "link arm", *"Bot package edited conflict orphan waiting model record import order".split()),
)


def run(count: int, seed: int) -> int:
    """Run cases; returns the number of faults."""
    folder = Path.cwd() / "work"
    return run_cases("state", functools.partial(_case, Workplace(folder), _templates(folder)), count, seed)


def _case(work: Workplace, templates: Sequence[Path], random: Random) -> str:
    work.fill(random.choice(templates))
    if (planned := work.project / ".urdfsync/planned.json").is_file() and random.random() < 0.8:
        crashes.bind(planned)
    for _ in range(random.choice((1, 1, 2, 4))):
        _damage(work, random)
    code = 0
    for _ in range(random.choice((1, 1, 2))):
        before = contents(work.project)
        code, _said = work.run(random.choice(COMMANDS))
        _check_edits(before, contents(work.project))
    return f"exit {code}"


def _check_edits(before: dict[str, bytes | str], after: dict[str, bytes | str]) -> None:
    """The user's lines are where they were, and all that is no output is as it was."""
    require_edits(after)
    others = [
        name
        for name in changes(before, after)
        if not f"{name}/".startswith((GENERATED, ".urdfsync/")) and not name.startswith(".git/index")
    ]
    if others:
        raise Fault(f"changes of other files: {others[:5]}")


def _templates(folder: Path) -> Sequence[Path]:
    """The projects before the damage."""
    work, found = Workplace(folder), []
    empty = folder / "templates/empty"
    empty.mkdir(parents=True)
    (empty / "urdfsync.toml").write_text(CONFIGURATION)
    (empty / "bot.urdf").write_text(_urdf(1.0))
    (empty / "bot.stl").write_bytes(bytes(80) + (1).to_bytes(4, "little") + bytes(50))
    work.fill(empty)
    work.run(["build"])
    edit(work.project)
    work.run(["build"])
    commit(work.project)
    found.append(shutil.copytree(work.project, folder / "templates/in-step"))
    (work.project / "bot.urdf").write_text(_urdf(2.0))
    crashed = shutil.copytree(work.project, folder / "templates/killed")
    with contextlib.chdir(crashed):
        swaps = crashes.operations(crashes.copy(crashed, folder / "copy"), ["exchange"])
        crashes.kill(crashed, swaps[len(swaps) // 2].number)
    found.append(crashed)
    work.run(["build"])
    found.append(shutil.copytree(work.project, folder / "templates/conflict"))
    return found


def _urdf(mass: float) -> str:
    shape = '<visual><geometry><mesh filename="bot.stl"/></geometry></visual>'
    arm = link("arm", mass).replace("</link>", f"{shape}</link>")
    turning = joint("turn", "revolute", "base", "arm", axis="0 0 1", inside=[limit()])
    return robot(link("base"), arm, turning, link("hand", mass), joint("hold", "fixed", "arm", "hand"))


def edit(project: Path) -> None:
    """Add a line of the user's to each of the files `EDITED`, some of which are new."""
    for name in EDITED:
        path = project / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes((path.read_bytes() if path.exists() else b"within Bot;\nmodel Bench\nend Bench;\n") + MINE)


def require_edits(after: dict[str, bytes | str]) -> None:
    """Raise Fault unless all lines of the user's are still where they were."""
    for name in EDITED:
        if MINE.strip() not in (found if isinstance(found := after.get(name), bytes) else b""):
            raise Fault(f"the edit in {name} is lost")


def commit(project: Path) -> None:
    """Make the project a repository, with all that is committed of it, whatever git is told on this machine."""
    environment = os.environ | {"GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_NOSYSTEM": "1"}
    who = ["-c", "user.name=A", "-c", "user.email=a@example.org"]
    for command in (["init", "-q", "--template="], ["add", "-A"], [*who, "commit", "-q", "-m", "built"]):
        subprocess.run(["git", *command], cwd=project, env=environment, check=True, capture_output=True)


# --- damage -----------------------------------------------------------------------------------------------------------


def _damage(work: Workplace, random: Random) -> None:
    """Damage one file or folder of the state, or put one there."""
    state = work.project / ".urdfsync"
    if not state.is_dir() or state.is_symlink():
        return
    there = sorted(path for path in state.rglob("*") if "base" not in path.parts or random.random() < 0.2)
    new = [state / name for name in (*_NAMES, f"base/bot/{'0' * 64}")]
    path = state if random.random() < 0.02 else random.choice([*there, *there, *new])
    with contextlib.suppress(OSError, ValueError, RecursionError):  # the damage before has left something else
        path.parent.mkdir(parents=True, exist_ok=True)
        _damage_place(path, work, random)
        if path.name == "planned.json" and path.is_file() and not path.is_symlink() and random.random() < 0.5:
            crashes.bind(path)


_NAMES = (
    *("planned.json", "planned.json", ".planned.json.urdfsync-tmp", "stamp"),
    *("lock", "watch.lock", "robots/other.state", "robots/bot.state"),
    *(
        "robots/BOT.state",
        "robots/-x.state",
        "robots/.state",
        "robots/\x1b[2J.state",
        "robots/a.b.state",
        "conflicts/bot/x",
    ),
    *("svg/bot.svg", ".gitignore", "config", "robots/bot.state.urdfsync-tmp", "conflicts/bot/Links/Arm.merge.mo.txt"),
)
DAMAGES = (
    *(*["values"] * 8, "noise", "noise", "cut", "swap", "swap", "large", "delete", "folder", "link", "link"),
    *("hard link", "fifo", "copy"),
)


def _damage_place(path: Path, work: Workplace, random: Random) -> None:
    damage = random.choice(DAMAGES)
    content = path.read_bytes() if path.is_file() and not path.is_symlink() else b""
    if damage == "values" and path.suffix in (".toml", ".json"):
        content = _with_other_values(path, content.decode(), random)
    elif damage == "copy":  # the same file again: with another inode
        shutil.copy2(path, path.with_name("copied"))
        path.with_name("copied").replace(path)
        return
    _remove(path)
    match damage:
        case "values" if content:
            path.write_bytes(content)
        case "values" | "noise":
            path.write_bytes(damaged(content or b"{}", random))
        case "cut":
            path.write_bytes(content[: random.randint(0, len(content))])
        case "swap":
            files = [other for other in work.project.rglob("*") if other.is_file() and ".git" not in other.parts]
            path.write_bytes(random.choice(files).read_bytes())
        case "large":
            texts = (b"[" * 100_000, b"a = [" * 50_000, b"{" * 100_000, b'{"a":' * 100_000, bytes(1_000_000))
            path.write_bytes(random.choice((*texts, b"x." * 100_000)))
        case "folder":
            path.mkdir()
            if random.random() < 0.5:
                (path / random.choice(("x", "bot.toml", "planned.json"))).write_text("precious")
        case "link":
            places = [work.outside / name for name in ("victim.mo", "folder", "", "new")]
            path.symlink_to(random.choice((*places, path, *map(Path, ("/dev/zero", "/dev/tty", "/")))))
        case "hard link":
            path.hardlink_to(work.outside / "victim.mo")
        case "fifo":
            os.mkfifo(path)


def _remove(path: Path) -> None:
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink(missing_ok=True)


_PLANNED = '{"robot":"bot","token":"12","files":[{"path":"x"}],"emptied":[],"inode":1,"written":1}'


def _with_other_values(path: Path, text: str, random: Random) -> bytes:
    """A manifest, model or planned hashes that stay one."""
    document = tomllib.loads(text) if path.suffix == ".toml" else json.loads(text or _PLANNED)
    for _ in range(random.choice((1, 1, 3))):
        _change(document, random)
    changed = tomli_w.dumps(document) if path.suffix == ".toml" else json.dumps(document)
    return changed.encode(errors="replace")


def _change(document: Any, random: Random) -> None:
    """Change a value, a key or the number of entries somewhere in a document."""
    places = _places(document)
    if not places:
        return
    holder, key = random.choice(places)
    value, action = holder[key], random.random()
    if action < 0.15:
        del holder[key]
    elif action < 0.4 and isinstance(holder, dict):
        holder[random.choice(PATHS)] = holder.pop(key) if random.random() < 0.7 else value
    elif isinstance(value, str) and action < 0.85:
        holder[key] = random.choice((*PATHS, *(text for text in VALUES if isinstance(text, str))))
    elif isinstance(value, list) and action < 0.85:
        value.append(random.choice((*PATHS, *VALUES)))
    else:
        holder[key] = random.choice(VALUES)


def _places(document: Any) -> list[tuple[Any, Any]]:
    """Holder and key of every value."""
    if not isinstance(document, dict | list):
        return []
    found = []
    for key, value in list(document.items() if isinstance(document, dict) else enumerate(document)):
        found += [(document, key), *_places(value)]
    return found
