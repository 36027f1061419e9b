"""The RC network of the fixture `project`, which is the working folder: its changes, its builds, and their results."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

from support.choices import options
from support.states import records
from urdfsync.engine.actions import Reason
from urdfsync.engine.build import build
from urdfsync.engine.result import Exit, Result, exit_code
from urdfsync.project import config
from urdfsync.project.state import bases

Snapshot = Callable[[Path], dict[str, tuple[int, bytes]]]
"""The fixture `snapshot_of`."""

RC_FOLDER = Path(__file__).parents[1] / "rcnetwork"
LADDER = "modelica/Ladder"
R1, R2, C1 = (f"{LADDER}/Elements/{name}.mo" for name in ("R1", "R2", "C1"))
RECORD = f"{LADDER}/Elements/R1Parameters.mo"
MODEL = f"{LADDER}/Ladder.mo"
MINE, FRESH = '"Element R2, 1 %"', '"Element R3"'
"""The text of the model that the fixture `contradictory` writes, and the generated text in its place."""
MANIFEST = ".urdfsync/robots/ladder.state"
BASES = Path(".urdfsync/bases/ladder")
ROBOT = '[robots.{0}]\nsource = "ladder.json"\npackage = "{1}"\ndomain = "rcnetwork"\n'


def edit(path: str | Path, old: str, new: str) -> None:
    """Replace all occurrences of a text in a file; line ends stay unchanged."""
    text = Path(path).read_bytes().decode()
    assert old in text
    Path(path).write_bytes(text.replace(old, new).encode())


def source(old: str, new: str) -> None:
    """Change the source."""
    edit("ladder.json", old, new)


def resistor(ohm: float, before: float = 100) -> None:
    """Change the resistance of R1 in the source."""
    source(f'"ohm": {before:g}}}', f'"ohm": {ohm:g}}}')


def add_resistor(name: str) -> None:
    """Add a resistor to the source, between two existing nodes: a structural change, no rename."""
    last = '"farad": 4.7e-6}'
    source(last, f'{last},\n    {{"name": "{name}", "between": ["in", "out"], "ohm": 1}}')


def rename(old: str, new: str) -> None:
    """Give an element of the source another name."""
    source(f'"{old}"', f'"{new}"')


def configure(text: str) -> None:
    """Add lines to the table of the robot."""
    with Path("urdfsync.toml").open("a") as file:
        file.write(text)


def drop(*names: str) -> None:
    """Take elements out of the source."""
    network = json.loads(Path("ladder.json").read_text())
    network["elements"] = [element for element in network["elements"] if element["name"] not in names]
    Path("ladder.json").write_text(json.dumps(network))


def set_keys(**keys: str) -> None:
    """Write a configuration with these keys of the robot; the values are TOML."""
    lines = {"source": '"ladder.json"', "package": '"Ladder"', "domain": '"rcnetwork"'} | keys
    text = "\n".join(f"{key} = {value}" for key, value in lines.items())
    Path("urdfsync.toml").write_text(f"[robots.ladder]\n{text}\n")


def make_parent(name: str) -> Path:
    """Make a package around the robot's package; return its folder."""
    folder = Path("modelica", name)
    folder.mkdir(parents=True)
    (folder / "package.mo").write_text(f"package {name}\nend {name};\n")
    return folder


def own_model(declarations: str) -> None:
    """Add a declaration to the models of all elements."""
    template = Path("own/element/model.mo.jinja")
    template.parent.mkdir(parents=True)
    text = (RC_FOLDER / "templates/element/model.mo.jinja").read_text()
    template.write_text(text.replace("\nequation\n", f"\n{declarations}\nequation\n"))
    configure('templates = "own"\n')


def run_all(**request: Any) -> list[Result]:
    """Build all robots."""
    loaded = config.load(Path("urdfsync.toml"))
    return list(build(loaded, loaded.robots, options(loaded, **request)))


def run(**request: Any) -> Result:
    """Build the robot; it must not fail."""
    (result,) = run_all(**request)
    assert not result.failed, result.diagnostics
    return result


def failure(**request: Any) -> str:
    """Build the robot, which must fail; return the messages."""
    (result,) = run_all(**request)
    assert result.failed
    assert exit_code([result]) is Exit.ERROR
    return "\n".join(map(str, result.diagnostics)).replace("\\", "/")


def kinds(result: Result) -> dict[str, Reason]:
    """The reason of each action that changes a file and does not wait."""
    actions = (action for action in result.actions if action.reason is not Reason.UNCHANGED and not action.is_waiting)
    return {action.path: action.reason for action in actions}


def said(result: Result) -> list[str]:
    """The messages of a build."""
    return [str(found).replace("\\", "/") for found in result.diagnostics]


def stored(folder: Path = BASES) -> dict[str, str | None]:
    """All texts in the bases of a robot, by their hashes; None for a former text."""
    return {sha256: text for file in folder.iterdir() for sha256, text in bases.loads(file.read_bytes()).items()}


def mentioned() -> set[str]:
    """The hashes of texts that the recorded state mentions."""
    return {base for one in records(Path(MANIFEST)) for key, base in one.files.items() if "/Resources/" not in key}


def inner_kinds(result: Result) -> dict[str, Reason]:
    """The result of `kinds`, by the path below the package."""
    return {path.removeprefix(f"{LADDER}/"): reason for path, reason in kinds(result).items()}


def conflicts(**request: Any) -> list[str]:
    return [each.action.path for each in run(**request).conflicts]
