"""`urdfsync resolve --rename-uses`: the user's models follow new names, after they have been shown."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Mapping
from pathlib import Path

from urdfsync.api import build_and_check, load
from urdfsync.commands import arguments
from urdfsync.config.trust import find_untrusted_file, find_untrusted_output
from urdfsync.diagnostics import ConfigError, Diagnostic, OutputError, Severity
from urdfsync.engine.rename_uses import RenamedUses, rename_uses
from urdfsync.engine.result import Exit, exit_code
from urdfsync.files import failure, shown
from urdfsync.output.conflicts import difference_lines
from urdfsync.output.console import Console, StyledLine, line
from urdfsync.output.results import show_result
from urdfsync.spelling import counted
from urdfsync.state.transaction import save


def run(args: argparse.Namespace, console: Console) -> int:
    """Show the lines that change; if the user agrees, write them and build the robots whose names are new by that."""
    given = dict(_pair(args.parser, text) for text in args.rename_uses)
    loaded = load(args.config)
    robots = loaded.select(args.robot or [])
    renamed = rename_uses(loaded, robots, arguments.request(args, console, dry=True), given)
    if renamed.unknown:
        names = " or ".join(f"`{name}`" for name in sorted(renamed.unknown))
        raise arguments.UsageError(args.parser, f"no package has a name that begins with {names}")
    told, code = [*_conflicting(renamed), *_uncertain(renamed)], Exit.CONFLICT if renamed.conflicting else Exit.IN_STEP
    if not (renamed.texts or renamed.conflicting or renamed.uncertain):
        message = "none of your models uses a name that is known to have another one now"
        hint = "" if given else "give names that an earlier build renamed: --rename-uses OLD=NEW"
        told.append(Diagnostic(Severity.NOTE, "no-old-names", message, hint=hint))
    console.warnings([*told, *(_notes(renamed) if console.is_document else ())])
    console.tell(_lines(renamed))
    if not renamed.texts or args.dry_run:
        return console.end(code)
    if not args.trusted:
        outputs = (find_untrusted_output(loaded, robot) for robot in renamed.robots)
        if untrusted := [*filter(None, (*outputs, *(find_untrusted_file(loaded, path) for path in renamed.texts)))]:
            raise ConfigError(*untrusted)
    count = f"{counted(len(list(_changed_lines(renamed))), 'line')} in {counted(len(renamed.texts), 'file')}"
    builds = f", and build {', '.join(robot.name for robot in renamed.robots)}" if renamed.robots else ""
    if not (args.yes or arguments.is_confirmed(f"Write {count}{builds}?", "written", console)):
        return console.end(Exit.OUT_OF_STEP)
    _write(renamed.texts)
    console.tell([line((f"{count} written", ""))])
    results = []
    for result in build_and_check(loaded, renamed.robots, arguments.request(args, console)):
        show_result(console, result)
        results.append(result)
    return console.end(exit_code(results) or code)


def _pair(parser: argparse.ArgumentParser, text: str) -> tuple[str, str]:
    """The old name and the new one."""
    old, sign, new = text.partition("=")
    if not (old and sign and new):
        raise arguments.UsageError(parser, f"`{text}` is not OLD=NEW", "for example --rename-uses elbow=wrist")
    return old, new


def _conflicting(renamed: RenamedUses) -> Iterator[Diagnostic]:
    for robot in renamed.conflicting:
        message = f"files of `{robot}` are in conflict, so its names stay as they are"
        hint = "resolve them first; the build that follows says which uses are left"
        yield Diagnostic(Severity.WARNING, "conflicts-first", message, hint=hint)


def _uncertain(renamed: RenamedUses) -> Iterator[Diagnostic]:
    for path, use, new in renamed.uncertain:
        why = "may not be what it was" if new in use.candidates else "means nothing there"
        message = f"`{use.part}` in `{use.name}` stays: `{new}` {why}"
        hint = "change it by hand if it means the robot"
        yield Diagnostic(Severity.WARNING, "old-name-left", message, shown(path), use.line, hint=hint)


def _changed_lines(renamed: RenamedUses) -> Iterator[tuple[Path, int, str, str]]:
    """Each line that changes: its file, its number, its old and its new text."""
    for path, contents in renamed.texts.items():
        old, new = (content.decode(errors="replace").split("\n") for content in contents)
        for number, (before, after) in enumerate(zip(old, new, strict=True), start=1):
            if before != after:
                yield path, number, before.strip(), after.strip()


def _notes(renamed: RenamedUses) -> Iterator[Diagnostic]:
    for path, number, old, new in _changed_lines(renamed):
        yield Diagnostic(Severity.NOTE, "renamed-use", f"`{old}` becomes `{new}`", shown(path), number)


def _lines(renamed: RenamedUses) -> Iterator[StyledLine]:
    for path, contents in renamed.texts.items():
        old, new = (content.decode(errors="replace") for content in contents)
        yield from difference_lines(old, new, shown(path), shown(path))


def _write(texts: Mapping[Path, tuple[bytes, bytes]]) -> None:
    """Write all files but those that were saved since they were shown. Raises OutputError for these."""
    problems, written = list[Diagnostic](), 0
    for path, (old, new) in texts.items():
        try:
            save(path, old, new)
            written += 1
        except OutputError as error:
            problems += error.diagnostics
        except OSError as error:
            problems += failure(error, path).diagnostics
    if problems:
        note = Diagnostic(Severity.NOTE, "written-in-part", f"{counted(written, 'other file')} written, nothing built")
        raise OutputError(*problems, note)
