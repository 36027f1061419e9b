"""Replays the histories of the corpus with random edits by hand between the builds: not one edited line may get lost.

`python tests/replay_edits.py [STEPS [SEED]]` takes about 0.2 s per step; 2,000 steps is what the engine has to stand.
Versions are those of the histories, and variants with renamed elements and other numbers. After each build everything
is looked at again, see `support.steps`. The exit code is 1 if anything is wrong. `tests/test_replay.py` runs a few.
"""

from __future__ import annotations

import collections
import re
import shutil
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from random import Random

from support import edits, replay
from support.replay import Fresh, Project
from support.steps import Answer, Known, Step, plain

from urdfsync.engine.actions import Kind
from urdfsync.state.manifest import text_hash
from urdfsync.state.record import Choice

EPISODE = 40
"""Steps with one project."""
LARGEST = 60
"""Links that a robot has at most; the larger ones take seconds a step, and no other way."""
COLUMNS = (
    "steps",
    "builds",
    "refused",
    "edits",
    "kept",
    "conflicts",
    "merges",
    "as git",
    "moves",
    "resolved",
    "clones",
    "lost",
)


class Episode:
    """One project, one history, and somebody who edits."""

    def __init__(self, random: Random, versions: Sequence[bytes], work: Path, tally: collections.Counter[str]) -> None:
        self._random, self._versions, self._work, self._tally = random, versions, work, tally
        base = random.choice(["fixed", replay.base_of(versions)])
        meshes = random.random() < 0.2
        self.project = Project(work / "project", base, meshes=meshes)
        self.fresh = Fresh(work / "fresh", base, meshes=meshes)
        self.hand = edits.Hand(random)
        self.pristine: dict[str, bytes] = {}
        self.texts: dict[str, bytes] = {}
        self._place = random.randrange(len(versions))
        self.content = self._readable = versions[self._place]
        self._merging = False
        self._conflicts: Mapping[str, Sequence[Choice]] = {}
        """The paths of files that conflict, and what can be done about them."""
        self.answers: Mapping[str, Answer] = {}
        self._clones = 0
        self._build({})

    def step(self) -> Iterator[str]:
        """Edits, mostly another version, a build, and sometimes an answer to conflicts; gives what was wrong."""
        random = self._random
        for _ in range(random.choice([0, 1, 1, 2, 4, 8])):
            self.hand.edit(self.project.package)
        if random.random() < 0.8:
            self.content = self._next()
        if random.random() < 0.15:
            self._merging = not self._merging
            self.project.configure('on_conflict = "merge"\n' if self._merging else "")
        clone = self._clone() if random.random() < 0.15 else None
        yield from self._build({})
        if clone is not None:
            yield from self._compare(clone)
        if self._conflicts and random.random() < 0.6:
            choices = self._decide()
            if random.random() < 0.2:
                self.hand.edit(self.project.package)
            yield from self._build(choices)

    def _build(self, choices: Mapping[str, Choice]) -> list[str]:
        self.project.save(self.content)
        for text in plain(self.fresh(self.content).files).values():
            self.texts.setdefault(text_hash(text.decode()), text)
        known = Known(
            self.project, self.fresh(self.content).files, self.pristine, self.texts, self.answers, self._merging
        )
        step = Step(known, choices)
        faults = list(step.faults())
        self._tally["builds"] += 1
        self._tally["as git"] += step.as_git
        self._tally["lost"] += sum(fault.startswith("lost") for fault in faults)
        if step.result.failed:
            self._tally["refused"] += 1
            return faults
        self._readable = self.content
        kinds = collections.Counter(action.kind for action in step.result.actions if not action.held)
        for column, kind in (("kept", Kind.KEEP), ("merges", Kind.MERGE), ("moves", Kind.MOVE)):
            self._tally[column] += kinds[kind]
        self._tally["conflicts"] += len(step.result.conflicts)
        self._tally["resolved"] += len(choices)
        self._conflicts = step.conflicts()
        self.pristine, self.answers = step.pristine(), step.answers()
        return faults

    def _next(self) -> bytes:
        """The next version, any version, or a variant of this one."""
        random, chance = self._random, self._random.random()
        if chance < 0.35:
            return _renamed(self._readable, random)
        if chance < 0.5:
            return _retuned(self._readable, random)
        self._place = (
            (self._place + 1) % len(self._versions) if chance < 0.85 else random.randrange(len(self._versions))
        )
        return self._versions[self._place]

    def _decide(self) -> dict[str, Choice]:
        found = {}
        for path in self._random.sample(list(self._conflicts), self._random.randint(1, len(self._conflicts))):
            found[path] = self._random.choice(self._conflicts[path])
        return found

    def _clone(self) -> Project:
        self._clones += 1
        self._tally["clones"] += 1
        return self.project.clone(self._work / f"clone{self._clones}")

    def _compare(self, clone: Project) -> Iterator[str]:
        """The clone, where nothing but committed files was, comes to the same result."""
        clone.save(self.content)
        result = clone.build()
        if not result.failed:
            for what, here, there in (
                ("package", self.project.files(), clone.files()),
                ("state", self.project.state(), clone.state()),
            ):
                differ = sorted(path for path in here.keys() | there.keys() if here.get(path) != there.get(path))
                yield from [f"a clone differs in the {what}: {differ[:3]}"] if differ else []
        shutil.rmtree(clone.root)


def _renamed(content: bytes, random: Random) -> bytes:
    """One link or joint under another name."""
    names = re.findall(rb'<(?:link|joint)\s[^>]*?name="([^"]+)"', content)
    if not names:
        return content
    name = random.choice(names)
    new = name[:-2] if name.endswith(b"_r") else name + b"_r"
    return content.replace(b'"%s"' % name, b'"%s"' % new)


def _retuned(content: bytes, random: Random) -> bytes:
    """Some other vectors and limits."""
    places = list(re.finditer(rb'(?:xyz|lower|mass value)="([^" ]+)', content))
    for place in sorted(random.sample(places, min(len(places), 5)), key=lambda match: -match.start()):
        content = content[: place.start(1)] + b"%.3f" % random.uniform(-0.5, -0.1) + content[place.end(1) :]
    return content


def small_histories() -> list[Sequence[bytes]]:
    """The histories of robots that are not too large."""
    return [all_of for all_of in replay.histories().values() if _size(all_of) <= LARGEST]


def _size(versions: Sequence[bytes]) -> int:
    return max(content.count(b"<link") for content in versions)


def run(steps: int, seed: int, length: int = EPISODE) -> Iterator[tuple[collections.Counter[str], list[str]]]:
    """Replay so many steps; after each episode, what was counted in all and what was wrong in it."""
    tally = collections.Counter[str]()
    while tally["steps"] < steps:
        with tempfile.TemporaryDirectory() as work, replay.in_haste():
            yield tally, _episode(seed, min(length, steps - tally["steps"]), Path(work), tally)
        seed += 1


def _episode(seed: int, steps: int, work: Path, tally: collections.Counter[str]) -> list[str]:
    """Replay some steps of one project, up to the first one with faults, since more follow from those."""
    random, histories = Random(seed), small_histories()
    versions = random.choices(histories, [1 / _size(all_of) for all_of in histories])[0]
    episode = Episode(random, versions, work, tally)
    try:
        for number in range(steps):
            tally["steps"] += 1
            if faults := list(episode.step()):
                return [f"seed {seed}, step {number}: {fault}" for fault in faults]
    except Exception as error:
        error.add_note(f"seed {seed}, step {number}")
        raise
    finally:
        tally["edits"] += sum(episode.hand.made.values())
    return []


def main(arguments: Sequence[str]) -> int:
    """Replay as many steps as are asked for; 1 if anything is wrong."""
    steps, seed = (*map(int, arguments), *(2000, 1)[len(arguments) :])
    if not replay.histories():
        print("needs the corpus: set URDFSYNC_CORPUS")  # noqa: T201
        return 2
    begin, wrong = time.monotonic(), 0
    for tally, faults in run(steps, seed):  # noqa: B007 - the last one is printed
        wrong += len(faults)
        for fault in faults:
            print(fault[:400], flush=True)  # noqa: T201
    print("".join(f"{column:>10}" for column in COLUMNS))  # noqa: T201
    print("".join(f"{tally[column]:>10}" for column in COLUMNS))  # noqa: T201
    print(f"{wrong} faults, 0 exceptions, {time.monotonic() - begin:.0f} s")  # noqa: T201 - one would have ended it
    return int(bool(wrong))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
