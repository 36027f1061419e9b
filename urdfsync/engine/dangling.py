"""Names that a package loses with a build, and where the user's texts use them."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Callable, Collection, Iterable, Mapping
from pathlib import Path
from typing import TypeAlias

from urdfsync.config import library_folder, shown
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import Target
from urdfsync.engine.actions import Action, Kind
from urdfsync.engine.generation import Generation
from urdfsync.engine.inputs import NO_MODEL
from urdfsync.modelica.files import StoredClasses
from urdfsync.modelica.lexer import lex
from urdfsync.modelica.names import LIBRARY
from urdfsync.modelica.parser import parse
from urdfsync.modelica.scopes import Element, Node, Scopes, Type
from urdfsync.modelica.syntax import declared
from urdfsync.modelica.unresolved import Unresolved, UnresolvedKind, unresolved
from urdfsync.state.record import RecordState

Name: TypeAlias = tuple[str, ...]

_EDITED = frozenset({Kind.KEEP, Kind.INCLUDED, Kind.MERGE, Kind.MOVE})
"""What happens to files that are as the user wants them."""
_STAYING = frozenset({Kind.NEEDED, Kind.ORPHAN})
"""What happens to files that stay although they are no longer generated."""
_CLASS_KINDS = frozenset({"block", "class", "connector", "function", "model", "package", "record", "type"})


class DanglingNames:
    """The names that a package loses with a build, and their uses."""

    def __init__(self, generation: Generation) -> None:
        self._generation, self._files = generation, generation.inputs.files
        self._package = generation.inputs.robot.target.package

    @functools.cached_property
    def lost(self) -> dict[str, str]:
        """The names that the package loses, with their new names."""
        generation, inputs, recorded = self._generation, self._generation.inputs, self._generation.inputs.recorded
        before = {path: generation.base(inputs.old_key(path), one) or "" for path, one in generation.rewritten.items()}
        if recorded is None or not before:
            return {}
        states = {inputs.old_path(key): record.state for key, record in recorded.files.items()}
        now = {
            path: generation.content(inputs.key(path)).decode()
            for path in generation.package.artifacts
            if path in generation.changed or states.get(path) in (None, RecordState.WAITING, RecordState.CONFLICT)
        }
        found = lost_names(before, now, self._renamed_identifiers(), self._is_inherited)
        if recorded.package != self._package:
            found[recorded.package.rpartition(".")[2]] = self._package
        return found

    def _renamed_identifiers(self) -> dict[str, str]:
        """Return old and new identifiers of elements since the last complete build."""
        inputs, changes = self._generation.inputs, self._generation.changes_since_complete
        complete, recorded, found = inputs.last_complete, inputs.recorded, {}
        if complete is None or recorded is None:
            return {}
        old = recorded.names
        if complete is not inputs.last:
            try:
                old = inputs.domain.names(complete.snapshot, Target(recorded.package, recorded.class_))
            except NO_MODEL:
                return {}
        new = inputs.domain.names(self._generation.now.snapshot, inputs.robot.target)
        for kind, identifiers in old.items():
            for name, identifier in identifiers.items():
                now = changes.renames.get((kind.removesuffix("s"), name), name) if changes else name
                found[identifier] = new.get(kind, {}).get(now, identifier)
        return {before: after for before, after in found.items() if before != after}

    @functools.cached_property
    def _generated(self) -> Scopes:
        """The package as it is generated, without edits."""
        return Scopes(self._planned({}, {}))

    def _is_inherited(self, path: Name) -> bool:
        """Whether a class has an element because it extends another one; `path` counts from the package."""
        node = self._generated.node((*self._package.split("."), *path[:-1]))
        return isinstance(node, Node) and isinstance(self._generated.part((Type(node),), path[-1]), Element)

    def first_use(self, key: str, text: str) -> tuple[str, int] | None:
        """Return the first lost name in a text for a file of the package, with its line; None if there is none."""
        if self.lost.keys().isdisjoint(code_words(text)):
            return None
        uses = self._uses(self._class_name(key), text, Scopes(self._planned({key: text}, {})), self.lost)
        return (uses[0].part, uses[0].line) if uses else None

    def find(self, actions: Iterable[Action], written: Mapping[str, str]) -> list[Diagnostic]:
        """Return warnings about texts of the user's that use names which the package loses with these actions.

        `written` are texts that files are about to get.
        """
        inputs, files, recorded = self._generation.inputs, self._files, self._generation.inputs.recorded
        if recorded is None:
            return []
        known = {action.path: action for action in actions}
        edited = {path for path, action in known.items() if action.kind in _EDITED and not action.held}
        own = files.classes(inputs.folder) - known.keys()
        mine = {key: written.get(key) or files.any_text(key) for key in sorted(edited | own)}
        around = files.users_files({inputs.folder, recorded.folder})
        target, options = Target(recorded.package, recorded.class_), inputs.robot.options
        gone = sorted(self._generation.rewritten.keys() - self._generation.package.artifacts.keys())
        left_out = {path: option for path in gone if (option := inputs.domain.option_for(path, target, options))}
        found = []
        for path, option in left_out.items():
            action = known.get(inputs.old_key(path))
            if action and action.kind is Kind.ORPHAN:
                found.append(_left_out("the file is no longer generated", files.path(action.path), 0, option))
        if left_out and (mine or around):
            names = {_class_of(path): option for path, option in left_out.items()}
            sources = self._planned(mine, around)
            scopes = Scopes(sources)
            for name, file, text in self._users_classes(mine, sources):
                uses = {use.part: use for use in reversed(find_uses(name, text, scopes, names, names))}
                for use in uses.values():
                    message = f"`{use.name}` is used here, and no longer generated"
                    found.append(_left_out(message, file, use.line, names[use.part]))
        if not self.lost or not (mine or around):
            return found
        staying = {path: files.any_text(path) for path, action in known.items() if action.kind in _STAYING}
        doubtful = self.lost.keys() - {_class_of(path) for path in staying}
        sources = self._planned({**mine, **staying}, around)
        scopes = Scopes(sources)
        unread = [((), file, around[file].decode(errors="replace")) for file in sources.unread]
        for name, file, text in (*self._users_classes(mine, sources), *unread):
            lines: dict[str, list[Unresolved]] = {}
            for use in self._uses(name, text, scopes, doubtful):
                lines.setdefault(use.part, []).append(use)
            for part, (first, *rest) in lines.items():
                message = f"`{first.name}` is used here, but the package has no `{part}` any more"
                new, others = self.lost[part], sorted({use.line for use in rest} - {first.line})
                hint = f"it is `{new}` now" if new else "adapt your text to what the package is now"
                hint += (
                    f"; also in line{'s' if len(others) > 1 else ''} {', '.join(map(str, others))}" if others else ""
                )
                place = shown(file), first.line
                found.append(Diagnostic(Severity.WARNING, "vanished-name", message, *place, hint=hint))
        return found

    def _users_classes(self, mine: Mapping[str, str], sources: StoredClasses) -> list[tuple[Name, Path, str]]:
        """Return the classes of the user's to look at: full name, file, and the text if it is one of the package."""
        own = [(self._class_name(key), self._files.path(key), text) for key, text in mine.items()]
        return own + [(name, Path(one.file), "") for name, one in sources.users.items()]

    def _uses(self, name: Name, text: str, scopes: Scopes, doubtful: Collection[str]) -> list[Unresolved]:
        """As `find_uses`, without what the generated text of the class says, too: that is in order."""
        uses = find_uses(name, text, scopes, self.lost, doubtful)
        generated = {self._class_name(self._generation.inputs.key(path)) for path in self._generation.package.artifacts}
        if not uses or name not in generated:
            return uses
        fine = {use.name for use in find_uses(name, "", self._generated, self.lost, doubtful)}
        return [use for use in uses if use.name not in fine]

    def _planned(self, texts: Mapping[str, str], others: Mapping[Path, bytes]) -> StoredClasses:
        """The classes as they will be after the build: `texts` of the package by their keys, `others` of the user's."""
        inputs, recorded, robot = (
            self._generation.inputs,
            self._generation.inputs.recorded,
            self._generation.inputs.robot,
        )
        paths = {inputs.key(path): path for path in self._generation.package.artifacts}
        files = recorded.files if recorded else {}
        old = {key for key, record in files.items() if record.state is not RecordState.ORPHAN}
        found = {path: self._generation.content(key) for key, path in paths.items()}
        own = {key: self._files.any_text(key) for key in self._files.classes(inputs.folder) - old - paths.keys()}
        for key, text in {**own, **texts}.items():
            found[inputs.path(key)] = text.encode(errors="replace")

        def find(name: str) -> Path | None:
            if name == LIBRARY != self._package.partition(".")[0]:
                return library_folder() / LIBRARY
            places = (robot.output / name, robot.output / f"{name}.mo")
            return next((path for path in places if path.is_file() or (path / "package.mo").is_file()), None)

        gone = recorded.package if recorded and recorded.package != self._package else ""
        return StoredClasses(self._package, robot.folder, found, others, find, gone)

    def _class_name(self, key: str) -> Name:
        *folders, file = self._generation.inputs.path(key).removesuffix(".mo").split("/")
        return (*self._package.split("."), *folders, *([] if file == "package" else [file]))


def _class_of(path: str) -> str:
    return path.rpartition("/")[2].removesuffix(".mo")


def _left_out(message: str, file: Path, line: int, option: str) -> Diagnostic:
    hint = f"`{option}` in the configuration keeps it up to date"
    return Diagnostic(Severity.WARNING, "left-out", message, shown(file), line, hint=hint)


def lost_names(
    before: Mapping[str, str], now: Mapping[str, str], renamed: Mapping[str, str], is_inherited: Callable[[Name], bool]
) -> dict[str, str]:
    """The names of classes and components that texts declared before and do not declare now, with their new names.

    Texts are given by the paths of their files below the package; those that are the same in both may be left out.
    `renamed` are old and new identifiers of elements: names that begin with the old one may begin with the new one now.
    A new name is empty if there is none. What `is_inherited`, by its path, is not lost.
    """
    old, new = _declared(before), _declared(now)
    gone = {path for path in old - new if not is_inherited(path)}
    names = {path[-1] for path in gone if not any(path[:count] in gone for count in range(1, len(path)))}
    known, found = {path[-1] for path in new}, {}
    for name in sorted(names):
        found[name] = ""
        for identifier, now_ in sorted(renamed.items(), key=lambda pair: -len(pair[0])):  # the longest one counts
            if name.lower().startswith(identifier.lower()):
                first, end = now_[:1].upper() if name[:1].isupper() else now_[:1].lower(), name[len(identifier) :]
                candidates = (f"{first}{now_[1:]}{end}", f"{now_}{end}")
                found[name] = next((candidate for candidate in candidates if candidate in known), "")
                break
    return found


def _declared(texts: Mapping[str, str]) -> set[Name]:
    """Return the full names, below the package, of all that texts declare."""
    found: set[Name] = set()
    for path, text in texts.items():
        folder = tuple(path.split("/")[:-1])
        around = folder[:-1] if path.endswith("/package.mo") else folder
        found.update(one.path for one in declared(parse(text).classes, around))
    return found


def find_uses(
    name: Name, text: str, scopes: Scopes, lost: Collection[str], doubtful: Collection[str]
) -> list[Unresolved]:
    """Return the places in a stored class that use lost names and mean nothing, in their order.

    `name` is the full name of the class, `text` that of its file. Where a class on the way can't be read, `doubtful`
    names count as meaning nothing; in a text that is no Modelica, lost ones wherever they stand.
    """
    node = scopes.node(name)
    if not isinstance(node, Node):
        tokens = (token for token in lex(text)[0] if token.text in lost)
        return [Unresolved(UnresolvedKind.ELEMENT, token.text, token.text, "", token.line) for token in tokens]
    legal = (UnresolvedKind.NESTED_REDECLARE, UnresolvedKind.DOTTED_MODIFIER)
    found = (one for one in unresolved(node, scopes, doubtful) if one.kind not in legal)
    return sorted((one for one in found if one.part in lost), key=lambda one: one.line)


def code_words(text: str) -> set[str]:
    """Return all names and keywords in a text, without those in strings and comments, and without the classes in it.

    An edited file whose element has another name may still declare its class by the old one. The text need not parse.
    """
    found = [token.text for token in lex(text)[0]]
    return set(found) - {name for kind, name in itertools.pairwise(found) if kind in _CLASS_KINDS}
