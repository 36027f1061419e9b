"""An `output` outside of the configuration's folder: nothing is written there without the user's word."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

import pytest
from support import checks, fake_omc
from support.commands import Execute
from support.daemon import Watch
from support.git import NEEDS_GIT, Repository
from support.networks import configure

import urdfsync

NEEDS_SCRIPTS = pytest.mark.skipif(sys.platform == "win32", reason="the stand-in for omc is a script")


@pytest.fixture(autouse=True)
def trusted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The user's file of trusted folders, which is not there yet."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "home"))
    monkeypatch.setattr("platformdirs.user_config_path", lambda *_, **__: tmp_path / "home/urdfsync")
    file = tmp_path / "home/urdfsync/trusted.toml"
    file.parent.mkdir(parents=True)
    return file


@pytest.fixture
def outside(project: Path, tmp_path: Path) -> Path:
    """A folder beside the project, which the project builds to."""
    folder = tmp_path / "elsewhere"
    folder.mkdir()
    configure('output = "../elsewhere"\n')
    return folder


@pytest.mark.parametrize("command", ["build", "build --full", "build --svg"])
def test_a_build_needs_the_users_word(execute: Execute, outside: Path, trusted: Path, command: str) -> None:
    said = execute(*command.split(), code=2).words
    assert list(outside.iterdir()) == []
    assert f"urdfsync.toml:5: error: `output` leads out of the configuration's folder, to {outside.as_posix()}" in said
    assert "use --trust" in said
    assert f"into {trusted.as_posix()}" in said


def test_resolve_needs_the_users_word(outside: Path, execute: Execute) -> None:
    execute("build", "--trust")
    model = outside / "Ladder/Elements/R1Parameters.mo"
    model.write_text(model.read_text().replace("100", "101"))
    source = Path("ladder.json")
    source.write_text(source.read_text().replace("100", "150"))
    execute("build", "--trust", code=3)
    before = model.read_text()
    assert "[untrusted-output]" in execute("resolve", "--all", "--take", code=2).err
    assert model.read_text() == before
    execute("resolve", "--all", "--take", "--trust")
    assert "150" in model.read_text()


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="XDG_CONFIG_HOME says nothing there")
def test_watch_needs_the_users_word(outside: Path, rc_site: Path) -> None:
    folder = Path(__file__).parents[2] / "rcnetwork"
    with Watch(Path.cwd(), path=[rc_site, folder]) as watch:
        failed = watch.wait("failed")
        assert "untrusted-output" in json.dumps(failed)
        assert list(outside.iterdir()) == []
    with Watch(Path.cwd(), "--trust", path=[rc_site, folder]) as watch:
        watch.wait("built")
        assert (outside / "Ladder/package.mo").exists()


@pytest.mark.parametrize("command", ["status", "build --check", "build --dry-run", "diff", "diff --against HEAD"])
def test_other_commands_are_refused_like_builds(
    outside: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch, command: str
) -> None:
    Repository(Path.cwd(), monkeypatch).commit()
    assert "error: `output` leads out of the configuration's folder" in execute(*command.split(), code=2).words
    assert list(outside.iterdir()) == []


def test_a_folder_in_the_users_own_file_is_trusted(outside: Path, trusted: Path, execute: Execute) -> None:
    trusted.write_text(f"folders = ['{Path.cwd()}']\n")
    execute("build")
    assert (outside / "Ladder/package.mo").exists()
    assert "untrusted-output" not in execute("status").err
    trusted.unlink()
    for _ in range(2):
        execute("build", code=2)


@pytest.mark.parametrize("folder", ["..", "modelica", "/", "~"])
def test_no_other_folder_is_trusted_with_it(execute: Execute, outside: Path, trusted: Path, folder: str) -> None:
    trusted.write_text(f"folders = ['{Path(os.path.normpath(Path.cwd() / folder))}']\n")
    execute("build", code=2)
    assert list(outside.iterdir()) == []


@pytest.mark.parametrize("text", ["folders = 1", "folders = [1]", "folder = ['a']", "folders = [", "\udcff"])
def test_a_broken_file_of_trusted_folders_is_an_error(
    outside: Path, trusted: Path, execute: Execute, text: str
) -> None:
    trusted.write_bytes(text.encode(errors="surrogateescape"))
    assert str(trusted) in execute("build", code=2).err.replace("\n", "")
    assert list(outside.iterdir()) == []


def test_a_configuration_that_is_named_by_a_detour_writes_to_its_own_folder(execute: Execute, project: Path) -> None:
    Path("deep").mkdir()
    os.chdir("deep")
    execute("build", "--config", "../urdfsync.toml")


@NEEDS_GIT
def test_a_hook_takes_the_word_from_the_users_own_file(
    outside: Path, trusted: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute
) -> None:
    Repository(Path.cwd(), monkeypatch).git("add", "-A")
    assert "[untrusted-output]" in execute("hook", "build", code=2).err
    assert list(outside.iterdir()) == []
    assert "[untrusted-output]" in execute("hook", "check", code=2).err
    trusted.write_text(f"folders = ['{Path.cwd()}']\n")
    execute("hook", "build", code=1)  # the state is to be added
    assert (outside / "Ladder/package.mo").exists()


# --- OpenModelica, which runs what models and libraries name ----------------------------------------------------------


@pytest.fixture
def asked(project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A configuration that chooses OpenModelica for checks after builds; the file that tells what this was asked."""
    configure('on_build = "check"\n\n[check]\ntool = "omc"\n')
    balanced = '"Check of it completed successfully.\nClass it has 4 equation(s) and 4 variable(s)."\n""\n'
    fake_omc.install(tmp_path / "bin", {"checkModel": balanced})
    monkeypatch.setattr("urdfsync.common.processes.workers.workers", checks.thread_workers)
    monkeypatch.setenv("OPENMODELICAHOME", str(tmp_path))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return tmp_path / "bin/asked.txt"


@pytest.mark.slow
@NEEDS_SCRIPTS
def test_a_configuration_that_chooses_openmodelica_needs_the_users_word(asked: Path, execute: Execute) -> None:
    """A build in a stranger's repository would call its libraries, which may hold programs."""
    said = execute("build", code=2).words
    assert "urdfsync.toml:8: error: `tool` in the table `[check]`: OpenModelica was not run" in said
    assert "use --trust" in said
    assert "[untrusted-command]" in execute("check", code=2).err
    assert "[untrusted-command]" in execute("simulate", code=2).err
    assert [finding.code for finding in urdfsync.check()[0].diagnostics] == ["untrusted-command"]
    with pytest.raises(urdfsync.UrdfsyncError, match="OpenModelica was not run"):
        urdfsync.simulate()
    Path("urdfsync.toml").write_text(Path("urdfsync.toml").read_text().replace('"omc"', '"both"'))
    assert "[untrusted-command]" in execute("check", code=2).err
    assert not asked.exists()


@pytest.mark.slow
@NEEDS_SCRIPTS
@pytest.mark.parametrize("command", ["build --trust", "check --trust", "check --tool omc"])
def test_the_user_may_choose_openmodelica(asked: Path, execute: Execute, command: str) -> None:
    execute("build", code=2)
    execute(*command.split(), code=None)
    assert "checkModel(" in asked.read_text()


@pytest.mark.slow
@NEEDS_SCRIPTS
def test_a_trusted_folder_may_choose_openmodelica(asked: Path, trusted: Path, execute: Execute) -> None:
    trusted.write_text(f"folders = ['{Path.cwd()}']\n")
    execute("build", code=None)
    assert "checkModel(" in asked.read_text()


@NEEDS_SCRIPTS
def test_its_program_in_a_configuration_needs_the_users_word_in_any_case(
    asked: Path, tmp_path: Path, execute: Execute
) -> None:
    with Path("urdfsync.toml").open("a") as file:
        file.write(f"omc = '{tmp_path / 'bin/omc'}'\n")
    assert "`omc` in the table `[check]`: OpenModelica was not run" in execute("check", "--tool", "omc", code=2).words
    assert not asked.exists()
