"""Files of other revisions: what git has, what it has not, and names that are no revisions."""

from __future__ import annotations

import shutil
import tempfile
import zlib
from pathlib import Path
from unittest import mock

import pygit2
import pytest
from support.files import delete
from support.git import NEEDS_GIT, Repository

from urdfsync.common.dependencies.reads import file_type, is_file, list_folder, read_file
from urdfsync.common.diagnostics import SourceError
from urdfsync.common.files import shown
from urdfsync.project.git.revisions import Revision, open_repository

pytestmark = NEEDS_GIT


@pytest.fixture(scope="module")
def template(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A repository with two versions of `cad/arm.urdf`, the work tree a third one."""
    with pytest.MonkeyPatch.context() as patch:
        return _make(Repository(tmp_path_factory.mktemp("git") / "repo", patch))


def _make(made: Repository) -> Path:
    (made.folder / "cad").mkdir()
    arm = made.folder / "cad/arm.urdf"
    arm.write_bytes(b"one\r\n")
    made.commit("first")
    arm.write_bytes(b"two\n")
    made.commit("second")
    made.git("tag", "v2")
    arm.write_bytes(b"three\n")
    return made.folder


@pytest.fixture
def repository(template: Path, tmp_path: Path) -> Path:
    """The folder of a copy of the repository."""
    shutil.copytree(template, tmp_path / "repo")
    return tmp_path / "repo"


@pytest.mark.parametrize(("name", "content"), [("HEAD", b"two\n"), ("v2", b"two\n"), ("main~1", b"one\r\n")])
def test_a_file_is_read_as_it_was_without_git(
    repository: Path, name: str, content: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(repository))
    arm = repository / "cad/arm.urdf"
    assert Revision(arm.parent, name).read(arm) == content


def test_a_link_to_the_repository_is_no_obstacle(repository: Path, tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to(repository / "cad")
    arm = tmp_path / "link/arm.urdf"
    assert Revision(arm.parent, "HEAD").read(arm) == b"two\n"


def test_what_belongs_to_another_repository_is_not_asked_for(repository: Path) -> None:
    inner = repository / "cad/meshes"
    inner.mkdir()
    (inner / ".git").write_text("gitdir: elsewhere")
    (inner / "tip.stl").write_bytes(b"solid")
    revision = Revision(repository, "HEAD")
    assert not revision.holds(inner / "tip.stl")
    assert revision.holds(repository / "cad/arm.urdf")
    assert not revision.holds(repository.parent / "arm.urdf")


def test_a_view_has_the_files_of_the_revision(repository: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A link that leads out is none of its files, nor is an untracked file; those of another repository are on disk."""
    made, outside = Repository(repository, monkeypatch), repository.parent / "outside"
    outside.mkdir()
    (outside / "secret").write_bytes(b"secret")
    for name, target in {"out": "../../outside", "up": "../cad", "round": "round"}.items():
        (repository / "cad" / name).symlink_to(target)
    made.commit()
    for name in ("out", "up"):
        (repository / "cad" / name).unlink()
    (repository / "cad/later").write_bytes(b"later")
    (repository / "inner/.git").mkdir(parents=True)
    (repository / "inner/tip.stl").write_bytes(b"solid")
    monkeypatch.chdir(repository)
    arm = repository / "cad/arm.urdf"
    with Revision(repository, "main~1").view():
        assert (read_file(arm), shown(arm)) == (b"two\n", "main~1:cad/arm.urdf")
    with Revision(repository, "HEAD").view():
        assert read_file(arm) == read_file("cad/up/up/arm.urdf") == b"three\n"
        assert read_file("inner/tip.stl") == b"solid"
        names = "cad/out/secret", "cad/out", "cad/round", "cad/later"
        assert [file_type(name) for name in names] == [0, 0, 0, 0]
    assert shown(arm) == "cad/arm.urdf"


def test_a_view_writes_what_is_read(repository: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    made = Repository(repository, monkeypatch)
    (repository / "cad/film.mp4").write_bytes(bytes(10_000))
    (repository / "cad/huge.stl").write_bytes(bytes(10_000))
    made.commit()
    (repository / "cad/film.mp4").unlink()
    (tmp_path / "temporary").mkdir()
    for module in ("project.git.revisions", "common.dependencies.facts"):
        monkeypatch.setattr(f"urdfsync.{module}.MAX_FILE", 9_999)
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "temporary"))
    with Revision(repository, "HEAD").view():
        assert is_file(repository / "cad/arm.urdf")
        assert len(list_folder(repository / "cad")) == 3
        sizes = {path.name: path.stat().st_size for path in (tmp_path / "temporary").rglob("*.*") if path.is_file()}
        assert sizes == {"arm.urdf": 6, "film.mp4": 0, "huge.stl": 0}
        with pytest.raises(OSError, match="it has more than 9,999 bytes"):
            read_file(repository / "cad/huge.stl")
    assert list((tmp_path / "temporary").iterdir()) == []


def test_a_repository_of_committed_files_is_passed_over(repository: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Else a stranger's commit would say what the source was before."""
    arm, forged = repository / "cad/arm.urdf", Repository(repository.parent / "forged", monkeypatch)
    (forged.folder / "arm.urdf").write_bytes(b"forged")
    forged.commit()
    shutil.copytree(forged.folder / ".git", arm.parent, dirs_exist_ok=True)
    pygit2.Repository(arm.parent).config["core.worktree"] = str(arm.parent)
    assert Revision(arm.parent, "HEAD").read(arm) == b"two\n"
    assert Revision(arm.parent, "HEAD").holds(arm)
    delete(repository / ".git")
    assert open_repository(arm.parent) is None


def test_a_worktree_and_a_submodule_have_their_revisions(repository: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Their `.git` is a file."""
    outer = Repository(repository.parent / "outer", monkeypatch)
    outer.git("-c", "protocol.file.allow=always", "submodule", "add", "-q", str(repository), "arm")
    outer.git("-C", "arm", "worktree", "add", "-q", str(outer.folder / "tree"), "HEAD~1")
    for folder, content in (("arm", b"two\n"), ("tree", b"one\r\n")):
        arm = outer.folder / folder / "cad/arm.urdf"
        assert Revision(arm.parent, "HEAD").read(arm) == content


def test_a_path_that_the_revision_does_not_have(repository: Path) -> None:
    with pytest.raises(SourceError, match=r"tip\.urdf does not exist in revision 'HEAD'; .*git show") as caught:
        Revision(repository, "HEAD").read(repository / "cad/tip.urdf")
    assert caught.value.diagnostics[0].file.startswith("HEAD:")


@pytest.mark.parametrize(
    "name", ["nope", "HEAD~9", "HEAD:cad/arm.urdf", "a b", "..", "^HEAD", "-x", "--output=stolen", "", " ", "a\0b"]
)
def test_a_name_that_is_no_revision(repository: Path, name: str) -> None:
    with pytest.raises(SourceError, match=r"is neither a file nor a .*revision"):
        Revision(repository, name)


def test_a_content_that_the_clone_lacks(repository: Path) -> None:
    """As in one that was made without files."""
    for place in (repository / ".git/objects").glob("??/*"):
        if b"two\n" in zlib.decompress(place.read_bytes()):
            delete(place)
    with pytest.raises(SourceError, match=r"git does not have its content: .*; fetch it, or use --against ./FILE"):
        Revision(repository, "HEAD").read(repository / "cad/arm.urdf")


def test_a_repository_of_another_user(repository: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    error = pygit2.GitError(f"repository path '{repository}' is not owned by current user")
    monkeypatch.setattr(pygit2, "Repository", mock.Mock(side_effect=error))
    with pytest.raises(SourceError, match=r"the repository can't be read: .* is not owned by current user; repair it"):
        Revision(repository, "HEAD")
