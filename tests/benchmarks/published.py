"""The published tool, `urdf_to_package.py` of the library URDFModelica."""

from __future__ import annotations

import dataclasses
import re
import subprocess
from collections.abc import Callable
from pathlib import Path

from benchmarks.measuring import Cost, UnexpectedError, measure, variables

_SCRIPT = "urdf_to_package.py"
_PACKAGE = "P"
"""The package in which it puts that of a robot."""


@dataclasses.dataclass(frozen=True)
class Published:
    """The tool and the Python that runs it."""

    python: str
    script: Path
    version: str

    def build(self, source: Path, folder: Path) -> Cost:
        """Build the package of a robot in a folder that does not exist yet."""
        (folder / _PACKAGE).mkdir(parents=True)
        (folder / _PACKAGE / "package.order").touch()
        cost = measure(self._command(source), folder, "Successfully created package")
        links = source.read_text(encoding="utf-8").count("<link ")
        records = len(list(folder.glob(f"{_PACKAGE}/*/Links/*Params.mo")))
        if records != links:
            raise UnexpectedError(f"{records} records of {links} links in {folder}")
        return cost

    def update(self, source: Path, folder: Path, mass: str) -> Cost:
        """Bring the numbers of a package in step with its source, in which a link has this mass, in kg."""
        cost = measure([*self._command(source), "-u"], folder, "Successfully updated package")
        if not any(f"mass = {mass}," in file.read_text() for file in folder.glob(f"{_PACKAGE}/*/Links/*Params.mo")):
            raise UnexpectedError(f"no record in {folder} has the mass {mass}")
        return cost

    def _command(self, source: Path) -> list[str]:
        target = ["-o", "record.mo", "-r", ".", "-p", _PACKAGE]
        return [self.python, str(self.script), "-i", str(source), *target, "-s"]


def find(folder: Path | None, python: str, say: Callable[[str], None]) -> Published | None:
    """The tool, if a folder is given and it runs; `say` is told if not."""
    if folder is None:
        say("the published tool is left out: --published says where it is")
        return None
    script = folder.absolute() / _SCRIPT
    if not script.is_file():
        say(f"the published tool is left out: there is no {script}")
        return None
    if subprocess.run([python, "-c", "import urdf_parser_py"], check=False, env=variables()).returncode:
        say(f"the published tool is left out: {python} has no urdf_parser_py")
        return None
    return Published(python, script, _version(script))


def _version(script: Path) -> str:
    """What the citation file of its repository says, two folders above."""
    file = script.parents[2] / "CITATION.cff"
    found = re.search(r"^version: (\S+)", file.read_text(encoding="utf-8"), re.MULTILINE) if file.is_file() else None
    return found[1] if found else "unknown"
