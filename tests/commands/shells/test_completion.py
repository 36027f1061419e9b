"""Completion: what a line may become, in Python and in the real shells; run as a script, it renews the table."""

from __future__ import annotations

import argparse
import os
import select
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest
from support.networks import configure

from urdfsync.commands import cli
from urdfsync.commands.shells import completion

TABLE = Path(completion.__file__).parent / "options.tsv"


VALUES = {"NAME=VALUE": "robot.{}.parameters.", "PATTERN": "robot.{}."}
"""What `completion` makes of the values of options, with a joint in the place of `{}`."""
FILES = ("FILE", "PATH", "SOURCE", "BASE", "MINE", "OTHER")


def option_table() -> str:
    """The rows of all commands and options: command, option, its values, meaning."""
    commands = next(action for action in cli._parser([])._actions if isinstance(action, argparse._SubParsersAction))
    rows = [("", choice.dest, "", choice.help or "") for choice in commands._choices_actions]
    for name, parser in commands.choices.items():
        formatter = parser._get_formatter()
        for action in parser._actions:
            values = "" if action.nargs == 0 else "|".join(map(str, action.choices or ())) or str(action.metavar or "")
            values = "FILE" if values.startswith(FILES) else VALUES.get(values, values)
            texts = formatter._expand_help(action).split() if action.help else []
            options = [option for option in action.option_strings if option.startswith("--")] or [""]
            values = "ROBOT|FILE" if options == [""] and name in ("diff", "resolve") else values
            rows += [(name, option, values, " ".join(texts if option else [])[:70]) for option in options]
    return "".join("\t".join(row) + "\n" for row in rows)


def names(*words: str) -> list[str]:
    """What the last word may become."""
    return [name for name, _ in completion.complete([*words])]


def test_the_table_has_all_commands_and_options() -> None:
    assert TABLE.read_text(encoding="utf-8") == option_table(), f"run {__file__}"
    assert names("") == [*cli._COMMANDS]


@pytest.fixture
def built(project: Path) -> Path:
    """A built project of two robots."""
    configure('[robots.filter]\nsource = "ladder.json"\npackage = "Filter"\ndomain = "rcnetwork"\n')
    cli.main(["build"])
    return project


def test_what_a_line_may_become(built: Path) -> None:
    assert names("bui") == ["build"]
    assert names("build", "") == ["ladder", "filter"]
    assert names("build", "ladder", "") == ["filter"]
    assert names("build", "--dr") == ["--dry-run"]
    assert names("check", "--tool", "") == ["rumoca", "omc", "both"]
    assert names("check", "--tool=o") == ["--tool=omc"]
    assert names("resolve", "f") == ["filter"]
    assert names("resolve", "mod") == names("diff", "mod") == names("init", "") == [":files"]
    assert names("build", "--config", "") == names("record", "--output=") == [":files"]
    assert names("hook", "ch") == ["check"]
    assert names("nothing", "") == names("build", "--wait", "") == names("library", "x") == []


def test_joints_are_those_of_the_recorded_state(folder: Path) -> None:
    arm = Path(__file__).parents[3] / "modelica/UrdfSync/Resources/robots/six_axis_arm/six_axis_arm.urdf"
    Path("urdfsync.toml").write_text(f"[robots.arm]\nsource = '{arm}'\npackage = 'Arm'\n")
    assert names("simulate", "--set", "robot.el") == []
    cli.main(["build", "-q"])
    assert names("simulate", "--set", "robot.el") == ["robot.elbow.parameters."]
    assert names("simulate", "arm", "--variable", "robot.el") == ["robot.elbow."]
    with Path(".urdfsync/robots/arm.state").open("ab") as state:
        state.truncate(50_000_000)  # a stranger's
    assert names("simulate", "--set", "robot.el") == []


HOSTILE = {
    "no file": None,
    "no TOML": b"[robots\n",
    "no UTF-8": b"\xff\xfe",
    "no tables": b"robots = 3",
    "names that do harm": b'[robots."$(touch harm)"]\n[robots."a b"]\n["robots"."\\u001b[2J"]\n',
    "large": b"[robots.x]\n" + b"#" * 500_000,
    "deep": b"a = " + b"[" * 5000,
}


@pytest.mark.parametrize("content", HOSTILE.values(), ids=HOSTILE.keys())
def test_nothing_is_said_of_a_configuration_that_is_wrong(folder: Path, content: bytes | None) -> None:
    if content is not None:
        Path("urdfsync.toml").write_bytes(content)
    state = Path(".urdfsync/robots")
    state.mkdir(parents=True)
    (state / "x.state").write_bytes(b'model ["joints","$(x)",{}]\nfile 12\n\xff')
    for line in (["build", ""], ["diff", "--edits", ""], ["simulate", "--set", ""]):
        done = subprocess.run(
            [sys.executable, "-m", "urdfsync", "completion", "zsh", "--", *line],
            env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
            capture_output=True,
            text=True,
            check=True,
        )
        assert (done.stdout.replace(":files\n", ""), done.stderr) == ("", "")


def test_it_loads_no_more_than_the_up_to_date_check(built: Path) -> None:
    code = (
        "import sys; sys.argv = ['urdfsync', 'completion', 'bash', '--', 'build', '']\n"
        "from urdfsync.__main__ import main; main(); print(*sys.modules, file=sys.stderr)"
    )
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines() == ["ladder", "filter"]
    loaded = set(done.stderr.split())
    assert {name for name in loaded if name.startswith("urdfsync.")} <= {
        *("urdfsync.__main__", "urdfsync.commands", "urdfsync.commands.shells", "urdfsync.commands.shells.completion"),
        *(
            "urdfsync.common",
            "urdfsync.common.dependencies",
            "urdfsync.common.noop",
            "urdfsync.common.streams",
            "urdfsync.common.system",  # on Windows
            "urdfsync.common.version",
        ),
        *(f"urdfsync.common.dependencies.{name}" for name in ("facts", "localfile", "places", "program", "memory")),
    }
    assert not loaded & {"argparse", "msgspec", "json"}


# The real shells

LINES = {
    "urdfsync bui\tfil\t": "<build> <filter>",
    "urdfsync build --dry\tlad\t": "<build> <--dry-run> <ladder>",
    "urdfsync check --tool=o\t": "<check> <--tool=omc>",
    "urdfsync resolve --moved=nothing lad\t": "<resolve> <--moved=nothing> <ladder>",
    "urdfsync diff --edits mod\t": "<diff> <--edits> <modelica/>",
    "urdfsync init lad\t": "<init> <ladder.json>",
}


@pytest.fixture
def command(built: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder first on the PATH with a command `urdfsync` that completes, and else shows its arguments."""
    shown = tmp_path / "bin/urdfsync"
    shown.parent.mkdir()
    path = os.pathsep.join(sys.path)
    shown.write_text(
        f'#!/bin/sh\n[ "$1" = completion ] && PYTHONPATH={path} exec {sys.executable} -m urdfsync "$@"\n'
        'printf "\\nSEEN:"; printf " <%s>" "$@"; echo " END"\n'
    )
    shown.chmod(0o755)
    monkeypatch.setenv("PATH", f"{shown.parent}{os.pathsep}{os.environ['PATH']}")
    return shown.parent


def shell(name: str) -> str:
    return shutil.which(name) or pytest.skip(f"no {name} on this machine")


def typed(arguments: list[str], setup: str, line: str) -> str:
    """What the command gets, if somebody types a line into an interactive shell."""
    import pty  # which Windows lacks

    process, terminal = pty.fork()
    if process == 0:
        os.execvp(arguments[0], arguments)
    text = ""

    def read_until(mark: str, seconds: float = 60) -> None:
        nonlocal text
        end = time.monotonic() + seconds
        while mark not in text and time.monotonic() < end:
            if select.select([terminal], [], [], 0.1)[0]:
                try:
                    text += os.read(terminal, 4096).decode(errors="replace")
                except OSError:
                    return

    try:
        os.write(terminal, f"{setup}; echo REA''DY\n".encode())
        read_until("READY")
        text = ""
        for part in line.split("\t")[:-1]:
            os.write(terminal, f"{part}\t".encode())
            time.sleep(1.5)  # a shell drops what is typed while it completes
        os.write(terminal, b"\n")
        read_until(" END")
    finally:
        os.close(terminal)
        os.waitpid(process, 0)
    return text.partition("SEEN: ")[2].partition(" END")[0]


@pytest.mark.slow
@pytest.mark.parametrize("line", LINES)
def test_bash(command: Path, line: str) -> None:
    bash = [shell("bash"), "--norc", "--noprofile", "-i"]
    assert typed(bash, 'eval "$(urdfsync completion bash)"', line) == LINES[line]


@pytest.mark.slow
@pytest.mark.parametrize("line", LINES)
def test_zsh(command: Path, line: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ZDOTDIR", str(command))
    # else zsh takes the slash of a completed folder away when the line ends
    (command / ".zshrc").write_text("PS1='$ '\nunsetopt AUTO_REMOVE_SLASH\n")
    setup = 'autoload -U compinit && compinit -u -D && eval "$(urdfsync completion zsh)"'
    assert typed([shell("zsh"), "-d", "-i"], setup, line) == LINES[line]


@pytest.mark.slow
def test_fish(command: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HOME", str(command))
    script = "urdfsync completion fish | source; for line in $argv; complete -C $line; echo; end"
    Path("a folder").mkdir()
    lines = ["urdfsync bui", "urdfsync build f", "urdfsync diff --edits mod", "urdfsync init ladder.j"]
    lines += ["urdfsync init a\\ f", "urdfsync simulate --csv=mod"]
    done = subprocess.run([shell("fish"), "-c", script, *lines], capture_output=True, text=True, check=True)
    answers = [text.split("\t")[0].strip() for text in done.stdout.split("\n\n")]
    assert answers[:6] == ["build", "filter", "modelica/", "ladder.json", "a folder/", "--csv=modelica/"]


if __name__ == "__main__":
    TABLE.write_text(option_table(), encoding="utf-8")
