"""Options and source change between builds, in any order: no internal error, no change untold, and then all is in step.

Each case takes a history of the corpus. `URDFSYNC_CASES=300` takes as many fresh ones, some 2 s each.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from random import Random
from typing import Any

import pytest
from support import replay
from support.cases import CASES

import urdfsync
from urdfsync.engine.result import Result

pytestmark = pytest.mark.slow

SEEDS = range(4)
LARGEST = 150_000
"""Bytes of a source: larger ones take ten seconds."""
CHOICES: dict[str, list[Any]] = {
    "base": ["fixed", "floating"],
    "collisions": [True, False],
    "approach": [["package"], ["record"], ["package", "record"]],
    "meshes": ["import", "skip"],
    "drives": ["joint", "motor"],
    "frames": ["leaves", "all"],
    "inputs": ["names", "vector"],
    "friction": ["smooth", "stiction"],
}
HISTORIES = [
    *({name: versions for name, versions in replay.histories().items() if max(map(len, versions)) < LARGEST}.values())
]


def chosen(random: Random) -> str:
    """The robot's configuration, with some options other than the default."""
    options = {name: random.choice(values) for name, values in CHOICES.items() if random.random() < 0.5}
    return "".join(f"{name} = {json.dumps(value)}\n" for name, value in options.items())


def changed(content: bytes, random: Random) -> bytes:
    """A source as another export could have it."""
    match random.randrange(6):
        case 0:
            return re.sub(rb"<collision\b.*?</collision>", b"", content, count=random.randrange(3), flags=re.S)
        case 1:  # a visual collides, too
            visual = re.search(rb"<visual\b(.*?)(?:<material.*?)?</visual>", content, re.S)
            end = visual.end() if visual else 0
            return content[:end] + (b"<collision%b</collision>" % visual[1] if visual else b"") + content[end:]
        case 2:
            return re.sub(rb'<(sphere|cylinder|capsule) (.*?)="[\d.]+"', rb'<\1 \2="0.125"', content, count=2)
        case 3:
            return re.sub(rb"<material\b[^/]*?(/>|.*?</material>)", b"", content, count=2, flags=re.S)
        case 4:
            kind = random.choice([b"fixed", b"continuous", b"floating"])
            return re.sub(rb'type="(revolute|continuous)"', b'type="' + kind + b'"', content, count=1)
        case _:
            return re.sub(rb'<mass value="[^"]*"', b'<mass value="1.25"', content, count=2)


def internal(result: Result) -> list[str]:
    return [str(finding) for finding in result.diagnostics if finding.code == "internal"]


@pytest.mark.parametrize("seed", [Random().getrandbits(32) for _ in range(CASES)] or SEEDS)
def test_each_change_is_built_told_and_then_in_step(corpus: Path, tmp_path: Path, seed: int) -> None:
    random = Random(seed)
    versions = random.choice(HISTORIES)
    project, content = replay.Project(tmp_path, meshes=True), random.choice(versions)
    configuration = tmp_path / "urdfsync.toml"
    begin = '[robots.bot]\nsource = "bot.urdf"\npackage = "Bot"\npackage_paths = ["ros"]\n'
    for step in range(4):
        is_same_source = step > 0 and random.random() < 0.5
        if not is_same_source:
            content = changed(random.choice(versions), random)
            project.save(content)
        if is_same_source or step == 0:
            configuration.write_text(begin + chosen(random))
        (compared,) = urdfsync.diff(config=configuration)
        assert internal(compared.result) == []
        result = project.build()
        assert internal(result) == []
        if result.failed:  # options that a robot can't have
            continue
        is_first = not any(action.base for action in result.actions)
        assert is_first or not result.writes or is_same_source or result.changes
        again = project.build()
        assert (again.failed, again.writes, again.renews) == (False, False, False)
