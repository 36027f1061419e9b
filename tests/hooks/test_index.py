"""The index of git, and a checkout of it."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from support.git import NEEDS_GIT, Repository

from urdfsync.diagnostics import SourceError
from urdfsync.hooks.checkout import index_checkout
from urdfsync.hooks.index import Index

pytestmark = NEEDS_GIT


@pytest.fixture
def repo(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Repository:
    """A repository with some files, in a folder that has another one beside it; the working folder is its top."""
    repository = Repository(tmp_path / "place with spaces" / "repo", monkeypatch)
    monkeypatch.chdir(repository.folder)
    for name in ("top.txt", "cad/arm.urdf", "cad/tip \xfc.stl", "out/Arm/package.mo", "out/Arm/Links/a.mo"):
        Path(name).parent.mkdir(parents=True, exist_ok=True)
        Path(name).write_text(f"{name}, committed\n")
    repository.commit()
    (tmp_path / "place with spaces/beside").mkdir()
    (tmp_path / "place with spaces/beside/mesh.stl").write_text("beside\n")
    return repository


def changed() -> set[str]:
    return set(Index(Path.cwd()).changed)


def test_line_endings_that_git_converts_are_no_change(repo: Repository) -> None:
    Path(".gitattributes").write_text("*.mo text eol=crlf\n")
    repo.commit()
    Path("out/Arm/package.mo").write_bytes(b"out/Arm/package.mo, committed\r\n")
    assert changed() == set()
    Path("out/Arm/package.mo").unlink()
    with index_checkout(Index(repo.folder)) as checkout:
        checkout.add(["out/Arm/package.mo"])
        found = checkout.place(repo.folder / "out/Arm/package.mo").read_bytes()
    assert found == b"out/Arm/package.mo, committed\r\n", "as a checkout would write it"


def test_files_that_git_was_told_not_to_look_at_may_differ(repo: Repository) -> None:
    repo.git("update-index", "--assume-unchanged", "top.txt")
    repo.git("update-index", "--skip-worktree", "cad/arm.urdf")
    assert changed() == set()
    Path("top.txt").write_text("other")
    Path("cad/arm.urdf").unlink()
    assert changed() == {"top.txt", "cad/arm.urdf"}
    with index_checkout(Index(repo.folder)) as checkout:
        checkout.add(["cad/arm.urdf"])
        assert checkout.place(repo.folder / "cad/arm.urdf").read_text() == "cad/arm.urdf, committed\n"


def test_a_further_working_tree_has_its_own_index(
    repo: Repository, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    repo.git("worktree", "add", "-q", str(tmp_path / "second"))
    monkeypatch.chdir(tmp_path / "second")
    Path("top.txt").write_text("other")
    monkeypatch.setenv("GIT_DIR", str(repo.folder / ".git/worktrees/second"))  # as git does for hooks
    index = Index(tmp_path / "second")
    assert (index.top, set(index.changed)) == (tmp_path / "second", {"top.txt"})
    with index_checkout(index) as checkout:
        checkout.add(index.changed)
        assert checkout.place(tmp_path / "second/top.txt").read_text() == "top.txt, committed\n"


def test_paths_of_the_repository(repo: Repository, tmp_path: Path) -> None:
    Path("link").symlink_to("cad")
    Path("away").symlink_to(tmp_path)
    index = Index(repo.folder)
    assert index.path(repo.folder / "cad/arm.urdf") == "cad/arm.urdf"
    assert index.path(repo.folder / "link/arm.urdf") == "cad/arm.urdf", "git does not track what is behind a link"
    assert index.path(repo.folder / "away/arm.urdf") is None
    assert index.path(repo.folder.parent / "beside/mesh.stl") is None
    assert index.path(repo.folder.parent / "repo-2/mesh.stl") is None


def test_a_submodule_is_a_repository_of_its_own(repo: Repository, tmp_path: Path) -> None:
    other = tmp_path / "other"
    subprocess.run(["git", "clone", "-q", repo.folder, other], check=True)
    repo.git("-c", "protocol.file.allow=always", "submodule", "add", "-q", str(other), "sub")
    repo.commit()
    index = Index(repo.folder)
    assert index.path(repo.folder / "sub/cad/arm.urdf") is None
    with index_checkout(index) as checkout:
        checkout.add(["top.txt"])
        assert (checkout.place(repo.folder) / "sub/cad/arm.urdf").is_file()


def test_the_files_of_a_patch(repo: Repository, tmp_path: Path) -> None:
    Path("cad/tip \xfc.stl").write_bytes(b"\0binary")
    Path("top.txt").unlink()
    patch = subprocess.run(["git", "diff", "--binary"], check=True, capture_output=True).stdout
    (tmp_path / "patch").write_bytes(patch)
    assert Index(repo.folder).patched(tmp_path / "patch") == {"cad/tip \xfc.stl", "top.txt"}


def test_a_filter_that_fails_is_an_error(repo: Repository) -> None:
    repo.git("config", "filter.bad.smudge", "false")
    repo.git("config", "filter.bad.clean", "cat")
    repo.git("config", "filter.bad.required", "true")
    Path(".gitattributes").write_text("*.urdf filter=bad\n")
    with index_checkout(Index(repo.folder)) as checkout, pytest.raises(SourceError, match="git failed"):
        Index(repo.folder).checkout(["cad/arm.urdf"], checkout.place(repo.folder))


def test_a_mirror_has_what_is_staged_in_its_place(repo: Repository) -> None:
    Path("cad/arm.urdf").write_text("staged")
    repo.git("add", ".")
    Path("cad/arm.urdf").write_text("later")
    Path("out/Arm/Links/a.mo").unlink()
    Path("out/Arm/Links/new.mo").write_text("untracked")
    with index_checkout(Index(repo.folder)) as checkout:
        checkout.add(["cad/arm.urdf"])
        checkout.add_folder(repo.folder / "out/Arm")
        here = checkout.place(repo.folder)
        assert (here / "cad/arm.urdf").read_text() == "staged"
        assert sorted(path.name for path in (here / "out/Arm").rglob("*")) == ["Links", "a.mo", "package.mo"]
        assert not any(path.is_symlink() for path in (here / "out/Arm").rglob("*"))
        assert (here / "top.txt").is_symlink(), "nothing else is copied"
        assert (here.parent / "beside/mesh.stl").read_text() == "beside\n"
        assert not (here / ".git").exists()
    assert not here.exists()
    assert Path("cad/arm.urdf").read_text() == "later"
    assert Path("out/Arm/Links/new.mo").read_text() == "untracked"


CONTENTS = st.sampled_from([None, "one\n", "two\n"])


@pytest.mark.slow
@settings(max_examples=6, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    files=st.dictionaries(st.sampled_from(["f/a", "f/b", "f/g/c", "f/h/d"]), st.tuples(CONTENTS, CONTENTS, CONTENTS))
)
def test_a_mirrored_folder_is_what_a_checkout_gives(
    repo: Repository, tmp_path_factory: pytest.TempPathFactory, files: dict[str, tuple[str | None, ...]]
) -> None:
    """Whatever is committed, staged and on disk afterwards."""
    repo.git("rm", "-r", "-f", "-q", "--cached", "--ignore-unmatch", "f")
    for step in range(3):
        for name, versions in files.items():
            content = versions[step]
            Path(name).parent.mkdir(parents=True, exist_ok=True)
            Path(name).unlink(missing_ok=True)
            if content is not None:
                Path(name).write_text(content)
        if step < 2:
            repo.git("add", "-A")
        if step < 1:
            repo.git("commit", "-q", "--allow-empty", "-m", "next")
    with index_checkout(Index(repo.folder)) as checkout:
        checkout.add_folder(repo.folder / "f")
        found = contents(checkout.place(repo.folder) / "f")
    out = tmp_path_factory.mktemp("out")
    repo.git("checkout-index", "--all", f"--prefix={out}/")
    assert found == contents(out / "f")


def contents(folder: Path) -> dict[str, str]:
    return {str(path.relative_to(folder)): path.read_text() for path in folder.rglob("*") if path.is_file()}
