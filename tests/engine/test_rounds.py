"""Build after build, with a user who edits in between: everything pure that decides about files, on files in memory.

A text stands for its own hash here, so that a recorded base is the text itself.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Collection, Mapping
from typing import Any

import msgspec
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, rule

from urdfsync import changes
from urdfsync.domain import Role
from urdfsync.engine.actions import DISPUTED, Action, Kind, Reason
from urdfsync.engine.conflicts import Conflict, find_conflict, resolve
from urdfsync.engine.rules import (
    CLASS_FOLDER,
    File,
    OnDisk,
    decide,
    files_after,
    hold,
    keep_needed,
    pending_choices,
    valid_choices,
)
from urdfsync.modelica.literals import numbers_only
from urdfsync.state.record import Choice, FileRecord, UsersChoice

NAMES = ("Arm", "Base", "Cap")
MAIN, PACKAGE = "Main.mo", "package.mo"


@dataclasses.dataclass(frozen=True)
class Part:
    """An element of the model: its law shapes its files, its number does not."""

    name: str
    law: str = "v = i"
    number: int = 1

    @property
    def owner(self) -> str:
        return f"part {self.name}"


def package(parts: Collection[Part]) -> dict[str, File]:
    """The files of a model, by path."""
    files = {}
    for name, law, number in map(dataclasses.astuple, parts):
        owner, record = f"part {name}", f"{name}Parameters"
        text = f"model {name}\n\n  {record} p;\n\nequation\n\n  {law};\n\nend {name};\n"
        files[f"{name}.mo"] = File(Role.MODEL, owner, generated=text)
        text = f"record {record}\n\n  Real {law[0]} = {number};\n\nend {record};\n"
        files[f"{record}.mo"] = File(Role.RECORD, owner, generated=text)
    used = "".join(f"  {name} {name.lower()};\n\n" for name in sorted(part.name for part in parts))
    files[MAIN] = File(Role.MODEL, "robot", generated=f"model Main\n\n{used}end Main;\n")
    files[PACKAGE] = File(Role.PACKAGE, "robot", generated="package P\nend P;\n")
    return files


def template(path: str) -> str:
    """What stands for the template that a file is made from."""
    return path if path in (MAIN, PACKAGE) else "record" if path.endswith("Parameters.mo") else "model"


def as_folder(path: str) -> str:
    """Where a class is if the user made a folder of it."""
    return f"{path.removesuffix('.mo')}/{PACKAGE}"


def edits(texts: Collection[str]) -> set[str]:
    """The lines and ends of lines that are the user's."""
    return set(re.findall(r"// mine \d+", "".join(texts)))


class Project:
    """A model, its package, and what is recorded of it; elements by a number that stays when they are renamed."""

    def __init__(self) -> None:
        self.parts: dict[int, Part] = {}
        self.files: dict[str, str] = {}
        self.recorded: dict[str, FileRecord] = {}
        self.pending: dict[str, UsersChoice] = {}
        self.merging = False
        self._complete: dict[int, Part] = {}
        """The model of the last complete build."""

    def moves(self) -> dict[str, str]:
        """New and old path of every file whose element has another name; see `Generation`."""
        before, now = package(self._complete.values()), package(self.parts.values())
        renames = {("part", old.name): self.parts[key].name for key, old in self._complete.items() if key in self.parts}
        old = {path: (file.owner, template(path)) for path, file in before.items() if path in self.recorded}
        renamed = changes.moved_files(old, {path: (file.owner, template(path)) for path, file in now.items()}, renames)
        pairs = ((renamed.get(path, path), path) for path in self.recorded)
        return {new: path for new, path in pairs if new != path and new in now}

    def build(self, choices: Mapping[str, Choice] | None = None) -> tuple[Action, ...]:
        """Plan, write and record."""
        wanted = package(self.parts.values())
        actions, merged = self._decide(wanted, choices or {})
        for action in actions:
            if action.writes and action.kind is Kind.DELETE:
                del self.files[action.path]
        for action in actions:
            if action.writes and action.kind is not Kind.DELETE:
                self.files[action.path] = merged.get(action.path) or wanted[action.path].generated or ""
        is_complete = not any(action.held or action.kind is Kind.CONFLICT for action in actions)
        self.recorded = files_after(actions, self.recorded, is_complete=is_complete)
        self.pending = {} if is_complete else pending_choices(actions, merged)
        if is_complete:
            self._complete = dict(self.parts)
        return actions

    def _decide(
        self, wanted: Mapping[str, File], choices: Mapping[str, Choice]
    ) -> tuple[tuple[Action, ...], dict[str, str]]:
        """The actions, and the texts that are merged; see `decide`."""
        last = package(self._complete.values())
        files = {}
        for path in wanted.keys() | self.recorded.keys():
            file = wanted.get(path) or last.get(path) or File(Role.RECORD, "")
            generated = file.generated if path in wanted else None
            record = self.recorded.get(path, FileRecord())
            files[path] = File(file.role, file.owner, record, self._found(path), generated)
        planned = decide(files, self.moves())
        conflicts = {a.path: self._conflict(a) for a in planned if a.reason in DISPUTED}
        sides = {one.path: one.sides for one in planned}
        now = {path: UsersChoice(choice, sides[path]) for path, choice in choices.items() if path in sides}
        made = {**valid_choices(self.pending, planned, is_pending=True), **now}
        resolved, merged = resolve(planned, conflicts, made, self.merging)
        actions = keep_needed(
            [msgspec.structs.replace(action, result=merged.get(action.path)) for action in resolved],
            lambda path, gone: any(file not in gone and file != path for file in self.files),
            (),
        )
        records = [a for a in actions if a.reason in (Reason.UPDATE, Reason.MERGE) and a.role is Role.RECORD]
        texts = {a.path: (self.files[a.path], merged.get(a.path) or wanted[a.path].generated or "") for a in records}
        numbers = {path for path, (old, new) in texts.items() if numbers_only(old, new)}
        return hold(actions, numbers, self.moves().values(), moves=False), merged

    def _found(self, path: str) -> OnDisk:
        if path in self.files:
            return self.files[path]
        return CLASS_FOLDER if path != PACKAGE and as_folder(path) in self.files else None

    def _conflict(self, action: Action) -> Conflict:
        place, generated = action.origin or action.path, action.generated or ""
        if place in self.files:
            return find_conflict(action, [action.base] if action.base else [], self.files[place], generated)
        return Conflict(action.path, action.owner, action.base, self.files[as_folder(place)], generated, None)


def waiting(actions: Collection[Action]) -> list[str]:
    """The files that conflict."""
    return [action.path for action in actions if action.kind is Kind.CONFLICT]


class Rounds(RuleBasedStateMachine):
    """Anything may happen to source and files between two builds, again and again."""

    picks = st.integers(0, 99)

    def __init__(self) -> None:
        super().__init__()
        self.project = Project()
        self._count = 0

    @initialize(merging=st.booleans())
    def begin(self, merging: bool) -> None:
        self.project.merging = merging
        self.project.parts = {-1: Part("Arm"), -2: Part("Base")}
        assert not waiting(self.project.build())

    # The source

    @rule(pick=picks)
    def add(self, pick: int) -> None:
        if free := self._free():
            self.project.parts[self._number()] = Part(free[pick % len(free)])

    @rule(pick=picks)
    def remove(self, pick: int) -> None:
        for key in self._some(self.project.parts, pick):
            del self.project.parts[key]

    @rule(pick=picks, to=picks)
    def rename(self, pick: int, to: int) -> None:
        free = self._free()
        for key in self._some(self.project.parts, pick) if free else ():
            self.project.parts[key] = dataclasses.replace(self.project.parts[key], name=free[to % len(free)])

    @rule()
    def turn_names_round(self) -> None:
        keys, parts = list(self.project.parts), list(self.project.parts.values())
        for key, part in zip(keys, [*parts[1:], *parts[:1]], strict=True):
            self.project.parts[key] = dataclasses.replace(self.project.parts[key], name=part.name)

    @rule(pick=picks, law=st.sampled_from(["v = i", "i = v"]), number=st.integers(1, 3))
    def change(self, pick: int, law: str, number: int) -> None:
        for key in self._some(self.project.parts, pick):
            self.project.parts[key] = dataclasses.replace(self.project.parts[key], law=law, number=number)

    # The user

    @rule(pick=picks, at=picks)
    def insert_a_line(self, pick: int, at: int) -> None:
        for path in self._some(self.project.files, pick):
            before, *rest = re.split(r"(?<=\n)(?=\n)", self.project.files[path])
            rest.insert(at % (len(rest) + 1), f"\n  // mine {self._number()}\n")
            self.project.files[path] = "".join([before, *rest])

    @rule(pick=picks, at=picks)
    def change_a_line(self, pick: int, at: int) -> None:
        for path in self._some(self.project.files, pick):
            lines = self.project.files[path].splitlines()
            lines[at % len(lines)] += f" + 1 // mine {self._number()}"
            self.project.files[path] = "\n".join(lines) + "\n"

    @rule(pick=picks)
    def delete(self, pick: int) -> None:
        for path in self._some(self.project.files, pick):
            del self.project.files[path]

    @rule(pick=picks)
    def make_a_folder_of(self, pick: int) -> None:
        for path in self._some([path for path in self.project.files if "/" not in path and path != PACKAGE], pick):
            if as_folder(path) not in self.project.files:
                self.project.files[as_folder(path)] = self.project.files.pop(path)

    @rule(pick=picks, to=st.sampled_from([f"{name}{end}.mo" for name in NAMES for end in ("", "Parameters")]))
    def move_by_hand(self, pick: int, to: str) -> None:
        for path in self._some([path for path in self.project.files if path != PACKAGE], pick):
            if to not in self.project.files and as_folder(to) not in self.project.files:
                self.project.files[to] = self.project.files.pop(path)

    # The build

    @rule()
    def build(self) -> None:
        self._build({})

    @rule(choices=st.lists(st.sampled_from(Choice), min_size=1, max_size=3))
    def resolve(self, choices: list[Choice]) -> None:
        conflicts = waiting(self._build({}))
        self._build(dict(zip(conflicts, choices, strict=False)))

    @rule(choice=st.sampled_from([Choice.KEEP, Choice.TAKE]))
    def resolve_all(self, choice: Choice) -> None:
        """Once every conflict is resolved, nothing waits, and the package is complete."""
        conflicts = waiting(self._build({}))
        actions = self._build(dict.fromkeys(conflicts, choice))
        conflicts = waiting(actions)
        assert choice is Choice.TAKE or not conflicts
        assert all(as_folder(path) in self.project.files for path in conflicts), "only a folder can't be taken away"
        if not conflicts:
            files = self.project.files
            assert not any(action.held for action in actions)
            assert not self.project.pending
            assert all(path in files or as_folder(path) in files for path in package(self.project.parts.values()))

    def _build(self, choices: Mapping[str, Choice]) -> tuple[Action, ...]:
        project = self.project
        before, hashes = dict(project.files), dict(project.recorded)
        actions = project.build(choices)
        self._nothing_is_lost(before, hashes, actions)
        self._structure_is_all_or_nothing(actions)
        files, recorded = dict(project.files), project.recorded
        again = project.build()
        assert project.files == files, "the next build finds nothing to write"
        assert project.recorded == recorded
        assert waiting(again) == waiting(actions)
        return actions

    def _nothing_is_lost(
        self, before: Mapping[str, str], recorded: Mapping[str, FileRecord], actions: Collection[Action]
    ) -> None:
        taken = {a.origin or a.path for a in actions if a.choice in (Choice.TAKE, Choice.MERGE_GENERATED) and a.writes}
        kept = edits([text for path, text in before.items() if path not in taken])
        assert kept <= edits(self.project.files.values())
        moved = {action.origin for action in actions if action.reason is Reason.MOVE and action.writes}
        for action in actions:
            if action.writes and action.path in before and action.path not in taken | moved:
                known = action.base, *recorded.get(action.path, FileRecord()).hashes
                assert action.reason is Reason.MERGE or before[action.path] in known

    def _structure_is_all_or_nothing(self, actions: Collection[Action]) -> None:
        if waiting(actions):
            written = [action for action in actions if action.writes]
            assert all(action.role is Role.RECORD or action.reason is Reason.RESTORE for action in written)
            assert not any(action.kind is Kind.DELETE for action in written)
            left = set(self.project.moves().values())
            restored = [one for one in actions if one.reason is Reason.RESTORE and one.base == one.generated]
            assert all(one.writes for one in restored if one.origin is None and one.path not in left)

    @invariant()
    def no_markers_are_in_any_file(self) -> None:
        assert not any("<<<<<<<" in text for text in self.project.files.values())

    def _number(self) -> int:
        self._count += 1
        return self._count

    def _free(self) -> list[str]:
        return [name for name in NAMES if name not in {part.name for part in self.project.parts.values()}]

    def _some(self, things: Collection[Any], pick: int) -> list[Any]:
        return [sorted(things)[pick % len(things)]] if things else []


TestRounds = Rounds.TestCase
TestRounds.settings = settings(max_examples=120, stateful_step_count=20, deadline=None)
