"""Decides on one robot's package: looks at its files, applies the rules, and resolves conflicts."""

from __future__ import annotations

import functools
import itertools
import re
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import msgspec

from urdfsync.changes import Changes
from urdfsync.diagnostics import Diagnostic, OutputError, Severity
from urdfsync.domain import ChangeClass, Role
from urdfsync.engine import united
from urdfsync.engine.actions import DISPUTED, ORPHANS, Action, Actions, Choice, Reason
from urdfsync.engine.conflicts import PREFERENCES, Conflict, find_conflict, only_names_changed, resolve
from urdfsync.engine.differences import GONE, Differences, compare_with_last
from urdfsync.engine.edit_origins import find_doubts
from urdfsync.engine.generate import Package
from urdfsync.engine.generation import Generation
from urdfsync.engine.inputs import Inputs
from urdfsync.engine.package_after import PackageAfter, keep_needed
from urdfsync.engine.package_files import PackageFiles
from urdfsync.engine.package_names import known_names, names_of, renamed_names
from urdfsync.engine.parents import SharedFile, merge_order
from urdfsync.engine.renames import describe_doubt
from urdfsync.engine.renumbered import NOT_RENUMBERED, Renumbered, find_renumbered
from urdfsync.engine.rules import File, decide, put_off
from urdfsync.files import shown
from urdfsync.matching import Doubt
from urdfsync.modelica.literals import numbers_only
from urdfsync.modelica.markers import find_markers, join_sides
from urdfsync.modelica.names import is_identifier
from urdfsync.state.record import role_of

if TYPE_CHECKING:
    from urdfsync.engine.fit import Misfit


class Decision(msgspec.Struct, frozen=True, dict=True):
    """All actions of one robot, and the findings about them."""

    differences: Differences
    """The differences from the last complete build; the actions follow from these."""
    actions: Actions
    texts: Mapping[str, str]
    """New texts of every `package.order` and of merged files, by key."""
    doubts: Mapping[str, Doubt] = {}
    """Why edited files may belong to other parts, by key."""
    disputed: Mapping[str, Conflict] = {}
    """Texts of files that both sides changed, and of edited files that move, by key."""
    shared: tuple[SharedFile, ...] = ()
    """Changes of the `package.mo` and `package.order` files around the package."""
    misfits: tuple[Misfit, ...] = ()
    """Unknown names and syntax errors in the user's files."""
    names: Mapping[str, str] = {}
    """New names by old names, from before the choices; empty if no edit and no text in `aside` needs them."""
    outdated: frozenset[str] = frozenset()
    """Hashes of confirmed texts that use numbers of parts from before this export."""

    @property
    def conflicts(self) -> tuple[Conflict, ...]:
        """The texts of the files in conflict."""
        keys = [action.path for action in self.actions if action.is_conflict]
        return tuple(self.disputed[key] for key in keys if key in self.disputed)

    @functools.cached_property  # there are thousands of actions
    def is_complete(self) -> bool:
        """Whether nothing conflicts and nothing waits."""
        return not any(action.is_waiting or action.is_conflict for action in self.actions)


class _Judged(NamedTuple):
    """What the hashes of the files tell, and which parts the user's edits mean."""

    actions: tuple[Action, ...]
    origins: frozenset[str]
    """The former keys of files whose elements have other names."""
    doubts: Mapping[str, Doubt]
    renumbered: Renumbered
    names: Mapping[str, str]
    """New names by old names; empty if no edit and no text in `aside` needs them."""


class _Verdicts(NamedTuple):
    """Actions on the generated files and on the user's own, with the texts that decide them."""

    actions: Sequence[Action]
    merged: Mapping[str, str] = {}
    """The texts that the actions write, by key."""
    conflicts: Mapping[str, Conflict] = {}
    """The texts of the files that both sides changed, by key."""


def decide_package(inputs: Inputs, generation: Generation) -> Decision:
    """Decide on every file of a robot. Raises OutputError for links and for merge markers."""
    files, package, differences = inputs.files, generation.package, compare_with_last(inputs, generation)
    judged = _judge(inputs, generation, differences)
    settled = _merge(inputs, generation, judged, differences)
    own = _find_own(inputs, settled.actions)
    followed = _follow(inputs, package, settled, own, differences.former)
    actions = [action for action in followed.actions if action.reason is not Reason.UNKNOWN]
    order_actions, orders, shared = _decide_orders(inputs, package, differences, actions)
    _refuse_markers(files, actions, (key for key, text in orders.items() if find_markers(text)))
    has_conflicts = any(action.is_conflict for action in actions)
    numbers: Collection[str] = ()
    # if names were exchanged, each build would move edits again
    if has_conflicts and not (differences.has_exchanges or judged.renumbered):
        after = PackageAfter(inputs, package, actions, followed.merged)
        numbers = _renumbered(after, differences.changes, followed.conflicts)
    known = {action.path for action in (*actions, *order_actions)}
    unknown = [action for action in own if action.path not in known]
    all_actions = Actions(put_off((*actions, *order_actions, *unknown), numbers, judged.origins, inputs.has_moved))
    waiting = {action.path for action in all_actions if action.is_waiting}
    texts = {**orders, **followed.merged}
    of_parts = [action for action in all_actions if action.is_conflict and judged.renumbered.components(action)]
    new_conflicts = followed.conflicts.keys() - settled.conflicts.keys()
    misfits = _find_misfits(PackageAfter(inputs, package, all_actions, texts))
    return Decision(
        differences,
        all_actions,
        texts,
        judged.doubts,
        followed.conflicts,
        shared=tuple(file for file in shared if files.key(file.path) not in waiting),
        misfits=tuple(one for one in misfits if one.key not in new_conflicts or one.use is None),
        names=inputs.settled.names or judged.names,
        outdated=frozenset(str(one.mine) for one in of_parts if not inputs.last.has_written(str(one.mine))),
    )


def _judge(inputs: Inputs, generation: Generation, differences: Differences) -> _Judged:
    """Decide on every file by hashes; ask about edits that may belong to other parts."""
    package, origins = generation.package, frozenset(differences.moves.values())
    decided = decide(_find_files(inputs, generation), differences.moves)
    edits = [one for one in decided if one.reason in DISPUTED | {Reason.KEEP} and one.role is not Role.IMPORT]
    renumbered = find_renumbered(inputs, generation, differences, edits) if edits else NOT_RENUMBERED
    doubts = {**renumbered.doubts(edits), **find_doubts(inputs, generation, differences, renumbered, decided)}
    actions = tuple(_adjust(inputs, package, action, doubts) for action in decided)
    names: Mapping[str, str] = {}
    needing = DISPUTED | {Reason.KEEP} if differences.other_elements else DISPUTED
    if inputs.last.aside or any(one.reason in needing and one.role is not Role.IMPORT for one in actions):
        names = renamed_names(inputs, generation, differences)
    if differences.other_elements or renumbered:
        actions = tuple(_with_other_names(inputs, package, actions, names, renumbered))
    return _Judged(actions, origins, doubts, renumbered, names)


def _merge(inputs: Inputs, generation: Generation, judged: _Judged, differences: Differences) -> _Verdicts:
    """Merge the files that both sides changed, as far as the user allows merges and these fit the package."""
    package, actions = generation.package, judged.actions
    disputed = [action for action in actions if action.reason in DISPUTED and action.role is not Role.IMPORT]
    conflicts = {one.path: _conflict(inputs, generation, one, judged) for one in disputed}
    conflicts = _without_misfits(PackageAfter(inputs, package, actions, {}), conflicts, judged.origins)
    names = {name: new for (_, name), new in differences.renames.items()} | dict(judged.names)
    renamed = {key for key, conflict in conflicts.items() if only_names_changed(conflict, names)}
    actions, merged = resolve(actions, conflicts, merging=inputs.is_merging, renamed=renamed)
    needed = keep_needed(PackageAfter(inputs, package, actions, merged), judged.origins)
    return _Verdicts(*united.write_meanings(inputs.files, needed, merged), conflicts)


def _find_unknown(inputs: Inputs, known: Collection[str]) -> Iterator[str]:
    """Yield the Modelica files in the package that are neither generated nor recorded."""
    others = tuple(f"{inputs.files.key(one.folder)}/" for one in inputs.config.robots if one.name != inputs.robot.name)
    for key in sorted(inputs.files.classes(inputs.folder) - set(known)):
        if not key.startswith(others) and key.removesuffix("/package.mo") + ".mo" not in known:
            yield key


def _find_own(inputs: Inputs, actions: Iterable[Action]) -> list[Action]:
    """Return an action for each of the user's own files in the package, which changes nothing."""
    known, files = {action.path for action in actions}, inputs.files
    return [
        Action(key, Reason.UNKNOWN, Role.MODEL, mine=files.hash(key, Role.MODEL) if files.can_read(key) else None)
        for key in _find_unknown(inputs, known)
    ]


def _follow(
    inputs: Inputs, package: Package, settled: _Verdicts, own: Sequence[Action], renamed: Mapping[str, str]
) -> _Verdicts:
    """Let the user's files follow renames that their bases do not show.

    They follow as the user allows merges; else they conflict, and the new text is proposed. `own` are his own files.
    """
    after = PackageAfter(inputs, package, (*settled.actions, *own), settled.merged, is_open=True)
    users = {Reason.KEEP, Reason.INCLUDED, Reason.MERGE, Reason.MOVE, Reason.UNKNOWN}
    keys = {
        action.path
        for action in after.actions
        if action.reason in users and action.path.endswith(".mo")
        if action.mine not in (None, *inputs.last.record.confirmed)
        if action.path in after.merged or not inputs.files.is_chosen(action.path)
    }
    if not renamed or not keys or not after.mentions(keys, renamed):
        return settled._replace(actions=after.actions)
    from urdfsync.engine.followers import find_followers  # imports the parser
    from urdfsync.merge import Merge

    texts = find_followers(after, keys, renamed)
    actions, merged, conflicts = list[Action](), dict(settled.merged), dict(settled.conflicts)
    for action in after.actions:
        key = action.path
        if key in texts and (inputs.is_merging or action.reason in (Reason.MERGE, Reason.MOVE)):
            merged[key] = texts[key][1]
            action = msgspec.structs.replace(action, reason=Reason.MOVE if action.origin else Reason.MERGE)
        elif key in texts:
            mine, new = texts[key]
            path = inputs.folder.path(key)
            generated = package.content(path).decode() if action.generated else mine
            conflicts[key] = Conflict(key, generated, mine, generated, Merge(new, new, ()))
            action = msgspec.structs.replace(action, reason=Reason.RENAMED)
        actions.append(action)
    return _Verdicts(actions, merged, conflicts)


def _find_files(inputs: Inputs, generation: Generation) -> dict[str, File]:
    """Return every recorded or generated file as it is before the build, by key."""
    last, files = inputs.last, dict[str, File]()

    def add(key: str, role: Role, owner: str, generated: str | None) -> None:
        on_disk = inputs.files.on_disk(key, role)
        record = last.file(key, role, on_disk, generated)
        files[key] = File(role, owner, record, on_disk, generated)

    for path, artifact in generation.package.artifacts.items():
        add(inputs.folder.key(path), artifact.role, artifact.owner, generation.package.hash(path))
    for name, entry in generation.imported.imports.items():
        add(inputs.folder.key(entry.target), Role.IMPORT, name, entry.target_hash)
    for key in last.files.keys() - files.keys():
        path = last.folder.path(key)
        # `last.package` takes 20 ms with 100 links: only files that are no longer generated need it
        old = last.package.artifacts.get(path) if last.package else None
        add(key, old.role if old else role_of(path), old.owner if old else "", None)
    for key, record in united.find_left_records(inputs, _find_unknown(inputs, files)).items():
        role = role_of(inputs.folder.path(key))
        if not last.is_chosen(key, on_disk := inputs.files.on_disk(key, role)):
            files[key] = File(role, "", record, on_disk, None)
    return files


def _adjust(inputs: Inputs, package: Package, action: Action, doubts: Mapping[str, Doubt]) -> Action:
    """Correct an action by contents and options: the rules see only hashes."""
    left = inputs.files.left_by_git
    if left.get(action.path) and action.reason in (Reason.KEEP, Reason.UNCHANGED, Reason.UPDATE):
        return msgspec.structs.replace(action, reason=Reason.MARKERS)
    if left.get(action.path, True) is None:
        action = msgspec.structs.replace(action, is_left_by_git=True)
    if action.path in doubts:
        return msgspec.structs.replace(action, reason=Reason.ASKED)
    if action.reason is Reason.DELETE and action.mine is not None and action.role is not Role.IMPORT:
        # a record alone proves nothing: its author, or git's union of two records, may name any file of the user's
        is_written = action.mine in package.paths_by_hash or inputs.last.has_written(action.mine)
        return action if is_written else msgspec.structs.replace(action, reason=Reason.ORPHAN)
    if action.reason is Reason.UNOWNED and inputs.options.adopts:
        return msgspec.structs.replace(action, reason=Reason.KEEP, base=action.generated)
    return action


def _with_other_names(
    inputs: Inputs, package: Package, actions: Iterable[Action], names: Mapping[str, str], renumbered: Renumbered
) -> Iterator[Action]:
    """Yield the actions. An edit that uses an outdated name is merged, even if the generated text did not change."""
    for action in actions:
        is_chosen = inputs.files.is_chosen(action.path)
        is_edit = action.reason is Reason.KEEP and action.role is not Role.IMPORT and not is_chosen
        if is_edit and action.base == action.generated:
            from urdfsync.modelica.lexer import words_in  # imports the parser

            text = inputs.files.text(action.path) or ""
            generated = package.content(inputs.folder.path(action.path)).decode()
            words, is_settled = words_in(generated), action.mine in inputs.last.record.confirmed
            mine = Counter(words_in(text))
            mine.subtract(words)
            is_outdated = not is_settled and any(count > 0 and word in names for word, count in mine.items())
            if not is_outdated and (numbers := renumbered.names(action, words)):
                is_outdated = find_conflict(action, [generated], text, generated, numbers).merged(None) != text
            if is_outdated:
                action = msgspec.structs.replace(action, reason=Reason.CONFLICT)
        yield action


def _conflict(inputs: Inputs, generation: Generation, action: Action, judged: _Judged) -> Conflict:
    """Return the texts of a file that both sides changed; if its class is a folder, *mine* is its `package.mo`."""
    doubt, names, renumbered = judged.doubts.get(action.path), judged.names, judged.renumbered
    key, files, last = action.origin or action.path, inputs.files, inputs.last
    path = inputs.folder.path(action.path)
    mine, generated = files.text(key), generation.package.content(path).decode()
    record = last.files.get(key)
    hashes = record.hashes if record and action.base in record.hashes else (action.base,)
    known = [generated if sha256 == action.generated else last.base(sha256) for sha256 in hashes]
    # if the text of one of several bases is lost, the user's changes are unknown: nothing is merged
    bases = [text for text in known if text is not None] if None not in known else []
    base, rejected, moved_to = bases[0] if bases else None, "", ""
    if mine is None:
        mine = files.text(f"{key.removesuffix('.mo')}/package.mo") or ""
        rejected = describe_doubt(doubt) if doubt else "you turned the class into a folder"
    elif doubt:
        is_own = action.owner == doubt.element
        rejected, moved_to = describe_doubt(doubt, is_used=not is_own), doubt.moved_to if is_own else ""
    elif branches := files.left_by_git.get(key):
        merge = msgspec.structs.replace(branches, contradictions=(united.describe(branches.contradictions, mine),))
        return Conflict(action.path, base, mine, generated, merge, origin=action.origin, is_of_branches=True)
    if rejected:
        texts = base, mine, generated, None
        return Conflict(action.path, *texts, origin=action.origin, rejected=rejected, moved_to=moved_to)
    from urdfsync.modelica.lexer import words_in  # imports the parser

    if not names and bases and last.record.former:
        names = _names_since_undo(inputs, generation, action, frozenset(words_in(bases[0])))
    numbers = renumbered.names(action, itertools.chain.from_iterable(map(words_in, bases)))
    conflict = find_conflict(action, bases, mine, generated, {**names, **numbers})
    proposal = conflict.merge.proposal if conflict.merge else ""
    for name, new in numbers.items():
        if GONE in new and new in proposal:  # no answer may write this name
            rejected = f"`{name}` is another part now, and the export has no part like the one that you edited"
            without = conflict.merge and conflict.merge.rejected
            return msgspec.structs.replace(conflict, merge=without, rejected=rejected)
    return msgspec.structs.replace(conflict, renumbered=renumbered.describe(action, numbers)) if numbers else conflict


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


def _without_misfits(
    after: PackageAfter, conflicts: Mapping[str, Conflict], origins: Collection[str]
) -> dict[str, Conflict]:
    """Return the conflicts; leave out merges that would use unknown names.

    First this tries clean merges, then merges with contradictions decided for each side. `after` has no merges yet.
    """
    sound, before, actions = dict(conflicts), None, after.actions
    files_after = functools.partial(PackageAfter, after.inputs, after.package)
    for side in (None, *PREFERENCES):
        tried = {
            key: text
            for key, one in sound.items()
            # a merge of branches gets its new names only when it moves
            if not (one.is_of_branches and one.origin)
            if (text := one.merged(side)) is not None and (side is None or one.merged(None) is None)
        }
        if not tried:
            continue
        planned, merged = resolve(actions, sound, merging=True, choice=side)
        planned = keep_needed(files_after(planned, merged), origins)
        misfits = _find_misfits(files_after(planned, merged, is_open=True), merged.keys())
        if misfits and before is None:
            # names in a folder without its `package.mo` are not looked up: the faults there would seem to be new
            restored = {one.path for one in actions if one.reason is Reason.RESTORE and one.base == one.generated}
            waiting = [msgspec.structs.replace(one, is_waiting=one.path not in restored) for one in actions]
            paths = {one.origin or one.path for one in conflicts.values()}
            before = {(one.key, one.fault) for one in _find_misfits(files_after(waiting, {}), paths)}
        for key in {one.key for one in misfits} & tried.keys():
            conflict = sound[key]
            own = (one for one in misfits if one.key == key)
            new = next((one.finding for one in own if (conflict.origin or key, one.fault) not in (before or ())), None)
            if new is None or tried[key] == conflict.mine:
                continue
            reason = f"in the merge, {new.message} (line {new.line})"
            merge = conflict.merge and conflict.merge.rejected
            changed = {"refused": {**conflict.refused, side: reason}} if side else {"merge": merge, "rejected": reason}
            sound[key] = msgspec.structs.replace(conflict, **changed)
    return sound


def _find_misfits(after: PackageAfter, only: Collection[str] | None = None) -> Sequence[Misfit]:
    """Find misfits in the user's files after all actions that do not wait; `only` limits the search to these keys."""
    if only is None and after.inputs.has_moved and any(action.is_waiting for action in after.actions):
        return ()  # the package does not move yet
    if not (after.users or (only is None and after.extended_orders)):
        return ()
    from urdfsync.engine.fit import find_misfits  # this imports the parser: 15 of 220 ms of a build

    return find_misfits(after, only)


def _renumbered(after: PackageAfter, changes: Changes | None, conflicts: Mapping[str, Conflict]) -> frozenset[str]:
    """Return the records in which only numbers change, including records in conflict."""
    inputs, keys, by_element = after.inputs, set(), changes.by_element() if changes else {}
    for action in after.actions:
        if action.role is not Role.RECORD or action.origin is not None:
            continue
        if action.reason in (Reason.UPDATE, Reason.MERGE):
            text = after[inputs.folder.path(action.path)].decode(errors="surrogateescape")
            if numbers_only(inputs.files.text(action.path) or "", text):
                keys.add(action.path)
        elif action.reason is Reason.CONFLICT and (base := conflicts[action.path].base) is not None:
            # the record of a whole robot owns no change: a number in its tables may be structural
            own = by_element.get(action.owner, ())
            is_parameter = own and all(change.change_class.rank <= ChangeClass.PARAMETER.rank for change in own)
            if is_parameter and numbers_only(base, conflicts[action.path].generated):
                keys.add(action.path)
    return frozenset(keys)


def _refuse_markers(files: PackageFiles, actions: Iterable[Action], orders: Iterable[str]) -> None:
    """Refuse files in which version control left its merge markers. Raises OutputError."""
    errors = []
    texts = (action for action in actions if action.role is not Role.IMPORT and action.reason is not Reason.UPDATE)
    edited = [action for action in texts if action.mine not in (None, action.base, action.generated)]
    # contradictions of branches are conflicts, not errors; with `--undo`, the user chose a text with markers
    told = {action.origin or action.path for action in edited if action.is_conflict} & files.left_by_git.keys()
    told |= files.overlay.keys()
    for key in dict.fromkeys((*(action.origin or action.path for action in edited), *orders)):
        found = find_markers(files.text(key) or "")
        if found and key not in told:
            message, hint = "unresolved merge markers", "settle them in the file, then build again"
            file = shown(files.path(key))
            errors.append(Diagnostic(Severity.ERROR, "merge-markers", message, file, found[0][1], hint=hint))
    if errors:
        raise OutputError(*errors)


def _recorded_orders(inputs: Inputs, package: Package | None) -> dict[str, Collection[str]]:
    """Return the lines of each `package.order` that the last build wrote, by key, in their order.

    `package` is the package of the last build. Without it, the lines follow from the recorded files, in another order.
    """
    last, orders = inputs.last, dict[str, dict[str, None]]()
    if last.record.files and package:
        orders = {last.folder.key(path): dict.fromkeys(names) for path, names in package.orders.items()}
    for key in last.files:
        folder, _, name = key.removesuffix("/package.mo").removesuffix(".mo").rpartition("/")
        if f"{folder}/".startswith(last.folder.key("")) and key.endswith(".mo"):
            orders.setdefault(f"{folder}/package.order", {})[name] = None
    if "." in last.target.package and last.record.files:
        above, _, name = last.folder.rpartition("/")
        orders[f"{above}/package.order" if above else "package.order"] = {name: None}
    return {key: names for key, names in orders.items() if inputs.files.is_inside(key)}


def _removable_lines(
    inputs: Inputs, order: str, text: str, recorded: Collection[str], actions: Iterable[Action]
) -> list[str]:
    """Return the lines of a `package.order` to remove: deleted classes, and recorded lines without a class.

    A recorded line may name a user's class, so this looks for the class on disk and in `package.mo`. If git has united
    two states, this looks for each line's class: the other branch may have renamed it.
    """
    folder = order.removesuffix("package.order")
    paths = (action.path.removesuffix("/package.mo").removesuffix(".mo") for action in actions if action.is_deletion)
    deleted = [path.removeprefix(folder) for path in paths if path.rpartition("/")[0] == folder.rstrip("/")]
    listed = {line.strip() for line in text.splitlines()}
    is_united = inputs.last.record.is_united and order.startswith(inputs.folder.key(""))
    candidates = listed if is_united else listed.intersection(recorded)
    names = filter(is_identifier, candidates.difference(deleted))
    missing = [name for name in names if not inputs.files.has_class(folder, name)]
    mentioned = set(re.findall(r"\w+", inputs.files.text(f"{folder}package.mo") or "")) if missing else set()
    return [*deleted, *(name for name in missing if name not in mentioned)]


def _classes_beside(order: str, keys: Iterable[str]) -> list[str]:
    """Return the names of the classes that these files store in the folder of a `package.order`."""
    folder = order.removesuffix("package.order")
    paths = (key.removeprefix(folder).removesuffix("/package.mo") for key in keys if key.startswith(folder))
    return sorted(filter(is_identifier, (path.removesuffix(".mo") for path in paths)))


def _decide_orders(
    inputs: Inputs, package: Package, differences: Differences, actions: Sequence[Action]
) -> tuple[list[Action], dict[str, str], list[SharedFile]]:
    """Decide on `package.order` files, and on the packages around the robot's.

    Returns the actions, the new texts of orders, and the files around this package and around the last build's package.
    """
    files, robot = inputs.files, inputs.robot
    is_same = not (differences.is_structural or inputs.has_moved)
    recorded = _recorded_orders(inputs, package if is_same else inputs.last.package)
    desired = {inputs.folder.key(path): names for path, names in package.orders.items()}
    if robot.folder.parent != robot.output and inputs.parents.listed:
        desired[files.key(robot.folder.parent / "package.order")] = (robot.folder.name,)
    inside = (inputs.folder.key(""), inputs.last.folder.key(""))
    decided, texts, shared = list[Action](), dict[str, str](), list[SharedFile]()
    for key in sorted(recorded.keys() | desired.keys()):
        old, written, generated = files.text(key), recorded.get(key, ()), desired.get(key, ())
        text = None if old is None else _order_text(inputs, key, old)
        names = _wanted_lines(inputs, key, generated, written, actions)
        owned = () if text is None else _owned_lines(inputs, key, text, generated, written, actions)
        texts[key] = merge_order(text, names, owned)
        reason = _order_reason(old, texts[key], is_recorded=key in recorded)
        decided.append(Action(key, reason, Role.ORDER, "package"))
        if not key.startswith(inside):
            shared.append(SharedFile(files.path(key), None, names, owned, joins=text != old))
    for file in inputs.parents.shared:
        key = files.key(file.path)
        if file.content is not None:
            files.on_disk(key, Role.PACKAGE)  # raises OutputError for a link
            decided.append(Action(key, Reason.CREATE, Role.PACKAGE, "parent package"))
        elif (old := files.text(key)) != merge_order(old, file.names):
            reason = Reason.CREATE if old is None else Reason.UPDATE
            decided.append(Action(key, reason, Role.ORDER, "parent package"))
    return decided, texts, [*shared, *inputs.parents.shared]


def _order_reason(old: str | None, new: str, *, is_recorded: bool) -> Reason:
    """Decide on one `package.order` by its text on disk, None without a file, and its new text, empty for no file."""
    if old is None:
        return Reason.FORGET if not new else Reason.RESTORE if is_recorded else Reason.CREATE
    return Reason.UNCHANGED if new == old else Reason.UPDATE if new else Reason.DELETE


def _order_text(inputs: Inputs, key: str, old: str) -> str:
    """Return the lines on disk; where git has left both sides of a merge that may stand together, both."""
    is_united = inputs.last.record.is_united
    is_joined = find_markers(old) and united.can_join(inputs.files.path(key), old, is_united=is_united)
    return join_sides(old) if is_joined else old


def _wanted_lines(
    inputs: Inputs, key: str, generated: Sequence[str], written: Collection[str], actions: Iterable[Action]
) -> tuple[str, ...]:
    """Return the lines of a `package.order`: those of the generated package, and of classes that no line names."""
    names = dict.fromkeys(generated)
    if inputs.options.adopts and inputs.files.text(key) is None:  # tools hide the user's classes without a line
        names |= dict.fromkeys(_classes_beside(key, inputs.files.classes(key.removesuffix("package.order"))))
    if written:  # `--undo` brought an orphan back, or a class of the user's own
        orphans = {action.path for action in actions if action.reason in ORPHANS}
        undone = {path for path, one in inputs.settled.actions.items() if one.choice is Choice.UNDO}
        undone -= {action.path for action in actions if action.is_deletion}
        names |= dict.fromkeys(_classes_beside(key, {*orphans, *filter(inputs.files.read, undone)}))
    return tuple(names)


def _owned_lines(
    inputs: Inputs,
    key: str,
    text: str,
    generated: Sequence[str],
    written: Collection[str],
    actions: Iterable[Action],
) -> tuple[str, ...]:
    """Return the lines of a `package.order` on disk that a build may move or remove."""
    wanted = set(generated)
    # looking at the disk for all names would take 15 ms with 100 links
    unwanted = [name for name in written if name not in wanted]
    return *(name for name in written if name in wanted), *_removable_lines(inputs, key, text, unwanted, actions)
