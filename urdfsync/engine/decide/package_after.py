"""The files of a robot's package after a build, the user's files around the package, and files that these need.

This module needs no parser, unlike `fit`, which resolves names: a build of an unedited package does not load `fit`.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import msgspec

from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Reason, find_deletions
from urdfsync.engine.decide.package_names import class_of, identifier_of
from urdfsync.engine.inspect.inputs import Inputs
from urdfsync.engine.inspect.package_files import encode, text_hash
from urdfsync.engine.package.generate import Package
from urdfsync.modelica.files import as_file, code_of, text_of

_CLASS_KINDS = frozenset({"block", "class", "connector", "function", "model", "package", "record", "type"})


class FileAfter(NamedTuple):
    """A file of the package after the build."""

    key: str
    text: str | None = None
    """The text that the build writes; None for the generated text or the text on disk."""
    is_generated: bool = False
    is_edited: bool = False
    """Whether the text is the user's: an edit of a generated file, or a file of the user's own."""
    is_users: bool = False
    """Whether the file is the user's own."""
    is_expected: bool = True
    """Whether a file of this name is generated."""


class PackageAfter(Mapping[str, bytes]):
    """The files of a robot's package after a build, by their paths below it, and the user's files around it.

    Contents are read or rendered on demand: rendering 4,000 texts takes a second.
    """

    def __init__(
        self,
        inputs: Inputs,
        package: Package,
        actions: Sequence[Action],
        merged: Mapping[str, str],
        *,
        conflicts_empty: bool = False,
    ) -> None:
        """`package` is the generated package, `merged` has texts that the build writes, by key.

        If `conflicts_empty`, files in conflict count as empty.
        """
        self.inputs, self.package, self.actions = inputs, package, actions
        self.merged, self.conflicts_empty = merged, conflicts_empty
        self._contents, self._generated = dict[str, bytes](), set[bytes]()

    @cached_property
    def files(self) -> dict[str, FileAfter]:
        """The files of the package after the build, by their paths below it."""
        inputs, files, merged, found = self.inputs, self.inputs.files, self.merged, dict[str, FileAfter]()
        inside, classes, keys = inputs.folder.key(""), set[str](), set[str]()
        for action in self.actions:
            key = action.path
            if action.reason is Reason.UNKNOWN or action.role in (Role.ORDER, Role.IMPORT):
                continue
            if not (key.endswith(".mo") and key.startswith(inside)):
                continue
            keys |= {key, *filter(None, [action.origin])}
            classes |= {key} if action.generated else set()
            file = FileAfter(key, is_expected=action.generated is not None)
            if not action.is_waiting and key in merged:
                is_edited = text_hash(merged[key]) != action.generated
                found[inputs.folder.path(key)] = file._replace(text=merged[key], is_edited=is_edited)
            elif action.is_conflict and self.conflicts_empty:
                found[inputs.folder.path(key)] = file._replace(text="")
            elif action.keeps_text:
                present, is_forgotten = action.origin or key, action.reason is Reason.FORGET
                if (sha256 := files.hash(present, action.role)) and not is_forgotten:
                    known = (action.generated, inputs.last.files.get(present))
                    is_edited = action.reason is Reason.ORPHAN or sha256 not in known
                    found[inputs.folder.path(present)] = file._replace(key=present, is_edited=is_edited)
            elif not action.is_deletion:
                found[inputs.folder.path(key)] = file._replace(is_generated=True)
        for key in sorted(filter(files.can_read, files.classes(inputs.folder) - keys)):
            is_expected = as_file(key) in classes
            text = merged.get(key)
            found[inputs.folder.path(key)] = FileAfter(
                key, text, is_edited=True, is_users=True, is_expected=is_expected
            )
        return found

    @cached_property
    def around(self) -> dict[Path, bytes]:
        """The user's files outside of the package that may use the package."""
        inputs, files = self.inputs, self.inputs.files
        found = {**inputs.users_files.mentioning}
        if inputs.has_moved:
            inside = {key for key in files.classes(inputs.last.folder) if key.startswith(inputs.folder.key(""))}
            rest = files.classes(inputs.last.folder) - find_deletions(self.actions) - inside
            found |= {files.path(key): encode(files.any_text(key)) for key in sorted(rest)}
        return found

    def __getitem__(self, path: str) -> bytes:
        """Return the content of a file of the package. Raises KeyError."""
        if path not in self._contents:
            file, files = self.files[path], self.inputs.files
            if file.is_generated:
                content = self.package.content(path)
                self._generated.add(content)
            else:
                content = encode(files.any_text(file.key) if file.text is None else file.text)
            self._contents[path] = content
        return self._contents[path]

    def is_generated(self, content: bytes) -> bool:
        """Return whether a content that was looked up is that of an unedited generated file."""
        return content in self._generated

    def __iter__(self) -> Iterator[str]:
        return iter(self.files)

    def __len__(self) -> int:
        return len(self.files)

    @cached_property
    def users(self) -> dict[Path, bytes]:
        """Contents of all files that the user wrote or edited, by their absolute paths."""
        edited = {path: file for path, file in self.files.items() if file.is_edited}
        return {**{self.inputs.files.path(file.key): self[path] for path, file in edited.items()}, **self.around}

    def mentions(self, keys: Collection[str], identifiers: Collection[str]) -> bool:
        """Return whether one of the user's files with these keys has a word that begins with an identifier."""
        key, users = self.inputs.files.key, self.users.items()
        words = set().union(*(code_words(content) for path, content in users if key(path) in keys))
        return any(identifier_of(word, identifiers) for word in words)

    @cached_property
    def differing(self) -> dict[str, tuple[str, str]]:
        """The generated text and the text of each file that differ, by the path below the package.

        A class that the user turned into a folder has the path of its file. For a class of the user's own, the
        generated text is empty.
        """
        generated, found = self.package.artifacts, dict[str, tuple[str, str]]()
        for path, file in self.files.items():
            place = path if path in generated else as_file(path)
            source = text_of(self.package.content(place)) if place in generated else ""
            if not file.is_generated and (text := text_of(self[path])) != source:
                found[place] = source, text
        return found

    @cached_property
    def extended_orders(self) -> dict[str, tuple[str, set[str]]]:
        """Each `package.order` with names of the user's classes, by path: its text, and the lines with these names."""
        inputs, files, orders, merged = self.inputs, self.inputs.files, self.package.orders, self.merged
        # the orders around the package name other robots, too
        orders_inside = (
            one for one in self.actions if one.role is Role.ORDER and one.path.startswith(inputs.folder.key(""))
        )
        written = (one.path for one in orders_inside if not one.is_waiting)
        users = [f"{path.removesuffix('.mo')}.order" for path, file in self.files.items() if file.is_users]
        texts = {path: files.any_text(inputs.folder.key(path)) for path in users if path.endswith("package.order")}
        texts |= {inputs.folder.path(key): merged[key] for key in written if key in merged}
        found = dict[str, tuple[str, set[str]]]()
        for path, text in texts.items():
            if lines := {line.strip() for line in text.split("\n")} - {"", *orders.get(path, ())}:
                found[path] = text, lines
        return found


def keep_needed(after: PackageAfter, present: Collection[tuple[str, str]]) -> tuple[Action, ...]:
    """Return the actions; keep files that the user's files need.

    Needed files are records, their meshes, and the `package.mo` of a folder with classes. `present` has the id and
    the class of each generated file: what is left of one of these in another folder is not needed.
    """
    actions, deleted, kept = after.actions, find_deletions(after.actions), set[str]()
    if any(action.reason is Reason.DELETE and action.role is Role.RECORD for action in actions):
        kept |= _find_mentioned(after, present)
    packages = {action.origin or action.path: action for action in actions if action.role is Role.PACKAGE}
    for path in sorted(packages.keys() & deleted, key=lambda path: path.count("/"), reverse=True):  # innermost first
        is_in_place = path.endswith("/package.mo")  # the user may have given the file another name
        if is_in_place and after.inputs.files.has_classes(path, deleted - kept):
            kept.add(path)
    hashes = {key: after.inputs.files.hash(key, Role.PACKAGE) for key in packages}
    stays = {  # an action that brings its text to another path leaves this file
        key: msgspec.structs.replace(action, path=key, origin=None, generated=None, mine=hashes[key])
        for key, action in packages.items()
    }
    stays |= {action.path: action for action in actions if action.path in kept}
    needed = [msgspec.structs.replace(stays[path], reason=Reason.NEEDED) for path in sorted(kept)]
    return *(action for action in actions if action.path not in kept), *needed


def code_words(content: bytes) -> set[str]:
    """Return all names and keywords in a text, without strings, comments, its own classes and its `within` clause.

    Its own classes are left out: an edited file may have the old name of its class. The `within` clause is left out: a
    package may have the name of the robot's model. The text need not be valid Modelica.
    """
    code = re.sub(r"\A\ufeff?\s*within\b[^;]*;", "", text_of(code_of(content)))
    words = re.findall(r"[^\W\d]\w*", code)
    return set(words) - {name for kind, name in itertools.pairwise(words) if kind in _CLASS_KINDS}


def _find_mentioned(after: PackageAfter, present: Collection[tuple[str, str]]) -> frozenset[str]:
    """Return the files that are no longer generated, but that the user's texts need.

    The user's texts need the records that they mention. A kept file needs all files that it mentions; these need the
    files that they mention, and so on.
    """
    inputs, before, actions = after.inputs, after.inputs.last.package, after.actions
    words = {inputs.files.key(file): code_words(content) for file, content in after.users.items()}
    all_words = set().union(*words.values())
    # names of older generated texts in files that the user kept
    kept_words = set[str]()
    for key in {action.path for action in actions if action.reason is Reason.KEEP} & words.keys():
        if before is not None and (path := inputs.last.folder.path(key)) in before.artifacts:
            kept_words |= words[key] & code_words(before.content(path))
    deleted = (action for action in actions if action.reason is Reason.DELETE)
    pending = {
        action.path: action.role
        for action in deleted
        if (stamp := inputs.files.stamp(action.path)) is None or (stamp.id, class_of(action.path)) not in present
    }
    needed = set[str]()
    for path, role in pending.items():
        was_needed = before is not None and inputs.last.folder.path(path) not in before.artifacts
        if path.endswith(".mo") and class_of(path) in (all_words if role is Role.RECORD or was_needed else kept_words):
            needed.add(path)
    all_needed = set(needed)
    while needed:
        texts = [*map(inputs.files.any_text, needed)]
        mentioned = set().union(*(code_words(encode(text)) for text in texts))
        needed = {
            path
            for path in pending.keys() - all_needed
            if (
                class_of(path) in mentioned
                if path.endswith(".mo")
                else any(inputs.last.folder.path(path) in text for text in texts)  # such as a mesh
            )
        }
        all_needed |= needed
    return frozenset(all_needed)
