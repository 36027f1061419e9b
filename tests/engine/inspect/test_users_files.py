"""Where the user's models are looked for, and which of them are looked through when names go."""

from __future__ import annotations

import tracemalloc
from collections.abc import Mapping
from pathlib import Path

import pytest
from support.networks import C1, configure, drop, rename, run

from urdfsync.common.dependencies.reads import Reads
from urdfsync.engine.inspect import users_files
from urdfsync.engine.result import Result
from urdfsync.project import config

USE = "  .Ladder.Elements.C1 other;\n"


def model(name: str, within: str = "", body: str = USE) -> str:
    return f"within {within};\nmodel {name}\n{body}end {name};\n"


def write(files: Mapping[str, str]) -> None:
    for path, text in files.items():
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        Path(path).write_text(text)


def users(result: Result) -> list[str]:
    """The files that use what is gone."""
    return sorted(one.file for one in result.diagnostics if one.code == "unresolved")


def test_models_anywhere_below_the_configuration_and_where_it_says_are_looked_through(project: Path) -> None:
    configure('users = ["../plant", "../One.mo", ".hidden"]\n')
    run()
    found = [
        "../One.mo",
        "../plant/deep/Cell.mo",
        ".hidden/Bench.mo",
        "Top.mo",
        "models/a/b/Bench.mo",
        "modelica/Old.mo",
    ]
    others = [".git/X.mo", "models/Resources/X.mo", "venv/lib/X.mo", "nested/X.mo", "models/X.txt", "../elsewhere/X.mo"]
    write({path: model(Path(path).stem) for path in (*found, *others)})
    write({"venv/pyvenv.cfg": "", "nested/urdfsync.toml": ""})
    Path("models/Link.mo").symlink_to(Path("../elsewhere/X.mo").absolute())
    drop("C1")
    assert users(run()) == sorted(found)


def test_a_class_of_a_package_elsewhere_is_resolved_in_that_package(project: Path) -> None:
    """Its base is in a file that says nothing of the robot, and its package in another one."""
    run()
    write(
        {
            "Plant/package.mo": "within;\npackage Plant\nend Plant;\n",
            "Plant/Base.mo": model("Base", "Plant", "  Real x;\n"),
            "Plant/Cell.mo": model(
                "Cell", "Plant", f"  extends Base;\n  extends Common.Frame;\n{USE}  Real y = x + z;\n"
            ),
            "Common.mo": "package Common\n  model Frame\n    Real z;\n  end Frame;\nend Common;\n",
        }
    )
    drop("C1")
    (found,) = run().diagnostics
    assert (found.file, found.line, found.code) == ("Plant/Cell.mo", 5, "unresolved")


def test_of_files_that_are_no_modelica_only_the_names_are_read(project: Path) -> None:
    run()
    write({f"data/{number}.csv": "1" for number in range(30)} | {"data/Bench.mo": model("Bench")})
    rename("C1", "Tank")
    with Reads() as dependencies:
        assert users(run(dry=True)) == ["data/Bench.mo"]
    assert not [path for _, path in dependencies.entries if "data/" in path and path.endswith(".csv")]


def test_words_about_a_robot_use_nothing(project: Path) -> None:
    run()
    write({"Words.mo": 'model Words "Ladder"\n  // Ladder.Elements.C1\n  Nowhere.To.Be it;\nend Words;\n'})
    drop("C1")
    assert not run().diagnostics
    assert not Path(C1).exists()


def test_what_is_no_modelica_is_told_if_it_mentions_the_robot(project: Path) -> None:
    run()
    write({"Words.mo": "Ladder? No Modelica.", "Other.mo": "No Modelica."})
    (found,) = run().diagnostics
    assert (found.severity, found.code, found.file, found.line) == ("warning", "syntax", "Words.mo", 1)


def test_more_folders_than_a_project_has_are_not_looked_through(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Such as all folders of the disk, which `/` names: the first ones are looked at, and no file is read."""
    configure('users = ["/"]\n')
    write({"Bench.mo": model("Bench")})
    monkeypatch.setattr(users_files, "_MOST", 50)
    run()
    drop("C1")
    with Reads() as dependencies:
        (found,) = run(dry=True).diagnostics
    assert (found.severity, found.code, found.file) == ("warning", "too-many-folders", "urdfsync.toml")
    assert not any(str(path).endswith("Bench.mo") for _, path in dependencies.entries)


def test_of_a_text_without_end_no_names_are_looked_at(project: Path) -> None:
    """Reading it would take longer than 3 s."""
    run()
    text = model("Bench", body=f"{USE}  parameter Real table[:] = {{{', '.join(['0.125'] * 150_000)}}};\n")
    write({"Bench.mo": text})
    drop("C1")
    (found,) = run().diagnostics
    assert (found.severity, found.code, found.file) == ("warning", "too-long", "Bench.mo")
    edited = Path("modelica/Ladder/Ladder.mo")
    edited.write_text(edited.read_text().replace("\nequation", f"\n  // {'long ' * 200_000}\n\nequation"))
    assert [one.file for one in run().diagnostics] == ["Bench.mo", str(edited)]


def test_large_files_are_looked_at_one_after_the_other(project: Path) -> None:
    loaded = config.load(Path("urdfsync.toml"))
    write({"Bench.mo": model("Bench"), "Above.mo": model("Above", body="  Bench bench;\n")})
    for number in range(40):
        with Path(f"Large{number}.mo").open("wb") as file:
            file.truncate(5_000_000)
    tracemalloc.start()
    try:
        found = users_files.read_users_files(loaded, loaded.robots[0], ["Ladder"])
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert [path.name for path in found.mentioning] == ["Above.mo", "Bench.mo"]
    assert peak < 100_000_000


def test_of_classes_with_one_name_nobody_knows_which_is_meant() -> None:
    paths = map(Path, ("a/Cell.mo", "b/Cell.mo", "Plant/package.mo", "Plant/Line.mo", "One.mo"))
    tops = users_files.UsersFiles(dict.fromkeys(paths, b""), {}).tops
    assert tops == {"Plant": Path("Plant"), "One": Path("One.mo")}
