"""Finds names in the user's texts that will not resolve in the package after the build.

These texts are edited files of the package, the user's own classes in it, and the user's models outside. Findings
depend only on the project: the package, UrdfSync, and the user's files. A name from an unread library is no fault.
Generated texts fit each other. So this reads only edited statements, and statements with a name that an edit adds,
changes or removes.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from functools import cached_property
from pathlib import Path, PurePath, PurePosixPath

import msgspec

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.common.files import shown
from urdfsync.engine.decide.package_after import PackageAfter, code_words
from urdfsync.engine.decide.package_names import class_of, declared_names
from urdfsync.modelica.classes import ClassNode
from urdfsync.modelica.files import (
    PACKAGE_FILE,
    ClassName,
    as_file,
    class_of_file,
    class_parts,
    place_of,
    text_of,
)
from urdfsync.modelica.layout import check_class_file, check_order, check_places
from urdfsync.modelica.scopes import NamedElement, Scopes
from urdfsync.modelica.statements import (
    TOO_LONG,
    EditedStatements,
    ShortText,
    compare,
    component_of,
    mentioning,
    parse_without,
    plain_statements,
)
from urdfsync.modelica.stored import StoredClasses
from urdfsync.modelica.syntax import declared
from urdfsync.modelica.unresolved import Unresolved, UnresolvedKind, unresolved

_LEGAL = (UnresolvedKind.NESTED_REDECLARE, UnresolvedKind.DOTTED_MODIFIER)
_KINDS = {"model": ("model", "block", "class"), "record": ("record", "operator record")}
"""For a kind of generated class, the kinds that an edit may give the class."""
_TOO_LONG = Diagnostic(
    Severity.WARNING,
    "too-long",
    f"the file {TOO_LONG.faults[0].reason}: names in it are not checked",
    hint="`urdfsync check` checks them",
)


class Misfit(msgspec.Struct, frozen=True):
    """A syntax error or an unresolved name in a user's file."""

    file: Path
    finding: Diagnostic
    """The finding without its file; for an unresolved name, also without its hint."""
    key: str = ""
    """The key of a file in the package; empty for other files."""
    is_broken: bool = False
    """Whether the fault breaks the package; only an edited generated file can."""
    use: Unresolved | None = None
    lacking: str = ""
    """A name that a generated text mentions, and that is missing in this file."""

    @property
    def fault(self) -> str:
        """The unresolved name, or the code of another finding, to recognise the same fault later.

        The class without the name is left out: it may be renamed with its element.
        """
        return self.use.part if self.use else self.finding.code


def find_misfits(after: PackageAfter, only: Collection[str] | None = None) -> list[Misfit]:
    """Return all findings about the user's texts; with `only`, about the merged texts of the files with these keys.

    In a merge, a removed name is a fault even if a class may inherit it from an unread library.
    """
    return _Resolver(after).misfits(only)


class _Resolver:
    """Resolves the names in a package after a build."""

    def __init__(self, after: PackageAfter) -> None:
        self._after, self._inputs = after, after.inputs
        self._readings, self._differences = dict[bytes, ShortText](), dict[str, EditedStatements]()

    def class_name(self, path: str) -> ClassName:
        """Return the full name of a file's class, by the file's path below the package."""
        return (*self._inputs.robot.target.package.split("."), *class_parts(path))

    # --- classes --------------------------------------------------------------------------------------------------

    def classes(self) -> StoredClasses:
        """Return all classes for resolving names."""
        inputs, target = self._inputs, self._inputs.robot.target
        parents = {one.path: one.content for one in inputs.parents.shared if one.content is not None}
        former = inputs.last.target.package if inputs.last.target.package != target.package else ""
        folder, around = inputs.files.path(inputs.folder), {**self._after.around, **parents}
        return StoredClasses(
            target.package,
            folder,
            self._after,
            around,
            inputs.look_for_class,
            lambda content: self._reading(content).stored,
            former,
        )

    def _reading(self, content: bytes) -> ShortText:
        """Parse a file; in a generated file, read only the statements that matter to other files."""
        if content not in self._readings:
            text = text_of(content)
            passed = plain_statements(text) if self._after.is_generated(content) else frozenset[str]()
            self._readings[content] = parse_without(text, passed)
        return self._readings[content]

    # --- findings -------------------------------------------------------------------------------------------------

    def misfits(self, only: Collection[str] | None = None) -> list[Misfit]:
        """See `find_misfits`."""
        if not self._after.users:
            return [*self._look_at_orders()] if only is None else []
        passed = self._passed_statements()
        for path, statements in passed.items():
            self._readings[self._after[path]] = parse_without(text_of(self._after[path]), statements)
        misfits = [*self._look_at_places(), *self._look_at_orders()] if only is None else []
        scopes, lost = Scopes(self.classes()), self._is_lost if only is not None else None
        for path in passed:
            if only is None or self._after.files[path].key in only:
                misfits += self._look(path, scopes, lost, passed)
        for file in sorted(self._after.around) if only is None else ():
            misfits += self._look_around(file, scopes)
        return misfits

    def _passed_statements(self) -> dict[str, frozenset[str]]:
        """Return the files to check, each with the statements that need no check: these equal generated statements."""
        artifacts, statements = self._after.package.artifacts, dict[str, frozenset[str]]()
        # begin with classes that generated texts mention and that are missing
        before = self._inputs.last.files
        expected = set(map(self._inputs.folder.path, before)) if self._is_waiting else set(artifacts)
        missing = expected - set(map(as_file, self._after)) - self._after.files.keys()
        names, classes = {class_of(path) for path in missing if path.endswith(".mo")}, set[str]()
        edited = [path for path, file in self._after.files.items() if file.is_edited]
        for path in edited:
            difference = self._differences[path] = compare(text_of(self._after[path]), self._generated_text(path))
            classes.update(self.class_name(path)[-1:] if difference.is_whole else ())
            statements[path], names = difference.same, names | difference.names
        owners = {artifacts[path].owner for path in edited if path in artifacts}
        for path, file in self._after.files.items():
            if file.is_generated and path in artifacts and (artifacts[path].owner in owners or "/" not in path):
                text = text_of(self._after[path])
                if mentioning([text], names | classes):
                    statements[path] = plain_statements(text)
        components = (component_of(one) for same in statements.values() for one in mentioning(same, classes))
        names |= classes | {name for kind, name in filter(None, components) if kind in classes}
        return {path: same - mentioning(same, names) for path, same in statements.items()}

    @cached_property
    def _is_waiting(self) -> bool:
        """Whether an action waits, so that the package stays as the last complete build left it."""
        return any(action.is_waiting for action in self._after.actions)

    def _generated_text(self, path: str) -> str:
        """Return the generated text of an edited file; empty if there is none."""
        inputs, artifacts = self._inputs, self._after.package.artifacts
        place = path if path in artifacts else as_file(path)
        if not self._is_waiting:
            return self._after.package.content(place).decode() if place in artifacts else ""
        if inputs.last.package and place in inputs.last.package.artifacts:
            return inputs.last.package.content(place).decode()
        return inputs.last.base(inputs.last.files.get(inputs.folder.key(place))) or ""

    def _is_lost(self, name: str) -> bool:
        """Whether a replaced or deleted text declares this name, and the new text does not."""
        files, folder = self._inputs.files, self._inputs.folder
        replaced = list[tuple[str, str]]()
        # if all actions wait, the package stays as it was before the choices
        if not all(action.is_waiting for action in self._after.actions):
            chosen = (key for key in files.overlay if key.endswith(".mo") and files.is_chosen(key))
            replaced += [(folder.path(key), text_of(files.read_on_disk(key) or b"")) for key in chosen]
        for action in self._after.actions:
            if action.writes and (key := action.origin or action.path).endswith(".mo"):
                replaced.append((folder.path(action.path), files.any_text(key)))
        for path, old in replaced:
            if name not in old or name not in declared_names([old]):  # parsing all texts would take too long
                continue
            if path not in self._after or name not in declared_names([text_of(self._after[path])]):
                return True
        return False

    def _look_at_places(self) -> Iterator[Misfit]:
        """Find classes that are stored in two places."""
        packages = [
            path for path, file in self._after.files.items() if file.is_edited and f"/{path}".endswith("/package.mo")
        ]
        for path, finding in check_places(
            self._after, {package: self._declared(package) or {} for package in packages}
        ):
            file, other = self._after.files[path], self._after.files.get(f"{path.removesuffix('.mo')}/{PACKAGE_FILE}")
            is_broken = file.is_expected or (other is not None and other.is_expected)
            yield Misfit(self._inputs.files.path(file.key), finding, file.key, is_broken)

    @cached_property
    def _used(self) -> set[str | Path]:
        """The user's own files whose classes his edits of generated files use, directly or through others."""
        own = dict[str | Path, bytes]()
        own.update((path, self._after[path]) for path, file in self._after.files.items() if file.is_users)
        own.update(self._after.around.items())
        edited = (self._after[path] for path, file in self._after.files.items() if file.is_edited and file.is_expected)
        words, used = set().union(*map(code_words, edited)), set[str | Path]()
        while new := {path for path in own.keys() - used if class_of(PurePath(path).as_posix()) in words}:
            used |= new
            words |= set().union(*(code_words(own[path]) for path in new))
        return used

    def _declared(self, path: str) -> dict[str, int] | None:
        """Return the lines of a `package.mo`'s declarations, by name; None for a missing or faulty file."""
        stored = self._reading(self._after[path]).stored if path in self._after else None
        if stored is None or stored.is_broken:
            return None
        return {inside.path[1]: inside.line for inside in declared(stored.classes) if len(inside.path) == 2}

    def _look_at_orders(self) -> Iterator[Misfit]:
        """Find the user's lines in a `package.order` that name no class."""
        inputs, files, orders = self._inputs, self._inputs.files, self._after.package.orders
        for path, (text, lines) in self._after.extended_orders.items():
            names, folder = orders.get(path, ()), path.removesuffix("package.order")
            below = (other.removeprefix(folder) for other in self._after if other.startswith(folder))
            package, key = f"{folder}{PACKAGE_FILE}", inputs.folder.key(path)
            inside = self._declared(package)
            present = {other.partition("/")[0].removesuffix(".mo") for other in below} | {*(inside or ())}
            others = {line for line in lines - present if files.has_class(inputs.folder.key(folder), line)}
            for finding in check_order(text, present, None if inside is None else others | {*names}):
                if finding.severity is Severity.ERROR:
                    yield Misfit(files.path(key), finding, key, is_broken=self._after.files[package].is_expected)

    def _instance(self, node: ClassNode, scopes: Scopes, paths: Iterable[str]) -> str:
        """Return the place where one of these files instantiates a class; empty if no file does."""
        for path in paths:
            other = scopes.node(self.class_name(path))
            if other is None or "partial" in other.definition.prefixes:
                continue
            types = [component.type for component in other.definition.components]
            redeclared = (one.type for base in other.definition.extends for one in base.arguments)
            types += [one.type for one in redeclared if one]
            for name in types:
                meaning = scopes.lookup(name, other)
                if isinstance(meaning, NamedElement) and meaning.types[0].node is node:
                    return f"{shown(self._inputs.files.path(self._after.files[path].key))}:{name.line}"
        return ""

    def _look_at_head(self, path: str, node: ClassNode, scopes: Scopes, paths: Iterable[str]) -> Iterator[Diagnostic]:
        """Check that an edited class still has its kind, and that no file instantiates a partial class."""
        generated = self._differences[path].generated if path in self._differences else None
        if generated is None:
            return
        name, kind, line = node.definition.name, generated.kind, node.definition.name.line
        if node.definition.kind not in _KINDS.get(kind, (kind,)):
            message = f"`{name}` is declared as `{node.definition.kind}`, but used as `{kind}`"
            yield Diagnostic(Severity.ERROR, "wrong-kind", message, line=line, hint=f"write `{kind} {name}`")
        is_partial = "partial" in node.definition.prefixes - generated.prefixes
        place = "other classes" if kind == "package" or not is_partial else self._instance(node, scopes, paths)
        if is_partial and place:
            message, hint = f"`{name}` is partial, but {place} uses it", "remove `partial`, or extend the class"
            yield Diagnostic(Severity.ERROR, "wrong-kind", message, line=line, hint=hint)

    def _look(
        self, path: str, scopes: Scopes, lost: Callable[[str], bool] | None, paths: Iterable[str]
    ) -> Iterator[Misfit]:
        """Check a file of the package; in a generated file, check only for names that the user's files lack.

        `paths` are all checked files.
        """
        file, name, reading = self._after.files[path], self.class_name(path), self._readings[self._after[path]]
        place = self._inputs.files.path(file.key)
        findings = check_class_file(reading.text, PurePosixPath(path), ".".join(name), reading.stored)[1]
        node = scopes.node(name)
        findings += self._look_at_head(path, node, scopes, paths) if node else ()
        for use, finding in _faults(reading, findings, [node] if node else [], scopes, lost):
            if not file.is_generated:
                is_broken = (file.is_expected or path in self._used) and finding.severity is Severity.ERROR
                yield Misfit(place, finding, file.key, is_broken, use)
            elif use and (owner := scopes.node(use.owner.split("."))) and Path(owner.file) in self._after.users:
                message = f"it has no `{use.part}`, which {shown(place)}:{use.line} mentions"
                finding = msgspec.structs.replace(finding, message=message, line=owner.definition.name.line)
                key = self._inputs.files.key(Path(owner.file))
                yield Misfit(Path(owner.file), finding, key, is_broken=True, lacking=use.part)

    def _look_around(self, file: Path, scopes: Scopes) -> Iterator[Misfit]:
        """Check a user's file outside of the package; it may hold several classes if it is in no package."""
        reading, package = self._reading(self._after.around[file]), place_of(file, self._after.around)[1]
        findings = list[Diagnostic]()
        if reading.stored.is_broken or (package and reading.stored.within != ".".join(package)):
            name = ".".join((*package, class_of_file(file)))
            findings = check_class_file(reading.text, PurePosixPath(file.name), name, reading.stored)[1]
        nodes = [node for node in scopes.users() if node.file == str(file)]
        for use, finding in _faults(reading, findings, nodes, scopes):
            yield Misfit(file, finding, "", file in self._used and finding.severity is Severity.ERROR, use)


def _faults(
    reading: ShortText,
    findings: Sequence[Diagnostic],
    nodes: Sequence[ClassNode],
    scopes: Scopes,
    lost: Callable[[str], bool] | None = None,
) -> Iterator[tuple[Unresolved | None, Diagnostic]]:
    """Yield the syntax errors of a file; without syntax errors, yield each unresolved name."""
    errors = [finding for finding in findings if finding.severity is Severity.ERROR]
    if reading.stored is TOO_LONG:
        errors = [_TOO_LONG]
    yield from ((None, finding) for finding in errors)
    for node in nodes if not errors else ():
        uses = unresolved(node, scopes, all_libraries=True, lost=lost, passed=reading.passed)
        for use in sorted((one for one in uses if one.kind not in _LEGAL), key=lambda one: one.line):
            yield use, Diagnostic(Severity.ERROR, "unresolved", use.message, line=use.line)
