"""A clone decides as the original: what a decision rests on is committed, never a note of one machine."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from support.commands import Execute
from support.git import NEEDS_GIT, Repository, built_arm
from support.networks import edit
from support.replay import contents
from support.urdfs import joint, link, robot

pytestmark = NEEDS_GIT

ARM = Path("modelica/Arm")
MODEL = ARM / "Arm.mo"


def write_source(*, elbow: str = "elbow", hand: str = "hand", grip: bool = True, mass: float = 2) -> None:
    links = [link("base"), link("upper", mass), link(hand, 3), *([link("tool", 4)] if grip else [])]
    joints = [
        joint(elbow, "revolute", "base", "upper", axis="0 0 1"),
        joint("wrist", "revolute", "upper", hand, axis="0 1 0"),
        *([joint("grip", "revolute", hand, "tool", axis="0 1 0")] if grip else []),
    ]
    Path("arm.urdf").write_text(robot(*links, *joints))


@pytest.fixture
def repository(folder: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute) -> Repository:
    """An arm, built and committed."""
    return built_arm(folder / "project", write_source, execute, monkeypatch)


class Both:
    """The original and a clone of it, in which the same happens."""

    def __init__(self, repository: Repository, execute: Execute, monkeypatch: pytest.MonkeyPatch) -> None:
        repository.commit()
        self.folders = [repository.folder, repository.folder.parent / "clone"]
        shutil.rmtree(self.folders[1], ignore_errors=True)
        repository.git("clone", "-q", ".", str(self.folders[1]))
        self._execute, self._monkeypatch = execute, monkeypatch

    def run(self, *commands: str, code: int = 0) -> list[str]:
        """Run commands in both; return the words of both, which differ only in notes about texts put aside."""
        words = list[str]()
        for folder in self.folders:
            self._monkeypatch.chdir(folder)
            words.append("".join(self._execute(*command.split(), code=code).out for command in commands))
        assert words[0] == words[1]
        first, second = (contents(folder / ARM) for folder in self.folders)
        assert first == second
        return words


def test_what_needs_a_file_keeps_it_wherever_it_is_built(
    repository: Repository, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    edit(ARM / "Joints/Grip.mo", "\nequation\n", "\n  Real mine = 1;\nequation\n")
    write_source(grip=False)
    execute("build")
    execute("resolve", ARM / "Joints/Grip.mo", "--keep")
    both = Both(repository, execute, monkeypatch)
    (words, _) = both.run("build", "status")
    assert "orphan modelica/Arm/Joints/GripParameters.mo no longer generated, but your files need it" in " ".join(
        words.split()
    )
    for folder in both.folders:
        (folder / ARM / "Joints/Grip.mo").unlink()
        edit(folder / ARM / "Joints/package.order", "Grip\n", "")
    both.run("build", "build --check")
    assert not (ARM / "Joints/GripParameters.mo").exists()


@pytest.mark.parametrize("exports", [1, 2, 4])
def test_an_older_text_of_urdfsyncs_own_is_repaired(
    repository: Repository, execute: Execute, monkeypatch: pytest.MonkeyPatch, exports: int
) -> None:
    for number in range(exports):
        write_source(mass=2.5 + number)
        execute("build")
        repository.commit()
    now = contents(ARM)
    both = Both(repository, execute, monkeypatch)
    first = repository.git("rev-list", "--max-parents=0", "HEAD").strip()
    old = repository.git("show", f"{first}:{ARM.as_posix()}/Links/UpperParameters.mo").encode()
    for folder in both.folders:
        monkeypatch.chdir(folder)
        Path(ARM, "Links/UpperParameters.mo").write_bytes(old)
    both.run("build")
    assert contents(ARM) == now
    if exports > 1:
        assert old in contents(Path(".urdfsync/aside")).values(), "a person may have written it"
    both.run("build --check")


def test_a_text_that_an_undo_brought_back_is_the_users_in_each_clone(
    repository: Repository, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    old = (record := ARM / "Links/UpperParameters.mo").read_bytes()
    for mass in (3, 4):
        write_source(mass=mass)
        execute("build")
    record.write_bytes(old)
    execute("build")
    assert record.read_bytes() != old
    execute("resolve", record, "--undo")
    both = Both(repository, execute, monkeypatch)
    both.run("build", "build --check")
    assert record.read_bytes() == old


@pytest.mark.parametrize("later", [pytest.param("", marks=pytest.mark.slow), "another name", "another mass"])
@pytest.mark.parametrize("merging", [False, True])
def test_an_edit_follows_a_rename_over_a_merge(
    repository: Repository, execute: Execute, monkeypatch: pytest.MonkeyPatch, merging: bool, later: str
) -> None:
    """One branch connects a sensor to `hand`, the other branch renames `hand`."""
    if merging:
        edit("urdfsync.toml", 'package = "Arm"\n', 'package = "Arm"\non_conflict = "merge"\n')
        repository.commit()
    repository.git("checkout", "-q", "-b", "edit")
    sensor = "  Modelica.Mechanics.MultiBody.Sensors.AbsoluteSensor mine;\n"
    edit(MODEL, "\nequation\n", f"\n{sensor}\nequation\n  connect(hand.frame_a, mine.frame_a);\n")
    execute("build")
    repository.commit()
    repository.git("checkout", "-q", "main")
    write_source(hand="palm")
    execute("build")
    name = "paw" if later == "another name" else "palm"
    if later:
        write_source(hand=name, mass=5 if later == "another mass" else 2)
        execute("build")
    repository.commit()
    repository.git("merge", "-q", "--no-edit", "edit")
    both = Both(repository, execute, monkeypatch)
    if not merging:
        both.run("build --check", code=3)
        both.run(f"resolve {MODEL} --merge")
    else:
        both.run("build --check", code=1)
        both.run("build")
    both.run("build --check", "status")
    assert f"connect({name}.frame_a, mine.frame_a);" in MODEL.read_text()


# The user's own classes


BRAKE = 'within Arm.Joints;\nmodel MyBrake "Mine, not Elbow"\n  extends Elbow;  // of Elbow\nend MyBrake;\n'


@pytest.fixture
def brake(repository: Repository, execute: Execute) -> Path:
    """A class of the user's own that extends a generated one, and that the edited model uses."""
    path = ARM / "Joints/MyBrake.mo"
    path.write_text(BRAKE)
    with (ARM / "Joints/package.order").open("a") as file:
        file.write("MyBrake\n")
    edit(MODEL, "Joints.Elbow elbow", "Joints.MyBrake elbow")
    execute("build", "--check")
    repository.commit()
    return path


def followed(path: Path) -> bool:
    return path.read_text() == BRAKE.replace("extends Elbow", "extends Knee")


@pytest.mark.slow
@pytest.mark.parametrize("how", ["at once", "one by one", "build --merge"])
def test_a_users_own_class_follows_like_an_edit(
    repository: Repository, brake: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch, how: str
) -> None:
    write_source(elbow="knee")
    both = Both(repository, execute, monkeypatch)
    if how == "build --merge":
        both.run(how)
    else:
        both.run("build", code=3)
        assert brake.read_text() == BRAKE, "nobody has allowed it"
        if how == "at once":
            both.run("resolve --all --merge")
        else:
            both.run(f"resolve {MODEL} --merge", code=3)
            both.run(f"resolve {brake} --merge")
    both.run("build --check", "status")
    assert followed(brake)
    assert "Joints.MyBrake knee" in MODEL.read_text()
    execute("resolve", brake, "--undo", code=None)
    assert brake.read_text() == BRAKE


def test_nothing_but_its_new_names_can_be_taken_for_a_users_own_class(brake: Path, execute: Execute) -> None:
    write_source(elbow="knee")
    execute("build", code=3)
    execute("resolve", "--all", "--take")
    assert followed(brake)
    assert "MyBrake" not in MODEL.read_text()


@pytest.mark.slow
def test_a_users_own_class_that_is_kept_and_used_makes_the_package_broken(brake: Path, execute: Execute) -> None:
    write_source(elbow="knee")
    execute("build", code=3)
    execute("resolve", brake, "--keep", code=3)
    execute("resolve", MODEL, "--merge", code=3)
    for command, code in (("build", 3), ("build --merge", 3), ("build --check", 1)):
        assert "broken" in execute(*command.split(), code=code).out
    assert brake.read_text() == BRAKE
    edit(brake, "extends Elbow", "extends Knee")
    execute("build", "--check")


def test_a_users_class_elsewhere_is_told_and_stays(repository: Repository, execute: Execute) -> None:
    """The edited model uses it, so that the package is broken; only its user may write it."""
    Path("MyBrake.mo").write_text('model MyBrake "Mine"\n  extends Arm.Joints.Elbow;\nend MyBrake;\n')
    edit(MODEL, "Joints.Elbow elbow", "MyBrake elbow")
    execute("build", "--check")
    text = Path("MyBrake.mo").read_text()
    write_source(elbow="knee")
    printed = execute("build", "--merge", code=3)
    assert "broken" in printed.out
    assert "MyBrake.mo:2: error: " in printed.err
    assert "use `Knee` instead" in printed.err
    assert Path("MyBrake.mo").read_text() == text


def test_a_name_that_the_user_declares_himself_does_not_follow(brake: Path, execute: Execute) -> None:
    """It can't be known which of both is meant."""
    brake.write_text(
        BRAKE.replace("  extends", "  model Inner\n    model Elbow\n    end Elbow;\n  end Inner;\n  extends")
    )
    execute("build", "--check")
    write_source(elbow="knee")
    execute("build", "--merge", code=3)
    assert "  extends Elbow;" in brake.read_text()


def test_with_merge_unknown_files_are_listed_too(brake: Path, execute: Execute) -> None:
    (robot,) = execute("build", "--merge", "--dry-run", "--format=json").json["results"]
    assert brake.as_posix() in [action["path"] for action in robot["actions"]]
