"""Lets the user's texts follow a rename that their bases do not show: by names that are missing now.

Such a text is a class of the user's own in the package, an edit of a file whose generated text stays the same, or an
edit that git has merged with the rename of another branch.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import TYPE_CHECKING

import msgspec

from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Reason
from urdfsync.engine.decide.conflicts import Conflict
from urdfsync.engine.decide.decision import Decision
from urdfsync.engine.decide.package_after import PackageAfter
from urdfsync.engine.decide.package_names import declared_names, new_name
from urdfsync.engine.generation import Generation
from urdfsync.engine.inspect.inputs import Inputs

if TYPE_CHECKING:
    from urdfsync.engine.decide.fit import Misfit


def follow(inputs: Inputs, generation: Generation, decision: Decision) -> Decision:
    """Let the user's files follow renames that their bases do not show; adds an action for each of his own classes.

    They follow as the user allows merges; else they conflict, and the new text is proposed.
    """
    package, renamed, texts = generation.package, decision.differences.former, dict(decision.texts)
    decision = decision.with_actions((*decision.actions, *_find_users_classes(inputs, decision)))
    after = PackageAfter(inputs, package, decision.actions, texts, conflicts_empty=True)
    users = {Reason.KEEP, Reason.MERGE, Reason.MOVE, Reason.UNKNOWN}
    keys = {
        action.path
        for action in after.actions
        if action.reason in users and action.path.endswith(".mo")
        if action.mine not in (None, *inputs.last.record.confirmed)
        if action.path in texts or not inputs.files.is_chosen(action.path)
    }
    if not renamed or not keys or not after.mentions(keys, renamed):
        return decision
    from urdfsync.merge import Merge  # imports the parser

    followers = _find_followers(after, keys, renamed)
    actions, conflicts = list[Action](), dict(decision.disputed)
    for action in after.actions:
        key = action.path
        if key in followers and (inputs.is_merging or action.reason in (Reason.MERGE, Reason.MOVE)):
            texts[key] = followers[key][1]
            action = msgspec.structs.replace(action, reason=Reason.MOVE if action.origin else Reason.MERGE)
        elif key in followers:
            mine, new, names = followers[key]
            generated = package.content(inputs.folder.path(key)).decode() if action.generated else mine
            conflicts[key] = Conflict(key, generated, mine, generated, Merge(new, new, ()), names=names)
            action = msgspec.structs.replace(action, reason=Reason.RENAMED)
        actions.append(action)
    return decision.with_actions(actions, texts=texts, disputed=conflicts)


def _find_users_classes(inputs: Inputs, decision: Decision) -> Iterator[Action]:
    """Yield an action for each of the user's own classes in the package, which changes nothing."""
    known, files = {key for action in decision.actions for key in (action.path, action.origin) if key}, inputs.files
    others = tuple(f"{files.key(one.folder)}/" for one in inputs.config.robots if one.name != inputs.robot.name)
    for key in sorted(files.classes(inputs.folder) - known):
        if not key.startswith(others) and key.removesuffix("/package.mo") + ".mo" not in known:
            state = files.state(key) if files.can_read(key) else None
            mine, stamp = (state.text_sha256, state.stamp) if state else (None, None)
            copy_of = decision.differences.paths.get(stamp.id, "") if stamp else ""
            yield Action(key, Reason.UNKNOWN, Role.MODEL, mine=mine, copy_of=copy_of)


def _find_followers(
    after: PackageAfter, keys: Collection[str], renamed: Mapping[str, str]
) -> dict[str, tuple[str, str, Mapping[str, str]]]:
    """Return the text, the text with new names, and these names, of those files of `keys` that can follow, by key.

    `renamed` has new identifiers by old identifiers. A name follows if it is missing, and if its new name exists at the
    same place. A text that declares the old name itself does not follow.
    """
    from urdfsync.engine.decide.fit import find_misfits  # imports the parser
    from urdfsync.merge.renames import rename

    names: dict[str, dict[str, list[Misfit]]] = {}
    for misfit in find_misfits(after):
        if misfit.key in keys and misfit.use and new_name(misfit.use.part, renamed, misfit.use.candidates):
            names.setdefault(misfit.key, {}).setdefault(misfit.use.part, []).append(misfit)
    found = dict[str, tuple[str, str, Mapping[str, str]]]()
    for key, misfits in names.items():
        text = after.merged.get(key) or after.inputs.files.text(key) or ""
        lines, own, news = text.splitlines(), declared_names([text]), dict[str, str]()
        for part, uses in misfits.items():
            candidates = {name for one in uses if one.use for name in one.use.candidates}
            if part not in own:
                news[part] = new_name(part, renamed, candidates)
        used = "\n".join(lines[one.finding.line - 1] for uses in misfits.values() for one in uses)
        found[key] = text, rename(used, text, news)[1], news
    texts = {key: new for key, (text, new, _) in found.items() if new != text}
    if not texts:
        return {}
    merged = {**after.merged, **texts}
    followed = PackageAfter(after.inputs, after.package, after.actions, merged, conflicts_empty=after.conflicts_empty)
    lost = {one.key for one in find_misfits(followed) if one.use and one.use.part in names.get(one.key, ())}
    return {key: found[key] for key in texts.keys() - lost}
