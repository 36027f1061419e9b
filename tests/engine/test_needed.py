"""Random builds of a network whose user mentions what comes and goes: a repeated build says and does nothing else.

`URDFSYNC_REPLAYS=2000` sets the number of steps.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from random import Random
from typing import Any

import pytest
from support import replay
from support.networks import LADDER, configure, own_model, run
from support.replay import contents

from urdfsync.engine.actions import Reason
from urdfsync.engine.result import Result
from urdfsync.state.record import Choice

EPISODE = 25
"""Steps with one project."""
STEPS = replay.STEPS or 12 * EPISODE
SOURCE, ELEMENTS, WHOLE = Path("ladder.json"), Path(LADDER, "Elements"), Path(LADDER, "Ladder.mo")
NAMES = ("C1", "C2", "R1", "R2", "Shunt", "Tank")
POWER = "<% if kind == 'resistor' %>\n  Real power = v*i;\n<% endif %>"
MENTIONS = (
    "Elements.{} other{};",
    "parameter Elements.{}Parameters numbers{};",
    "Real power{1} = element{0}.power;",
    "Real voltage{1} = element{0}.v;",
    "Real twice{1} = 2*power;",
)

pytestmark = pytest.mark.slow


class Episode:
    """One project, and what happens to its source and its files."""

    def __init__(self, random: Random) -> None:
        self.random, self.count, self.begin = random, 0, SOURCE.read_text()

    def change_source(self) -> None:
        network, pick = json.loads(SOURCE.read_text()), self.random.choice
        elements = network["elements"]
        free = [name for name in NAMES if name not in {element["name"] for element in elements}]
        match pick(["begin", "drop", "rename", "rename", "swap", "add", "kind"]):
            case "begin":
                network = json.loads(self.begin)
            case "drop" if len(elements) > 1:
                elements.remove(pick(elements))
            case "rename" if free:
                pick(elements)["name"] = pick(free)
            case "swap":
                one, two = pick(elements), pick(elements)
                one["name"], two["name"] = two["name"], one["name"]
            case "add" if free:
                elements.append({"name": pick(free), "between": ["in", "ground"], pick(["ohm", "farad"]): 5})
            case "kind":
                element = pick(elements)
                element["farad" if element.pop("ohm", None) else "ohm"] = element.pop("farad", 1)
        SOURCE.write_text(json.dumps(network))

    def edit(self) -> None:
        self.count += 1
        pick, number = self.random.choice, self.count
        path = pick([WHOLE, *ELEMENTS.glob("*.mo"), *ELEMENTS.glob("*/package.mo")])
        if (path.name == "package.mo" and path.parent == ELEMENTS) or not path.exists():
            return
        text, name = path.read_text(), pick(NAMES)
        match pick(["mention", "mention", "mention", "delete", "folder", "own", "around", "contradict", "undo"]):
            case "mention":
                line = pick(MENTIONS).format(name, number)
                path.write_text(text.replace("\nequation", f"\n  {line}\nequation", 1))
            case "delete":
                path.unlink()
            case "folder" if path.name != "package.mo" and not path.with_suffix("").exists():
                path.with_suffix("").mkdir()
                path.rename(path.with_suffix("") / "package.mo")
            case "own":
                mine = f"within Ladder.Elements;\nmodel Mine{number}\n  extends {name};\nend Mine{number};\n"
                (ELEMENTS / f"Mine{number}.mo").write_text(mine)
            case "around":
                use = f"Ladder.Elements.{name}{pick(['', 'Parameters'])} one;"
                Path(f"modelica/Bench{number}.mo").write_text(f"model Bench{number}\n  {use}\nend Bench{number};\n")
            case "contradict":
                path.write_text(
                    re.sub(r'"(Resistor|Capacitor|Values|Element)[^"\n]*"', f'"mine {number}"', text, count=1)
                )
            case "undo":
                path.write_text(re.sub(r"(?m)^  .*\b(other|numbers|power|voltage|twice)\d+\b.*\n", "", text))

    def build(self) -> Result:
        """Build twice. What a merged text mentions was there before, and must be there afterwards."""
        before, mentioned = set(declared()), set(mentions())
        result = run()
        files = contents(Path.cwd())
        again = run()
        assert verdict(again) == verdict(result)
        assert contents(Path.cwd()) == files
        if any(Path(action.path) == WHOLE and action.reason is Reason.MERGE for action in result.actions):
            assert set(mentions()) & mentioned & before <= set(declared())
        return result

    def resolve(self, result: Result) -> None:
        paths = [action.path for action in result.conflicts]
        run(choices={path: self.random.choice(list(Choice)) for path in paths if self.random.random() < 0.7})


def verdict(result: Result) -> list[Any]:
    return [(one.path, one.rejected, one.merge and one.merge.text) for one in result.conflict_texts]


def declared() -> Iterator[str]:
    """The elements that are there, and their components of the network."""
    yield from (path.stem for path in ELEMENTS.glob("*.mo"))
    yield from (path.parent.name for path in ELEMENTS.glob("*/package.mo"))
    yield from re.findall(r"\b(element\w+) \"", WHOLE.read_text() if WHOLE.exists() else "")


def mentions() -> Iterator[str]:
    """The elements and components that the user's lines in the network mention."""
    text = WHOLE.read_text() if WHOLE.exists() else ""
    yield from re.findall(r"Elements\.(\w+) (?:other|numbers)\d", text)
    yield from re.findall(r"= (element\w+)\.", text)


@pytest.mark.parametrize("number", range(-(-STEPS // EPISODE)))
def test_a_repeated_build_says_and_does_nothing_else(project: Path, number: int) -> None:
    seed = replay.SEED + number
    print(f"seed {seed}")  # noqa: T201 - to repeat a failure: URDFSYNC_SEED
    random = Random(seed)
    own_model(POWER)
    configure(random.choice(["", 'on_conflict = "merge"\n']))
    episode = Episode(random)
    result = episode.build()
    for _ in range(EPISODE):
        for _ in range(random.choice([0, 1, 1, 2, 3])):
            episode.edit()
        for _ in range(random.choice([0, 1, 1, 2])):
            episode.change_source()
        result = episode.build()
        if result.conflicts and random.random() < 0.4:
            episode.resolve(result)
            episode.build()
