"""The files of a robot's package after a build, and the user's files around it.

Separate from `fit`, which resolves names: a build of an unedited package imports no parser.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Reason
from urdfsync.engine.generation import Generation
from urdfsync.engine.package_files import encode, text_hash


def as_file(path: str) -> str:
    """Return the path of a class's file, if the class is no folder."""
    return f"{path.removesuffix('/package.mo').removesuffix('.mo')}.mo"


class _File(NamedTuple):
    """A file of the package after the build."""

    key: str
    text: str | None = None
    """The text that the build writes, if it differs from the generated one."""
    is_generated: bool = False
    is_edited: bool = False
    """Whether urdfsync wrote it and the user edited it."""
    is_users: bool = False
    """Whether the user wrote it."""
    is_expected: bool = True
    """Whether a file of this name is generated."""


class PackageAfter(Mapping[str, bytes]):
    """The files of a robot's package after a build, by their paths below it, and the user's files around it.

    Contents are made on demand: rendering 4,000 takes a second.
    """

    def __init__(
        self,
        generation: Generation,
        actions: Sequence[Action],
        merged: Mapping[str, str],
        *,
        is_open: bool = False,
    ) -> None:
        """`merged` are texts that the build writes, by key. If `is_open`, files in conflict may become anything."""
        self._generation, self._inputs, self._actions = generation, generation.inputs, actions
        self._contents, self._generated = dict[str, bytes](), set[bytes]()
        self._files = self._files_after(merged, is_open=is_open)
        orders = (one.path for one in actions if one.role is Role.ORDER and not one.is_waiting and one.path in merged)
        self._orders = {self._inputs.folder.path(key): merged[key] for key in orders}
        self.around = self._files_around()

    def _files_after(self, merged: Mapping[str, str], *, is_open: bool) -> dict[str, _File]:
        """Return the files of the package after the build, by their paths below it."""
        inputs, files, found = self._inputs, self._inputs.files, dict[str, _File]()
        inside, classes, keys = inputs.folder.key(""), set[str](), set[str]()
        for action in self._actions:
            key = action.path
            if action.reason is Reason.UNKNOWN or action.role in (Role.ORDER, Role.IMPORT):
                continue
            if not (key.endswith(".mo") and key.startswith(inside)):
                continue
            keys.add(key)
            classes |= {key} if action.generated else set()
            file = _File(key, is_expected=action.generated is not None)
            if not action.is_waiting and key in merged:
                is_edited = text_hash(merged[key]) != action.generated
                found[inputs.folder.path(key)] = file._replace(text=merged[key], is_edited=is_edited)
            elif is_open and action.is_conflict:
                found[inputs.folder.path(key)] = file._replace(text="")
            elif action.keeps_text:
                is_forgotten = action.reason is Reason.FORGET
                if (sha256 := files.hash(key, action.role)) and not is_forgotten:
                    record = inputs.last.files.get(key)
                    known = (action.generated, *(record.hashes if record else ()))
                    is_edited = action.reason is Reason.ORPHAN or sha256 not in known
                    found[inputs.folder.path(key)] = file._replace(is_edited=is_edited)
            elif not action.is_deletion:
                found[inputs.folder.path(key)] = file._replace(is_generated=True)
        for key in sorted(filter(files.can_read, files.classes(inputs.folder) - keys)):
            is_expected = as_file(key) in classes
            found[inputs.folder.path(key)] = _File(key, is_edited=True, is_users=True, is_expected=is_expected)
        return found

    def _files_around(self) -> dict[Path, bytes]:
        """Return the user's files outside of the package that may use it."""
        inputs, files = self._inputs, self._inputs.files
        found = {**inputs.users_files.mentioning}
        if inputs.has_moved:
            keys = {action.path for action in self._actions}
            rest = files.classes(inputs.last.folder) - keys - inputs.last.files.keys()
            found |= {files.path(key): encode(files.any_text(key)) for key in sorted(rest)}
        return found

    def __getitem__(self, path: str) -> bytes:
        """Return what is in a file of the package. Raises KeyError."""
        if path not in self._contents:
            file, files = self._files[path], self._inputs.files
            if file.is_generated:
                content = self._generation.package.content(path)
                self._generated.add(content)
            else:
                content = encode(files.any_text(file.key) if file.text is None else file.text)
            self._contents[path] = content
        return self._contents[path]

    def __iter__(self) -> Iterator[str]:
        return iter(self._files)

    def __len__(self) -> int:
        return len(self._files)

    @cached_property
    def users(self) -> dict[Path, bytes]:
        """Contents of all files that the user wrote or edited, by their absolute paths."""
        edited = {path: file for path, file in self._files.items() if file.is_edited}
        return {**{self._inputs.files.path(file.key): self[path] for path, file in edited.items()}, **self.around}

    @cached_property
    def extended_orders(self) -> dict[str, tuple[str, set[str]]]:
        """Each `package.order` that names classes of the user's, by path: its text, and the lines with these names."""
        inputs, files, orders = self._inputs, self._inputs.files, self._generation.package.orders
        users = [f"{path.removesuffix('.mo')}.order" for path, file in self._files.items() if file.is_users]
        texts = {path: files.any_text(inputs.folder.key(path)) for path in users if path.endswith("package.order")}
        found = dict[str, tuple[str, set[str]]]()
        for path, text in (texts | self._orders).items():
            if lines := {line.strip() for line in text.split("\n")} - {"", *orders.get(path, ())}:
                found[path] = text, lines
        return found
