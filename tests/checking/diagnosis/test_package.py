"""A package as a check looks at it: where it is, and which classes in it are the user's."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfsync.checking.diagnosis.package import Package


def package(**texts: str) -> Package:
    """A robot's package with these files, written with `_` for `/` and without `.mo`."""
    files = {f"{name.replace('_', '/')}.mo": text.encode() for name, text in texts.items()}
    return Package("Plant.Robots.Arm", Path("/out/Plant/Robots/Arm"), files, str)


def test_the_top_level_package_is_as_far_out_as_there_are_dots() -> None:
    assert package().top == Path("/out/Plant")
    assert Package("Arm", Path("/out/Arm"), {}, str).top == Path("/out/Arm")


def test_own_models_are_those_in_files_that_are_not_generated() -> None:
    found = package(
        Arm="within Plant.Robots.Arm;\nmodel Arm\nend Arm;\n",
        Own="within Plant.Robots.Arm;\nmodel Own\nend Own;\n",
        Control_PID="within Plant.Robots.Arm.Control; block PID\nend PID;\n",
        Control_package="within Plant.Robots.Arm;\npackage Control\nend Control;\n",
        Resources_Notes="model Notes\nend Notes;\n",
    )
    assert found.own_models(["Arm.mo", "package.mo"]) == ["Control.PID", "Own"]
    assert found.own_models(found.texts) == []


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        pytest.param("model Own end Own;", True, id="model"),
        pytest.param("within; // model\n\nencapsulated model Own end Own;", True, id="encapsulated"),
        pytest.param("final block Own end Own;", True, id="block"),
        pytest.param("model Own = Arm(n = 2);", True, id="short"),
        pytest.param("model Own partial model In end In; end Own;", True, id="something partial in it"),
        pytest.param("partial model Own end Own;", False, id="partial"),
        pytest.param("encapsulated partial model Own end Own;", False, id="encapsulated partial"),
        pytest.param("function Own end Own;", False, id="function"),
        pytest.param("record Own end Own;", False, id="record"),
        pytest.param("package Own model In end In; end Own;", False, id="package"),
        pytest.param("expandable connector Own end Own;", False, id="connector"),
        pytest.param("type Own = Real;", False, id="type"),
        pytest.param("model Other end Other;", False, id="another name"),
        pytest.param("within Plant.Robots", False, id="nothing behind within"),
        pytest.param("model", False, id="no name"),
        pytest.param("", False, id="empty"),
    ],
)
def test_models_and_blocks_that_are_not_partial_compile_by_themselves(text: str, expected: bool) -> None:
    assert (package(Own=text).own_models([]) == ["Own"]) is expected
