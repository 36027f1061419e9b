"""Where the user's models are looked for, and which of them are looked through when names go."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest
from support.networks import C1, ROBOT, configure, edit, rename, resistor, run, run_all, source

from urdfsync import config
from urdfsync.dependencies import Dependencies
from urdfsync.engine.result import Result
from urdfsync.engine.users_files import find_users_files

USE = "  .Ladder.Elements.C1 other;\n"


def model(name: str, within: str = "", body: str = USE) -> str:
    return f"within {within};\nmodel {name}\n{body}end {name};\n"


def write(files: Mapping[str, str]) -> None:
    for path, text in files.items():
        Path(path).parent.mkdir(parents=True, exist_ok=True)
        Path(path).write_text(text)


def drop_capacitor() -> None:
    source('    {"name": "C1", "between": ["middle", "ground"], "farad": 1e-6},\n', "")


def users(result: Result) -> list[str]:
    """The files that use what is gone."""
    return sorted(one.file for one in result.diagnostics if one.code == "vanished-name")


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
    drop_capacitor()
    assert users(run()) == sorted(str(Path(path).absolute().resolve()) if path[:2] == ".." else path for path in found)


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
    drop_capacitor()
    (found,) = run().diagnostics
    assert (found.file, found.line, found.code) == ("Plant/Cell.mo", 5, "vanished-name")


def test_only_what_the_user_wrote_counts_in_packages_of_other_robots(project: Path) -> None:
    """The other robot has an element that is called like this one."""
    write({"other.json": Path("ladder.json").read_text().replace("R2", "Ladder")})
    configure(ROBOT.format("other", "Other").replace("ladder.json", "other.json"))
    run_all()
    other = Path("modelica/Other").absolute()
    edited, own = other / "Elements/R1.mo", other / "Elements/Mine.mo"
    edit(edited, "equation", f"{USE}\nequation")
    write({str(own): model("Mine", "Other.Elements")})
    loaded = config.load(Path("urdfsync.toml"))
    ladder = loaded.robots[0]
    assert [*find_users_files(loaded, ladder, [ladder.folder], ["Ladder"])] == [own, edited]
    drop_capacitor()
    result, rest = run_all()
    assert users(result) == [str(path.relative_to(project)) for path in (own, edited)]
    assert not rest.changes
    Path(".urdfsync/robots/other.state").write_text("broken")
    assert edited in find_users_files(loaded, ladder, [ladder.folder], ["Ladder"])


def test_a_build_in_which_no_name_goes_reads_no_model_of_the_users(project: Path) -> None:
    run()
    write({"models/Bench.mo": model("Bench")})
    resistor(200)
    with Dependencies() as dependencies:
        assert run().changes
    assert not [path for _, path in dependencies.entries if "models" in path]


def test_of_files_that_are_no_modelica_only_the_names_are_read(project: Path) -> None:
    run()
    write({f"data/{number}.csv": "1" for number in range(30)} | {"data/Bench.mo": model("Bench")})
    rename("C1", "Tank")
    with Dependencies() as dependencies:
        assert users(run(dry=True)) == ["data/Bench.mo"]
    assert [Path(path).name for _, path in dependencies.entries if f"{Path('data').absolute()}/" in path] == [
        "Bench.mo"
    ]


@pytest.mark.parametrize(
    "text", ['model Words "Ladder"\n  // Ladder.Elements.C1\nend Words;\n', "Ladder? No Modelica."]
)
def test_words_about_a_robot_use_nothing(project: Path, text: str) -> None:
    run()
    write({"Words.mo": text})
    drop_capacitor()
    assert not run().diagnostics
    assert not Path(C1).exists()
