"""A large table of motors to measure with: its edits, and the work that no build of it can leave out."""

from __future__ import annotations

import itertools
import os
import tempfile
import time
from pathlib import Path

from benchmarks.measuring import Cost, Measurement
from urdfsync.domain import Artifact, Target
from urdfsync.engine.package.render import Renderer
from urdfsync.formats.table.domain import DOMAIN
from urdfsync.formats.table.model import TableOptions
from urdfsync.project.config import templates_folder

_HEADER = "name,torque [N.cm],inertia [g.cm2],poles [integer],maker"


class Motors:
    """A table below a folder, as the only robot of its configuration; each row gives a record and a model."""

    def __init__(self, folder: Path, rows: int) -> None:
        folder.mkdir(parents=True)
        self.folder, self._file, self._number = folder, folder / "motors.csv", itertools.count(1)
        self._rows = [[f"M{n}", f"{600 + n / 4:g}", f"{n + 12.5:g}", str(n % 3 * 2 + 4), "Maker"] for n in range(rows)]
        configuration = '[robots.robot0]\ndomain = "table"\nsource = "motors.csv"\npackage = "Robot0"\n'
        (folder / "urdfsync.toml").write_text(configuration, encoding="utf-8")
        self._write()

    def change_row(self) -> None:
        """Change one number of the row in the middle."""
        self._rows[len(self._rows) // 2][2] = str(next(self._number))
        self._write()

    def exchange_keys(self) -> None:
        """Exchange the keys of two rows."""
        one, other = self._rows[10], self._rows[20]
        one[0], other[0] = other[0], one[0]
        self._write()

    def render_and_write(self) -> Measurement:
        """Return a measurement of rendering all texts and writing each to a new file that is then renamed."""
        reading = DOMAIN.read(self._file.read_bytes(), "motors.csv", TableOptions())
        found = DOMAIN.artifacts(reading.snapshot, {}, Target("Robot0", "Robot0"), TableOptions())
        artifacts = [artifact for artifact in found if isinstance(artifact, Artifact)]
        renderer = Renderer([templates_folder(DOMAIN)])

        def measurement() -> Cost:
            folder = tempfile.mkdtemp(dir=self.folder.parent)  # not where builds look for models
            for path in {os.path.dirname(artifact.path) for artifact in artifacts}:  # noqa: PTH120
                Path(folder, path).mkdir(exist_ok=True)
            os.sync()
            begin, used = time.perf_counter(), time.process_time()
            for artifact in artifacts:
                text, path = renderer.render(artifact.template, artifact.data), f"{folder}/{artifact.path}"
                descriptor = os.open(f"{path}.new", os.O_WRONLY | os.O_CREAT | os.O_EXCL)
                os.write(descriptor, text.encode())
                os.close(descriptor)
                os.rename(f"{path}.new", path)  # noqa: PTH104 - as fast as it can be
            return Cost(time.perf_counter() - begin, time.process_time() - used)

        return measurement

    def _write(self) -> None:
        lines = (",".join(row) for row in self._rows)
        self._file.write_text("\n".join([_HEADER, *lines, ""]), encoding="utf-8")
