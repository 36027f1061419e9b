"""`urdfsync resolve --edit`: starts the editor of `$VISUAL` or `$EDITOR` on files outside of the project.

No setting of git chooses the program: the project may be a stranger's clone, and its folders may pose as repositories.
"""

from __future__ import annotations

import difflib
import os
import shutil
import subprocess
import tempfile
from collections.abc import Sequence
from pathlib import Path, PurePosixPath

from urdfsync.common import system
from urdfsync.common.dependencies.facts import read_unrecorded
from urdfsync.common.diagnostics import UrdfsyncError
from urdfsync.engine.decide.conflicts import Conflict
from urdfsync.engine.inspect.package_files import encode
from urdfsync.merge.texts import find_flaw
from urdfsync.modelica.markers import find_markers, read_sides
from urdfsync.modelica.parser import parse

_HINT = "name one in the environment variable VISUAL or EDITOR"
_UNSAVED = 1_000_000_000
"""The time of a file, in s, until the editor saves it."""


def edit(conflicts: Sequence[tuple[Conflict, str, str | None]]) -> tuple[Path, dict[str, str]]:
    """Let the user write one text for each conflict.

    Beside a conflict stand its file as messages show it, and the proposed merge as the user edited it before.

    Returns the folder with the edited files, and the texts by the conflicts' paths. Raises UrdfsyncError without an
    editor, if the editor fails, and for an unusable text; the folder stays.
    """
    command = os.environ.get("VISUAL") or os.environ.get("EDITOR") or ""
    try:
        words = system.split_words(command)
    except ValueError as error:
        raise UrdfsyncError.of("no-editor", f"`{command}` is no command: {str(error).lower()}", hint=_HINT) from None
    if not words:
        raise UrdfsyncError.of("no-editor", "there is no editor to open", hint=_HINT)
    folder, texts = Path(tempfile.mkdtemp(prefix="urdfsync-edit-")), dict[str, str]()
    hint = f"your text is in {folder}; --edit begins anew"
    for number, (conflict, place, edited) in enumerate(conflicts):
        file = folder / str(number) / PurePosixPath(conflict.path).name  # several conflicts may have the same name
        file.parent.mkdir()
        proposal = conflict.merge.proposal if conflict.merge else _both(conflict.mine, conflict.generated)
        file.write_bytes(encode(proposal if edited is None else edited))
        os.utime(file, (_UNSAVED, _UNSAVED))  # else a save within the clock's step would not show
        try:  # not in the project's folder, where an editor may look for settings
            code = subprocess.run(system.command([*words, str(file)]), cwd=file.parent, check=False).returncode  # noqa: S603
        except OSError as error:
            if not texts:  # nothing was edited
                shutil.rmtree(folder)
            message = f"`{words[0]}` can't be started: {error.strerror}"
            raise UrdfsyncError.of("no-editor", message, hint=_HINT) from None
        if code:
            message = f"the editor ended with exit code {code}; nothing was changed"
            raise UrdfsyncError.of("editor-failed", message, hint=hint)
        try:
            content, is_saved = read_unrecorded(file), file.stat().st_mtime != _UNSAVED
        except OSError as error:
            message = f"the editor left no file that can be read ({error.strerror}); nothing was changed"
            raise UrdfsyncError.of("no-edit", message, place, hint=hint) from None
        if flaw := _flaw(content, conflict):
            raise UrdfsyncError.of("no-edit", f"the edited text {flaw}; nothing was changed", place, hint=hint)
        if not is_saved:  # as with `git mergetool`, the end of the editor alone confirms nothing
            message = "the text was not saved in the editor; nothing was changed"
            hint = "save it there, even if it is right as it is"
            raise UrdfsyncError.of("no-edit", message, place, hint=hint)
        texts[conflict.path] = content.decode()
    return folder, texts


def _both(mine: str, generated: str) -> str:
    """Return both texts of a conflict without a base as one text, with markers around differences."""
    sides = [text.replace("\r\n", "\n").splitlines() for text in (mine, generated)]
    lines: list[str] = []
    for what, *places in difflib.SequenceMatcher(a=sides[0], b=sides[1], autojunk=False).get_opcodes():
        own, new = sides[0][places[0] : places[1]], sides[1][places[2] : places[3]]
        lines += own if what == "equal" else ["<<<<<<< mine", *own, "=======", *new, ">>>>>>> generated"]
    return ("\r\n" if "\r\n" in mine else "\n").join([*lines, ""])


def _flaw(content: bytes, conflict: Conflict) -> str:
    """Return the fault of an edited text, as the end of a sentence; empty for a usable text."""
    try:
        text = content.decode()
    except UnicodeDecodeError:
        return "is not UTF-8"
    if found := find_markers(text):
        return f"has the conflict marker `{found[0][0]}` (line {found[0][1]})"
    ours, theirs = read_sides(conflict.mine)
    if flaw := find_flaw(text, (ours, theirs, conflict.generated)):
        return flaw
    like = ours if conflict.is_of_branches else conflict.generated  # a merge of branches has no new name yet
    wanted, given = ([str(declared.name) for declared in parse(side).classes] for side in (like, text))
    return "" if given == wanted else f"is not one class called {' and '.join(f'`{name}`' for name in wanted)}"
