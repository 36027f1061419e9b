"""Keeps files that are no longer generated, but that the user's texts need."""

from __future__ import annotations

import itertools
import re
from collections.abc import Mapping, Sequence

import msgspec

from urdfsync.domain import Role
from urdfsync.engine.actions import Action, Reason
from urdfsync.engine.generation import Generation
from urdfsync.engine.package_after import PackageAfter
from urdfsync.engine.package_files import encode
from urdfsync.engine.package_names import class_of
from urdfsync.modelica.files import code_of, text_of

_CLASS_KINDS = frozenset({"block", "class", "connector", "function", "model", "package", "record", "type"})


def code_words(content: bytes) -> set[str]:
    """Return all names and keywords in a text, without strings, comments, its own classes and its packages.

    Its own classes are left out because an edited file may still have the old name of its class, and its packages
    because a package may have the name of the robot's model. The text need not be valid Modelica.
    """
    code = re.sub(r"\A\ufeff?\s*within\b[^;]*;", "", text_of(code_of(content)))
    words = re.findall(r"[^\W\d]\w*", code)
    return set(words) - {name for kind, name in itertools.pairwise(words) if kind in _CLASS_KINDS}


def keep_needed(generation: Generation, actions: Sequence[Action], merged: Mapping[str, str]) -> tuple[Action, ...]:
    """Keep files that the user's files need: records, their meshes, and the `package.mo` of a folder with classes."""
    deleted = {action.path: action.role for action in actions if action.is_deletion}
    kept = set[str]()
    if any(action.reason is Reason.DELETE and action.role is Role.RECORD for action in actions):
        kept |= _find_mentioned(generation, actions, merged)
    packages = [path for path, role in deleted.items() if role is Role.PACKAGE]
    for path in sorted(packages, key=lambda path: path.count("/"), reverse=True):  # innermost first
        if generation.inputs.files.has_classes(path, deleted.keys() - kept):
            kept.add(path)
    return tuple(
        msgspec.structs.replace(action, reason=Reason.NEEDED) if action.path in kept else action for action in actions
    )


def _find_mentioned(generation: Generation, actions: Sequence[Action], merged: Mapping[str, str]) -> frozenset[str]:
    """Return the files that are no longer generated and that the user's texts need.

    These are records that his texts or edited files mention, except records of renamed elements: his texts get the new
    name. A kept file keeps all files that it mentions; these keep the files that they mention, and so on.
    """
    inputs, before = generation.inputs, generation.inputs.last.package
    package = PackageAfter(generation, actions, merged)
    words = {inputs.files.key(file): code_words(content) for file, content in package.users.items()}
    all_words = set().union(*words.values())
    # the user kept these files with the names of older generated texts
    kept_words = set[str]()
    for key in {action.path for action in actions if action.reason is Reason.KEEP} & words.keys():
        if before is not None and (path := inputs.last.folder.path(key)) in before.artifacts:
            kept_words |= words[key] & code_words(before.content(path))
    pending = {action.path: action.role for action in actions if action.reason is Reason.DELETE}
    needed = set[str]()
    for path, role in pending.items():
        was_needed = before is not None and inputs.last.folder.path(path) not in before.artifacts
        is_record = role is Role.RECORD and path not in generation.moves.values()
        if path.endswith(".mo") and class_of(path) in (all_words if is_record or was_needed else kept_words):
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
