"""Merges the files that both the user and the export changed."""

from __future__ import annotations

import functools
from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

import msgspec

from urdfsync.domain import ElementKey, Role
from urdfsync.engine.actions import DISPUTED, ORPHANS, Action, Choice, Reason
from urdfsync.engine.decide.conflicts import (
    PREFERENCES,
    Conflict,
    describe_doubt,
    find_conflict,
    only_names_changed,
    resolve,
)
from urdfsync.engine.decide.decision import Decision
from urdfsync.engine.decide.misfits import look_for_misfits
from urdfsync.engine.decide.package_after import PackageAfter, keep_needed
from urdfsync.engine.decide.package_names import class_of, elements_by_identifier, identifier_of, known_names, names_of
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.inspect.package_files import PackageFiles
from urdfsync.modelica import markers

if TYPE_CHECKING:
    from urdfsync.engine.decide.fit import Misfit

_IN_STEP = frozenset({Reason.UNCHANGED, Reason.KEEP})
"""Reasons for which a generated file stays."""
_SETTLED = frozenset({Reason.MERGE, Reason.FORGET}) | ORPHANS
"""Reasons for which a build writes the text that both branches meant."""


def merge_edits(inputs: Inputs, generation: Generation, decision: Decision) -> Decision:
    """Merge the files that both sides changed, as far as the user allows merges and these fit the package."""
    package, actions = generation.package, decision.actions
    disputed = [action for action in actions if action.reason in DISPUTED and action.role is not Role.IMPORT]
    conflicts = {one.path: _conflict(inputs, generation, one, decision) for one in disputed}
    trials = _Trials(inputs, generation, decision)
    conflicts = _refuse_unfit_merges(trials, conflicts)
    names = {name: new for (_, name), new in decision.differences.renames.items()} | dict(decision.names)
    renamed = {key for key, conflict in conflicts.items() if only_names_changed(conflict, names)}
    resolved, texts = resolve(actions, conflicts, merging=inputs.is_merging, renamed=renamed)
    needed = keep_needed(PackageAfter(inputs, package, resolved, texts), trials.present)
    written, texts = _write_git_merges(inputs.files, needed, texts)
    return decision.with_actions(written, texts=texts, disputed=conflicts)


def _conflict(inputs: Inputs, generation: Generation, action: Action, decision: Decision) -> Conflict:
    """Return the texts of a file that both sides changed; if its class is a folder, *mine* is its `package.mo`."""
    doubt, names = decision.doubts.get(action.path), decision.names
    key, files, last = action.origin or action.path, inputs.files, inputs.last
    path = inputs.folder.path(action.path)
    if action.reason is Reason.SECOND:
        base, rejected = last.base(action.base), f"{action.copy_of} has edits of the same part: --moved merges both"
        return Conflict(action.path, base, files.text(key) or "", base or "", None, rejected=rejected)
    mine, generated = files.text(key), generation.package.content(path).decode()
    base = generated if action.base == action.generated else last.base(action.base)
    rejected, moved_to = "", ""
    if mine is None:
        mine = files.text(f"{key.removesuffix('.mo')}/package.mo") or ""
        rejected = describe_doubt(doubt) if doubt else "you turned the class into a folder"
    elif branches := files.left_by_git.get(key):
        merge = msgspec.structs.replace(branches, contradictions=(_describe_branches(branches.contradictions, mine),))
        return Conflict(action.path, base, mine, generated, merge, origin=action.origin, is_of_branches=True)
    elif doubt:
        is_own = action.owner == doubt.element
        rejected, moved_to = describe_doubt(doubt, is_used=not is_own), doubt.moved_to if is_own else ""
    if rejected:
        texts = base, mine, generated, None
        return Conflict(action.path, *texts, origin=action.origin, rejected=rejected, moved_to=moved_to)
    if last.record.open and action.mine in last.record.open.named and last.seen == generation.now.snapshot:
        return find_conflict(action, base, mine, generated, {})
    from urdfsync.modelica.lexer import words_in  # imports the parser

    words = words_in(base or "")
    if not names and words and last.record.former:
        names = _names_since_undo(inputs, generation, action, frozenset(words))
    return find_conflict(action, base, mine, generated, names)


def _names_since_undo(
    inputs: Inputs, generation: Generation, action: Action, words: frozenset[str]
) -> Mapping[str, str]:
    """Return the new names of words in a base: `--undo` came after the build that brought these names."""
    last, path = inputs.last, inputs.folder.path(action.path)
    names = names_of(inputs, generation, last.record.former, words)
    if not names:
        return names  # the rest renders and parses texts
    before = last.package if last.record.generator == inputs.generator else None
    if before is None or path not in before.artifacts or before.hash(path) == action.base:
        now = known_names(generation.package)  # the base may have the new names already
        return {name: new for name, new in names.items() if name not in now}
    return names


def _refuse_unfit_merges(trials: _Trials, conflicts: Mapping[str, Conflict]) -> dict[str, Conflict]:
    """Return the conflicts; a merge that would use an unknown name is refused, with the reason.

    First all clean merges are tried together, then those whose contradictions are decided for one side.
    """
    unfit = trials.find_unfit(conflicts, None)
    judged = {
        key: msgspec.structs.replace(one, merge=one.merge and one.merge.rejected, rejected=unfit[key])
        if key in unfit
        else one
        for key, one in conflicts.items()
    }
    refused = {side: trials.find_unfit(judged, side) for side in PREFERENCES}
    for key in set().union(*refused.values()):
        reasons = {side: unfit[key] for side, unfit in refused.items() if key in unfit}
        judged[key] = msgspec.structs.replace(judged[key], refused=reasons)
    return judged


class _Trials(msgspec.Struct, frozen=True, dict=True):
    """Looks at packages as they would be with some merges; decides nothing."""

    inputs: Inputs
    generation: Generation
    decision: Decision
    """The decision before any merge."""

    @functools.cached_property
    def present(self) -> Collection[tuple[str, str]]:
        """The id and the class of each generated file."""
        return {(file_id, class_of(path)) for path, file_id in self.decision.differences.ids.items()}

    def find_unfit(self, conflicts: Mapping[str, Conflict], side: Choice | None) -> dict[str, str]:
        """Return why merges do not fit the package, by key; `side` decides contradictions, None tries clean merges."""
        tried = {
            key: text
            for key, one in conflicts.items()
            # a merge of branches gets its new names only when it moves
            if not (one.is_of_branches and one.origin)
            if (text := one.merged(side)) is not None and (side is None or one.merged(None) is None)
        }
        if not tried:
            return {}
        package = self.generation.package
        planned, merged = resolve(self.decision.actions, conflicts, merging=True, choice=side)
        planned = keep_needed(PackageAfter(self.inputs, package, planned, merged), self.present)
        after = PackageAfter(self.inputs, package, planned, merged, conflicts_empty=True)
        misfits = [one for one in look_for_misfits(after, merged.keys()) if one.key in tried]
        unfit = dict[str, str]()
        for misfit in misfits:
            key = misfit.key
            # names in a class whose file has another name are not looked up: a killed build may have moved the file
            known = {(conflicts[key].origin or key, misfit.fault), (key, "wrong-name")}
            is_new = known.isdisjoint(self._present_faults)
            if key not in unfit and is_new and tried[key] != conflicts[key].mine:
                unfit[key] = f"in the merge, {self._describe(misfit, tried[key])}"
        return unfit

    def _describe(self, misfit: Misfit, text: str) -> str:
        """Return a misfit in words, with its line in the merged text."""
        from urdfsync.merge.words import quoted  # loaded for the merge

        finding, removed = misfit.finding, self._removed
        element = removed.get(identifier_of(misfit.use.part, removed)) if misfit.use else None
        since = f", since {' '.join(element)} is removed" if element else ""
        line = text.split("\n")[finding.line - 1]
        return f"{finding.message}{since}{f'; line {finding.line}: `{quoted(line)}`' if finding.line else ''}"

    @functools.cached_property
    def _removed(self) -> Mapping[str, ElementKey]:
        """The elements that the source no longer has, by their former identifiers."""
        if (last := self.inputs.last.version) is None:
            return {}
        domain, renames = self.inputs.domain, self.decision.differences.renames
        former = elements_by_identifier(domain, last.snapshot, self.inputs.last.target)
        present = elements_by_identifier(domain, self.generation.now.snapshot, self.inputs.robot.target).values()
        return {name: element for name, element in former.items() if element not in {*present, *renames}}

    @functools.cached_property
    def _present_faults(self) -> set[tuple[str, str]]:
        """The faults that the texts in dispute have without any merge: key and fault."""
        # names in a folder without its `package.mo` are not looked up: the faults there would seem to be new
        actions = self.decision.actions
        restored = {one.path for one in actions if one.reason is Reason.RESTORE and one.base == one.generated}
        waiting = [msgspec.structs.replace(one, is_waiting=one.path not in restored) for one in actions]
        paths = {one.origin or one.path for one in actions if one.reason in DISPUTED}
        without = PackageAfter(self.inputs, self.generation.package, waiting, {})
        return {(one.key, one.fault) for one in look_for_misfits(without, paths)}


def _describe_branches(contradictions: Sequence[str], text: str) -> str:
    """Return a clause that names the elements about which two branches contradict each other in a file's text."""
    elements = [element for element in dict.fromkeys(contradictions) if element]
    both = f"both branches changed {' and '.join(elements) or 'the same lines'}"
    if not markers.find_markers(text):  # git's merge driver failed, or somebody took one side
        return f"git has not merged it, since {both}: `git add` it to keep this text"
    return f"git's markers are in it, since {both}"


def _write_git_merges(
    files: PackageFiles, actions: Iterable[Action], merged: Mapping[str, str]
) -> tuple[tuple[Action, ...], dict[str, str]]:
    """Return actions that write what both branches meant with files that git merged, and all merged texts, by key."""
    settled, texts = list[Action](), dict(merged)
    for action in actions:
        if action.is_left_by_git and action.reason in _IN_STEP:
            reason = Reason.UPDATE if action.reason is Reason.UNCHANGED else Reason.MERGE
            action = msgspec.structs.replace(action, reason=reason)
        if action.is_left_by_git and action.reason in _SETTLED and action.path not in merged:
            texts[action.path] = files.text(action.path) or ""
        settled.append(action)
    return tuple(settled), texts
