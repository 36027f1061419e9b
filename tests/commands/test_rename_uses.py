"""`urdfsync resolve --rename-uses`: models of the user's follow what the source renames."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from support.commands import Execute, Terminal
from support.crashes import Operation, before_each
from support.files import unchanged
from support.old_names import CELL, COMMAND, CONFIG, FILES, RENAMED, make_user, texts, write_source


@pytest.fixture
def user(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute) -> Path:
    return make_user(tmp_path, monkeypatch, execute)


@pytest.mark.parametrize("options", [(), ("--json",), ("--dry-run",)])
def test_without_a_word_of_the_user_the_lines_are_only_shown(
    user: Path, execute: Execute, options: tuple[str, ...]
) -> None:
    with unchanged(user.parent):
        printed = execute(*COMMAND, *options, code=0 if "--dry-run" in options else 2)
    message = "nothing was written: there is no terminal to ask on"
    if "--json" in options:
        *notes, last = printed.json["diagnostics"]
        assert (notes[0]["file"], notes[0]["line"], notes[0]["code"]) == ("Cell.mo", 5, "renamed-use")
        assert len(notes) == 7
        assert last["message"] == message
        return
    assert "    +  connect(robot.wristAxis, motor); // robot.elbowAxis" in printed.lines
    hint = "look at what is shown, then give --yes"
    assert printed.errors == ([] if options else [f"error: {message}; {hint} [not-confirmed]"])


@pytest.mark.parametrize(("words", "code"), [("y", 0), ("Yes ", 0), ("", 1), ("no", 1)])
def test_somebody_at_a_terminal_is_asked(
    user: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch, words: str, code: int
) -> None:
    monkeypatch.setattr(sys, "stdin", Terminal(words))
    assert "Write 7 lines in 3 files, and build arm? [y/N] " in execute(*COMMAND, code=code).out
    assert texts() == (FILES if code else RENAMED)


def test_a_file_that_is_saved_before_the_answer_stays_and_nothing_is_built(
    user: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "stdin", Terminal("y", "../plant/Bench.mo"))
    found = execute(*COMMAND, code=2).words
    assert "Bench.mo: error: it has changed meanwhile, and stays as it is now; " in found
    assert texts() == {**RENAMED, "../plant/Bench.mo": "saved"}
    assert Path("modelica/Arm/Joints/Elbow.mo").exists()


def test_an_output_elsewhere_is_asked_for_before_anything_is_written(
    user: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(user))
    Path("../elsewhere").mkdir()
    Path("urdfsync.toml").write_text(CONFIG + 'output = "../elsewhere"\n')
    Path("arm.urdf").write_text(Path("arm.urdf").read_text().replace("wrist", "elbow"))
    execute("build", "--trust")
    write_source("wrist")
    Path("modelica/Arm/Links/Mine.mo").unlink()
    Path("../plant/Bench.mo").unlink()
    assert "untrusted-output" in execute(*COMMAND, "--yes", code=2).err
    assert Path("Cell.mo").read_bytes() == CELL.encode()
    execute(*COMMAND, "--yes", "--trust")
    assert Path("Cell.mo").read_bytes() == RENAMED["Cell.mo"].encode()


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (("elbow=wirst",), "no package has a name that begins with `wirst`"),
        (("elbow",), "`elbow` is not OLD=NEW; for example --rename-uses elbow=wrist"),
        (("--all",), "--rename-uses goes without paths and --all"),
    ],
)
def test_arguments_that_make_no_sense(user: Path, execute: Execute, given: tuple[str, ...], message: str) -> None:
    assert f"error: {message}" in execute(*COMMAND, *given, code=2).words


@pytest.mark.parametrize("is_linked", [False, True])
def test_files_elsewhere_are_written_only_with_the_users_word(
    user: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch, is_linked: bool
) -> None:
    monkeypatch.setenv("XDG_CONFIG_HOME", str(user))
    if is_linked:
        Path("Bench.mo").symlink_to(user.parent / "plant/Bench.mo")
        Path("urdfsync.toml").write_text(CONFIG.replace("../plant", "Bench.mo"))
    with unchanged(user.parent):
        found = execute(*COMMAND, "--yes", code=2)
    assert f"leads out of the configuration's folder, to {user.parent}/plant/Bench.mo; " in found.words
    execute(*COMMAND, "--yes", "--trust")
    assert texts() == RENAMED


def test_a_model_that_is_saved_while_others_are_written_stays(user: Path, execute: Execute) -> None:
    """The others are written; nothing is built before all are."""
    saved = f"// saved\n{CELL}"
    once = iter([saved])

    def save(found: Operation) -> None:
        if found.name == "exchange" and user / "Cell.mo" in found.paths and (text := next(once, "")):
            Path("Cell.mo").write_bytes(text.encode())

    with before_each(save):
        error = execute(*COMMAND, "--yes", code=2).err
    assert "Cell.mo: error: it has changed meanwhile, and stays as it is now; run the command again" in error
    assert "2 other files written, nothing built" in error
    assert texts() == {**RENAMED, "Cell.mo": saved}
    execute(*COMMAND, "--yes")
    assert texts() == {**RENAMED, "Cell.mo": f"// saved\n{RENAMED['Cell.mo']}"}
