"""Names that a package loses with a build, and where the user's texts use them."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

import msgspec

from urdfsync.config import library_folder, shown
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.engine.actions import Action, Kind
from urdfsync.engine.inputs import Inputs
from urdfsync.modelica.files import StoredClasses
from urdfsync.modelica.lexer import lex
from urdfsync.modelica.names import LIBRARY
from urdfsync.modelica.parser import parse
from urdfsync.modelica.scopes import Element, Node, Scopes, Type
from urdfsync.modelica.syntax import declared
from urdfsync.modelica.unresolved import Unresolved, UnresolvedKind, unresolved
from urdfsync.state.record import RecordState as State

Name: TypeAlias = tuple[str, ...]


_EDITED = frozenset({Kind.KEEP, Kind.INCLUDED, Kind.MERGE, Kind.MOVE})
"""What happens to files that are as the user wants them."""
_CLASS_KINDS = frozenset({"block", "class", "connector", "function", "model", "package", "record", "type"})
_KEPT = frozenset({Kind.NEEDED, Kind.ORPHAN})
"""What happens to files that stay although they are no longer generated."""


class UsersTexts(msgspec.Struct, frozen=True):
    """Texts of the user's that may use names of a package."""

    own: Mapping[str, str]
    """Edited files and own classes in the package, by their keys."""
    kept: Mapping[str, str]
    """Files of the package that stay although they are no longer generated; these are not looked at."""
    edited: frozenset[str]
    """Those of them that the user edited."""
    around: Mapping[Path, bytes]
    """Files below the output folder that have to do with the package."""

    def __bool__(self) -> bool:
        return bool(self.own or self.around)


class DanglingNames:
    """Finds uses of lost names, which are given with their new names."""

    def __init__(self, inputs: Inputs, paths: Sequence[str], content: Callable[[str], bytes]) -> None:
        """`paths` are those of the generated files below the package, `content` gives the text of each."""
        self._inputs, self._paths, self._content = inputs, paths, content

    @functools.cached_property
    def _generated(self) -> Scopes:
        """The package as it is generated, without edits."""
        return Scopes(self._planned({}, {}))

    def is_inherited(self, path: Name) -> bool:
        """Whether a class has an element because it extends another one; `path` counts from the package."""
        node = self._generated.node((*self._inputs.robot.target.package.split("."), *path[:-1]))
        return isinstance(node, Node) and isinstance(self._generated.part((Type(node),), path[-1]), Element)

    def users_texts(self, actions: Iterable[Action], written: Mapping[str, str]) -> UsersTexts:
        """Return the texts to look at after these actions; `written` are texts that files are about to get."""
        disk, folder, known = self._inputs.files, self._inputs.folder, {action.path: action for action in actions}
        kept = [path for path, action in known.items() if action.kind in _KEPT]
        edited = {path for path, action in known.items() if action.kind in _EDITED and not action.held}
        own = disk.classes(folder) - known.keys()
        before = self._inputs.recorded.folder if self._inputs.recorded else folder
        return UsersTexts(
            {key: written.get(key) or disk.any_text(key) for key in sorted(edited | own)},
            {key: disk.any_text(key) for key in kept},
            frozenset(key for key in kept if known[key].kind is Kind.ORPHAN),
            disk.users_files({folder, before}),
        )

    def first_use(self, key: str, text: str, lost: Mapping[str, str]) -> tuple[str, int] | None:
        """Return the first lost name in a text for a file of the package, with its line; None if there is none."""
        if lost.keys().isdisjoint(code_words(text)):
            return None
        scopes = Scopes(self._planned({key: text}, {}))
        uses = self._uses(self._class_name(key), text, scopes, lost, lost)
        return (uses[0].part, uses[0].line) if uses else None

    def warnings(self, texts: UsersTexts, lost: Mapping[str, str]) -> list[Diagnostic]:
        """One warning for each lost name in each file."""
        sources = self._planned({**texts.own, **texts.kept}, texts.around)
        scopes = Scopes(sources)
        doubtful = lost.keys() - {path.rpartition("/")[2].removesuffix(".mo") for path in texts.kept}
        unread = [((), path, texts.around[path].decode(errors="replace")) for path in sources.unread]
        found = []
        for name, file, text in (*self._asked(texts, sources), *unread):
            uses: dict[str, list[Unresolved]] = {}
            for use in self._uses(name, text, scopes, lost, doubtful):
                uses.setdefault(use.part, []).append(use)
            found += [_warning(file, one, lost[part]) for part, one in uses.items()]
        return found

    def left_out(self, texts: UsersTexts, options: Mapping[str, str]) -> list[Diagnostic]:
        """A warning for each text that uses a file which options leave out now, and for such a file that was edited.

        The options are given by the paths of the files.
        """
        names = {path.rpartition("/")[2].removesuffix(".mo"): path for path in options}
        sources = self._planned(texts.own, texts.around)
        scopes, found = Scopes(sources), []
        for file, option in options.items():
            if (key := self._inputs.old_key(file)) in texts.edited:
                place = shown(self._inputs.files.path(key))
                found.append(_left_out("the file is no longer generated", place, 0, option))
        for name, path, text in self._asked(texts, sources):
            for use in {use.part: use for use in reversed(find_uses(name, text, scopes, names, names))}.values():
                message = f"`{use.name}` is used here, and no longer generated"
                found.append(_left_out(message, shown(path), use.line, options[names[use.part]]))
        return found

    def _asked(self, texts: UsersTexts, sources: StoredClasses) -> list[tuple[Name, Path, str]]:
        """Return the classes of the user's to look at: full name, file, and the text if it is one of the package."""
        own = [(self._class_name(key), self._inputs.files.path(key), text) for key, text in texts.own.items()]
        return own + [(name, Path(one.file), "") for name, one in sources.users.items()]

    def _uses(
        self, name: Name, text: str, scopes: Scopes, lost: Collection[str], doubtful: Collection[str]
    ) -> list[Unresolved]:
        """As `find_uses`, without what the generated text of the class says, too: that is in order."""
        uses = find_uses(name, text, scopes, lost, doubtful)
        if not uses or name not in {self._class_name(self._inputs.key(path)) for path in self._paths}:
            return uses
        generated = {use.name for use in find_uses(name, "", self._generated, lost, doubtful)}
        return [use for use in uses if use.name not in generated]

    def _planned(self, texts: Mapping[str, str], others: Mapping[Path, bytes]) -> StoredClasses:
        """The classes as they will be after the build: `texts` of the package by their keys, `others` of the user's."""
        inputs, recorded, robot = self._inputs, self._inputs.recorded, self._inputs.robot
        files = recorded.files if recorded else {}
        generated = {inputs.key(path) for path in self._paths}
        old = {key for key, record in files.items() if record.state is not State.ORPHAN}
        own = {key: inputs.files.any_text(key) for key in inputs.files.classes(inputs.folder) - old - generated}
        found = {path: self._content(path) for path in self._paths}
        for key, text in {**own, **texts}.items():
            found[key.removeprefix(inputs.key(""))] = text.encode(errors="replace")

        def find(name: str) -> Path | None:
            if name == LIBRARY != robot.target.package.partition(".")[0]:
                return library_folder() / LIBRARY
            places = (robot.output / name, robot.output / f"{name}.mo")
            return next((path for path in places if path.is_file() or (path / "package.mo").is_file()), None)

        package = robot.target.package
        gone = recorded.package if recorded and recorded.package != package else ""
        return StoredClasses(package, robot.folder, found, others, find, gone)

    def _class_name(self, key: str) -> Name:
        *folders, file = key.removeprefix(self._inputs.key("")).removesuffix(".mo").split("/")
        package = self._inputs.robot.target.package.split(".")
        return (*package, *folders) if file == "package" else (*package, *folders, file)


def _left_out(message: str, file: str, line: int, option: str) -> Diagnostic:
    hint = f"`{option}` in the configuration keeps it up to date"
    return Diagnostic(Severity.WARNING, "left-out", message, file, line, hint=hint)


def _warning(file: Path, uses: Sequence[Unresolved], new: str) -> Diagnostic:
    first, lines = uses[0].line, sorted({use.line for use in uses} - {uses[0].line})
    message = f"`{uses[0].name}` is used here, but the package has no `{uses[0].part}` any more"
    hints = [f"it is `{new}` now" if new else "adapt your text to what the package is now"]
    if lines:
        hints.append(f"also in line{'s' if len(lines) > 1 else ''} {', '.join(map(str, lines))}")
    return Diagnostic(Severity.WARNING, "vanished-name", message, shown(file), first, hint="; ".join(hints))


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
    known = {path[-1] for path in new}
    return {name: _new_name(name, known, renamed) for name in sorted(names)}


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


def _declared(texts: Mapping[str, str]) -> set[Name]:
    """Return the full names, below the package, of all that texts declare."""
    found: set[Name] = set()
    for path, text in texts.items():
        folder = tuple(path.split("/")[:-1])
        around = folder[:-1] if path.endswith("/package.mo") else folder
        found.update(one.path for one in declared(parse(text).classes, around))
    return found


def _new_name(name: str, known: Collection[str], renamed: Mapping[str, str]) -> str:
    """Return the new name of what had a name, by the new identifier of its element; the longest old one counts."""
    for old, new in sorted(renamed.items(), key=lambda pair: -len(pair[0])):
        if name.lower().startswith(old.lower()):
            first = new[:1].upper() if name[:1].isupper() else new[:1].lower()
            candidates = (f"{first}{new[1:]}{name[len(old) :]}", f"{new}{name[len(old) :]}")
            return next((candidate for candidate in candidates if candidate in known), "")
    return ""
