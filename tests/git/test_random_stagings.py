"""`hook check` says of a commit what `build --check` says in a fresh clone, whatever was staged, and how.

The clone takes the place of the repository, so paths that lead out of the repository mean the same.
"""

from __future__ import annotations

import contextlib
import os
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from random import Random

import pytest
from support import meshes, urdfs
from support.cases import CASES
from support.git import NEEDS_GIT, Repository

from urdfsync import cli

pytestmark = NEEDS_GIT

SEEDS = range(1, 3)
"""The cases of each run; `URDFSYNC_CASES` gives as many fresh ones."""
RECORD, MODEL, STATE = (
    "modelica/Arm/Links/BaseParameters.mo",
    "modelica/Arm/Links/Base.mo",
    ".urdfsync/robots/arm.state",
)
SOURCES = "exports/v1/arm.urdf", "exports/v2/arm.urdf"
FORMS = "file", "link", "folder", "chain", "outside", "submodule", "nested", "xacro"
IGNORES = "COLCON_IGNORE", "AMENT_IGNORE", "CATKIN_IGNORE"
ATTRIBUTES = "*.urdf text eol=crlf", "*.stl text eol=crlf", "*.mo eol=crlf", "* text=auto", "*.toml ident", "* -text"


def write(path: str | Path, text: str) -> None:
    """Write a file, also through a link; what is in the way of its folder goes."""
    file = Path(path)
    for folder in file.parents:
        if (folder.is_symlink() and not folder.exists()) or folder.is_file():
            folder.unlink()
    file.parent.mkdir(parents=True, exist_ok=True)
    if file.is_dir() and not file.is_symlink():
        shutil.rmtree(file)
    if not file.resolve().parent.is_dir():  # a link that leads to no folder
        file.unlink()
    file.write_text(text)


def arm(mass: float, *, mesh: str = "package://parts/a.stl") -> str:
    """A robot of one link with a mass and a mesh."""
    shape = f'<visual><geometry><mesh filename="{mesh}"/></geometry></visual>'
    return urdfs.robot(urdfs.link("base", mass).replace("</link>", f"{shape}</link>"))


def git(*arguments: str, at: str = ".") -> None:
    """Run git; it may refuse, as for a path that is ignored."""
    subprocess.run(["git", "-c", "protocol.file.allow=always", *arguments], cwd=at, capture_output=True, check=False)


def make(form: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Make a repository with a robot in step, all committed; the robot's source is reached by this form."""
    repository = Repository(folder / "project", monkeypatch)
    (folder / "outside").mkdir()
    monkeypatch.chdir(repository.folder)
    source = {"link": "arm.urdf", "submodule": "sub/arm.urdf", "nested": "nest/arm.urdf", "xacro": "arm.urdf.xacro"}
    for number, path in enumerate(SOURCES):
        write(path, arm(1 + number))
    write("share/deep/parts/package.xml", "<package><name>parts</name></package>")
    write("share/deep/parts/a.stl", meshes.stl())
    write("models/Mine.mo", "model Mine\n  Arm.Arm arm;\nend Mine;\n")
    write("notes.txt", "notes\n")
    if form == "link":
        Path("arm.urdf").symlink_to(SOURCES[0])
    elif form == "chain":
        Path("current").symlink_to("exports/v1")
    elif form == "outside":
        write(folder / "outside/arm.urdf", arm(3))
        (folder / "outside/back").symlink_to(repository.folder / "exports/v1")
    elif form == "submodule":
        git("init", "-q", "-b", "main", "--template=", str(folder / "upstream"))
        git("config", "receive.denyCurrentBranch", "ignore", at=str(folder / "upstream"))
        write(folder / "upstream/arm.urdf", arm(4))
        git("add", ".", at=str(folder / "upstream"))
        git("commit", "-qm", "first", at=str(folder / "upstream"))
        git("submodule", "add", "-q", "../upstream", "sub")
    elif form == "nested":
        git("init", "-q", "--template=", "nest")
        write("nest/arm.urdf", arm(5))
        git("add", ".", at="nest")
        git("commit", "-qm", "first", at="nest")
        shutil.rmtree("nest/.git")  # at first it is an ordinary folder
    elif form == "xacro":
        macro = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">'
        write("exports/v1/part.xacro", f"{macro}<xacro:property name='m' value='2'/></robot>")
        text = arm(7).replace("<robot ", f"{macro[:-1]} ").replace('value="7"', 'value="${m}"')
        write("arm.urdf.xacro", text.replace("<link", '<xacro:include filename="exports/v1/part.xacro"/><link', 1))
    if form in ("folder", "chain"):
        Path("robots").symlink_to("exports/v1" if form == "folder" else "current")
    robot = source.get(form, "robots/arm.urdf" if form in ("folder", "chain") else SOURCES[0])
    if form == "outside":
        Path("arm.urdf").symlink_to("../outside/back/arm.urdf")
        robot = "arm.urdf"
    write("urdfsync.toml", f'[robots.arm]\nsource = "{robot}"\npackage = "Arm"\npackage_paths = ["share"]\n')
    assert cli.main(["build", "--quiet"]) == 0
    repository.commit()
    assert cli.main(["build", "--check", "--quiet"]) == 0


class Stagings:
    """Random changes of one repository, and random ways to stage them."""

    def __init__(self, random: Random, folder: Path) -> None:
        self.random, self._folder = random, folder
        self.done: list[str] = []

    def step(self) -> None:
        """Change something, and stage something."""
        change = self.random.choice(CHANGES)
        path = change(self)
        stage = self.random.choices(STAGES, [3, 3, 1, 1, 1, 1, 1, 1])[0]
        self.done.append(f"{change.__name__} {path}; {stage}")
        git(*[word.format(path) for word in stage.split()])
        if stage == "add {}" and self.random.random() < 0.2:  # then it is staged in part
            self.done[-1] += f"; {self.edit_source()}"

    def _pick(self, *paths: str) -> str:
        there = [path for path in paths if Path(path).exists() or Path(path).is_symlink()]
        return self.random.choice(there or paths)

    def edit_source(self) -> str:
        path = self._pick(*SOURCES, "sub/arm.urdf", "nest/arm.urdf", "exports/v1/part.xacro", "arm.urdf")
        with contextlib.suppress(OSError):
            text = Path(path).read_text()
            old, new = self.random.sample(['"1"', '"2"', '"8"', '"9"', "'2'", "'6'"], 2)
            Path(path).write_text(text.replace(old, new) if old in text else arm(self.random.choice([1, 2, 6])))
        return path

    def break_source(self) -> str:
        path = self._pick(*SOURCES, "nest/arm.urdf", "arm.urdf")
        write(path, self.random.choice(["<robot", "", "<robot name='a'/>"]))
        return path

    def retarget(self) -> str:
        path = self._pick("robots", "current", "arm.urdf", "share")
        targets = ["exports/v1", "exports/v2", "current", "nowhere", "nest"]
        files = [
            *SOURCES,
            "../outside/arm.urdf",
            "../outside/back/arm.urdf",
            str(Path.cwd() / SOURCES[1]),
            "nest/arm.urdf",
        ]
        place = Path(path)
        if place.is_dir() and not place.is_symlink():
            if not Path("moved").exists():
                place.rename("moved")
            targets = ["moved", "exports"]
        if place.is_symlink() or not place.is_dir():
            place.unlink(missing_ok=True)
        if not place.exists():
            place.symlink_to(self.random.choice(files if path == "arm.urdf" else targets))
        return path

    def delete(self) -> str:
        path = self._pick(
            *SOURCES, RECORD, MODEL, STATE, "share/deep/parts/a.stl", "urdfsync.toml", "robots", "notes.txt"
        )
        place = Path(path)
        if not place.is_dir() or place.is_symlink():
            place.unlink(missing_ok=True)
        return path

    def edit_mesh(self) -> str:
        path = self._pick("share/deep/parts/a.stl", "moved/deep/parts/a.stl")
        write(path, meshes.stl(self.random.choice([1, 2, 3])))
        return path

    def ignore_package(self) -> str:
        path = f"{self._pick('share/deep', 'share/deep/parts', 'share')}/{self.random.choice(IGNORES)}"
        Path(path).unlink() if Path(path).is_file() else write(path, "")
        return path

    def second_package(self) -> str:
        folder = self.random.choice(["share/again/parts", "share/a/parts", "parts", "exports/v1/parts"])
        write(f"{folder}/package.xml", "<package><name>parts</name></package>")
        write(f"{folder}/a.stl", meshes.stl(self.random.choice([1, 4])))
        return folder

    def edit_package(self) -> str:
        path = self._pick(RECORD, MODEL, "modelica/Arm/package.order", "modelica/Arm/Arm.mo")
        with contextlib.suppress(OSError):
            text = Path(path).read_text()
            Path(path).write_text(
                self.random.choice([f"{text}// mine\n", text.replace("1", "2"), text.replace("Base", "Bas")])
            )
        return path

    def edit_state(self) -> str:
        folder = Path(".urdfsync/bases/arm")
        path = self.random.choice([STATE, *map(str, sorted(folder.iterdir()) if folder.is_dir() else [])])
        lines = Path(path).read_text().splitlines(keepends=True) if Path(path).is_file() else []
        kept = [line for line in lines if self.random.random() < 0.8]
        if self.random.random() < 0.5:
            write(path, "".join(kept))
        else:
            Path(path).unlink(missing_ok=True)
        return path

    def attributes(self) -> str:
        path = self.random.choice([".gitattributes", "exports/.gitattributes", "modelica/.gitattributes"])
        write(path, f"{self.random.choice(ATTRIBUTES)}\n")
        return path

    def ignore(self) -> str:
        write(".gitignore", self.random.choice(["*.urdf\n", "modelica/Arm/Links/\n", "*.stl\n", "share/\n", "\n"]))
        return ".gitignore"

    def own_model(self) -> str:
        path = self._pick("models/Mine.mo", "modelica/Other.mo", "modelica/Arm/Own.mo")
        name, within = Path(path).stem, "within Arm;\n" if "Arm" in path else ""
        write(path, f"{within}model {name}\n  Arm.Arm arm;\nend {name};\n")
        return path

    def build(self) -> str:
        cli.main(["build", "--quiet"])
        return "modelica"

    def configure(self) -> str:
        with contextlib.suppress(OSError):
            text = Path("urdfsync.toml").read_text()
            old, new = self.random.choice([
                ('["share"]', '["moved", "share/deep"]'), ('"Arm"', '"Bot"'), ("source", "sorce"), ("v1", "v2"),
                ('package = "Arm"', 'package = "Arm"\ntemplates = "own"'), ("arm.urdf", "sub/arm.urdf"),
                ('"exports', f'"{Path.cwd()}/exports'),
            ])  # fmt: skip
            Path("urdfsync.toml").write_text(text.replace(old, new))
        return "urdfsync.toml"

    def templates(self) -> str:
        path = self.random.choice(["own/link/record.mo.jinja", "own/notes.txt", "own/deep"])
        if path == "own/deep":
            Path("own").mkdir(exist_ok=True)
            if not Path(path).is_symlink():
                Path(path).symlink_to(self.random.choice(["../share", "../own", "/"]))
        else:
            write(path, "record <<")
        return path

    def submodule(self) -> str:
        """Commit in the submodule, for all to get; or only check out another commit there."""
        if not Path("sub/.git").exists():
            git("submodule", "add", "-q", "--force", "../upstream", "sub")
        if not Path("sub/.git").exists():  # git refuses; a commit would be one of the project
            return "sub"
        write("sub/arm.urdf", arm(self.random.choice([4, 5, 6])))
        git("commit", "-qam", "next", at="sub")
        git("push", "-q", "origin", "HEAD:main", at="sub")
        if self.random.random() < 0.3:
            git("checkout", "-q", "HEAD~1", at="sub")
        return "sub"

    def nested(self) -> str:
        """Make a folder a repository of its own, or an ordinary folder again."""
        path = self._pick("nest", "exports/v2")
        if Path(path, ".git").exists():
            shutil.rmtree(Path(path, ".git"))
        elif Path(path).is_dir():
            git("init", "-q", "--template=", at=path)
            git("add", ".", at=path)
            git("commit", "-qm", "own", at=path)
            if self.random.random() < 0.5:
                git("rm", "-rq", "--cached", path)
        return path

    def nothing(self) -> str:
        write("notes.txt", str(self.random.random()))
        return "notes.txt"


CHANGES: list[Callable[[Stagings], str]] = [
    *(Stagings.edit_source, Stagings.edit_source, Stagings.break_source, Stagings.retarget, Stagings.retarget),
    *(Stagings.delete, Stagings.edit_mesh, Stagings.ignore_package, Stagings.second_package, Stagings.edit_package),
    *(Stagings.edit_state, Stagings.attributes, Stagings.ignore, Stagings.own_model, Stagings.build, Stagings.build),
    *(Stagings.configure, Stagings.templates, Stagings.submodule, Stagings.nested, Stagings.nothing),
]
STAGES = (
    "add -A", "add {}", "add -f {}", "add -N {}", "add -u", "rm -rq --cached {}", "update-index --assume-unchanged {}",
    "status",
)  # fmt: skip


def verdict_of_clone(folder: Path) -> int:
    """The exit code of `build --check` in a clone of the last commit, at the place of the repository."""
    project, clone, away = folder / "project", folder / "clone", folder / "away"
    shutil.rmtree(clone, ignore_errors=True)
    git("clone", "-q", "--recurse-submodules", str(project), str(clone), at=str(folder))
    os.chdir(folder)
    project.rename(away)
    clone.rename(project)
    os.chdir(project)
    try:
        return cli.main(["build", "--check", "--quiet"]) if Path("urdfsync.toml").exists() else 2
    finally:
        os.chdir(folder)
        project.rename(clone)
        away.rename(project)
        os.chdir(project)


def verdict_of_hook() -> int:
    return cli.main(["hook", "check", "--quiet", "--config", "urdfsync.toml"])


def play(random: Random, folder: Path, done: list[str]) -> None:
    """Stage at random, and compare the hook with clones: before each commit, and after it for all robots."""
    stagings, before = Stagings(random, folder), 0
    stagings.done = done
    for _ in range(random.choice([1, 2, 3])):
        for _ in range(random.choice([1, 1, 2, 4])):
            stagings.step()
            if random.random() < 0.2:
                verdict_of_hook()  # so that the next export begins with another one
        has_staged = subprocess.run(["git", "diff-index", "--cached", "--quiet", "HEAD"], check=False).returncode
        said = verdict_of_hook()
        git("commit", "-q", "--no-verify", "-m", "next")
        expected, afterwards = verdict_of_clone(folder), verdict_of_hook()
        done.append(f"hook {said}, clone {expected}, hook after the commit {afterwards}")
        assert afterwards == expected, "of all robots"
        if before == 0 or not has_staged:
            assert said == expected, "of the commit"
        assert said in (0, expected)
        before = expected


def test_the_hook_says_what_a_clone_says(
    tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch
) -> None:
    fresh, bases, commits = Random(), dict[str, Path](), 0
    for number, seed in enumerate([fresh.randrange(10**9) for _ in range(CASES)] or SEEDS):
        random = Random(seed)
        form = random.choice(FORMS if CASES else FORMS[:-1])
        with monkeypatch.context() as patch:
            if form not in bases:
                bases[form] = tmp_path_factory.mktemp(f"base-{form}")
                make(form, bases[form], patch)
            os.chdir(bases[form].parent)
            folder = bases[form].parent / f"case{number}"
            shutil.copytree(bases[form], folder, symlinks=True)
            Repository(folder / "project", patch)
            for link in [path for path in (folder / "outside").iterdir() if path.is_symlink()]:
                link.unlink()
                link.symlink_to(folder / "project/exports/v1")
            settings = "[core]\n\tautocrlf = true\n" if random.random() < 0.2 else ""
            (folder / "gitconfig").write_text(f'{settings}[protocol "file"]\n\tallow = always\n')
            patch.setenv("GIT_CONFIG_GLOBAL", str(folder / "gitconfig"))
            if random.random() < 0.2:
                patch.setenv("ROS_PACKAGE_PATH", str(folder / random.choice(["project/share", "outside"])))
            patch.chdir(folder / "project")
            git("submodule", "-q", "sync")
            done = [f"seed {seed}", form, settings]
            try:
                play(random, folder, done)
            except BaseException as error:
                error.add_note("\n".join(done))
                raise
            commits += sum(line.startswith("hook ") for line in done)
            shutil.rmtree(folder)
    print(f"{commits} commits")  # noqa: T201
