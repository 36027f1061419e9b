"""`urdfsync resolve --edit`: what an editor sees, what becomes of the text that it leaves, and which one is started."""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path

import pytest
from support.commands import SETTLE, Editor, Execute
from support.files import unchanged
from support.git import NEEDS_GIT
from support.networks import FRESH, LADDER, MODEL, edit

from urdfsync.common import system
from urdfsync.modelica.stamp import split


def test_an_editor_makes_one_text_of_both(
    contradictory: Path, execute: Execute, editor: Editor, tmp_path: Path
) -> None:
    editor(SETTLE)
    assert execute("resolve", MODEL, "--edit").lines[0].endswith("2 deleted, 1 merged with your edits")
    for text in (FRESH, 'Real mine "1 %";'):
        assert text in Path(MODEL).read_text()
    execute("build", "--check")
    assert not list(tmp_path.glob("urdfsync-edit-*"))


@pytest.mark.parametrize("left", ["", pytest.param("os.mkfifo(file)", marks=pytest.mark.posix("a pipe in a folder"))])
def test_an_editor_that_leaves_no_file_is_told(
    contradictory: Path, execute: Execute, editor: Editor, left: str
) -> None:
    editor(f"import os\nfile.unlink()\n{left}")
    error = execute("resolve", MODEL, "--edit", code=2).err
    assert "the editor left no file that can be read" in error
    assert "nothing was changed" in error


def test_the_editor_sees_all_versions_in_one_file_outside_of_the_project(
    contradictory: Path, execute: Execute, editor: Editor, tmp_path: Path
) -> None:
    editor("print(len(names), Path.cwd() == file.parent); print(file.read_text()); sys.exit(3)")
    with unchanged(contradictory, but=".urdfsync/lock"):
        error = execute("resolve", MODEL, "--edit", code=2).err
    assert "the editor ended with exit code 3; nothing was changed; your text is in " in error
    (file,) = tmp_path.glob("urdfsync-edit-*/0/*")
    assert file.name == "Ladder.mo"
    lines = file.read_text().splitlines()
    marks = [line for line in lines if line[:7] in ("<<<<<<<", "|||||||", "=======", ">>>>>>>")]
    assert marks == ["<<<<<<< mine", "||||||| base", "=======", ">>>>>>> generated"]


def test_without_a_base_the_editor_sees_both_texts(execute: Execute, editor: Editor, project: Path) -> None:
    """The file that was there first is no edit of the generated one."""
    Path(MODEL).parent.mkdir(parents=True)
    Path(MODEL).write_text('model Ladder "of mine"\nend Ladder;\n')
    execute("build", code=3)
    own = 'within Ladder;\nmodel Ladder "of both"\nend Ladder;\n'
    copy = project.parent / "seen"
    editor(f"Path({str(copy)!r}).write_text(file.read_text()); file.write_text({own!r})")
    assert f"  merge      {MODEL}  as you edited it" in execute("resolve", MODEL, "--edit").lines
    assert split(Path(MODEL).read_text())[0] == own
    seen = copy.read_text()
    assert seen.startswith('<<<<<<< mine\nmodel Ladder "of mine"\n=======\nwithin ')
    assert "\n>>>>>>> generated\nend Ladder;\n" in seen


@pytest.mark.parametrize(
    ("program", "words"),
    [
        ("", "has the conflict marker"),
        ('file.write_text("")', "is not one class called `Ladder`"),
        (SETTLE + 'file.write_text(file.read_text().replace("Ladder", "Other"))', "is not one class called `Ladder`"),
        (SETTLE + 'file.write_bytes(file.read_text().replace("1 %", "\\xe4").encode("latin-1"))', "is not UTF-8"),
    ],
)
def test_an_edited_text_that_cannot_be_used_changes_nothing(
    contradictory: Path, execute: Execute, editor: Editor, program: str, words: str
) -> None:
    editor(program)
    with unchanged(contradictory, but=".urdfsync/lock"):
        error = execute("resolve", MODEL, "--edit", code=2).err
    assert words in error
    assert "nothing was changed; your text is in " in error
    assert "; --edit begins anew" in error


def test_a_proposed_merge_is_taken_only_if_the_editor_saves_it(clean: Path, execute: Execute, editor: Editor) -> None:
    """It has no markers, so an editor that the user just closes would confirm it."""
    editor("")
    with unchanged(clean, but=".urdfsync/lock"):
        error = execute("resolve", MODEL, "--edit", code=2).err
    assert "the text was not saved in the editor; nothing was changed; save it there, even if it is right" in error
    editor("file.write_text(file.read_text())")
    execute("resolve", MODEL, "--edit")
    execute("build", "--check")


def test_an_edited_text_in_latin_1_is_no_bug_while_another_file_waits(
    contradictory: Path, execute: Execute, editor: Editor
) -> None:
    edit(f"{LADDER}/Elements/R1.mo", '"Resistor R1"', '"My resistor R1"')
    edit("ladder.json", '"R1"', '"R8"')
    editor(SETTLE + 'file.write_bytes(file.read_text().replace("1 %", "\\xe4").encode("latin-1"))')
    assert "the edited text is not UTF-8; nothing was changed" in execute("resolve", MODEL, "--edit", code=2).err
    execute("build", code=3)


def test_an_edited_text_is_written_whatever_conflicts(contradictory: Path, execute: Execute, editor: Editor) -> None:
    element = f"{LADDER}/Elements/R1.mo"
    edit(element, '"Resistor R1"', '"My resistor R1"')
    edit("ladder.json", '"R1"', '"R8"')
    mine = Path(MODEL).read_text()
    execute("build", code=3)
    editor(SETTLE)
    printed = execute("resolve", MODEL, "--edit", code=3)
    assert "there is no class" in printed.err, "until the others are resolved"
    assert Path(MODEL).read_text() != mine
    execute("resolve", "--all", "--keep")
    assert 'Real mine "1 %";' in Path(MODEL).read_text()
    execute("build", "--check")


def test_what_is_saved_while_the_editor_is_open_stays(contradictory: Path, execute: Execute, editor: Editor) -> None:
    editor(f'{SETTLE}\nmine = Path({str(Path(MODEL).absolute())!r})\nmine.write_text(mine.read_text() + "// saved\\n")')
    printed = execute("resolve", MODEL, "--edit", code=3)
    assert "some files were not replaced by your edited text" in printed.err
    assert Path(MODEL).read_text().endswith("// saved\n")


def test_a_header_and_other_line_ends_are_no_other_class(contradictory: Path, execute: Execute, editor: Editor) -> None:
    text = Path(MODEL).read_bytes().replace(b"model Ladder", b"// mine\n\n  model Ladder")
    Path(MODEL).write_bytes(text.replace(b"\n", b"\r\n"))
    editor(SETTLE)
    execute("resolve", MODEL, "--edit")
    assert b'Real mine "1 %";' in Path(MODEL).read_bytes()


def test_an_edit_that_is_ones_own_text_is_kept_as_by_keep(
    contradictory: Path, execute: Execute, editor: Editor
) -> None:
    editor(f"file.write_text(Path({str(Path(MODEL).absolute())!r}).read_text())")
    execute("resolve", MODEL, "--edit")
    assert Path(f"{LADDER}/Elements/R2.mo").exists(), "the file uses it"


def test_a_text_that_is_not_taken_is_left(
    contradictory: Path, execute: Execute, editor: Editor, tmp_path: Path
) -> None:
    edit(f"{LADDER}/Elements/R1.mo", '"Resistor R1"', '"My resistor R1"')
    edit("ladder.json", '"R1"', '"R8"')
    generated = "re.sub('<<<<<<<.*?=======\\n|>>>>>>>.*?\\n', '', file.read_text(), flags=re.S)"
    editor(f"import re\nif file.name == 'Ladder.mo': sys.exit(1)\nfile.write_text({generated})")
    with unchanged(contradictory, but=".urdfsync/lock"):
        error = execute("resolve", "--all", "--edit", code=2).err
    assert "the editor ended with exit code 1; nothing was changed; your text is in " in error
    assert len(list(tmp_path.glob("urdfsync-edit-*/*/R8.mo"))) == 1


HOSTILE = """
[core]
repositoryformatversion = 0
bare = true
editor = touch pwned
[merge]
tool = evil
[mergetool "evil"]
cmd = touch pwned
trustExitCode = true
"""


@NEEDS_GIT
def test_no_folder_of_the_project_chooses_what_is_started(
    contradictory: Path, execute: Execute, editor: Editor, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """It poses as a bare repository, or is one that somebody has copied with its settings."""
    for folder in (contradictory, contradictory / ".git"):
        for name in ("objects", "refs"):
            (folder / name).mkdir(parents=True)
        (folder / "HEAD").write_text("ref: refs/heads/main\n")
        (folder / "config").write_text(HOSTILE)
    for name in ("VISUAL", "EDITOR"):
        monkeypatch.delenv(name, raising=False)
    error = execute("resolve", MODEL, "--edit", code=2).err
    assert "there is no editor to open; name one in the environment variable VISUAL or EDITOR" in error
    monkeypatch.setenv("VISUAL", "editor-of-nobody")
    (contradictory / "editor-of-nobody").write_text("#!/bin/sh\ntouch pwned\n")
    (contradictory / "editor-of-nobody").chmod(0o755)
    assert "`editor-of-nobody` can't be started" in execute("resolve", MODEL, "--edit", code=2).err
    assert not list(Path(tempfile.gettempdir()).glob("urdfsync-edit-*")), "nothing was edited"
    assert not list(tmp_path.rglob("pwned"))


def test_a_command_that_cannot_be_read_is_no_bug(
    contradictory: Path, execute: Execute, editor: Editor, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("VISUAL", 'it"s')
    assert '`it"s` is no command: no closing quotation' in execute("resolve", MODEL, "--edit", code=2).err


def test_what_an_edited_text_uses_stays(contradictory: Path, execute: Execute, editor: Editor) -> None:
    editor(SETTLE.replace("Real mine", "Elements.R2 mine"))
    printed = execute("resolve", MODEL, "--edit")
    assert "2 orphans kept because your files need them" in printed.words
    assert "Elements.R2 mine" in Path(MODEL).read_text()
    assert Path(LADDER, "Elements/R2.mo").exists()


@pytest.mark.windows
@pytest.mark.parametrize(("line", "words"), [
    (r"C:\windows\notepad.exe", [r"C:\windows\notepad.exe"]),
    (r'"C:\Program Files\Editor\editor.exe" -n', [r"C:\Program Files\Editor\editor.exe", "-n"]),
    (r"code.cmd --wait", ["code.cmd", "--wait"]),
])  # fmt: skip
def test_backslashes_of_an_editor_stay(line: str, words: list[str]) -> None:
    assert system.split_words(line) == words


@pytest.mark.windows
def test_an_editor_may_be_a_batch_file(
    contradictory: Path, execute: Execute, editor: Editor, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    editor(SETTLE)
    batch = tmp_path / "my editor" / "code.cmd"
    batch.parent.mkdir()
    batch.write_text(f'@"{sys.executable}" "{tmp_path / "editor.py"}" %1\n')
    monkeypatch.setenv("PATH", f"{batch.parent}{os.pathsep}{os.environ['PATH']}")
    for command in (f'"{batch}"', "code"):
        monkeypatch.setenv("VISUAL", command)
        execute("resolve", MODEL, "--edit")
        assert 'Real mine "1 %";' in Path(MODEL).read_text()
        execute("resolve", MODEL, "--undo", code=3)
