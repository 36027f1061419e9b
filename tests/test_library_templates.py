"""The library's own links and joints are what the templates of generated ones say."""

from pathlib import Path

import pytest
from support.library import library_artifacts

from urdfsync.domain import Artifact, Order
from urdfsync.render import Renderer

REPOSITORY = Path(__file__).resolve().parents[1]
LIBRARY = REPOSITORY / "modelica" / "UrdfSync"


def text_of(artifact: Artifact | Order) -> str:
    if isinstance(artifact, Order):
        return "".join(f"{name}\n" for name in artifact.names)
    return Renderer([REPOSITORY / "templates" / "urdf"]).render(artifact.template, artifact.data)


@pytest.mark.parametrize("artifact", list(library_artifacts()), ids=lambda artifact: artifact.path)
def test_library_file_is_in_step_with_the_templates(artifact: Artifact | Order) -> None:
    file = LIBRARY / artifact.path
    assert file.read_text(encoding="utf-8") == text_of(artifact), (
        "a template has changed: run `python tests/test_library_templates.py` and review what it wrote"
    )


def test_there_is_nothing_else_in_links_and_joints() -> None:
    written = {artifact.path for artifact in library_artifacts()} | {"Links/package.mo", "Joints/package.mo"}
    found = {p.relative_to(LIBRARY).as_posix() for kind in ("Links", "Joints") for p in (LIBRARY / kind).iterdir()}
    assert found == written


if __name__ == "__main__":
    for each in library_artifacts():
        (LIBRARY / each.path).write_text(text_of(each), encoding="utf-8", newline="\n")
