"""The user's editor on one file outside of the project: that of `$VISUAL` or `$EDITOR`.

Nothing else chooses the program: the project may be a clone of a stranger's, and its folders may pose as repositories.
"""

from __future__ import annotations

import os
import shlex
import subprocess
import tempfile
from pathlib import Path

from urdfsync.diagnostics import UrdfsyncError

_HINT = "set $VISUAL or $EDITOR"


def edit(name: str, content: bytes) -> Path:
    """Let the user edit a file called `name`; return it as it was saved, in a folder of its own.

    Raises UrdfsyncError if there is no editor, or if it fails.
    """
    command = os.environ.get("VISUAL") or os.environ.get("EDITOR") or ""
    try:
        words = shlex.split(command)
    except ValueError as error:
        raise UrdfsyncError.of("no-editor", f"`{command}` is no command: {str(error).lower()}", hint=_HINT) from None
    if not words:
        raise UrdfsyncError.of("no-editor", "there is no editor to open", hint=_HINT)
    folder = Path(tempfile.mkdtemp(prefix="urdfsync-edit-"))
    file = folder / name
    file.write_bytes(content)
    try:  # not in the project's folder, where an editor may look for settings
        code = subprocess.run([*words, str(file)], cwd=folder, check=False).returncode  # noqa: S603
    except OSError as error:
        raise UrdfsyncError.of("no-editor", f"`{words[0]}` can't be started: {error.strerror}", hint=_HINT) from error
    if code:
        message = f"the editor ended with exit code {code}; nothing was changed"
        raise UrdfsyncError.of("editor-failed", message, hint=f"what it saved is in {file}")
    return file
