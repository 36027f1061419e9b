"""How the verdicts of a hook look: a line for each robot, and commands to copy. Short, and without rich."""

from __future__ import annotations

import os
import shlex
from collections.abc import Callable, Collection, Iterator, Sequence
from pathlib import Path

from urdfsync import wording
from urdfsync.config import FILE_NAME
from urdfsync.staging.verdict import Verdict

_FEW = 5
"""So many files are named one by one."""


class Place:
    """Where the user is, and what commands have to know because of that."""

    def __init__(self, top: Path, folder: Path, pending: Callable[[str], Collection[str]]) -> None:
        """`top` is that of the repository, `folder` where the user types.

        `pending` gives all files below a folder that `git add` would take with it; all by their path from the top.
        """
        self._top, self._folder, self._pending = top, folder, pending

    def shown(self, path: Path | str) -> str:
        """A path as the user would type it; a text is one of the repository."""
        text = os.path.relpath(self._top / path, self._folder)
        return f"./{text}" if text.startswith("-") else text

    def add(self, verdicts: Sequence[Verdict], ignored: Collection[str]) -> str:
        """The command that stages what verdicts name; `ignored` files have to be forced."""
        paths = sorted({path for verdict in verdicts for path in verdict.add})
        if not set(ignored).isdisjoint(paths):
            return shlex.join(["git", "add", "-f", *map(self.shown, paths)])
        folders = {folder for verdict in verdicts for folder in verdict.folders}
        return shlex.join(["git", "add", *map(self.shown, self._folded(paths, folders))])

    def build(self, verdicts: Sequence[Verdict]) -> str:
        """The commands that build what verdicts name, one for each configuration."""
        commands = []
        for file in dict.fromkeys(verdict.config for verdict in verdicts):
            robots = [verdict.robot for verdict in verdicts if verdict.config == file]
            near = next((f for f in (self._folder, *self._folder.parents) if (f / FILE_NAME).is_file()), None)
            option = [] if near is not None and near / FILE_NAME == file else ["--config", self.shown(file)]
            commands.append(shlex.join(["urdfsync", "build", *robots, *option]))
        return " && ".join(commands)

    def _folded(self, paths: Sequence[str], folders: Collection[str]) -> list[str]:
        """The paths; if they are many, folders instead of those in which nothing else would be added."""
        found = list(paths)
        for folder in sorted(folders) if len(paths) > _FEW else ():
            inside = {path for path in found if path.startswith(f"{folder}/")}
            if len(inside) > 1 and inside.issuperset(self._pending(folder)):
                found = [folder, *(path for path in found if path not in inside)]
        return sorted(found)


def lines(verdicts: Sequence[Verdict], place: Place, ignored: Collection[str]) -> Iterator[str]:
    """Everything that there is to say of robots that are not in step, or not staged."""
    several = len({verdict.config for verdict in verdicts}) > 1
    for verdict in verdicts:
        name = f"{verdict.robot} ({place.shown(verdict.config)})" if several else verdict.robot
        yield wording.visible(f"{name}: {words(verdict, place)}")
    for advice, command in steps(verdicts, place, ignored):
        yield wording.visible(advice)
        yield wording.visible(f"  {command}")


def steps(verdicts: Sequence[Verdict], place: Place, ignored: Collection[str]) -> Iterator[tuple[str, str]]:
    """What to do, and the command for it."""
    ready = [verdict for verdict in verdicts if verdict.add and not verdict.waits]
    if ready:
        yield "add to the commit:", place.add(ready, ignored)
    waiting = [verdict for verdict in verdicts if verdict.waits and not verdict.troubled]
    if not waiting:
        return
    hindering = sorted({path for verdict in waiting for path in verdict.hindered})
    advice = "build, then add to the commit:"
    if hindering:
        files = shlex.join(map(place.shown, hindering))
        advice = f"stage the changes (git add {files}) or put them aside (git stash push --keep-index), then build:"
    yield advice, f"{place.build(waiting)} && {place.add(waiting, ignored)}"


def words(verdict: Verdict, place: Place) -> str:
    """What is wrong, as the rest of a line that names the robot."""
    result = verdict.result
    if result is None:
        number = len(verdict.add)
        return f"in step on disk, but {'1 file is' if number == 1 else f'{number} files are'} not staged"
    if verdict.troubled:
        return wording.summary(result)
    what = "what urdfsync recorded of it is out of date" if result.in_step else wording.summary(result)
    if not verdict.hindered:
        return f"out of step: {what}"
    files = ", ".join(map(place.shown, verdict.hindered))
    return f"out of step: {what}; {files} {'has' if len(verdict.hindered) == 1 else 'have'} changes that are not staged"
