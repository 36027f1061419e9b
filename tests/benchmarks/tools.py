"""What all benchmarks are given: an environment with the console scripts, other tools, options."""

from __future__ import annotations

import base64
import dataclasses
import hashlib
import os
import shutil
import subprocess
import sys
import venv
import zipfile
from collections.abc import Callable
from pathlib import Path

from support.corpus import REPOSITORY

from benchmarks.measuring import Cost, measure, run, variables
from benchmarks.published import Published

_ENTRIES = {"empty": "benchmark:main", "urdfsync": "urdfsync.__main__:main", "urdfsync-hook": "urdfsync.hook:main"}

NOTHING = "python -c pass"
"""Label of a Python that does nothing."""


@dataclasses.dataclass(frozen=True)
class Tools:
    """What a benchmark works with."""

    folder: Path
    """An empty one."""
    scripts: Path
    """Folder of the console scripts `urdfsync`, `urdfsync-hook` and `empty`, which does nothing."""
    path: str
    """Where programs of other tools are looked for."""
    published: Published | None
    say: Callable[[str], None]
    """Is told of what is left out."""
    idle: float = 60.0
    """Seconds to idle."""
    rebuilds: int = 500
    """So many, to see how memory grows."""

    def urdfsync(self, *arguments: str) -> list[str]:
        """A command."""
        return [str(self.scripts / "urdfsync"), *arguments]

    def hook(self) -> list[str]:
        """What the hook of git runs."""
        return [str(self.scripts / "urdfsync-hook"), "check"]

    def empty(self) -> Cost:
        """Measure a console script that does nothing."""
        return measure([str(self.scripts / "empty")], self.folder)

    def nothing(self) -> Cost:
        """Measure a Python that does nothing, in that environment: in others, packages may hook into its start."""
        return measure([str(self.scripts / "python"), "-c", "pass"], self.folder)

    def program(self, name: str) -> str | None:
        """The program of another tool; if there is none, that is said."""
        found = shutil.which(name, path=self.path)
        if found is None:
            self.say(f"{name} is not there: left out")
        return found

    def commit(self, folder: Path) -> None:
        """Make a folder a repository with everything committed."""
        author = ["-c", "user.name=b", "-c", "user.email=b@c"]
        for command in (["init", "-q"], ["add", "."], [*author, "commit", "-qm", "all"], ["status"]):
            run(["git", *command], folder)


def install(folder: Path) -> Path:
    """Make an environment with the console scripts, which sees what this one has; returns the scripts' folder."""
    venv.create(folder, symlinks=True)
    scripts = folder / "bin"
    wheel = folder / "benchmark-1-py3-none-any.whl"
    _write_wheel(wheel)
    python = str(scripts / "python")
    options = ["--no-deps", "--no-index", str(wheel)]
    run([sys.executable, "-m", "pip", "-q", "--python", python, "install", *options], folder)
    asked = [python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"]
    told = subprocess.run(asked, check=True, capture_output=True, text=True, env=variables())
    libraries = [str(REPOSITORY), *(path for path in sys.path if path.endswith("-packages"))]
    (Path(told.stdout.strip()) / "benchmark.pth").write_text("\n".join(libraries) + "\n")
    return scripts


def search_path(peers: Path | None) -> str:
    """Where other tools are looked for: in their own folder first."""
    return os.pathsep.join(filter(None, [str(peers or ""), os.environ.get("PATH", "")]))


def _write_wheel(file: Path) -> None:
    scripts = "".join(f"{name} = {place}\n" for name, place in _ENTRIES.items())
    tags = "Root-Is-Purelib: true\nTag: py3-none-any"
    contents = {
        "benchmark.py": "def main():\n    return 0\n",
        "benchmark-1.dist-info/METADATA": "Metadata-Version: 2.1\nName: benchmark\nVersion: 1\n",
        "benchmark-1.dist-info/WHEEL": f"Wheel-Version: 1.0\nGenerator: by hand\n{tags}\n",
        "benchmark-1.dist-info/entry_points.txt": f"[console_scripts]\n{scripts}",
    }
    record = [f"{name},sha256={_digest(text)},{len(text)}" for name, text in contents.items()]
    contents["benchmark-1.dist-info/RECORD"] = "\n".join([*record, "benchmark-1.dist-info/RECORD,,"]) + "\n"
    with zipfile.ZipFile(file, "w") as archive:
        for name, text in contents.items():
            archive.writestr(name, text)


def _digest(text: str) -> str:
    return base64.urlsafe_b64encode(hashlib.sha256(text.encode()).digest()).decode().rstrip("=")
