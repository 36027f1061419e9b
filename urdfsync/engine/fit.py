"""Whether what the user wrote fits the package: each name in it is resolved, against what is there after the build.

Looked at are the files of the package that the user edited, his own classes in it, and his models outside. The finding
rests on what travels with the project: the package, UrdfSync, and the user's files. Nothing is said of what is in
libraries that are not read.
"""

from __future__ import annotations

import os
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
from urdfsync.engine.fit_cache import Fit, FitCache, Source
from urdfsync.engine.generation import Generation
from urdfsync.engine.package_files import encode
from urdfsync.engine.package_names import declared_names, new_name, renamed_identifiers
from urdfsync.files import digest, shown, text_digest
from urdfsync.modelica.classes import Node
from urdfsync.modelica.files import ClassName, StoredClasses, class_parts, files_that_use, place_of, text_of
from urdfsync.modelica.layout import check_class_file
from urdfsync.modelica.scopes import Scopes
from urdfsync.modelica.syntax import Class
from urdfsync.modelica.unresolved import Unresolved, UnresolvedKind, unresolved

_LEGAL = (UnresolvedKind.NESTED_REDECLARE, UnresolvedKind.DOTTED_MODIFIER)
_ON_DISK = frozenset(one for one in Reason if one.kind in (Kind.LEAVE, Kind.CONFLICT)) - {
    Reason.UNCHANGED,
    Reason.ADOPT,
}
"""Actions that leave the file on disk."""


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
    def name(self) -> tuple[str, str]:
        """What means nothing, wherever that is in the file."""
        return (self.use.owner, self.use.part) if self.use else ("", self.finding.message)


class _Text(NamedTuple):
    """The text of a file after the build."""

    key: str
    sha256: str
    is_generated: bool = False
    text: str | None = None
    """A text that the build writes, other than the generated one."""
    is_edited: bool = False
    """Whether the user wrote in it."""
    is_expected: bool = True
    """Whether a file of its name is generated."""


class Package:
    """The classes of a robot's package, with the user's, as a build leaves them."""

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
        self._generation, self._inputs = generation, generation.inputs
        self.cache = FitCache(self._inputs.config.root, self._inputs.robot.name)
        self._contents, self._read = contents or {}, dict[str, bytes]()
        self._lost: Container[str] = ()
        self._is_open = is_open
        self.texts = self._texts(actions, merged)
        self.changed = [action for action in actions if action.writes]
        self.around = self._around(actions, former_names)

    def _texts(self, actions: Sequence[Action], merged: Mapping[str, str]) -> dict[str, _Text]:
        """Return the files of the package after the build, by their paths below it."""
        inputs, files, found = self._inputs, self._inputs.files, dict[str, _Text]()
        inside, classes, keys = inputs.key(""), set[str](), set[str]()
        for action in actions:
            key = action.path
            if action.role in (Role.ORDER, Role.IMPORT) or not (key.endswith(".mo") and key.startswith(inside)):
                continue
            keys.add(key)
            classes |= {key} if action.generated else set()
            is_expected = action.generated is not None
            if not action.held and key in merged:
                sha256, text = text_digest(encode(merged[key])), merged[key]
                is_edited = sha256 != action.generated
                found[inputs.path(key)] = _Text(key, sha256, text=text, is_edited=is_edited, is_expected=is_expected)
            elif self._is_open and action.kind is Kind.CONFLICT:
                found[inputs.path(key)] = _Text(key, text_digest(b""), text="")
            elif action.held or action.reason in _ON_DISK:
                if (sha256 := files.hash(key, action.role) or "") and not (
                    action.reason is Reason.FORGET and not action.handed_to_user
                ):
                    record = inputs.recorded_files.get(key)
                    is_edited = sha256 not in (action.generated, *(record.hashes if record else ()))
                    found[inputs.path(key)] = _Text(key, sha256, is_edited=is_edited, is_expected=is_expected)
            elif action.kind is not Kind.DELETE:
                found[inputs.path(key)] = _Text(key, action.generated or "", is_generated=True)
        for key in sorted(filter(files.can_read, files.classes(inputs.folder) - keys)):
            is_expected = f"{key.removesuffix('/package.mo')}.mo" in classes
            found[inputs.path(key)] = _Text(key, "", is_edited=True, is_expected=is_expected)
        return found

    def _around(self, actions: Sequence[Action], former_names: Collection[str]) -> dict[Path, bytes]:
        """Return the user's files outside of the package that may use it."""
        inputs, files = self._inputs, self._inputs.files
        found = {**inputs.users_files.mentioning, **files_that_use(inputs.users_files.all, former_names)}
        if inputs.has_moved:
            left = files.classes(inputs.old_folder) - {action.path for action in actions} - inputs.recorded_files.keys()
            found |= {files.path(key): encode(files.any_text(key)) for key in sorted(left)}
        return {path: self._contents.get(path, content) for path, content in found.items()}

    # --- classes --------------------------------------------------------------------------------------------------

    def classes(self) -> StoredClasses:
        """Return all classes, to resolve names in."""
        inputs, target = self._inputs, self._inputs.robot.target
        parents = {one.path: one.content for one in inputs.parents.shared if one.content is not None}
        former = inputs.old_target.package if inputs.old_target.package != target.package else ""
        texts = _Contents(self.texts, self._content)
        around = {**self.around, **parents}
        return StoredClasses(
            target.package, inputs.files.path(inputs.folder), texts, around, self._find, self.cache.read, former
        )

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

    def _content(self, path: str) -> bytes:
        """Return what is in a file of the package, by its path below it."""
        if path not in self._read:
            one, files = self.texts[path], self._inputs.files
            if one.text is not None:
                content = encode(one.text)
            else:
                content = self._generation.content(one.key) if one.is_generated else encode(files.any_text(one.key))
            self._read[path] = self._contents.get(files.path(one.key), content) if one.is_edited else content
        return self._read[path]

    def content_of(self, file: Path) -> bytes:
        """Return what is in a file of the user's."""
        path = str(file).removeprefix(f"{self._inputs.files.path(self._inputs.folder)}{os.sep}").replace(os.sep, "/")
        return self._content(path) if path in self.texts else self.around[file]

    def is_users(self, file: str) -> bool:
        """Whether the user wrote a file, and not only edited it."""
        path = str(file).removeprefix(f"{self._inputs.files.path(self._inputs.folder)}{os.sep}").replace(os.sep, "/")
        return Path(file) in self.around or (path in self.texts and not self.texts[path].sha256)

    def names(self) -> Iterator[str]:
        """Yield the names of all classes in the package, and of what those at its top declare."""
        for path in self.texts:
            yield from self.class_name(path)[-1:]
            if "/" not in path:
                for one in self.cache.interface(self._content(path)).classes:
                    yield from (str(component.name) for component in one.components)

    def loses(self, name: str, action: Action) -> bool:
        """Whether the text that an action replaces or deletes declares a name, and the new one does not."""
        key = action.origin or action.path
        old = self._inputs.files.any_text(key) if key.endswith(".mo") else ""
        if name not in old or name not in declared_names([old]):
            return False
        path = self._inputs.path(action.path)
        return path not in self.texts or name not in declared_names([text_of(self._content(path))])

    def class_name(self, path: str) -> ClassName:
        """Return the full name of the class that a file is for, by its path below the package."""
        return (*self._inputs.robot.target.package.split("."), *class_parts(path))

    # --- findings -------------------------------------------------------------------------------------------------

    def misfits(self, only: Collection[str] | None = None, *, lost: Container[str] = ()) -> list[Misfit]:
        """Return all findings; `only` those in the files of the package with these keys.

        A `lost` name is missed although a class may inherit it from a library that is not read.
        """
        self._lost = lost
        paths = [path for path, one in self.texts.items() if one.is_edited and (only is None or one.key in only)]
        around = dict(self.around) if only is None else {}
        found: list[Misfit] = []
        if paths or around:
            classes, known = self.classes(), self.cache.known_fits
            lacking = self._users_of_lacking(paths)
            keys = {path: self._fit_key(self._content(path), classes, path) for path in (*paths, *lacking)}
            file_keys = {str(path): self._fit_key(content, classes) for path, content in around.items()}
            every = {**keys, **file_keys}
            old = {name for name, key in every.items() if name in known and self._still_fits(known[name], key, classes)}
            self.cache.fits.update((name, known[name]) for name in old)
            new = every.keys() - old
            # what an edited file lacks is told with its line, which an interface does not have
            for name in sorted(new | ({*paths} if new & {*lacking} else set())):
                self.cache.parse(self._content(name) if name in keys else around[Path(name)])
            if new:
                classes = self.classes()
                for path in keys:
                    if path in new:
                        found += self._look(path, keys[path], classes, is_generated=path in lacking)
                for name in sorted(new & file_keys.keys()):
                    found += self._look_around(Path(name), file_keys[name], classes)
            self.cache.save()
        return found

    def _fit_key(self, content: bytes, classes: StoredClasses, path: str = "") -> str:
        where = ".".join(self.class_name(path)) if path else ""
        return digest("\0".join((text_digest(content), where, *sorted(classes.libraries))).encode())

    def _still_fits(self, fit: Fit, key: str, classes: StoredClasses) -> bool:
        """Whether a file and all that it uses are as they were when it fitted."""
        if fit.key != key:
            return False
        for name, source in fit.uses.items():
            file = classes.file(tuple(name.split(".")))
            if file is None or source is None:
                if file is not None or source is not None:
                    return False
            elif self._sha256(file, classes) != source.text:
                now = self._source(file, classes)
                if now is None or now.interface != source.interface:
                    return False
        return True

    def _sha256(self, file: str, classes: StoredClasses) -> str:
        path = classes.path_below(file)
        if path in self.texts and self.texts[path].sha256:
            return self.texts[path].sha256
        source = self._source(file, classes)
        return source.text if source else ""

    def _source(self, file: str, classes: StoredClasses) -> Source | None:
        try:
            return self.cache.source(classes.content(file))
        except OSError:
            return None

    def _remember(self, name: str, key: str, file: str, classes: StoredClasses) -> None:
        """Remember that a file fits what it uses."""
        places = {used: place for used, place in classes.seen.items() if place != file}
        sources = {place: self._source(place, classes) for place in {*places.values()} if place}
        if all(sources.values()):  # else one can't be read
            uses = {".".join(used): sources[place] if place else None for used, place in places.items()}
            self.cache.fits[name] = Fit(key, uses)

    def _look(self, path: str, key: str, classes: StoredClasses, *, is_generated: bool) -> list[Misfit]:
        """Look at a file of the package; at a generated one for what others lack."""
        one, name = self.texts[path], self.class_name(path)
        file = self._inputs.files.path(one.key)
        said = check_class_file(text_of(self._content(path)), PurePosixPath(path), ".".join(name))[1]
        errors = [finding for finding in said if finding.severity is Severity.ERROR]
        found = [Misfit(file, finding, one.key, one.is_expected) for finding in errors]
        classes.seen.clear()
        scopes = Scopes(classes)
        node = scopes.node(name) if not errors else None
        uses = self._uses([node] if node else [], scopes)
        for use, finding in uses:
            if not is_generated:
                found.append(Misfit(file, finding, one.key, one.is_expected, use, self._renamed_by(use)))
            elif (lacking := scopes.node(use.owner.split("."))) and self._is_edited(lacking.file, classes):
                place = Path(lacking.file)
                message = f"it has no `{use.part}`, which {shown(file)}:{use.line} mentions"
                new = msgspec.structs.replace(finding, message=message, line=lacking.definition.name.line)
                found.append(Misfit(place, new, self._inputs.files.key(place), is_broken=True))
        if not found:
            self._remember(path, key, str(file), classes)
        return found

    def _look_around(self, path: Path, key: str, classes: StoredClasses) -> list[Misfit]:
        """Look at a file of the user's outside of the package."""
        text, nodes = self.cache.read(self.around[path]), list[Node]()
        around = tuple(text.within.split(".")) if text.within else ()
        expected = place_of(path, self.around)[1]
        if text.is_broken or (expected and around != expected):
            name = ".".join((*expected, path.parent.name if path.name == "package.mo" else path.stem))
            said = check_class_file(text_of(self.around[path]), PurePosixPath(path.name), name)[1]
            return [Misfit(path, finding) for finding in said if finding.severity is Severity.ERROR]
        classes.seen.clear()
        scopes = Scopes(classes)
        nodes = [node for node in scopes.users() if node.file == str(path)]
        found = [
            Misfit(path, finding, use=use, renamed=self._renamed_by(use)) for use, finding in self._uses(nodes, scopes)
        ]
        if not found:
            self._remember(str(path), key, str(path), classes)
        return found

    def _is_edited(self, file: str, classes: StoredClasses) -> bool:
        path = classes.path_below(file)
        return path in self.texts and self.texts[path].is_edited

    def _uses(self, nodes: Sequence[Node], scopes: Scopes) -> Iterator[tuple[Unresolved, Diagnostic]]:
        """Yield each name that means nothing, and what there is to say of it."""
        for node in nodes:
            found = unresolved(node, scopes, all_libraries=True, lost=self._lost)
            for use in sorted((one for one in found if one.kind not in _LEGAL), key=lambda one: one.line):
                hint = self._hint(use)
                yield use, Diagnostic(Severity.ERROR, "unresolved", use.message, line=use.line, hint=hint)

    # --- what generated files use of edited ones ------------------------------------------------------------------

    def _users_of_lacking(self, edited: Sequence[str]) -> list[str]:
        """Return the generated files that may use what edited ones do not have any more.

        These are files of the same elements, and those at the top of the package.
        """
        artifacts, found = self._generation.package.artifacts, list[str]()
        owners = {artifacts[path].owner for path in edited if path in artifacts and not self._has_all(path)}
        for path, one in self.texts.items() if owners else ():
            if one.is_generated and path in artifacts and (artifacts[path].owner in owners or "/" not in path):
                found.append(path)
        return found

    def _has_all(self, path: str) -> bool:
        """Whether an edited file declares all that the generated one does."""
        generated = self._generation.content(self._inputs.key(path))
        mine, wanted = (self.cache.interface(content) for content in (self._content(path), generated))
        return mine.is_broken or _declares(mine.classes, wanted.classes)

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
        if use.part == inputs.old_target.package != target.package and target.name not in use.known:
            return f"use `{target.package}` instead"
        if name := self.new_name(use):
            return f"use `{name}` instead"
        if option := inputs.domain.option_for(f"{use.part}.mo", target, inputs.robot.options):
            return brings_back(option)
        names = dict.fromkeys((use.part, *filter(None, [new_name(use.part, self._renamed, _Everything())])))
        for name in names:
            snapshot, options = self._generation.now.snapshot, inputs.robot.options
            if option := inputs.domain.option_for_connector(name, snapshot, target, options):
                return brings_back(option, name if name != use.part else "")
        if use.near:
            return f"did you mean `{use.meant}`?"
        if use.kind is UnresolvedKind.CLASS and use.is_library:
            return f'name the library in `uses` if `{use.part}` is one: annotation (uses({use.part}(version="…")))'
        return "change or remove this use"


class LostNames(Container[str]):
    """The names that a text on disk declares, and that no text in its place will declare."""

    def __init__(self, package: Package) -> None:
        self._package, self._found = package, dict[object, bool]()

    def __contains__(self, name: object) -> bool:
        if name not in self._found:
            self._found[name] = any(self._package.loses(str(name), action) for action in self._package.changed)
        return self._found[name]


class _Everything(frozenset[str]):
    """A set with every name."""

    def __contains__(self, _: object) -> bool:
        return True


class _Contents(Mapping[str, bytes]):
    """The contents of a package's files, each made when it is asked for: rendering 4,000 takes a second."""

    def __init__(self, paths: Mapping[str, object], content: Callable[[str], bytes]) -> None:
        self._paths, self._content = paths, content

    def __getitem__(self, path: str) -> bytes:
        if path not in self._paths:
            raise KeyError(path)
        return self._content(path)

    def __iter__(self) -> Iterator[str]:
        return iter(self._paths)

    def __len__(self) -> int:
        return len(self._paths)


def _declares(mine: Sequence[Class], wanted: Sequence[Class]) -> bool:
    """Whether classes have all that others can see of the wanted ones."""
    classes = {one.name.parts: one for one in mine}
    for one in wanted:
        found = classes.get(one.name.parts)
        if found is None or (found.kind, found.prefixes, found.alias) != (one.kind, one.prefixes, one.alias):
            return False
        components, extends = {str(other.name): other for other in found.components}, list(found.extends)
        if any(components.get(str(other.name)) != other for other in one.components):
            return False
        if any(base not in extends for base in one.extends) or not _declares(found.classes, one.classes):
            return False
    return True


def find_misfits(generation: Generation, actions: Sequence[Action], merged: Mapping[str, str]) -> list[Misfit]:
    """Find what does not fit in the files that the user wrote, once all actions are done but those that wait."""
    if generation.inputs.has_moved and any(action.held for action in actions):
        return []  # the package stays where it was
    return Package(generation, actions, merged).misfits()


def diagnose(generation: Generation, misfits: Sequence[Misfit]) -> Iterator[Diagnostic]:
    """Yield one finding for all places in a file that have the same fault: an error if the package is broken.

    And a note if names are known that can take the places of old ones.
    """
    inputs, places = generation.inputs, dict[tuple[object, ...], list[Misfit]]()
    outside = {one.file for one in misfits if not one.key}
    folders = {inputs.folder.rpartition("/")[2], inputs.old_folder.rpartition("/")[2]}
    users = files_that_use(inputs.users_files.mentioning, folders).keys() if outside else ()
    for one in misfits:
        if one.key or one.file in users:
            what = one.use.part if one.use else (one.finding.code, one.finding.message, one.finding.line)
            places.setdefault((one.file, what), []).append(one)
    for first, *more in places.values():
        finding = first.finding
        lines = sorted({one.finding.line for one in more} - {finding.line})
        also = f"also in line{'s' if len(lines) > 1 else ''} {', '.join(map(str, lines))}" if lines else ""
        yield msgspec.structs.replace(
            finding,
            severity=Severity.ERROR if first.is_broken else Severity.WARNING,
            file=shown(first.file),
            hint="; ".join(filter(None, (finding.hint, also))),
        )
    renamed = {one.renamed: one for group in places.values() for one in reversed(group) if one.renamed}
    if renamed:
        command = " ".join(("urdfsync resolve --rename-uses", *(f"{old}={new}" for old, new in sorted(renamed))))
        message, place = "your files can get the new names", [*renamed.values()][-1]
        hint = f"`{command}` shows the lines, and writes them if you agree"
        yield Diagnostic(Severity.NOTE, "rename-uses", message, shown(place.file), place.finding.line, hint=hint)
