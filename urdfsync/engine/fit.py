"""Whether what the user wrote fits the package: each name in it is resolved, against what is there after the build.

Looked at are the files of the package that the user edited, his own classes in it, and his models outside. The finding
rests on what travels with the project: the package, UrdfSync, and the user's files. Nothing is said of what is in
libraries that are not read.

Generated texts fit each other. So of an edited one only those statements are looked at that are not as generated, and
those that mention a name which an edit adds, changes or takes away; of generated ones the latter.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Container, Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path, PurePosixPath
from typing import NamedTuple

import msgspec

from urdfsync.config import find_own_library
from urdfsync.dependencies import is_file
from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.domain import Role, brings_back
from urdfsync.engine.actions import Action, Kind, Reason
from urdfsync.engine.generation import Generation
from urdfsync.engine.package_files import encode, text_hash
from urdfsync.engine.package_names import class_of, declared_names, new_name, new_names, renamed_identifiers
from urdfsync.files import shown
from urdfsync.modelica.classes import Node
from urdfsync.modelica.files import ClassName, StoredClasses, class_parts, files_that_use, place_of, text_of
from urdfsync.modelica.layout import check_class_file
from urdfsync.modelica.scopes import Scopes
from urdfsync.modelica.statements import (
    TOO_LONG,
    Reading,
    compare,
    component_of,
    mentioning,
    parse_without,
    plain_statements,
)
from urdfsync.modelica.syntax import StoredText
from urdfsync.modelica.unresolved import Unresolved, UnresolvedKind, unresolved

_LEGAL = (UnresolvedKind.NESTED_REDECLARE, UnresolvedKind.DOTTED_MODIFIER)
_ON_DISK = frozenset(one for one in Reason if one.kind in (Kind.LEAVE, Kind.CONFLICT)) - {
    Reason.UNCHANGED,
    Reason.ADOPT,
}
"""Actions that leave the file on disk."""
_TOO_LONG = Diagnostic(
    Severity.WARNING,
    "too-long",
    f"the file {TOO_LONG.faults[0].reason}: names in it are not looked at",
    hint="`urdfsync check` looks at them",
)


class Misfit(msgspec.Struct, frozen=True):
    """Something in a file of the user's that is no Modelica, or means nothing."""

    file: Path
    finding: Diagnostic
    """Without the file."""
    key: str = ""
    """Of a file in the package."""
    is_broken: bool = False
    """Whether it keeps the package from being compiled: the file is one of those that are generated."""
    use: Unresolved | None = None
    """The name that means nothing."""
    renamed: tuple[str, str] | None = None
    """Old and new identifier, if the build knows what was renamed."""

    @property
    def fault(self) -> str:
        """The name that means nothing, or the code of another finding: as long as it is the same, so is the fault.

        The class that lacks the name is no part of it: that gets another name when its element does.
        """
        return self.use.part if self.use else self.finding.code


class _File(NamedTuple):
    """A file of the package after the build."""

    key: str
    text: str | None = None
    """A text that the build writes, other than the generated one."""
    is_generated: bool = False
    is_edited: bool = False
    """Whether the user wrote in it."""
    is_users: bool = False
    """Whether it is the user's own."""
    is_expected: bool = True
    """Whether a file of its name is generated."""


class Package(Mapping[str, bytes]):
    """The files of a robot's package as a build leaves them, by their paths below it, and the user's around it.

    Contents are made when they are asked for: rendering 4,000 takes a second.
    """

    def __init__(
        self,
        generation: Generation,
        actions: Sequence[Action],
        merged: Mapping[str, str],
        contents: Mapping[Path, bytes] | None = None,
        former_names: Collection[str] = (),
        *,
        is_open: bool = False,
    ) -> None:
        """`merged` are texts that the build writes, by key; `contents` counts for what is in files of the user's.

        Files that use one of the `former_names` have to do with the package, too. If it `is_open` what becomes of files
        in conflict, they may have anything.
        """
        self._generation, self._inputs, self._actions = generation, generation.inputs, actions
        self._contents, self._read_contents = contents or {}, dict[str, bytes]()
        self._generated, self._readings = set[bytes](), dict[bytes, Reading]()
        self._files = self._files_after(merged, is_open=is_open)
        self.around = self._files_around(former_names)

    def _files_after(self, merged: Mapping[str, str], *, is_open: bool) -> dict[str, _File]:
        """Return the files of the package after the build, by their paths below it."""
        inputs, files, found = self._inputs, self._inputs.files, dict[str, _File]()
        inside, classes, keys = inputs.folder.key(""), set[str](), set[str]()
        for action in self._actions:
            key = action.path
            if action.role in (Role.ORDER, Role.IMPORT) or not (key.endswith(".mo") and key.startswith(inside)):
                continue
            keys.add(key)
            classes |= {key} if action.generated else set()
            file = _File(key, is_expected=action.generated is not None)
            if not action.held and key in merged:
                is_edited = text_hash(merged[key]) != action.generated
                found[inputs.folder.path(key)] = file._replace(text=merged[key], is_edited=is_edited)
            elif is_open and action.kind is Kind.CONFLICT:
                found[inputs.folder.path(key)] = file._replace(text="")
            elif action.held or action.reason in _ON_DISK:
                is_forgotten = action.reason is Reason.FORGET and not action.handed_to_user
                if (sha256 := files.hash(key, action.role)) and not is_forgotten:
                    record = inputs.last.files.get(key)
                    is_edited = sha256 not in (action.generated, *(record.hashes if record else ()))
                    found[inputs.folder.path(key)] = file._replace(is_edited=is_edited)
            elif action.kind is not Kind.DELETE:
                found[inputs.folder.path(key)] = file._replace(is_generated=True)
        for key in sorted(filter(files.can_read, files.classes(inputs.folder) - keys)):
            is_expected = _as_file(key) in classes
            found[inputs.folder.path(key)] = _File(key, is_edited=True, is_users=True, is_expected=is_expected)
        return found

    def _files_around(self, former_names: Collection[str]) -> dict[Path, bytes]:
        """Return the user's files outside of the package that may use it."""
        inputs, files = self._inputs, self._inputs.files
        found = {**inputs.users_files.mentioning, **files_that_use(inputs.users_files.all, former_names)}
        if inputs.has_moved:
            keys = {action.path for action in self._actions}
            rest = files.classes(inputs.last.folder) - keys - inputs.last.files.keys()
            found |= {files.path(key): encode(files.any_text(key)) for key in sorted(rest)}
        return {path: self._contents.get(path, content) for path, content in found.items()}

    def __getitem__(self, path: str) -> bytes:
        """Return what is in a file of the package. Raises KeyError."""
        if path not in self._read_contents:
            file, files = self._files[path], self._inputs.files
            if file.is_generated:
                content = self._generation.package.content(path)
                self._generated.add(content)
            else:
                content = encode(files.any_text(file.key) if file.text is None else file.text)
            self._read_contents[path] = self._contents.get(files.path(file.key), content) if file.is_edited else content
        return self._read_contents[path]

    def __iter__(self) -> Iterator[str]:
        return iter(self._files)

    def __len__(self) -> int:
        return len(self._files)

    def content_of(self, file: Path) -> bytes:
        """Return what is in a file of the user's."""
        path = self._path_below(file)
        return self[path] if path in self else self.around[file]

    def users_texts(self) -> dict[str, str]:
        """Return the texts in the package that the user wrote or edited, by key."""
        return {file.key: text_of(self[path]) for path, file in self._files.items() if file.is_edited}

    def is_users(self, file: Path) -> bool:
        """Whether the user wrote a file, and not only edited it."""
        path = self._path_below(file)
        return file in self.around or (path in self._files and self._files[path].is_users)

    def _path_below(self, file: Path) -> str:
        """Return the path of a file below the package; empty if it is elsewhere."""
        key, inside = self._inputs.files.key(file), self._inputs.folder.key("")
        return key.removeprefix(inside) if key.startswith(inside) else ""

    def class_name(self, path: str) -> ClassName:
        """Return the full name of the class that a file is for, by its path below the package."""
        return (*self._inputs.robot.target.package.split("."), *class_parts(path))

    # --- classes --------------------------------------------------------------------------------------------------

    def classes(self) -> StoredClasses:
        """Return all classes, to resolve names in."""
        inputs, target = self._inputs, self._inputs.robot.target
        parents = {one.path: one.content for one in inputs.parents.shared if one.content is not None}
        former = inputs.last.target.package if inputs.last.target.package != target.package else ""
        folder, around = inputs.files.path(inputs.folder), {**self.around, **parents}
        return StoredClasses(target.package, folder, self, around, self._find, self._read, former)

    @cached_property
    def _tops(self) -> dict[str, Path]:
        return self._inputs.users_files.tops()

    def _find(self, name: str) -> Path | None:
        """Return the folder or file of a top-level class that is not in the package."""
        robot = self._inputs.robot
        if own := find_own_library(name, robot.target.package):
            return own
        for path in (robot.output / name, robot.output / f"{name}.mo"):
            if is_file(path / "package.mo" if path.suffix != ".mo" else path):
                return path
        return self._tops.get(name)

    def _read(self, content: bytes) -> StoredText:
        """Parse a file; of generated ones only what others see."""
        if content not in self._readings:
            text = text_of(content)
            passed = plain_statements(text) if content in self._generated else frozenset[str]()
            self._readings[content] = parse_without(text, passed)
        return self._readings[content].stored

    # --- findings -------------------------------------------------------------------------------------------------

    def misfits(self, only: Collection[str] | None = None) -> list[Misfit]:
        """Return all findings; `only` those in the files of the package with these keys, which are about to be merged.

        Of a merge it is also told if it uses what this build takes away, and what a class may inherit from a library
        that is not read.
        """
        edited, around = [path for path, one in self._files.items() if one.is_edited], dict(self.around)
        if only is not None:
            around = {}
        if not (edited or around):
            return []
        found, passed = list[Misfit](), self._passed_statements(edited)
        for path, statements in passed.items():
            self._readings[self[path]] = parse_without(text_of(self[path]), statements)
        scopes, lost = Scopes(self.classes()), self._is_lost if only is not None else None
        for path in passed:
            if only is None or self._files[path].key in only:
                found += self._look(path, scopes, lost)
        for file in sorted(around):
            found += self._look_around(file, scopes)
        return found

    def _passed_statements(self, edited: Sequence[str]) -> dict[str, frozenset[str]]:
        """Return the files to look at, with their statements that mean what they mean in generated texts."""
        artifacts, found = self._generation.package.artifacts, dict[str, frozenset[str]]()
        names, classes = self._missing_classes(), set[str]()
        for path in edited:
            generated = self._generated_text(path)
            difference = None if generated is None else compare(text_of(self[path]), generated)
            if difference is None or difference.is_whole:
                classes.update(self.class_name(path)[-1:])
            found[path] = difference.same if difference and not difference.is_whole else frozenset()
            names |= difference.names if difference else frozenset()
        owners = {artifacts[path].owner for path in edited if path in artifacts}
        for path, file in self._files.items():
            if file.is_generated and path in artifacts and (artifacts[path].owner in owners or "/" not in path):
                text = text_of(self[path])
                if mentioning([text], names | classes):
                    found[path] = plain_statements(text)
        components = (component_of(one) for statements in found.values() for one in mentioning(statements, classes))
        names |= classes | {name for kind, name in filter(None, components) if kind in classes}
        return {path: statements - mentioning(statements, names) for path, statements in found.items()}

    @cached_property
    def _is_waiting(self) -> bool:
        """Whether files stay as they are in the package of the last complete build."""
        return any(action.held for action in self._actions)

    def _missing_classes(self) -> set[str]:
        """Return the names of classes that generated texts mention, and that are not there."""
        recorded = map(self._inputs.folder.path, self._inputs.last.files)
        paths = {*recorded} if self._is_waiting else self._generation.package.artifacts.keys()
        known = set(map(_as_file, self))
        return {class_of(path) for path in paths - known - self._files.keys() if path.endswith(".mo")}

    def _generated_text(self, path: str) -> str | None:
        """Return the text in the place of an edited one that all other generated texts fit; None if there is none."""
        inputs, place = self._inputs, path if path in self._generation.package.artifacts else _as_file(path)
        if not self._is_waiting:
            is_generated = place in self._generation.package.artifacts
            return self._generation.package.content(place).decode() if is_generated else None
        record = inputs.last.files.get(inputs.folder.key(place))
        return inputs.last.base(record.hashes[0]) if record and len(record.hashes) == 1 else None

    def _is_lost(self, name: str) -> bool:
        """Whether a text that is replaced or deleted declares a name, and the one in its place does not."""
        return any(self._loses(name, action) for action in self._actions if action.writes)

    def _loses(self, name: str, action: Action) -> bool:
        key = action.origin or action.path
        old = self._inputs.files.any_text(key) if key.endswith(".mo") else ""
        if name not in old or name not in declared_names([old]):
            return False
        path = self._inputs.folder.path(action.path)
        return path not in self or name not in declared_names([text_of(self[path])])

    def _look(self, path: str, scopes: Scopes, lost: Callable[[str], bool] | None) -> list[Misfit]:
        """Look at a file of the package; at a generated one for what others lack."""
        one, name, reading = self._files[path], self.class_name(path), self._readings[self[path]]
        file = self._inputs.files.path(one.key)
        if reading.stored is TOO_LONG:
            return [Misfit(file, _TOO_LONG, one.key)]
        said = check_class_file(reading.text, PurePosixPath(path), ".".join(name), reading.stored)[1]
        found = [Misfit(file, finding, one.key, one.is_expected) for finding in _errors(said)]
        node = scopes.node(name) if not found else None
        for use, finding in self._uses([node] if node else [], scopes, lost, reading.passed):
            if not one.is_generated:
                found.append(Misfit(file, finding, one.key, one.is_expected, use, self._renamed_by(use)))
            elif (owner := scopes.node(use.owner.split("."))) and self._is_edited(Path(owner.file)):
                message = f"it has no `{use.part}`, which {shown(file)}:{use.line} mentions"
                new = msgspec.structs.replace(finding, message=message, line=owner.definition.name.line)
                found.append(Misfit(Path(owner.file), new, self._inputs.files.key(Path(owner.file)), is_broken=True))
        return found

    def _look_around(self, path: Path, scopes: Scopes) -> list[Misfit]:
        """Look at a file of the user's outside of the package."""
        text = self._read(self.around[path])
        if text is TOO_LONG:
            return [Misfit(path, _TOO_LONG)]
        around = tuple(text.within.split(".")) if text.within else ()
        expected = place_of(path, self.around)[1]
        if text.is_broken or (expected and around != expected):
            name = ".".join((*expected, path.parent.name if path.name == "package.mo" else path.stem))
            said = check_class_file(text_of(self.around[path]), PurePosixPath(path.name), name)[1]
            return [Misfit(path, finding) for finding in _errors(said)]
        nodes = [node for node in scopes.users() if node.file == str(path)]
        uses = self._uses(nodes, scopes)
        return [Misfit(path, finding, use=use, renamed=self._renamed_by(use)) for use, finding in uses]

    def _is_edited(self, file: Path) -> bool:
        path = self._path_below(file)
        return path in self._files and self._files[path].is_edited

    def _uses(
        self,
        nodes: Sequence[Node],
        scopes: Scopes,
        lost: Callable[[str], bool] | None = None,
        passed: Container[int] = (),
    ) -> Iterator[tuple[Unresolved, Diagnostic]]:
        """Yield each name that means nothing, and what there is to say of it."""
        for node in nodes:
            found = unresolved(node, scopes, all_libraries=True, lost=lost, passed=passed)
            for use in sorted((one for one in found if one.kind not in _LEGAL), key=lambda one: one.line):
                hint = self._hint(use)
                yield use, Diagnostic(Severity.ERROR, "unresolved", use.message, line=use.line, hint=hint)

    # --- what to do -----------------------------------------------------------------------------------------------

    @cached_property
    def _renamed(self) -> dict[str, str]:
        return renamed_identifiers(self._generation)

    def new_name(self, use: Unresolved) -> str:
        """Return the name that something has since the last complete build; empty if that is not known."""
        return new_name(use.part, self._renamed, use.known)

    def _renamed_by(self, use: Unresolved) -> tuple[str, str] | None:
        pairs = ((old, new) for old, new in self._renamed.items() if use.part.lower().startswith(old.lower()))
        return next(pairs, None) if self.new_name(use) else None

    def _hint(self, use: Unresolved) -> str:
        """Return what to do about a name that means nothing."""
        inputs, target = self._inputs, self._inputs.robot.target
        if use.part == inputs.last.target.package != target.package and target.name not in use.known:
            return f"use `{target.package}` instead"
        if name := self.new_name(use):
            return f"use `{name}` instead"
        snapshot, options = self._generation.now.snapshot, inputs.robot.options
        for name in dict.fromkeys((use.part, next(new_names(use.part, self._renamed), use.part))):
            if option := inputs.domain.option_for(name, snapshot, target, options):
                return brings_back(option, name if name != use.part else "")
        if use.near:
            return f"did you mean `{use.meant}`?"
        if use.kind is UnresolvedKind.CLASS and use.is_library:
            return f'name the library in `uses` if `{use.part}` is one: annotation (uses({use.part}(version="…")))'
        return "change or remove this use"


def _as_file(path: str) -> str:
    """Return the path of the file that a class has as long as it is no folder."""
    return f"{path.removesuffix('/package.mo').removesuffix('.mo')}.mo"


def _errors(findings: Sequence[Diagnostic]) -> list[Diagnostic]:
    return [finding for finding in findings if finding.severity is Severity.ERROR]


def find_misfits(generation: Generation, actions: Sequence[Action], merged: Mapping[str, str]) -> list[Misfit]:
    """Find what does not fit in the files that the user wrote, once all actions are done but those that wait."""
    if generation.inputs.has_moved and any(action.held for action in actions):
        return []  # the package stays where it was
    return Package(generation, actions, merged).misfits()
