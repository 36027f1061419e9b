"""The documentation agrees with urdfsync."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
from pathlib import Path

import pytest
from support.commands import Execute

from urdfsync.analysis.checks.cache import LIMIT
from urdfsync.analysis.checks.contents import MOST_BYTES
from urdfsync.analysis.checks.libraries import NEXT, OLDEST
from urdfsync.analysis.checks.results import MOST_SINGLE_EDITS, CheckOptions
from urdfsync.analysis.simulation.motion import MOST_ROWS
from urdfsync.analysis.simulation.results import STEPS, STOP, SimulateOptions
from urdfsync.analysis.simulation.results import TOLERANCE as SIMULATED_TO
from urdfsync.commands import cli
from urdfsync.domain import Target
from urdfsync.domain.experiment import TOLERANCE
from urdfsync.engine.result import Exit
from urdfsync.formats.urdf.domain import DOMAIN
from urdfsync.formats.urdf.options import Options
from urdfsync.output.markdown import FOLDED
from urdfsync.project import config

REPOSITORY = Path(__file__).parents[1]
ARM = REPOSITORY / "modelica/UrdfSync/Resources/robots/six_axis_arm/six_axis_arm.urdf"
PAGES = [*sorted(REPOSITORY.glob("*.md")), *sorted((REPOSITORY / "docs").glob("*.md"))]


def test_the_picture_of_the_arm_is_the_diagram_of_the_example() -> None:
    options = Options()
    snapshot = DOMAIN.read(ARM.read_bytes(), ARM.name, options).snapshot
    assert snapshot is not None
    drawing = DOMAIN.drawing(snapshot, {}, Target("UrdfSync.Examples.SixAxisArm", "SixAxisArm"), options, {})
    assert (REPOSITORY / "docs/images/six_axis_arm.svg").read_text(encoding="utf-8") == drawing, (
        "run `urdfsync build six_axis_arm --svg` and copy .urdfsync/svg/six_axis_arm.svg"
    )


def test_the_picture_of_the_four_bar_is_the_diagram_of_the_example() -> None:
    robot = next(robot for robot in config.load(REPOSITORY / "urdfsync.toml").robots if robot.name == "four_bar")
    source = REPOSITORY / robot.source_text
    snapshot = DOMAIN.read(source.read_bytes(), source.name, robot.options).snapshot
    assert snapshot is not None
    assert (REPOSITORY / "docs/images/four_bar.svg").read_text(encoding="utf-8") == DOMAIN.drawing(
        snapshot, {}, robot.target, robot.options, {}
    ), "run `urdfsync build four_bar --svg` and copy .urdfsync/svg/four_bar.svg"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_between_pages_lead_somewhere(page: Path) -> None:
    for target, anchor in re.findall(r"\]\(([^)#\s]*)#?([^)]*)\)", page.read_text(encoding="utf-8")):
        if "://" not in target:
            file = page.parent / target if target else page
            assert file.exists(), target
            assert not anchor or anchor in anchors(file), f"{target}#{anchor}"


def test_files_of_the_repository_that_pages_name_are_there() -> None:
    for page in PAGES:
        for path in re.findall(
            r"(?<![\w/.])(?:docs|tests|tools|urdfsync)/[\w/]+\.(?:py|md)\b", page.read_text(encoding="utf-8")
        ):
            assert (REPOSITORY / path).exists(), f"{page.name}: {path}"


def anchors(page: Path) -> set[str]:
    """The names that GitHub gives to the headings of a page."""
    text = re.sub(r"^( *)```.*?^\1```", "", page.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
    return {
        re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-") for title in re.findall("^#+ (.*)$", text, re.MULTILINE)
    }


def test_the_first_command_of_the_readme_prints_what_stands_below_it(folder: Path, execute: Execute) -> None:
    page = (REPOSITORY / "README.md").read_text(encoding="utf-8")
    command, printed = re.findall(r"^```(?:sh|text)\n(.*?)^```", page, re.MULTILINE | re.DOTALL)[:2]
    init, build = (shlex.split(part)[1:] for part in command.split(" && ")[-2:])
    execute("init", str(ARM), code=Exit.IN_STEP)
    assert init == ["init", f"../{ARM.relative_to(REPOSITORY).as_posix()}"]
    assert execute(*build, code=Exit.IN_STEP).out.endswith(printed)


def test_commands_install_what_there_is() -> None:
    """urdfsync has no release: users install a clone or a git address, and extras by the names of packages."""
    files = [*PAGES, REPOSITORY / ".pre-commit-hooks.yaml", *sorted((REPOSITORY / "urdfsync").rglob("*.py"))]
    files += sorted((REPOSITORY / "modelica/UrdfSync").rglob("*.mo"))
    for file in files:
        text = file.read_text(encoding="utf-8")
        assert re.findall(r"urdfsync\[|rev: *v?\d", text) == [], file
        for command in re.findall(r"pip install ([^`#\n]*)", text):
            names = [name.strip("'\"") for name in command.split("&&")[0].split() if not name.startswith("-")]
            wanted = "." in names or any(name.startswith((".[", "git+")) for name in names)
            assert wanted or file.name in ("speed.md", "extras.py"), f"{file}: pip install {command}"


@pytest.mark.parametrize(
    ("command", "page"),
    [("watch", "watch"), ("check", "checking"), ("simulate", "simulate"), ("fmu", "fmu"), ("report", "report")],
)
def test_pages_name_options_that_their_command_has(command: str, page: str, capsys: pytest.CaptureFixture[str]) -> None:
    """The help lists all options, and so does the site: no page repeats the list."""
    assert cli.main([command, "--help"]) == 0
    options = set(re.findall(r"--[a-z-]+", capsys.readouterr().out))
    (paragraph,) = re.findall(rf"^`urdfsync {command} --help`.*?\n\n", text_of(page), re.MULTILINE | re.DOTALL)
    assert set(re.findall(r"--[a-z-]+", paragraph)) <= options


def test_the_table_of_systems_has_each_command_once(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["--help"]) == 0
    commands = re.findall(r"(?m)^  ([a-z][a-z-]+) ", capsys.readouterr().out.partition("commands:")[2])
    rows = re.findall(r"(?m)^\| (`.*?) \|", text_of("windows").partition("## Commands by system")[2])
    assert sorted(re.findall(r"`([a-z-]+)`", " ".join(rows))) == sorted(commands)


def text_of(page: str) -> str:
    return (REPOSITORY / f"docs/{page}.md").read_text(encoding="utf-8")


def test_numbers_of_the_check_are_those_in_use() -> None:
    page = " ".join((REPOSITORY / "docs/checking.md").read_text(encoding="utf-8").split())
    defaults = CheckOptions()
    assert f"no more than {TOLERANCE:.0e} of the largest value" in page
    assert f"The cache stays below {LIMIT / 2**30:.0f} GiB" in page
    assert f"A library may have at most {MOST_BYTES // 2**20} MB" in page
    oldest, following = (".".join(map(str, version)) for version in (OLDEST, NEXT))
    assert f"has to be {oldest}.0 or later, below {following}." in page
    assert MOST_SINGLE_EDITS == 6
    assert "More than six files are not told apart" in page
    assert f"`--timeout` ({defaults.timeout:.0f} s)" in page


def test_numbers_of_comments_are_those_in_use() -> None:
    assert f"folded beyond {FOLDED} rows" in text_of("git")


def test_numbers_of_simulations_are_those_in_use() -> None:
    page = " ".join((REPOSITORY / "docs/simulate.md").read_text(encoding="utf-8").split())
    defaults = SimulateOptions()
    assert f"they are {STOP:g} s, a {STEPS}th of the stop time, and {SIMULATED_TO:g}" in page
    assert f"`--timeout` ({defaults.timeout:g} s)" in page
    assert f"There may be up to {MOST_ROWS:,} rows." in page


def test_every_option_of_a_robot_is_documented() -> None:
    text = (REPOSITORY / "docs/configuration.md").read_text(encoding="utf-8")
    assert [name for name in Options.__struct_fields__ if f"| `{name}` |" not in text] == []


@pytest.fixture
def unit() -> str:
    """The systemd unit of the page on the daemon."""
    (found,) = re.findall(r"```ini\n(.*?)```", (REPOSITORY / "docs/watch.md").read_text("utf-8"), re.DOTALL)
    return str(found)


@pytest.mark.skipif(not shutil.which("systemd-analyze"), reason="systemd-analyze is not installed")
def test_systemd_takes_the_unit(unit: str, tmp_path: Path) -> None:
    program, file = tmp_path / "robots/.venv/bin/urdfsync", tmp_path / "urdfsync.service"
    program.parent.mkdir(parents=True)
    program.touch(mode=0o755)
    file.write_text(unit, encoding="utf-8")
    command = ["systemd-analyze", "verify", "--user", "--man=no", str(file)]
    home = {"HOME": str(tmp_path), "XDG_RUNTIME_DIR": str(tmp_path)}
    found = subprocess.run(command, env=os.environ | home, capture_output=True, text=True, check=False)
    assert (found.stdout, found.stderr, found.returncode) == ("", "", 0)


def test_the_unit_starts_what_can_be_started_again(unit: str) -> None:
    assert "ExecStart=%h/robots/.venv/bin/urdfsync watch\n" in unit
    assert "RestartPreventExitStatus=2 4\n" in unit, "an error and a lock, see `urdfsync.engine.result.Exit`"
