"""Replays of the corpus's histories with random edits by hand between the builds: not one edited line may get lost.

Versions are those of the histories, and variants with renamed elements and other numbers. After each build everything
is looked at again. `URDFSYNC_REPLAYS=2000` sets the number of steps; 2,000 is what the engine has to stand, at 0.2 s
each. The counts are printed.
"""

from __future__ import annotations

import collections
import itertools
import re
import shutil
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from random import Random

import pytest
from support import edits, replay
from support.replay import Files, Fresh, Project

from urdfsync.domain import Role
from urdfsync.engine.actions import Reason
from urdfsync.engine.conflicts import MERGES, Conflict
from urdfsync.engine.result import Result
from urdfsync.files import text_digest
from urdfsync.state.record import Choice

STEPS = replay.STEPS or 60
EPISODE = 40 if replay.STEPS else 20
"""Steps with one project."""
LARGEST = 60
"""Links that a robot has at most; the larger ones take seconds a step, and no other way."""
CONFLICTS = ".urdfsync/conflicts/bot"
_MARKERS = re.compile(rb"^(<{7}|={7}|>{7}|\|{7})", re.MULTILINE)

Answer = tuple[Choice, bytes | None, bytes | None]
"""What was chosen for a file that conflicts, its text, and what would have been written."""

pytestmark = pytest.mark.slow


class Episode:
    """One project, one history, and somebody who edits. Paths count from the package."""

    def __init__(self, random: Random, versions: Sequence[bytes], work: Path, tally: collections.Counter[str]) -> None:
        self.random, self.versions, self.work, self.tally = random, versions, work, tally
        base, meshes = random.choice(["fixed", replay.base_of(versions)]), random.random() < 0.2
        self.project = Project(work / "project", base, meshes=meshes)
        self.fresh_of = Fresh(work / "fresh", base, meshes=meshes)
        self.hand = edits.Hand(random)
        self.place = random.randrange(len(versions))
        self.content = self.readable = versions[self.place]
        self.merging = False
        self.pristine: Files = {}
        """Files that were as urdfsync wrote them after the last build."""
        self.texts: dict[str, bytes] = {}
        """Everything that was ever generated, by its hash."""
        self.possible: Mapping[str, Sequence[Choice]] = {}
        """The files that conflict, and what can be done about them."""
        self.waiting: Mapping[str, Answer] = {}
        """The choices that wait for other conflicts, and will be done if nothing changes till then."""
        self.build({})

    def step(self) -> None:
        """Edits, mostly another version, a build, and sometimes an answer to conflicts."""
        random = self.random
        for _ in range(random.choice([0, 1, 1, 2, 4, 8])):
            self.hand.edit(self.project.package)
        if random.random() < 0.8:
            self.content = self.next()
        if random.random() < 0.15:
            self.merging = not self.merging
            self.project.configure('on_conflict = "merge"\n' if self.merging else "")
        clone = self.project.clone(self.work / "clone") if random.random() < 0.15 else None
        self.build({})
        if clone is not None:
            self.compare(clone)
        if self.possible and random.random() < 0.6:
            chosen = random.sample(list(self.possible), random.randint(1, len(self.possible)))
            choices = {path: random.choice(self.possible[path]) for path in chosen}
            if random.random() < 0.2:
                self.hand.edit(self.project.package)
            self.build(choices)

    def next(self) -> bytes:
        """The next version, any version, or a variant of this one."""
        chance, count = self.random.random(), len(self.versions)
        if chance < 0.35:
            return renamed(self.readable, self.random)
        if chance < 0.5:
            return retuned(self.readable, self.random)
        self.place = (self.place + 1) % count if chance < 0.85 else self.random.randrange(count)
        return self.versions[self.place]

    def compare(self, clone: Project) -> None:
        """The clone, where nothing but committed files was, comes to the same result."""
        self.tally["clones"] += 1
        clone.save(self.content)
        if not clone.build().failed:
            assert (clone.files(), clone.state()) == (self.project.files(), self.project.state())
        shutil.rmtree(clone.root)

    def build(self, choices: Mapping[str, Choice]) -> None:
        """Build, and see that nothing is wrong."""
        self.project.save(self.content)
        self.fresh = plain(self.fresh_of(self.content)[0])
        self.texts |= {text_digest(text): text for text in self.fresh.values()}
        raw = self.project.files()
        self.before = plain(raw)
        result = self.project.build(choices={f"{replay.PACKAGE}/{path}": what for path, what in choices.items()})
        self.after = plain(self.project.files())
        self.actions = {inside(action.path): action for action in result.actions}
        self.origins = {inside(a.origin): path for path, a in self.actions.items() if a.origin and a.writes}
        kept = {path: one[0] for path, one in self.waiting.items() if one == self.answer(path, one[0])}
        self.choices = {**kept, **choices}
        if faults := list(self.faults(result, raw)):
            raise AssertionError("\n".join(faults))
        if not result.failed:
            self.readable = self.content
            self.count(result, choices)
            found = {p: c for p, c in self.after.items() if c in (self.fresh.get(p), self.pristine.get(p))}
            self.pristine = {path: content for path, content in found.items() if not is_order(path)}
            self.possible = {inside(conflict.path): self.options(conflict) for conflict in result.conflict_texts}
            self.waiting = {p: self.answer(p, choice) for p, choice in self.choices.items() if self.actions[p].held}

    def count(self, result: Result, choices: Mapping[str, Choice]) -> None:
        kinds = collections.Counter(action.reason for action in result.actions if not action.held)
        found = {"kept": kinds[Reason.KEEP], "merges": kinds[Reason.MERGE], "moves": kinds[Reason.MOVE], "builds": 1}
        self.tally.update({**found, "conflicts": len(result.conflicts), "resolved": len(choices)})

    def answer(self, path: str, choice: Choice) -> Answer:
        action = self.actions.get(path)
        place = inside(action.origin) if action and action.origin else path
        return choice, self.before.get(place), self.fresh.get(path)

    def options(self, conflict: Conflict) -> Sequence[Choice]:
        if self.is_folder(inside(conflict.origin or conflict.path)):
            return [Choice.KEEP]
        merges = [choice for choice in Choice if choice in MERGES and conflict.merged(choice) is not None]
        return [Choice.KEEP, Choice.TAKE, *merges]

    def is_folder(self, path: str) -> bool:
        """Whether the user has made a folder of a class."""
        return (self.project.package / path).with_suffix("").joinpath("package.mo").is_file()

    # What must hold

    def faults(self, result: Result, raw: Files) -> Iterator[str]:
        """Everything that is not as it should be after a build of the files `raw`."""
        for path in self.project.root.rglob("*.mo"):
            if path.is_file() and _MARKERS.search(path.read_bytes()):
                yield f"{path.name} has conflict markers"
        if result.failed:
            yield from ["a version that can be read is refused"] if self.fresh else []
            yield from ["an error changes files"] if self.project.files() != raw else []
            return
        yield from self.lost_lines(raw)
        yield from self.replaced()
        yield from self.out_of_step(result)
        yield from self.odd_conflicts(result, raw)
        yield from self.odd_choices(result)
        stamps = self.project.stamps()
        again = self.project.build()
        yield from ["a second build writes"] if self.project.stamps() != stamps else []
        if {action.path for action in result.conflicts} != {action.path for action in again.conflicts}:
            yield "a second build has other conflicts"

    def lost_lines(self, raw: Files) -> Iterator[str]:
        """Each tag is where it was, or where its file went; a line of the user's is whole."""
        after = edits.tagged(self.after)
        for tag, line in edits.tagged(raw).items():
            place = self.origins.get(line.path, line.path)
            found = after.get(tag)
            if self.choices.get(place) in (Choice.TAKE, Choice.MERGE_GENERATED):
                continue
            if found is None or found.path != place:
                yield f"lost: {tag} of {line.path} is {'nowhere' if found is None else f'in {found.path}'}"
            elif line.own and found.text != line.text:
                yield f"lost: {line.text!r} became {found.text!r} in {place}"

    def replaced(self) -> Iterator[str]:
        """What the user has edited changes by a merge only, and never without permission."""
        for path, content in self.before.items():
            if text_digest(content) in self.texts or is_order(path):
                continue  # as generated, be it because all edits were taken back
            if self.project.package.joinpath(path).is_file() and self.after.get(path) == content:
                continue
            action = self.actions.get(path)
            merged = action is not None and action.reason is Reason.MERGE and self.merging
            if not (merged or path in self.origins or self.choices.get(path) in {Choice.TAKE, *MERGES}):
                yield f"{path} was edited, and is changed: {action and action.reason}"

    def out_of_step(self, result: Result) -> Iterator[str]:
        """What nobody has edited equals a fresh build, unless it has to wait."""
        edited = {p for p, c in self.before.items() if c != self.pristine.get(p) and not is_order(p)}
        edited |= {self.origins[path] for path in edited & self.origins.keys()}
        for path in (self.fresh.keys() | self.after.keys()) - edited:
            if path not in self.after and self.is_folder(path):
                continue
            here, before, wanted = self.after.get(path), self.before.get(path), self.fresh.get(path)
            if is_order(path):
                here, before = (self.generated_order(path, order or b"", wanted or b"") for order in (here, before))
            action = self.actions.get(path)
            needed = wanted is None and action is not None and action.reason is Reason.NEEDED
            if here != wanted and not needed and not (result.conflicts and here == before):
                yield f"{path} differs from a fresh build: {action and action.reason} {action and action.held}"

    def generated_order(self, path: str, order: bytes, wanted: bytes) -> bytes | None:
        """A `package.order` without the lines of the user's, and of classes that stay his, or that he deleted."""
        folder, below = (self.project.package / path).parent, path.removesuffix("package.order")
        names = edits.without_own(order).decode().splitlines(keepends=True)
        generated = wanted.decode().splitlines(keepends=True)

        def stays(name: str) -> bool:
            deleted = f"{below}{name}.mo" not in self.before
            return deleted or (folder / f"{name}.mo").is_file() or (folder / name / "package.mo").is_file()

        left = [line for line in names if line.strip() in wanted.decode().split() or not stays(line.strip())]
        same = sorted(left) == sorted(generated)  # a line that was his stays in its place
        return (wanted if same else "".join(left).encode()) or None

    def odd_conflicts(self, result: Result, raw: Files) -> Iterator[str]:
        """The file is as it was, and the texts of both sides are put aside; nothing of older conflicts is left."""
        found, aside = self.project.files(), replay.contents(self.project.root / CONFLICTS)
        wanted = set()
        for conflict in result.conflict_texts:
            path, place = inside(conflict.path), inside(conflict.origin or conflict.path)
            if found.get(place) != raw.get(place):
                yield f"{place} conflicts, and is changed"
            stem, action = path.removesuffix(".mo"), self.actions[path]
            wanted |= {f"{stem}.{part}" for part in ("base", "generated", "merge")}
            texts = {part: aside.get(f"{stem}.{part}.mo") for part in ("base", "generated", "merge")}
            if texts["generated"] is None or lf(texts["generated"]) != self.fresh.get(path):
                yield f"{stem}.generated.mo is not what would be written"
            if conflict.base is not None and lf(texts["base"] or b"") != lf(conflict.base.encode()):
                yield f"{stem}.base.mo is not the base"
            if conflict.base is not None and action.base and text_digest(conflict.base.encode()) != action.base:
                yield f"the base of {path} is not the recorded one"
            if texts["merge"] is not None:
                tags = edits.tagged({path: self.before[place]}).keys() - edits.tagged({path: texts["merge"]}).keys()
                yield from (f"lost: {tag} in {stem}.merge.mo" for tag in tags)
        stray = {name for name in aside if name.removesuffix(".txt").removesuffix(".mo") not in wanted}
        yield from (f"{name} is left over" for name in stray)
        files = {action.path for action in result.conflicts if action.role is not Role.IMPORT}
        missing = files - {conflict.path for conflict in result.conflict_texts}
        yield from (f"{path} conflicts, but there are no texts of it" for path in missing)

    def odd_choices(self, result: Result) -> Iterator[str]:
        """What was chosen has come about."""
        conflicts, moved = {inside(action.path) for action in result.conflicts}, self.origins.values()
        # what the user keeps elsewhere may lack a name that the merge would bring in
        rejected = {inside(one.path) for one in result.conflict_texts if one.rejected}
        for path, choice in self.choices.items():
            action = self.actions.get(path)
            before, after = self.before.get(path), self.after.get(path)
            if path in conflicts:
                if choice not in MERGES or path not in rejected:
                    yield f"{path} still conflicts after {choice}"
            elif action is None or action.held:
                continue
            elif choice is Choice.TAKE and after != self.fresh.get(path):
                yield f"{path} is not what was taken"
            elif choice is Choice.KEEP and path not in moved and after != before:
                yield f"{path} was not kept"


def renamed(content: bytes, random: Random) -> bytes:
    """One link or joint under another name."""
    names = re.findall(rb'<(?:link|joint)\s[^>]*?name="([^"]+)"', content)
    if not names:
        return content
    name = random.choice(names)
    new = name[:-2] if name.endswith(b"_r") else name + b"_r"
    return content.replace(b'"%s"' % name, b'"%s"' % new)


def retuned(content: bytes, random: Random) -> bytes:
    """Some other vectors and limits."""
    places = list(re.finditer(rb'(?:xyz|lower|mass value)="([^" ]+)', content))
    for place in sorted(random.sample(places, min(len(places), 5)), key=lambda match: -match.start()):
        content = content[: place.start(1)] + b"%.3f" % random.uniform(-0.5, -0.1) + content[place.end(1) :]
    return content


def lf(content: bytes) -> bytes:
    """The content with the line ends that are normal here."""
    return content.replace(b"\r\n", b"\n")


def plain(files: Files) -> dict[str, bytes]:
    """Text files with the line ends that are normal here; no others."""
    return {path: lf(content) for path, content in files.items() if path.endswith((".mo", ".order"))}


def inside(path: str | None) -> str:
    """A path of a manifest as it counts from the package."""
    return (path or "").removeprefix(f"{replay.PACKAGE}/")


def is_order(path: str) -> bool:
    return path.endswith("package.order")


def run(folder: Path, steps: int) -> collections.Counter[str]:
    """Replay so many steps, with a project for some of them at a time; what was counted."""
    histories = [all_of for all_of in replay.histories().values() if size(all_of) <= LARGEST]
    tally = collections.Counter[str]()
    for seed in itertools.count(replay.SEED):
        if tally["steps"] >= steps:
            return tally
        random, work = Random(seed), folder / str(seed)
        versions = random.choices(histories, [1 / size(all_of) for all_of in histories])[0]
        with replay.in_haste():
            episode = Episode(random, versions, work, tally)
            for number in range(min(EPISODE, steps - tally["steps"])):
                tally["steps"] += 1
                try:
                    episode.step()
                except Exception as error:
                    error.add_note(f"seed {seed}, step {number}")
                    raise
        tally["edits"] += sum(episode.hand.made.values())
        shutil.rmtree(work)
    raise AssertionError("seeds do not end")


def size(versions: Sequence[bytes]) -> int:
    return max(content.count(b"<link") for content in versions)


def test_no_edited_line_gets_lost(corpus: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    tally = run(tmp_path, STEPS)
    assert all(tally[count] for count in ("edits", "conflicts", "merges", "moves", "resolved", "clones"))
    with capsys.disabled():
        print(f"\n{dict(tally)}")  # noqa: T201


def test_a_lost_line_would_be_found(corpus: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    build = Project.build

    def careless(project: Project, **request: object) -> Result:
        result = build(project, **request)
        for path in project.package.rglob("*.mo"):
            lines = path.read_text().splitlines(keepends=True)
            if any("// mine" in line for line in lines):
                path.write_text("".join(line for line in lines if "// mine" not in line))
        return result

    monkeypatch.setattr(Project, "build", careless)
    monkeypatch.setattr(replay, "SEED", 3)
    with pytest.raises(AssertionError) as caught:
        run(tmp_path, 20)
    assert "lost: mine" in str(caught.value)
    assert "was edited, and is changed" in str(caught.value)
