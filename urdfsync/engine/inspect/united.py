"""Finds the text that two branches meant with a file that git could not merge.

Git leaves both versions between markers, or one of them if its merge driver fails. Git's index has their common base.
"""

from __future__ import annotations

import os
from collections import Counter, defaultdict
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import msgspec

from urdfsync.common.dependencies.places import named, real
from urdfsync.common.diagnostics import SourceError
from urdfsync.domain import Role
from urdfsync.engine.inspect.commits import plain
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.inspect.last_build import LastBuild, lines_of
from urdfsync.engine.inspect.package_files import encode, text_hash
from urdfsync.engine.package.generate import Package
from urdfsync.modelica import markers
from urdfsync.modelica.stamp import Stamp, split, with_stamp
from urdfsync.project.git.revisions import open_repository
from urdfsync.project.state.record import role_of

if TYPE_CHECKING:
    import pygit2

    from urdfsync.merge import Merge

_Version: TypeAlias = tuple[str, Stamp | None]
_Changes: TypeAlias = Counter[tuple[tuple[str, ...], tuple[str, ...]]]
"""Changed lines and their replacements. The order of lines does not count: a diff can cut added blocks in several
ways."""


class Sides(NamedTuple):
    """The versions of a file that git could not merge: bare texts, whose lines end with line feeds."""

    base: str | None
    """The text in the common ancestor; None without one."""
    ours: str
    theirs: str
    stamps: tuple[Stamp | None, Stamp | None, Stamp | None]
    """The stamps of all three."""
    deleted: int = 0
    """The side that has deleted the file, 1 or 2; it has the other side's text."""
    left: str | None = None
    """The text with markers that git has noted; None if it has noted none."""


class _Unmerged(NamedTuple):
    """A file that git could not merge."""

    sides: Sides
    text: str
    """The bare text on disk."""
    is_untouched: bool
    """Whether the text is what git left."""


class _Meant(NamedTuple):
    """The text that both branches meant."""

    text: str
    stamp: Stamp | None
    """The stamp with the base of this text."""


def with_git_merges(inputs: Inputs, package: Package, ids: Mapping[str, str]) -> Inputs:
    """Return the inputs, in which each file that git left unmerged has the text that both branches meant.

    If nobody edited the versions, this is our version. Otherwise it is a merge by elements without contradictions.
    `ids` are the ids of generated files by path.
    """
    files, last, folder = inputs.files, inputs.last, inputs.folder
    contents: dict[str, bytes] = {}
    left: dict[str, Merge | None] = {}
    generated = {folder.key(path): package.hash(path) for path in package.artifacts}
    known = dict.fromkeys((*generated, *last.files))
    unmerged = {key: file for key in known if key in inputs.unmerged and (file := _read_unmerged(inputs, key))}
    apart = _by_parts(inputs, package, unmerged, ids)
    for key in known:
        role, text = role_of(folder.path(key)), generated.get(key)
        if role is Role.IMPORT:
            continue
        on_disk = files.on_disk(key, role)
        if on_disk == text and key not in inputs.unmerged and key not in apart:
            continue  # most files are in step
        is_edited = isinstance(on_disk, str) and on_disk not in (text, last.base_of(key, role))
        found = apart.get(key)
        if found is None and (is_edited or key in inputs.unmerged):
            found = _find_meant_text(inputs, key, unmerged.get(key))
        if isinstance(found, _Meant):
            is_there = (text_hash(found.text), found.stamp) == (files.hash(key, role), files.stamp(key))
            if is_there and not markers.find_markers(_text_on_disk(inputs, key)):
                continue  # the file has the meant text already, and only `git add` is missing
            contents[key], left[key] = with_stamp(encode(found.text), found.stamp), None
        elif found is not None:
            left[key] = found
    sure = frozenset(key for key in apart if key in inputs.unmerged or not _is_unknown(inputs, key, ids))
    inputs = msgspec.structs.replace(inputs, apart=sure)
    return inputs.laid_over(contents, left) if left else inputs


def _find_meant_text(inputs: Inputs, key: str, unmerged: _Unmerged | None) -> _Meant | Merge | None:
    """Return the text that both branches meant, or their merge if they contradict each other; None for other files."""
    last, content = inputs.last, _text_on_disk(inputs, key)
    has_markers = bool(markers.find_markers(content))
    if unmerged and unmerged.is_untouched:
        _, ours, theirs, *_ = sides = unmerged.sides
        if has_markers:
            return _meant(last, sides)
        other = theirs if unmerged.text == ours else ours
        return _Meant(*split(content)) if _are_generated(last, [other]) else _merge_edits(last, sides)
    if has_markers and not markers.find_markers(split(content)[0]):
        return _Meant(*split(content))  # they are around the stamp alone
    if has_markers:
        (ours, stamp), (theirs, _) = (split(side) for side in markers.read_sides(content))
        return _Meant(ours, stamp) if _are_generated(last, (ours, theirs)) else None  # no edit is lost
    return None


def _by_parts(
    inputs: Inputs, package: Package, unmerged: Mapping[str, _Unmerged], ids: Mapping[str, str]
) -> dict[str, _Meant | Merge]:
    """Return the texts that both branches meant with files whose names have meant several parts, by key.

    Git pairs the versions of unmerged files by paths. This pairs them by the parts that their stamps name. Returns
    nothing if two versions of one side are of one part: a copy has the same stamp.
    """
    home = {file_id: inputs.folder.key(path) for path, file_id in ids.items()}
    staged = {key: one.sides for key, one in unmerged.items() if one.is_untouched and _are_apart(one.sides, key, home)}
    versions, apart = defaultdict[str, dict[int, _Version]](dict), set[str]()
    for key, sides in staged.items():
        for side, (text, stamp) in enumerate(zip(sides[:3], sides.stamps, strict=True)):
            target = home.get(stamp.id, key) if stamp else key
            if text is None or side == sides.deleted:
                continue
            if side and target != key:
                apart |= {key, target}
            if side and side in versions[target]:
                return {}
            versions[target].setdefault(side, (text, stamp))
    merged = sorted(apart - staged.keys())  # by git
    for key in merged:
        path, side = inputs.folder.path(key), 2 if 1 in versions[key] else 1
        text, stamp = split(_text_on_disk(inputs, key))
        seen = _id_of_seen_edit(inputs, text, stamp)
        if stamp and path in ids and ids[path] != seen in home:  # git has brought the edit of another part
            target = home[seen]
            if 3 - side in versions[target]:
                return {}
            versions[target][3 - side] = text, Stamp(seen, stamp.base)
            merged += [target] if target not in {*staged, *apart} else []
            apart.add(target)
            text = package.content(path).decode()
            stamp = Stamp(ids[path], text_hash(text))
        versions[key].setdefault(side, (text, stamp))
    gone = {key: sides for key, sides in staged.items() if key in apart and versions[key].keys() <= {0}}
    if any(sides.base is None or inputs.folder.path(key) in ids for key, sides in gone.items()):
        return {}
    # an unedited file of a name that is gone goes
    meant = {key: _Meant(sides.base or "", sides.stamps[0]) for key, sides in gone.items()}
    return meant | {key: _unite(inputs.last, versions[key]) for key in sorted(apart - gone.keys())}


def _id_of_seen_edit(inputs: Inputs, text: str, stamp: Stamp | None) -> str:
    """Return the id of the file in which builds have seen the edit in a text; empty if none or several have."""
    generated = inputs.last.base(stamp.base if stamp else None) or ""
    found = inputs.last.ids_of_lines(lines_of(text) - lines_of(generated))
    return inputs.last.edits.get(text_hash(text)) or (min(found) if len(found) == 1 else "")


def _unite(last: LastBuild, versions: Mapping[int, _Version]) -> _Meant | Merge:
    """Return what both branches meant by one or two versions of a part, by their side in git's index; 0 is the base."""
    if len(sides := [versions[side] for side in (1, 2) if side in versions]) == 1:
        return _Meant(*sides[0])
    (ours, stamp), (theirs, their_stamp) = sides
    base, before = versions.get(0, (None, None))
    return _meant(last, Sides(base, ours, theirs, (before, stamp, their_stamp)))


def _text_on_disk(inputs: Inputs, key: str) -> str:
    """Return a file's text with its stamp; empty if it is missing."""
    return plain((inputs.files.read(key) or b"").decode(errors="surrogateescape"))


def _is_unknown(inputs: Inputs, key: str, ids: Mapping[str, str]) -> bool:
    """Return whether a file that git merged has an edit that no build has seen in this part's file."""
    stamp, text = inputs.files.stamp(key), inputs.files.hash(key, Role.MODEL) or ""
    return stamp is not None and stamp.base != text and inputs.last.edits.get(text) != ids.get(inputs.folder.path(key))


def _are_apart(sides: Sides, key: str, home: Mapping[str, str]) -> bool:
    """Return whether two versions are of different parts, or of the part at this path; else their file just moves."""
    _, ours, theirs = sides.stamps
    if ours is None or theirs is None or (sides.ours == sides.theirs and not sides.deleted):
        return False
    return bool(sides.deleted) or ours.id != theirs.id or home.get(ours.id, key) == key


def _read_unmerged(inputs: Inputs, key: str) -> _Unmerged | None:
    """Return a file that git could not merge; None if its versions can't be read."""
    if (sides := _read_staged(inputs.files.path(key))) is None:
        return None
    content = _text_on_disk(inputs, key)
    text = split(content)[0]
    if markers.find_markers(content):
        is_left = sides.left is not None and markers.without_labels(content) == markers.without_labels(sides.left)
        return _Unmerged(sides, text, is_left or _is_untouched(text, sides))
    return _Unmerged(sides, text, text in sides[1:3] and not _is_chosen(inputs, key, text, sides))


def _sides(base: str | None, ours: str, theirs: str) -> Sides:
    """Return the versions of a file by their texts with stamps."""
    (base_text, base_stamp), (our_text, our_stamp), (their_text, their_stamp) = map(split, (base or "", ours, theirs))
    return Sides(None if base is None else base_text, our_text, their_text, (base_stamp, our_stamp, their_stamp))


def _meant(last: LastBuild, sides: Sides) -> _Meant | Merge:
    """Return our version if builds wrote both, else the merge of their edits."""
    return _Meant(sides.ours, sides.stamps[1]) if _are_generated(last, sides[1:3]) else _merge_edits(last, sides)


def _merge_edits(last: LastBuild, sides: Sides) -> _Meant | Merge:
    """Merge two versions by their elements; if that fails, merge their edits into our generated text.

    The second way ignores differences between exports: these are no contradictions between people, and the build merges
    them next.
    """
    from urdfsync.merge.texts import merge, merge_branches  # imports the parser

    before, ours, theirs = sides.stamps
    merges: list[tuple[Merge, Stamp | None]] = []
    if sides.base is not None:  # the merge has the export of the side that exported
        has_exported = ours is None or before is None or ours.base != before.base
        merges.append((merge_branches(sides.base, sides.ours, sides.theirs), ours if has_exported else theirs))
    our_base, their_base = (last.base(stamp.base) if stamp else None for stamp in (ours, theirs))
    if our_base is not None and their_base is not None:
        moved = merge(their_base, sides.theirs, our_base, is_modelica=True).text
        merges += [(merge_branches(our_base, sides.ours, moved), ours)] if moved is not None else []
    if not merges:  # both branches added the file
        merges.append((merge_branches("", sides.ours, sides.theirs), ours))
    if before and ours and theirs and before.base not in (ours.base, theirs.base):
        merges.reverse()  # both exported: numbers of their export are no edits of ours
    best, stamp = min(merges, key=lambda one: len(one[0].contradictions))
    return best if best.text is None else _Meant(best.text, stamp)


def _are_generated(last: LastBuild, texts: Iterable[str]) -> bool:
    """Return whether builds wrote all of these texts."""
    return all(last.has_written(text_hash(text)) for text in texts)


def _is_chosen(inputs: Inputs, key: str, text: str, staged: Sides) -> bool:
    """Return whether the file has the user's choice, which has replaced another version, or the one with markers.

    The text equals one version, which does not show it. An earlier `--keep` looks the same.
    """
    last = inputs.last
    aside = last.aside.get(inputs.folder.path(key))
    if aside is None or aside.after != text_hash(text):
        return False
    former = plain((inputs.store.aside_text(last.name, aside.file) or b"").decode(errors="replace"))
    return split(former)[0] != text and (bool(markers.find_markers(former)) or split(former)[0] in staged[1:3])


def _read_staged(file: Path) -> Sides | None:
    """Return the versions in git's index; None if it lacks one side, or can't be read."""
    import pygit2

    try:
        if (repository := open_repository(file.parent)) is None:
            return None
        folder = Path(real(file.parent)).relative_to(named(os.path.realpath(repository.workdir)))
        path = (folder / file.name).as_posix()
        for entries in repository.index.conflicts or ():
            if path in (entry.path for entry in entries[1:] if entry):
                blobs = (repository[entry.id].read_raw() if entry else None for entry in entries)
                base, ours, theirs = (None if blob is None else plain(blob.decode(errors="replace")) for blob in blobs)
                # if both branches renamed a file, each of them has only one of the two paths
                sides = _sides(base, ours or theirs or "", theirs or ours or "")
                deleted = 1 if ours is None else 2 if theirs is None else 0
                sides = sides._replace(deleted=deleted, left=_read_left(repository, path))
                # if renames of both branches end here, git has merged two other files
                return None if any(map(markers.find_markers, sides[1:3])) else sides
    except (SourceError, pygit2.GitError, KeyError, OSError, ValueError):
        return None  # as without a repository: it is damaged or shallow
    return None


def _read_left(repository: pygit2.Repository, path: str) -> str | None:
    """Return the text that a merge, a rebase or a cherry-pick has left at a path, as git notes it since 2.34."""
    import pygit2

    try:
        tree = Path(repository.path, "AUTO_MERGE").read_text(encoding="ascii").strip()
        blob = repository[tree].peel(pygit2.Tree)[path].peel(pygit2.Blob)
        return plain(blob.data.decode(errors="surrogateescape"))
    except (FileNotFoundError, KeyError):
        return None


def _is_untouched(text: str, sides: Sides) -> bool:
    """Return whether a text with markers is git's merge of two versions, with the driver or by lines.

    After a merge by lines, each side of a conflict has one version, with the other version's changes to unchanged
    lines. This compares the changes, since git may compare lines in several ways.
    """
    from urdfsync.merge.texts import merge_branches

    base, ours, theirs = sides.base or "", sides.ours, sides.theirs
    readings = [split(side)[0] for side in markers.read_sides(text)]
    if not any(map(markers.find_markers, readings)):  # nested markers come only from the driver
        of_ours, of_theirs = _apart(base, ours, theirs)
        if _changes(ours, readings[0]) <= of_theirs and _changes(theirs, readings[1]) <= of_ours:
            return True
    first, middle, last = markers.signs(text)
    driven = merge_branches(base, ours, theirs, ((first, "mine"), (middle, "generated"), (last, "")))
    return driven.proposal == markers.without_labels(text)


def _changes(old: str, new: str) -> _Changes:
    from urdfsync.merge.lines import compare

    lines, new_lines = _lines(old), _lines(new)
    return Counter(
        _change(lines[change.start : change.stop], new_lines[change.new_start : change.new_stop])
        for change in compare(lines, new_lines)
    )


def _apart(*versions: str) -> tuple[_Changes, _Changes]:
    """Return the changes of our and of their version that do not touch changes of the other one."""
    from urdfsync.merge.lines import find_regions

    lines = [_lines(text) for text in versions]
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
