"""What docs/promises.md promises: no version loses a form, and each goes on with projects of the ones before it."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from support.commands import Execute
from support.kept import KEPT, PROJECTS, contents, forms, functions
from support.networks import edit

import urdfsync

FORMS = [file.name for file in sorted(KEPT.glob("*.txt"))]


@pytest.fixture(scope="module")
def present() -> dict[str, str]:
    return forms()


@pytest.mark.parametrize("form", FORMS)
def test_no_form_is_lost(present: dict[str, str], form: str) -> None:
    lost = set((KEPT / form).read_text(encoding="utf-8").splitlines()) - set(present[form].splitlines())
    assert not lost, f"{form}: a promise is broken (docs/promises.md)"


def test_each_form_is_kept(present: dict[str, str]) -> None:
    assert sorted(present) == FORMS
    assert all(len(text.splitlines()) > 10 for text in present.values())


@pytest.mark.parametrize(
    "after", ["def build(a, *, b=1): ...", "def build(a, *, b=2, c=3): ...", "def build(a, b=1, *, c=3): ..."]
)
def test_a_changed_function_would_be_seen(monkeypatch: pytest.MonkeyPatch, after: str) -> None:
    def before(a: object, *, b: int = 1, c: int = 3) -> None: ...

    monkeypatch.setattr(urdfsync, "build", before, raising=False)
    known, scope = set(functions()), dict[str, object]()
    exec(after, scope)
    monkeypatch.setattr(urdfsync, "build", scope["build"])
    assert known - set(functions())


@pytest.mark.parametrize("name", PROJECTS)
def test_a_project_of_an_earlier_version_goes_on(
    execute: Execute, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    """It is in step, or in the same conflict; the next export reaches it, and its edit stays."""
    kind, project = PROJECTS[name], Path(shutil.copytree(KEPT / name, tmp_path / "project"))
    monkeypatch.chdir(project)
    package, waits = Path("modelica"), 3 if kind.is_in_conflict else 0
    before = contents(package)
    execute("build", "--check", code=waits)
    execute("build", code=waits)
    assert contents(package) == before
    if kind.is_in_conflict:
        execute("resolve", "modelica/Arm/Links/ForeParameters.mo", "--take")
    execute("build", "--check")
    edited, (source, old, new) = package / kind.edited, kind.export
    text = edited.read_text(encoding="utf-8")
    edit(source, old, new)
    execute("build", "--check", code=1)
    execute("build")
    assert "// mine" in text
    assert edited.read_text(encoding="utf-8") == text
    assert contents(package) != before
    execute("build", "--check")
