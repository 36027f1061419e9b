"""Names that a package loses with a build, and where the user's texts use them."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Collection, Iterable, Mapping
from pathlib import Path, PurePosixPath

from urdfsync.config import find_own_library
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import Target
from urdfsync.engine.actions import Actions, Kind
from urdfsync.engine.generation import Generation
from urdfsync.engine.inputs import NO_MODEL
from urdfsync.files import shown
from urdfsync.modelica.classes import Type
from urdfsync.modelica.files import ClassName, StoredClasses, class_path
from urdfsync.modelica.lexer import lex
from urdfsync.modelica.parser import parse
from urdfsync.modelica.scopes import Element, Scopes
from urdfsync.modelica.syntax import declared
from urdfsync.modelica.unresolved import Unresolved, UnresolvedKind, unresolved
from urdfsync.state.record import RecordState

_EDITED = frozenset({Kind.KEEP, Kind.INCLUDED, Kind.MERGE, Kind.MOVE})
"""What happens to files that are as the user wants them."""
_DEEPEST = 30
"""No recorded name has so many parts: it may be a stranger's, and each of its beginnings is looked for."""
_CLASS_KINDS = frozenset({"block", "class", "connector", "function", "model", "package", "record", "type"})


class DanglingNames:
    """The names that a package loses with a build which rewrites files of the last one, and their uses."""

    def __init__(self, generation: Generation) -> None:
        self._generation, self._inputs, self._files = generation, generation.inputs, generation.inputs.files
        self._last = self._inputs.recorded or self._inputs.heading("")
        self._package = self._inputs.robot.target.package

    @functools.cached_property
    def gone(self) -> set[ClassName]:
        """What the package had when nothing waited, or had in the last build, and has no more.

        The parts of a class that is gone are left out. Those that a renamed class loses have its new name.
        """
        before = self._before
        classes = {path[:count] for path in before for count in range(1, len(path))}
        renamed = {path: (*path[:-1], new) for path in classes if (new := self._new_name(path))}
        if self._last.class_ != self._inputs.robot.target.name:
            renamed[(self._last.class_,)] = (self._inputs.robot.target.name,)
        moved = {(*renamed[path[:-1]], path[-1]) for path in before if path[:-1] in renamed}
        gone = {path for path in before | moved if not self._exists(path)}
        return {path for path in gone if not any(path[:count] in gone for count in range(1, len(path)))}

    @functools.cached_property
    def _before(self) -> set[ClassName]:
        """What the texts declare that this build rewrites, and what is recorded as gone since nothing waited."""
        generation, inputs = self._generation, self._inputs
        texts = ((path, generation.base(inputs.old_key(path), one) or "") for path, one in generation.rewritten)
        recorded = (inputs.model.gone or ()) if inputs.model else ()
        return _declared(texts) | {tuple(path.split(".", _DEEPEST)) for path in recorded}

    @functools.cached_property
    def lost(self) -> dict[str, str]:
        """The names that the package loses, with their new names; empty if there is none."""
        found: dict[str, str] = {}
        for path in sorted(self.gone):
            found[path[-1]] = found.get(path[-1]) or self._new_name(path)
        if self._last.package != self._package:
            found[self._last.package.rpartition(".")[2]] = self._package
        return found

    def _exists(self, path: ClassName) -> bool:
        """Whether the package has a class or component of this name now, its own or inherited, without edits."""
        node = self._generated.node((*self._package.split("."), *path[:-1]))
        return node is not None and isinstance(self._generated.part((Type(node),), path[-1]), Element)

    def _new_name(self, path: ClassName) -> str:
        """Return the name at the same place that begins with the new identifier where this one begins with the old one.

        Empty if there is none.
        """
        name = path[-1]
        for old, new in self._renamed_identifiers.items():
            if name.lower().startswith(old.lower()):
                first = new[:1].upper() if name[:1].isupper() else new[:1].lower()
                candidates = (f"{first}{new[1:]}{name[len(old) :]}", f"{new}{name[len(old) :]}")
                return next((candidate for candidate in candidates if self._exists((*path[:-1], candidate))), "")
        return ""

    @functools.cached_property
    def _renamed_identifiers(self) -> dict[str, str]:
        """Return old and new identifiers of elements since the last complete build, the longest old ones first."""
        inputs, changes, old = self._inputs, self._generation.changes_since_complete, self._last.names
        complete, found = inputs.last_complete, {}
        if complete is None:
            return {}
        if complete is not inputs.last:
            try:
                old = inputs.domain.names(complete.snapshot, Target(self._last.package, self._last.class_))
            except NO_MODEL:
                return {}
        new = inputs.domain.names(self._generation.now.snapshot, inputs.robot.target)
        for kind, identifiers in old.items():
            for name, identifier in identifiers.items():
                now = changes.renames.get((kind.removesuffix("s"), name), name) if changes else name
                found[identifier] = new.get(kind, {}).get(now, identifier)
        longest_first = sorted(found.items(), key=lambda pair: -len(pair[0]))
        return {before: after for before, after in longest_first if before != after}

    @functools.cached_property
    def _generated(self) -> Scopes:
        """The package as it is generated, without edits."""
        return Scopes(self._with_texts({}, {}))

    @functools.cached_property
    def _contents(self) -> dict[str, bytes]:
        """What would be written, by the paths below the package."""
        return {path: self._generation.content(self._inputs.key(path)) for path in self._generation.package.artifacts}

    def first_use(self, key: str, text: str, staying: Collection[str]) -> Unresolved | None:
        """Return the first use of a lost name in a text for a file of the package; None if there is none.

        `staying` are the keys of files that stay the user's, or because he needs them.
        """
        if self.lost.keys().isdisjoint(code_words(text)):
            return None
        scopes = Scopes(self._planned({**self._texts(staying), key: text}, {}))
        uses = self._uses(self._class_name(key), text, scopes, self.lost.keys() - set(map(class_of, staying)))
        return uses[0] if uses else None

    def find(self, actions: Actions, written: Mapping[str, str]) -> list[Diagnostic]:
        """Return warnings about texts of the user's that use names which the package loses with these actions.

        `written` are texts that files are about to get.
        """
        inputs, files = self._inputs, self._files
        edited = [action for action in actions if action.kind in _EDITED and not action.held]
        mine = inputs.users_classes(edited, actions, written)
        around = files.users_files({inputs.folder, inputs.old_folder})
        others = {file: content.decode(errors="replace") for file, content in around.items()}
        found = self._left_out(actions, {**{files.path(key): text for key, text in mine.items()}, **others})
        if not self.lost or not (mine or around):
            return found
        staying = self._texts(a.path for a in actions if a.kind in (Kind.NEEDED, Kind.ORPHAN) or a.released)
        doubtful = self.lost.keys() - set(map(class_of, staying))
        sources = self._planned({**mine, **staying}, around)
        scopes = Scopes(sources)
        classes = [(self._class_name(key), files.path(key), text) for key, text in mine.items()]
        classes += [(name, Path(one.file), "") for name, one in sources.users.items()]
        classes += [((), file, others[file]) for file in sources.unread]
        for name, file, text in classes:
            uses: dict[str, list[Unresolved]] = {}
            for use in self._uses(name, text, scopes, doubtful):
                uses.setdefault(use.part, []).append(use)
            for part, (first, *more) in uses.items():
                message = f"`{first.name}` is used here, but the package has no `{part}` any more"
                new, lines = self.lost[part], sorted({use.line for use in more} - {first.line})
                hint = f"it is `{new}` now" if new else "adapt your text to what the package is now"
                if lines:
                    hint += f"; also in line{'s' if len(lines) > 1 else ''} {', '.join(map(str, lines))}"
                found.append(Diagnostic(Severity.WARNING, "vanished-name", message, shown(file), first.line, hint=hint))
        return found

    def _left_out(self, actions: Actions, texts: Mapping[Path, str]) -> list[Diagnostic]:
        """Return warnings about files that an option leaves out now, where the user edited or uses them."""
        inputs, target, found = self._inputs, Target(self._last.package, self._last.class_), []
        orphans = {action.path for action in actions if action.kind is Kind.ORPHAN}
        orphaned = {inputs.old_path(key) for key, one in self._last.files.items() if one.state is RecordState.ORPHAN}
        rewritten = {path for path, _ in self._generation.rewritten}
        for path in sorted(rewritten - self._generation.package.artifacts.keys() - orphaned):
            option = inputs.domain.option_for(path, target, inputs.robot.options)
            if not option:
                continue
            key, name, places = inputs.old_key(path), class_of(path), []
            if key in orphans:
                places.append((self._files.path(key), 0, "the file is no longer generated"))
            for file, text in texts.items():
                line = next((token.line for token in lex(text)[0] if token.text == name), 0) if name in text else 0
                if line:
                    places.append((file, line, f"`{name}` is used here, and no longer generated"))
            hint = f"`{option}` in the configuration keeps it up to date"
            found += [
                Diagnostic(Severity.WARNING, "left-out", said, shown(file), line, hint=hint)
                for file, line, said in places
            ]
        return found

    def _uses(self, name: ClassName, text: str, scopes: Scopes, doubtful: Collection[str]) -> list[Unresolved]:
        """Return the places in a stored class that use lost names and mean nothing, in their order.

        `text` is that of its file: if that is no Modelica, lost names count wherever they stand. Where a class on the
        way can't be read, `doubtful` names count as meaning nothing, but for those that are generated there, too.
        """
        node = scopes.node(name)
        if node is None:
            tokens = (token for token in lex(text)[0] if token.text in doubtful)
            return [Unresolved(UnresolvedKind.ELEMENT, token.text, token.text, "", token.line) for token in tokens]
        legal = (UnresolvedKind.NESTED_REDECLARE, UnresolvedKind.DOTTED_MODIFIER)
        found = [one for one in unresolved(node, scopes, doubtful) if one.part in self.lost and one.kind not in legal]
        generated = {self._class_name(self._inputs.key(path)) for path in self._generation.package.artifacts}
        same = self._generated.node(name) if found and name in generated else None
        fine = {one.name for one in unresolved(same, self._generated, doubtful)} if same else ()
        return sorted((one for one in found if one.name not in fine), key=lambda one: one.line)

    def _planned(self, texts: Mapping[str, str], others: Mapping[Path, bytes]) -> StoredClasses:
        """The classes as they will be after the build: `texts` of the package by their keys, `others` of the user's.

        Files that urdfsync wrote and are no longer generated are there only as far as they are among the texts.
        """
        inputs = self._inputs
        generated = {inputs.key(path) for path in self._generation.package.artifacts}
        written = {key for key, record in self._last.files.items() if record.written_hash}
        own = self._files.classes(inputs.folder) - written - generated
        return self._with_texts({**{key: self._files.any_text(key) for key in own}, **texts}, others)

    def _with_texts(self, texts: Mapping[str, str], others: Mapping[Path, bytes]) -> StoredClasses:
        """The generated classes, with `texts` of the package in their place or beside them, and others' files."""
        inputs, robot = self._inputs, self._inputs.robot
        former = self._last.package if self._last.package != self._package else ""
        found = self._contents | {inputs.path(key): text.encode(errors="replace") for key, text in texts.items()}
        others = {**others, **{one.path: one.content for one in inputs.parents.shared if one.content is not None}}

        def find(name: str) -> Path | None:
            if own := find_own_library(name, self._package):
                return own
            places = (robot.output / name, robot.output / f"{name}.mo")
            return next((path for path in places if path.is_file() or (path / "package.mo").is_file()), None)

        return StoredClasses(self._package, robot.folder, found, others, find, former)

    def _texts(self, keys: Iterable[str]) -> dict[str, str]:
        """Return the texts of files that are there; the user may have made a folder of a class."""
        return {key: text for key in keys if (text := self._files.any_text(key))}

    def _class_name(self, key: str) -> ClassName:
        return (*self._package.split("."), *class_path(PurePosixPath(self._inputs.path(key))).parts)


def class_of(path: str) -> str:
    """Return the name of the class that a file is for, by its key or path."""
    return class_path(PurePosixPath(path)).name


def _declared(texts: Iterable[tuple[str, str]]) -> set[ClassName]:
    """Return the full names, below the package, of all that texts declare, by their paths below it."""
    found: set[ClassName] = set()
    for path, text in texts:
        name = class_path(PurePosixPath(path)).parts
        paths = (one.path for one in declared(parse(text).classes, name[:-1]))
        found.update(paths if name else (path[1:] for path in paths if path[1:]))  # the package itself is no part
    return found


def code_words(text: str) -> set[str]:
    """Return all names and keywords in a text, without those in strings and comments, and without the classes in it.

    An edited file whose element has another name may still declare its class by the old one. The text need not parse.
    """
    found = [token.text for token in lex(text)[0]]
    return set(found) - {name for kind, name in itertools.pairwise(found) if kind in _CLASS_KINDS}
