"""`.urdfsync/` on disk: where the state of each robot is, and how it gets there."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from pathlib import Path

from urdfsync import manifest
from urdfsync.diagnostics import Diagnostic, Severity, StateError
from urdfsync.files import commit
from urdfsync.manifest import Manifest, Model

FOLDER = ".urdfsync"
_IGNORE = """\
# Written by urdfsync. robots/ belongs into version control, everything else is safe to lose.
/*
!/.gitignore
!/robots/
.*-tmp
"""


@dataclasses.dataclass(frozen=True, slots=True)
class State:
    """What the last build recorded of a robot."""

    manifest: Manifest
    model: Model | None
    """None if its file is lost."""
    intact: bool
    """Whether manifest and model were written together."""


class Store:
    """The state folder of one configuration."""

    def __init__(self, root: Path, shown: Callable[[Path], str] = str) -> None:
        self.folder = root / FOLDER
        self._shown = shown

    def load(self, robot: str) -> State | None:
        """The robot's state, None if it was never built. Raises StateError if it can't be used."""
        path, beside = self._paths(robot)
        text = self._read(path)
        if text is None:
            return None
        recorded = manifest.loads(text, self._shown(path))
        content = self._read(beside)
        if content is None:
            return State(recorded, None, intact=False)
        model = manifest.load_model(content, self._shown(beside))
        return State(recorded, model, intact=manifest.text_hash(content) == recorded.source.snapshot)

    def save(self, robot: str, recorded: str, model: str | None) -> None:
        """Write the robot's files, as far as they changed, the manifest last; None leaves the model as it is.

        Raises OutputError if that is not possible.
        """
        path, beside = self._paths(robot)
        for file, text in ((self.folder / ".gitignore", _IGNORE), (beside, model), (path, recorded)):
            if text is not None and self._read(file) != text:
                commit({file: text.encode()})

    def drawing(self, robot: str) -> Path:
        """Where the robot's diagram goes."""
        return self.folder / "svg" / f"{robot}.svg"

    def _paths(self, robot: str) -> tuple[Path, Path]:
        folder = self.folder / "robots"
        return folder / f"{robot}.toml", folder / f"{robot}.json"

    def _read(self, path: Path) -> str | None:
        try:
            return path.read_bytes().decode().replace("\r\n", "\n")
        except (FileNotFoundError, NotADirectoryError):
            return None
        except (OSError, UnicodeDecodeError) as error:
            reason = error.strerror if isinstance(error, OSError) else "it is not UTF-8"
            hint = "restore it from version control"
            message = f"the recorded state can't be read: {reason}"
            found = Diagnostic(Severity.ERROR, "broken-state", message, self._shown(path), hint=hint)
            raise StateError(found) from None
