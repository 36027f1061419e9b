"""What must hold after each build of a project that somebody edits by hand."""

from __future__ import annotations

import dataclasses
import re
import subprocess
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from support import edits, replay
from support.replay import Files, Project
from urdfsync.domain import Role
from urdfsync.engine.actions import Kind
from urdfsync.engine.conflicts import Conflict
from urdfsync.state.manifest import text_hash
from urdfsync.state.record import Choice

CONFLICTS = ".urdfsync/conflicts/bot"
_MARKERS = re.compile(rb"^(<{7}|={7}|>{7}|\|{7})", re.MULTILINE)


@dataclasses.dataclass(frozen=True)
class Answer:
    """What was chosen for a file that conflicts, with its text and what would have been written."""

    choice: Choice
    mine: bytes | None
    generated: bytes | None


@dataclasses.dataclass(frozen=True)
class Known:
    """What is known of a project before a build."""

    project: Project
    fresh: Files
    """The package that a fresh build of the source makes; empty if it is refused."""
    pristine: Files
    """Files that were as urdfsync wrote them after the last build."""
    texts: Files
    """Everything that was ever generated, by its hash."""
    answers: Mapping[str, Answer]
    merging: bool
    """Whether clean merges are welcome without being asked for."""


class Step:
    """One build of a project that somebody has edited, and what must hold after it. Paths count from the package."""

    def __init__(self, known: Known, choices: Mapping[str, Choice]) -> None:
        self._project, self._pristine, self._texts = known.project, known.pristine, known.texts
        self._fresh = plain(known.fresh)
        self._merging = known.merging
        self.as_git = 0
        """How many merges were compared with what git makes of the same texts."""
        self._raw = self._project.files()
        self._before = plain(self._raw)
        self._tags = edits.tagged(self._raw)
        self.result = self._project.build(choices={f"{replay.PACKAGE}/{path}": what for path, what in choices.items()})
        self._actions = {inside(action.path): action for action in self.result.actions}
        self._after = plain(self._project.files())
        remembered = {p: a.choice for p, a in known.answers.items() if a == self._answer(p, a.choice)}
        self._choices = {**remembered, **choices}
        self._origins = {inside(a.origin): path for path, a in self._actions.items() if a.origin and a.writes}

    def faults(self) -> Iterator[str]:
        """Everything that is not as it should be."""
        yield from self._markers()
        if self.result.failed:
            yield from ["a version that can be read is refused"] if self._fresh else []
            yield from ["an error changes files"] if self._project.files() != self._raw else []
            return
        yield from self._lost_lines()
        yield from self._replaced()
        yield from self._out_of_step()
        yield from self._odd_merges()
        yield from self._conflicts()
        yield from self._choices_made()
        yield from self._written_again()

    def pristine(self) -> dict[str, bytes]:
        """The files that are as urdfsync wrote them, be it some versions ago."""
        found = {p: c for p, c in self._after.items() if c == self._fresh.get(p) or c == self._pristine.get(p)}
        return {path: content for path, content in found.items() if not _is_order(path)}

    def conflicts(self) -> Mapping[str, Sequence[Choice]]:
        """The paths of files that conflict, and what can be done about them: a folder can only be kept."""
        found = {}
        for standoff in self.result.conflict_texts:
            mergeable = standoff.merge is not None and standoff.merge.text is not None
            possible = list(Choice) if mergeable else [Choice.KEEP, Choice.TAKE]
            path = inside(standoff.path)
            found[path] = [Choice.KEEP] if self._is_folder(inside(standoff.place)) else possible
        return found

    def answers(self) -> Mapping[str, Answer]:
        """The choices that wait for other conflicts, and will be done if nothing changes till then."""
        return {path: self._answer(path, choice) for path, choice in self._choices.items() if self._actions[path].held}

    def _answer(self, path: str, choice: Choice) -> Answer:
        action = self._actions.get(path)
        place = inside(action.origin) if action and action.origin else path
        return Answer(choice, self._before.get(place), self._fresh.get(path))

    def _lost_lines(self) -> Iterator[str]:
        """Each tag is where it was, or where its file went; a line of the user's is whole."""
        after = edits.tagged(self._after)
        for tag, line in self._tags.items():
            place = self._origins.get(line.path, line.path)
            if self._choices.get(place) is Choice.TAKE:
                continue
            found = after.get(tag)
            if found is None or found.path != place:
                yield f"lost: {tag} of {line.path} is {'nowhere' if found is None else f'in {found.path}'}"
            elif line.own and found.text != line.text:
                yield f"lost: {line.text!r} became {found.text!r} in {place}"

    def _replaced(self) -> Iterator[str]:
        """What the user has edited changes by a merge only, and never without permission."""
        for path, content in self._before.items():
            if text_hash(content.decode()) in self._texts or _is_order(path):
                continue  # as generated, be it because all edits were taken back
            if self._project.package.joinpath(path).is_file() and self._after.get(path) == content:
                continue
            action = self._actions.get(path)
            chosen = self._choices.get(path) in (Choice.TAKE, Choice.MERGE)
            merged = action is not None and action.kind is Kind.MERGE and self._merging
            if not (chosen or merged or path in self._origins):
                yield f"{path} was edited, and is changed: {action and action.kind}"

    def _out_of_step(self) -> Iterator[str]:
        """What nobody has edited equals a fresh build, unless it has to wait."""
        edited = {p for p, c in self._before.items() if c != self._pristine.get(p) and not _is_order(p)}
        edited |= {self._origins[path] for path in edited & self._origins.keys()}
        waits = bool(self.result.conflicts)
        for path in (self._fresh.keys() | self._after.keys()) - edited:
            if path not in self._after and self._is_folder(path):
                continue
            here, wanted = self._after.get(path), self._fresh.get(path)
            if _is_order(path):
                here = self._without_kept(path, edits.without_own(here or b""), wanted or b"") or None
                before = self._without_kept(path, edits.without_own(self._before.get(path, b"")), wanted or b"") or None
            else:
                before = self._before.get(path)
            action = self._actions.get(path)
            needed = wanted is None and action is not None and action.kind is Kind.NEEDED
            if here != wanted and not needed and not (waits and here == before):
                yield f"{path} differs from a fresh build: {action and action.kind} {action and action.held}"

    def _without_kept(self, path: str, order: bytes, wanted: bytes) -> bytes:
        """A `package.order` without the lines of classes that are the user's: of those that stay, or were deleted."""
        folder, below = (self._project.package / path).parent, path.removesuffix("package.order")
        names, generated = order.decode().splitlines(keepends=True), set(wanted.decode().split())

        def stays(name: str) -> bool:
            deleted = f"{below}{name}.mo" not in self._before
            return deleted or (folder / f"{name}.mo").is_file() or (folder / name / "package.mo").is_file()

        left = [line for line in names if line.strip() in generated or not stays(line.strip())]
        same = sorted(left) == sorted(
            wanted.decode().splitlines(keepends=True)
        )  # a line that was his stays in its place
        return wanted if same else "".join(left).encode()

    def _odd_merges(self) -> Iterator[str]:
        """What git merges without a conflict is merged to the same text."""
        for path, action in self._actions.items():
            base = self._texts.get(action.base or "")
            if action.kind is not Kind.MERGE or not action.writes or base is None:
                continue
            merged = _git(self._before[path], base, self._fresh[path])
            self.as_git += merged is not None
            if merged is not None and merged != self._after[path]:
                yield f"{path} is merged in another way than git does"

    def _conflicts(self) -> Iterator[str]:
        """The file is as it was, and the texts of both sides are put aside; nothing of older conflicts is left."""
        wanted = set()
        for standoff in self.result.conflict_texts:
            path, place = inside(standoff.path), inside(standoff.place)
            if self._project.files().get(place) != self._raw.get(place):
                yield f"{place} conflicts, and is changed"
            stem = path.removesuffix(".mo")
            wanted |= {f"{stem}.{part}" for part in ("base", "generated", "merge")}
            yield from self._put_aside(path, stem, standoff)
        folder = replay.contents(self._project.root / CONFLICTS)
        stray = {name for name in folder if name.removesuffix(".txt").removesuffix(".mo") not in wanted}
        yield from (f"{name} is left over" for name in stray)
        files = {inside(a.path) for a in self.result.conflicts if a.role is not Role.IMPORT}
        missing = files - {inside(standoff.path) for standoff in self.result.conflict_texts}
        yield from (f"{path} conflicts, but there are no texts of it" for path in missing)

    def _is_folder(self, path: str) -> bool:
        """Whether the user has made a folder of a class."""
        return (self._project.package / path).with_suffix("").joinpath("package.mo").is_file()

    def _put_aside(self, path: str, stem: str, standoff: Conflict) -> Iterator[str]:
        folder = plain(replay.contents(self._project.root / CONFLICTS))
        if folder.get(f"{stem}.generated.mo") != self._fresh.get(path):
            yield f"{stem}.generated.mo is not what would be written"
        action = self._actions[path]
        if action.base and standoff.base is not None and text_hash(standoff.base) != action.base:
            yield f"the base of {path} is not the recorded one"
        if standoff.base is not None and folder.get(f"{stem}.base.mo") != lf(standoff.base.encode()):
            yield f"{stem}.base.mo is not the base"
        proposal = folder.get(f"{stem}.merge.mo")
        if proposal is not None:
            tags = edits.tagged({path: self._before[inside(standoff.place)]}).keys()
            yield from (f"lost: {tag} in {stem}.merge.mo" for tag in tags - edits.tagged({path: proposal}).keys())

    def _choices_made(self) -> Iterator[str]:
        """What was chosen has come about."""
        conflicts = {inside(action.path) for action in self.result.conflicts}
        for path, choice in self._choices.items():
            action = self._actions.get(path)
            if path in conflicts:
                yield f"{path} still conflicts after {choice}"
            elif action is None or action.held:
                continue
            elif choice is Choice.TAKE and self._after.get(path) != self._fresh.get(path):
                yield f"{path} is not what was taken"
            elif (
                choice is Choice.KEEP
                and path not in self._origins.values()
                and self._after.get(path) != self._before.get(path)
            ):
                yield f"{path} was not kept"

    def _written_again(self) -> Iterator[str]:
        stamps = self._project.stamps()
        again = self._project.build()
        if (
            changed := {p for p, s in self._project.stamps().items() if stamps.get(p) != s}
            | stamps.keys() - self._project.stamps().keys()
        ):
            yield f"a second build writes {sorted(changed)[:3]}"
        before, after = ({a.path for a in result.conflicts} for result in (self.result, again))
        if before != after:
            yield f"a second build has other conflicts: {sorted(before ^ after)[:3]}"

    def _markers(self) -> Iterator[str]:
        for path in self._project.root.rglob("*.mo"):
            if path.is_file() and _MARKERS.search(path.read_bytes()):
                yield f"{path.name} has conflict markers"


def _git(mine: bytes, base: bytes, generated: bytes) -> bytes | None:
    """What git makes of three texts; None if it finds a conflict."""
    with tempfile.TemporaryDirectory() as folder:
        paths = [Path(folder, name) for name in ("mine", "base", "generated")]
        for path, content in zip(paths, (mine, base, generated), strict=True):
            path.write_bytes(content)
        done = subprocess.run(["git", "merge-file", "-p", *paths], capture_output=True, check=False)
    return None if done.returncode else done.stdout


def lf(content: bytes) -> bytes:
    """The content with the line ends that are normal here."""
    return content.replace(b"\r\n", b"\n")


def plain(files: Files) -> dict[str, bytes]:
    """Text files with the line ends that are normal here; no others."""
    return {path: lf(content) for path, content in files.items() if path.endswith((".mo", ".order"))}


def inside(path: str | None) -> str:
    """A path of a manifest as it counts from the package."""
    return (path or "").removeprefix(f"{replay.PACKAGE}/")


def _is_order(path: str) -> bool:
    return path.endswith("package.order")
