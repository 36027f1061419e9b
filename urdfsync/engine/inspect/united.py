"""Finds the versions of files that git has merged from two branches, and the text that both branches meant."""

from __future__ import annotations

import itertools
import os
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from urdfsync import git
from urdfsync.dependencies import reads
from urdfsync.dependencies.places import named, real
from urdfsync.diagnostics import SourceError
from urdfsync.domain import Role
from urdfsync.engine.inspect.commits import UNDER_WAY, plain, read_text
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.inspect.last_build import LastBuild
from urdfsync.engine.inspect.package_files import encode, text_hash
from urdfsync.engine.package.generate import Package
from urdfsync.git.revisions import Revision
from urdfsync.modelica import markers
from urdfsync.modelica.stamp import Stamp, split, with_stamp
from urdfsync.state.record import role_of

if TYPE_CHECKING:
    import pygit2

    from urdfsync.merge import Merge

_Changes: TypeAlias = Counter[tuple[tuple[str, ...], tuple[str, ...]]]
"""Changed lines and their replacements. The order of lines does not count: a diff can cut added blocks in several
ways."""


class Sides(NamedTuple):
    """The versions of a file that git merged: bare texts, whose lines end with line feeds."""

    base: str
    """The text in the common ancestor; empty without one."""
    ours: str
    theirs: str
    stamps: tuple[Stamp | None, Stamp | None] = (None, None)
    """The stamps of both sides."""


def _sides(base: str, ours: str, theirs: str) -> Sides:
    """Return the versions of a file by their texts with stamps."""
    (our_text, our_stamp), (their_text, their_stamp) = split(ours), split(theirs)
    return Sides(split(base)[0], our_text, their_text, (our_stamp, their_stamp))


def with_git_merges(inputs: Inputs, package: Package) -> Inputs:
    """Return the inputs, in which each file that git merged, or left unmerged, has the text that both branches meant.

    If nobody edited the versions, this is our version. Otherwise it is a merge by elements without contradictions.
    """
    files, last, folder = inputs.files, inputs.last, inputs.folder
    contents: dict[str, bytes] = {}
    left: dict[str, Merge | None] = {}
    generated = {folder.key(path): package.hash(path) for path in package.artifacts}
    for key in dict.fromkeys((*generated, *last.files)):
        role, text = role_of(folder.path(key)), generated.get(key)
        if role is Role.IMPORT:
            continue
        on_disk = files.on_disk(key, role)
        if on_disk == text and key not in inputs.unmerged:
            continue  # most files are in step
        is_edited = isinstance(on_disk, str) and on_disk not in (text, last.base_of(key, role))
        found = _find_meant_text(inputs, key, is_edited=is_edited) if is_edited or key in inputs.unmerged else None
        if isinstance(found, str) and text_hash(found) == files.hash(key, role):
            continue  # the file has the meant text already, and only `git add` is missing
        if isinstance(found, str):
            contents[key], left[key] = with_stamp(encode(found), files.stamp(key)), None
        elif found is not None:
            left[key] = found
    return inputs.laid_over(contents, left) if left else inputs


def _find_meant_text(inputs: Inputs, key: str, *, is_edited: bool) -> str | Merge | None:
    """Return the text that both branches meant, or their merge if they contradict each other; None for other files."""
    last, file, text = inputs.last, inputs.files.path(key), inputs.files.any_text(key)
    has_markers, is_unmerged = bool(markers.find_markers(text)), key in inputs.unmerged
    if not (has_markers or is_unmerged):
        return None
    if is_unmerged and not has_markers and (left := _read_left_side(file, plain(text))):
        if _is_chosen(inputs, key, plain(text)):
            return None  # `git add` is missing
        return text if _are_generated(last, [left[1]]) else _merge_edits(last, left[0])
    if not (has_markers or is_edited):
        return None
    sides = read_sides(file, text)
    if sides is None and has_markers:
        ours, theirs = markers.read_sides(plain(text))
        # both sides are generated texts, so no edit is lost
        return ours if _are_generated(last, (ours, theirs)) else None
    if sides and _are_generated(last, (sides.ours, sides.theirs)):
        return sides.ours
    if sides is None or not has_markers:
        return None
    return _merge_edits(last, sides)


def _merge_edits(last: LastBuild, sides: Sides) -> str | Merge:
    """Merge two versions by their elements; if that fails, merge their edits into the same generated text.

    The second way ignores differences between exports: these are no contradictions between people.
    """
    from urdfsync.merge.texts import merge, merge_branches  # imports the parser

    merges = [merge_branches(*sides[:3])]
    our_base, their_base = (last.base(stamp.base) if stamp else None for stamp in sides.stamps)
    if our_base is not None and their_base is not None:
        moved = merge(their_base, sides.theirs, our_base, is_modelica=True).text
        merges += [merge_branches(our_base, sides.ours, moved)] if moved is not None else []
    best = min(merges, key=lambda one: len(one.contradictions))
    return best if best.text is None else best.text


def _are_generated(last: LastBuild, texts: Iterable[str]) -> bool:
    """Return whether builds wrote all of these texts."""
    return all(last.has_written(text_hash(text)) for text in texts)


def can_join(file: Path, text: str, *, is_united: bool) -> bool:
    """Return whether a `package.order` with markers is still git's merge, so that its lines may be joined.

    Without a readable repository, `is_united` decides: whether git has united the recorded state.
    """
    try:
        Revision(file.parent, "HEAD")
    except SourceError:
        return is_united
    return read_sides(file, text) is not None


def _is_chosen(inputs: Inputs, key: str, text: str) -> bool:
    """Return whether the file has the user's choice between git's present versions.

    The text equals one version, which does not show it. But the choice has replaced another version, or both.
    """
    import pygit2

    last, file = inputs.last, inputs.files.path(key)
    aside = last.aside.get(inputs.folder.path(key))
    if aside is None or aside.after != text_hash(text):
        return False
    former = split(plain((inputs.store.aside_text(last.name, aside.file) or b"").decode(errors="replace")))[0]
    if former == text:
        return False  # an earlier `--keep` looks the same
    try:
        staged = _staged(Revision(file.parent, "HEAD").repository, file, former)
        return any(former in sides[1:3] or _is_untouched(former, sides) for sides in staged)
    except (SourceError, pygit2.GitError, KeyError, OSError, ValueError):
        return False  # as in `read_sides`


def _read_left_side(file: Path, text: str) -> tuple[Sides, str] | None:
    """Return the versions of an unmerged file that has the text of one of them, and the text of the other.

    A merge driver that fails leaves ours.
    """
    import pygit2

    try:
        staged = _staged(Revision(file.parent, "HEAD").repository, file, text)
        found = next((sides for sides in staged if text in sides[1:3]), None)
    except (SourceError, pygit2.GitError, KeyError, OSError, ValueError):
        return None  # as in `read_sides`
    return (found, found.theirs if text == found.ours else found.ours) if found else None


def read_sides(file: Path, text: str) -> Sides | None:
    """Return the versions of a file that git merged, in the present merge or in the last merge.

    Return None if there are none, or if somebody has changed the file since the merge.
    """
    import pygit2

    reads.depend_on_commits(git.find_top(file.parent))
    text = plain(text)
    try:
        repository = Revision(file.parent, "HEAD").repository
        candidates = itertools.chain(_staged(repository, file, text), _committed(repository, file))
        return next((sides for sides in candidates if sides.ours == sides.theirs or _is_untouched(text, sides)), None)
    except (SourceError, pygit2.GitError, KeyError, OSError, ValueError):
        return None  # as without a repository: it is damaged or shallow


def _staged(repository: pygit2.Repository, file: Path, text: str) -> Iterator[Sides]:
    """Yield the versions in the index, if git reports a conflict in the file."""
    folder = Path(real(file.parent)).relative_to(named(os.path.realpath(repository.workdir)))
    path = (folder / file.name).as_posix()
    for base, ours, theirs in repository.index.conflicts or ():
        entries = [entry for entry in (ours, theirs) if entry and entry.path == path]
        blobs = (repository[entry.id].read_raw() if entry else b"" for entry in (base, ours, theirs))
        texts = [plain(blob.decode(errors="replace")) for blob in blobs]
        if ours and theirs and entries:
            if base is None:  # if renames of both branches end here, the index may have git's merge of two other files
                texts[1:] = (next(_read_side(file, one, number == 0), one) for number, one in enumerate(texts[1:]))
            if not any(map(markers.find_markers, texts[1:])):
                yield _sides(*texts)
        elif entries and text in (split(one)[0] for one in texts[1:]):
            # if both branches renamed a file, git writes the merge to both paths; each branch has only one path
            for version in _read_side(file, text, bool(ours)):
                yield _sides(version, version, version)


def _read_side(file: Path, merged: str, is_ours: bool) -> Iterator[str]:
    """Yield the texts of a file in the commits of one side; the markers in git's merge may name their branch."""
    label = re.search(r"(?m)^>{7,} ([^\s:]+)", merged)
    for name in ("HEAD",) if is_ours else (*UNDER_WAY, label[1] if label else ""):
        if (text := read_text(name, file)) is not None:
            yield text


def _committed(repository: pygit2.Repository, file: Path) -> Iterator[Sides]:
    """Yield the versions in the two commits that git is merging, and in the parents of the last merge."""
    import pygit2

    for names in (*(("HEAD", name) for name in UNDER_WAY), ("HEAD^1", "HEAD^2")):
        ours, theirs = (read_text(name, file) for name in names)
        if ours is None or theirs is None:
            continue
        commits = [repository.revparse_single(name).peel(pygit2.Commit) for name in names]
        ancestor = repository.merge_base(commits[0].id, commits[1].id)
        # the base of a merge is the common ancestor; the base of a cherry-pick is the commit's parent
        for base in dict.fromkeys([str(ancestor or ""), f"{names[1]}^"]):
            yield _sides(read_text(base, file) or "", ours, theirs)


def _is_untouched(text: str, sides: Sides) -> bool:
    """Return whether a text is git's merge of two versions, with the driver or by lines.

    After a merge by lines, each side of a conflict has one version, with the other version's changes to unchanged
    lines. This compares the changes, since git may compare lines in several ways.
    """
    from urdfsync.merge.texts import merge_file

    readings = markers.read_sides(text)
    if not any(map(markers.find_markers, readings)):  # nested markers come only from the driver
        is_merged = readings[0] == text
        ours, theirs = (_changes(sides.base, side) for side in sides[1:3]) if is_merged else _apart(sides)
        if _changes(sides.ours, readings[0]) <= theirs and _changes(sides.theirs, readings[1]) <= ours:
            return True
    first, middle, last = markers.signs(text)
    driven, _ = merge_file(*sides[:3], ((first, "mine"), (middle, "generated"), (last, "")))
    return driven == markers.without_labels(text)


def _changes(old: str, new: str) -> _Changes:
    from urdfsync.merge.lines import compare

    lines, new_lines = _lines(old), _lines(new)
    return Counter(
        _change(lines[change.start : change.stop], new_lines[change.new_start : change.new_stop])
        for change in compare(lines, new_lines)
    )


def _apart(sides: Sides) -> tuple[_Changes, _Changes]:
    """Return the changes of each side that do not touch changes of the other side."""
    from urdfsync.merge.lines import find_regions

    lines = [_lines(text) for text in sides[:3]]
    ours, theirs = _Changes(), _Changes()
    for region in find_regions(*lines):
        if not region.is_generated:
            ours[_change(lines[0][region.base], lines[1][region.mine])] += 1
        elif not region.is_mine:
            theirs[_change(lines[0][region.base], lines[2][region.generated])] += 1
    return ours, theirs


def _lines(text: str) -> list[str]:
    """Return the lines of a text, ignoring a missing line feed at the end: git adds one before a marker."""
    return text.removesuffix("\n").split("\n")


def _change(old: Sequence[str], new: Sequence[str]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    return tuple(sorted(old)), tuple(sorted(new))
