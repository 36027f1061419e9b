"""`urdfsync build` as people use it: words, exit codes, conflicts, the next steps."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from support.commands import Execute
from support.networks import LADDER, edit, source

from urdfsync import cli

NEXT = [
    "",
    "What to do next:",
    f"  open {Path('modelica/Ladder/package.mo')} in OMEdit or Dymola",
    "  urdfsync library  prints how these tools find the library UrdfSync",
    "  urdfsync watch    builds whenever a source changes",
    "  urdfsync check    compiles the package",
]
"""What follows the first build of a package."""


@pytest.fixture
def edited(project: Path) -> Path:
    """A built project with one edited model."""
    cli.main(["build"])
    edit(f"{LADDER}/Ladder.mo", "end Ladder;\n", "end Ladder;\n// mine\n")
    return project


def test_build_in_words(project: Path, execute: Execute) -> None:
    assert execute("build").lines == ["ladder: 14 files written", *NEXT]
    assert execute("build").out == "ladder: in step, 14 files\n"


def test_check_writes_nothing_and_exits_with_1_if_out_of_step(
    project: Path, execute: Execute, snapshot_of: Callable[[Path], object]
) -> None:
    before = snapshot_of(project)
    assert execute("build", "--check", code=1).out == "ladder: 14 files to write\n"
    assert snapshot_of(project) == before
    assert cli.main(["build", "--dry-run"]) == 0
    assert snapshot_of(project) == before
    cli.main(["build"])
    edit(f"{LADDER}/Ladder.mo", "end Ladder;\n", "end Ladder;\n// mine\n")
    assert cli.main(["build", "--check"]) == 0, "an edit is in step"


def test_verbose_names_each_file_that_is_not_as_generated_on_one_line(edited: Path, execute: Execute) -> None:
    (edited / "modelica/Ladder/Elements/R1.mo").unlink()
    lines = execute("build", "--verbose", "--dry-run").lines
    assert lines[0] == "ladder: 1 to restore, 1 kept because you edited it"
    folder = Path("modelica/Ladder")
    assert f"  keep       {folder / 'Ladder.mo'}  you edited it; its generated text has nothing new" in lines
    assert f"  restore    {folder / 'Elements' / 'R1.mo'}  you deleted it" in lines
    assert len(lines) == 3


def test_findings_go_to_the_error_stream(project: Path, execute: Execute) -> None:
    source('"R2"', '"r2"')
    (project / "step.csv").unlink()
    streams = execute("build", code=2)
    assert streams.out == ""
    assert streams.err.splitlines() == [
        "ladder: 1 error, nothing was changed",
        "ladder.json:8: error: 'r2' is no class name [element-name]",
    ]


def test_ros_package_path_is_searched(project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (project / "step.csv").rename(tmp_path / "step.csv")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    cli.main(["build"])
    assert (project / "modelica/Ladder/Resources/step.txt").exists()


def test_svg(execute: Execute, project: Path) -> None:
    drawing = Path(".urdfsync/svg/ladder.svg")
    assert execute("build", "--svg").lines == ["ladder: 14 files written", f"  diagram: {drawing}", *NEXT]
    assert drawing.exists()
    assert execute("build", "--svg").lines == ["ladder: in step, 14 files", f"  diagram: {drawing}"]


def test_conflict(edited: Path, execute: Execute) -> None:
    source('"R2"', '"R3"')
    model = Path("modelica/Ladder/Ladder.mo")
    for arguments in (["build", "--dry-run"], ["build", "--check"], ["build"], ["build", "--verbose"]):
        lines = execute(*arguments, code=3).lines
        assert lines[0] == "ladder: 1 conflict (5 files wait for it)"
        assert f"  conflict   {model}  network" in lines
        shown = '    +  Elements.R3 elementR3 "Element R3";'
        assert (shown if "--verbose" in arguments else "    the export  component `elementR3`: added") in lines
        assert f"    urdfsync resolve {model} --merge" in lines
    assert execute("build", "--quiet", code=3).lines == [
        "ladder: 1 conflict (5 files wait for it)",
        f"  conflict   {model}  element R2 renamed to R3; the changes fit together: --merge takes both",
        "",
        "  urdfsync resolve ladder --merge  merges it",
    ]
