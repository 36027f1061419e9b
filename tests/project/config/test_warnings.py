"""What a configuration asks for in vain is told before the work, and each thing once."""

from __future__ import annotations

from pathlib import Path

import pytest
from support.commands import Execute

from urdfsync.project import config
from urdfsync.project.config.warnings import find_warnings


def warnings(project: Path, text: str) -> list[str]:
    (project / "urdfsync.toml").write_text(text)
    loaded = config.load(Path("urdfsync.toml"))
    return [str(found).replace("\\", "/") for found in find_warnings(loaded, loaded.robots)]


def robots(number: int = 1, more: str = "") -> str:
    keys = f'source = "ladder.json"\ndomain = "rcnetwork"\n{more}'
    return "".join(f'[robots.r{n}]\npackage = "R{n}"\n{keys}' for n in range(number))


def template(project: Path, name: str, text: str = "text") -> None:
    path = project / "own" / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def test_search_paths_that_do_not_exist(project: Path) -> None:
    (project / "there").mkdir()
    text = '[defaults]\npackage_paths = ["there", "gone"]\n' + robots(3)
    assert warnings(project, text) == [
        "urdfsync.toml:2: warning: the folder gone of `package_paths` does not exist; correct it, or take it out "
        "[no-package-path]"
    ]


def test_models_of_the_users_that_do_not_exist(project: Path) -> None:
    (project / "Cell.mo").touch()
    assert warnings(project, robots(1, 'users = ["Cell.mo", ".", "../gone"]\n')) == [
        "urdfsync.toml:5: warning: ../gone of `users` does not exist; correct it, or take it out [no-users-path]"
    ]


@pytest.mark.parametrize(
    ("name", "near"),
    [
        ("element/modle.mo.jinja", "element/model.mo.jinja"),
        ("model.mo.jinja", "element/model.mo.jinja"),
        ("rcnetwork/element/model.mo.jinja", "element/model.mo.jinja"),
        ("element/model.mo", "element/model.mo.jinja"),
        ("zzz.jinja", ""),
    ],
)
def test_templates_that_replace_none(project: Path, name: str, near: str) -> None:
    template(project, name)
    (message,) = warnings(project, robots(2, 'templates = "own"\n'))
    hint = f"did you mean `{near}`? [stray-template]" if near else "rename it to one of element/model.mo.jinja, "
    assert f"own/{name}: warning: the file replaces no template: urdfsync has none of this name; {hint}" in message


def test_templates_that_have_a_use(project: Path) -> None:
    template(project, "element/model.mo.jinja", "<% include 'parts/axis.jinja' %>")
    template(project, "parts/axis.jinja")
    template(project, "README.md")
    template(project, ".git/model.mo.jinja")
    assert warnings(project, robots(1, 'templates = "own"\n')) == []


def test_warnings_are_shown_by_a_build(project: Path, execute: Execute) -> None:
    warnings(project, robots(1, 'package_paths = ["gone"]\n'))
    assert "[no-package-path]" in execute("build").err
    quiet = execute("build", "--quiet")
    assert (quiet.out, quiet.err) == ("", "")
    assert '"code": "no-package-path"' in execute("build", "--format=json", code=None).out
