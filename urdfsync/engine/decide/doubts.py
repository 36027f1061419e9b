"""Finds edited files that may belong to other elements now.

Git may bring an edit that was made before an export exchanged names: by a branch, a stash or a patch. Its text stands
in the file of the old name, and looks right. If a build has seen the edit, the state knows the file that it belongs to.
If no build has, and the name has meant two parts, the user is asked.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence

from urdfsync.domain import ElementKey, Role, Snapshot
from urdfsync.domain.matching import Doubt
from urdfsync.engine.actions import Action, Reason
from urdfsync.engine.decide.differences import Differences
from urdfsync.engine.decide.package_names import elements_by_identifier, identifier_of
from urdfsync.engine.decide.parts import is_of_part, other_meanings, recorded_ids
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.commits import PastCommit
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.inspect.last_build import lines_of
from urdfsync.engine.package.generate import Package
from urdfsync.modelica.files import code_of, text_of
from urdfsync.modelica.stamp import Stamp
from urdfsync.project.state.record import edit_key

EDITED = (Reason.KEEP, Reason.CONFLICT)
"""Reasons of files that the user edited and that stay where they are."""


def find_doubts(
    inputs: Inputs,
    generation: Generation,
    differences: Differences,
    actions: Sequence[Action],
) -> dict[str, Doubt]:
    """Return the doubts whether edited files belong to the same elements as before, by key."""
    edited = [one for one in actions if one.reason in EDITED and one.role is not Role.IMPORT]
    edited = [one for one in edited if not (inputs.files.is_chosen(one.path) or one.path in inputs.apart)]
    record = inputs.last.record
    unconfirmed = [one for one in edited if one.mine not in record.confirmed]
    # the user's decision about an export holds until the next export
    is_told = inputs.last.seen == generation.now.snapshot
    doubts = _of_other_parts(inputs, generation, differences, edited)
    for action in unconfirmed if is_told else edited:
        doubts[action.path] = _doubt(inputs, generation, differences, action) or doubts.get(action.path)
    open_doubts = _open_doubts(inputs, generation, unconfirmed)
    doubts |= _of_names(inputs, generation, differences, unconfirmed) | open_doubts
    unknown = [one for one in unconfirmed if one.path not in open_doubts and one.mine not in (None, *inputs.last.edits)]
    others = other_meanings(inputs, generation, differences.parts) if unknown else {}
    commits = [(one, one.texts(action.path for action in unknown)) for one in inputs.commits] if unknown else []
    for action in unknown if others or commits or inputs.last.notes.lines else ():
        doubts[action.path] = doubts.get(action.path) or _of_unknown(
            inputs, generation, differences, action, others, commits
        )
    reopened = inputs.settled.doubts
    doubts |= {one.path: reopened[one.path] for one in actions if one.path in reopened and one.reason in EDITED}
    return {path: doubt for path, doubt in doubts.items() if doubt}


def _of_other_parts(
    inputs: Inputs, generation: Generation, differences: Differences, actions: Iterable[Action]
) -> dict[str, Doubt | None]:
    """Return a doubt for each edit that builds have seen in the file of another part, or whose stamp says so, by key.

    Such an edit moves there, unless that file is edited, too: as git leaves two edits of one part.
    """
    doubts = dict[str, Doubt | None]()
    for action in actions:
        own, stamp = differences.ids.get(inputs.folder.path(action.path)), inputs.files.stamp(action.path)
        is_foreign = own and stamp and stamp.id in differences.paths and not is_of_part(stamp, own)
        other = inputs.last.edits.get(action.mine or "", stamp.id if stamp and is_foreign else None)
        if action.mine in inputs.last.record.confirmed and not is_foreign:
            continue  # an answer stamps the file
        if own and other and own != other and _element(action):
            doubts[action.path] = _moved(generation.package, action.owner, differences.paths.get(other))
    return doubts


def _of_unknown(
    inputs: Inputs,
    generation: Generation,
    differences: Differences,
    action: Action,
    others: Mapping[ElementKey, Doubt],
    commits: Sequence[tuple[PastCommit, Mapping[str, tuple[str, Stamp | None]]]],
) -> Doubt | None:
    """Return the doubt about an edit that no build has seen, from `others` (by element), commits, or seen lines."""
    package, element, lines = generation.package, _element(action), added_lines(inputs, generation.package, action)
    shared = [(commit, lines & lines_of(texts.get(action.path, ("", None))[0])) for commit, texts in commits]
    meanings = (_meanings_in(inputs, package, differences, commit, action, both) for commit, both in shared if both)
    for found in (others, *meanings):
        named = found.get(element) if element else _named(inputs, lines, found, generation.now.snapshot)
        if named:
            return named
    renamed = (one for one, texts in commits if action.path not in texts and element)
    mixed = (_mixed_by_git(inputs, package, differences, one, action, lines) for one in renamed)
    return next(filter(None, mixed), None) or _seen_elsewhere(inputs, package, differences, action, lines)


def _meanings_in(
    inputs: Inputs, package: Package, differences: Differences, commit: PastCommit, action: Action, shared: Counter[str]
) -> dict[ElementKey, Doubt]:
    """Return a doubt for each element of which a commit with some lines of this edit (`shared`) has another part.

    An edit that is in the file of its part already is no doubt.
    """
    doubts, key_of = dict[ElementKey, Doubt](), inputs.folder.key
    owners = {key_of(path): owner for path, owner in package.owners.items() if owner == action.owner or " " in owner}
    keys = [key for key, owner in owners.items() if owner == action.owner or not _element(action)]
    for key, (_, stamp) in commit.texts(keys).items():
        kind, _, name = owners[key].partition(" ")
        if not name or stamp is None or is_of_part(stamp, differences.ids[inputs.folder.path(key)]):
            continue
        target = differences.paths.get(stamp.id)
        if _element(action) and target and not shared - lines_of(inputs.files.any_text(key_of(target))):
            continue
        doubts[kind, name] = _moved(package, owners[key], target)
    return doubts


def _moved(package: Package, owner: str, path: str | None) -> Doubt:
    """Return the doubt about an edit in an owner's file that belongs to the part at a path; None if that is gone."""
    return Doubt(owner, "", (), package.owners[path].partition(" ")[2] if path else "", is_certain=True)


def _mixed_by_git(
    inputs: Inputs, package: Package, differences: Differences, commit: PastCommit, action: Action, lines: Counter[str]
) -> Doubt | None:
    """Return a doubt about an edit that a commit has in the file of another part.

    If a file is gone and a similar one is new, git takes this for a rename, and brings edits of the one into the other.
    """
    own = differences.ids[inputs.folder.path(action.path)]
    for text, stamp in commit.texts(commit.beside(action.path)).values() if lines else ():
        if stamp and is_of_part(stamp, own):
            continue
        target, brought = differences.paths.get(stamp.id) if stamp else None, lines & lines_of(text)
        if target:  # what stands in its file is there, too
            brought -= lines_of(package.content(target).decode())
            brought -= lines_of(inputs.files.any_text(inputs.folder.key(target)))
        elif brought != lines:
            continue
        if brought:
            return _moved(package, action.owner, target)
    return None


def _seen_elsewhere(
    inputs: Inputs, package: Package, differences: Differences, action: Action, lines: Counter[str]
) -> Doubt | None:
    """Return a doubt about an edit with a line that builds have seen in another part's file, which has it no more."""
    own, paths = differences.ids.get(inputs.folder.path(action.path)), differences.paths
    for line in lines if own and _element(action) else ():
        seen = inputs.last.ids_of_lines([line])
        for target in sorted(paths[one] for one in seen & paths.keys() if own not in seen):
            if line not in lines_of(inputs.files.any_text(inputs.folder.key(target))):
                return _moved(package, action.owner, target)
    return None


def _open_doubts(inputs: Inputs, generation: Generation, actions: Iterable[Action]) -> dict[str, Doubt]:
    """Return the doubts of recorded questions about these edits, by key, unless an export was undone."""
    last, now = inputs.last, generation.now.snapshot
    is_undone = last.seen != now and last.version is not None and last.version.snapshot == now
    asked = {} if is_undone or last.record.open is None else last.record.open.asked
    keys = {action.path: edit_key(action.path, action.mine) for action in actions}
    return {path: asked[key] for path, key in keys.items() if key in asked}


def _of_names(
    inputs: Inputs, generation: Generation, differences: Differences, actions: Sequence[Action]
) -> dict[str, Doubt]:
    """Return a doubt for each edit that uses a name that has meant two parts, if it is unknown when it was written.

    After a question the user may have corrected some names, and left others. A text with the names of an export that is
    not recorded comes from a killed build, or from another commit.
    """
    last, now = inputs.last, generation.now.snapshot
    asked = set(last.record.open.asked) if last.record.open and last.seen == now else set[str]()
    is_corrected = not asked <= {edit_key(one.path, one.mine) for one in actions}
    bases = [*(record.files for record in last.records), last.record.open.files if last.record.open else {}]
    common = [one for one in actions if not _element(one)]
    if not is_corrected and not last.is_united:
        known = {one.path: {one.generated, *(files.get(one.path) for files in bases)} for one in common}
        common = [one for one in common if one.base not in known[one.path]]
    if not common:
        return {}
    present = inputs.domain.features(now)
    if last.is_united:
        meant = [ids for _, _, ids in recorded_ids(last)]
        doubts = {key: Doubt(" ".join(key)) for key in present if len({ids[key] for ids in meant if key in ids}) > 1}
    else:
        renamed = {key: new for key, new in differences.renames.items() if key in present}
        doubts = {key: Doubt(" ".join(key), moved_to=new, is_certain=True) for key, new in renamed.items()}
    common = common if doubts else []  # the rest reads and renders texts
    named = {one.path: _named(inputs, added_lines(inputs, generation.package, one), doubts, now) for one in common}
    return {path: doubt for path, doubt in named.items() if doubt}


def _doubt(inputs: Inputs, generation: Generation, differences: Differences, action: Action) -> Doubt | None:
    """Return the doubt whether an edit belongs to its file's element, judged by the last build; None without one."""
    found, last = differences.matching.doubts, inputs.last
    if not (element := _element(action)):
        lines = added_lines(inputs, generation.package, action) if found else ()
        return _named(inputs, lines, found, generation.now.snapshot)
    if element in found:
        return found[element]
    is_seen = last.edits.get(action.mine or "", "") == differences.ids.get(inputs.folder.path(action.path))
    if (moved_to := differences.renames.get(element)) and not is_seen:  # the file can't move to the new name
        return Doubt(" ".join(element), "", (), moved_to, is_certain=True)
    # if only numbers changed, no element is new, and most builds need no features
    is_new_element = last.version is not None and differences.is_structural and element not in last.elements
    # other files with this name were written by an incomplete build
    is_orphan = is_new_element and any(action.path in record.files for record in last.records)
    if is_orphan and not (last.is_united or _is_back(inputs, generation, action)):
        return Doubt(" ".join(element), is_certain=True)  # the user edited the file for an element that is gone
    return None


def _is_back(inputs: Inputs, generation: Generation, action: Action) -> bool:
    """Whether earlier builds have written all texts of a file's element, with the same numbers."""
    package = generation.package
    own = (path for path, owner in package.owners.items() if owner == action.owner)
    return all(inputs.last.has_written(package.hash(path)) for path in own)


def added_lines(inputs: Inputs, package: Package, action: Action) -> Counter[str]:
    """Return the lines that the user added to a generated text, without their indents."""
    base = inputs.last.base(inputs.last.base_of(action.path, action.role)) or ""
    generated = package.content(inputs.folder.path(action.path)).decode()
    return lines_of(inputs.files.text(action.path) or "") - (lines_of(generated) | lines_of(base))


def _element(action: Action) -> ElementKey | None:
    """Return the element that a file belongs to; None for a common file."""
    kind, _, name = action.owner.partition(" ")
    return (kind, name) if name else None


def _named(
    inputs: Inputs,
    lines: Iterable[str],
    doubts: Mapping[ElementKey, Doubt],
    snapshot: Snapshot,
) -> Doubt | None:
    """Return the doubt about the first doubtful element in these lines of a common file; None without one."""
    if not doubts:
        return None
    elements = elements_by_identifier(inputs.domain, snapshot, inputs.last.target)
    code = text_of(code_of("\n".join(lines).encode()))
    words = dict.fromkeys(re.findall(r"\w+", code))
    found = filter(None, (elements.get(identifier_of(word, elements)) for word in words))
    return next((doubts[key] for key in found if key in doubts), None)
