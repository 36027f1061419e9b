"""The published tool: `urdf_to_package.py` of the library URDFModelica."""

from __future__ import annotations

import dataclasses
from pathlib import Path

from benchmarks.measuring import Cost, UnexpectedError, measure

_PACKAGE = "P"  # the package in which the tool puts that of a robot


@dataclasses.dataclass(frozen=True)
class Published:
    """The script and the Python that runs it, which needs the package urdf_parser_py."""

    python: str
    script: Path

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
        """Bring the numbers of a package in step with its source, in which a link has this mass in kg."""
        cost = measure([*self._command(source), "-u"], folder, "Successfully updated package")
        if not any(f"mass = {mass}," in file.read_text() for file in folder.glob(f"{_PACKAGE}/*/Links/*Params.mo")):
            raise UnexpectedError(f"no record in {folder} has the mass {mass}")
        return cost

    def _command(self, source: Path) -> list[str]:
        target = ["-o", "record.mo", "-r", ".", "-p", _PACKAGE]
        return [self.python, str(self.script), "-i", str(source), *target, "-s"]
