"""Git's unfinished merges: a file with several versions in the index is never in step, and builds merge the versions.

A merge driver that fails leaves our version alone, without markers; `git checkout --ours` does the same.
"""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest
from support.commands import Editor, Execute
from support.git import NEEDS_GIT, Repository
from support.networks import edit
from support.urdfs import joint, link, robot

from urdfsync.modelica.markers import read_sides

pytestmark = NEEDS_GIT

RECORD = Path("modelica/Arm/Links/UpperParameters.mo")
GONE = "/moved/bin/python -m urdfsync merge-driver %O %A %B"


@pytest.fixture
def repository(folder: Path, monkeypatch: pytest.MonkeyPatch, execute: Execute) -> Repository:
    """An arm, built and committed; the merge driver is not found."""
    Path("arm.urdf").write_text(
        robot(
            link("base"),
            link("upper", 1, rpy="0 0 0"),
            joint("shoulder", "revolute", "base", "upper", axis="0 0 1"),
        )
    )
    Path("urdfsync.toml").write_text('[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\non_conflict = "merge"\n')
    repository = Repository(folder, monkeypatch)
    Path(".gitattributes").write_text("*.mo merge=urdfsync\n")
    repository.git("config", "merge.urdfsync.driver", GONE)
    execute("build")
    repository.commit()
    return repository


def branch(repository: Repository, execute: Execute, name: str, old: str, new: str, file: Path = RECORD) -> None:
    """Make a branch from main with one change, built."""
    repository.git("checkout", "-q", "-b", name, "main")
    edit(file, old, new)
    execute("build")
    repository.commit()


def merge(repository: Repository, command: str = "merge theirs") -> None:
    with pytest.raises(subprocess.CalledProcessError):
        repository.git(*command.split())
    assert "<<<<<<<" not in RECORD.read_text()


@pytest.fixture
def apart(repository: Repository, execute: Execute) -> Repository:
    """Their branch edits the mass, and ours exports another inertia."""
    branch(repository, execute, "theirs", "mass = 1", "mass = 4.5")
    branch(repository, execute, "ours", 'ixx="0.021"', 'ixx="0.025"', Path("arm.urdf"))
    return repository


def is_merged() -> bool:
    return all(text in RECORD.read_text() for text in ("mass = 4.5", "0.025"))


@pytest.mark.parametrize("version", ["2", "4"])
def test_an_unmerged_file_is_not_in_step_and_a_build_merges_it(
    apart: Repository, execute: Execute, version: str
) -> None:
    apart.git("update-index", "--index-version", version)
    merge(apart)
    for command in ("status", "build --check"):
        printed = execute(*command.split(), code=1)
        assert f"{RECORD}: warning: git has not merged this file" in printed.err
        assert "in step," not in printed.out
    assert "unmerged in git" in execute("status", code=1).words
    execute("diff", code=1)
    execute("build")
    assert is_merged()
    before = RECORD.stat().st_mtime_ns
    assert "in step" not in execute("build").words
    assert RECORD.stat().st_mtime_ns == before
    execute("build", "--check", code=1)
    apart.git("add", "-A")
    execute("build", "--check")
    apart.commit()
    execute("build", "--check")
    assert is_merged()


@pytest.mark.parametrize("side", ["ours", "theirs"])
def test_one_side_that_somebody_took_counts_once_it_is_added(apart: Repository, execute: Execute, side: str) -> None:
    merge(apart)
    apart.git("checkout", f"--{side}", "--", str(RECORD))
    text = RECORD.read_text()
    execute("build", "--check", code=1)
    apart.git("add", "-A")
    execute("build")
    assert ("mass = 4.5" in RECORD.read_text()) is ("mass = 4.5" in text)


@pytest.mark.parametrize("command", ["rebase theirs", "cherry-pick theirs", "stash pop", "checkout -m theirs"])
def test_any_way_of_merging_is_seen(apart: Repository, execute: Execute, command: str) -> None:
    """A stash leaves no MERGE_HEAD."""
    if "theirs" in command and "checkout" not in command:
        merge(apart, command)
    else:
        apart.git("checkout", "-q", "theirs" if "stash" in command else "ours")
        edit(RECORD, "mass = 4.5" if "stash" in command else "mass = 1", "mass = 7")
        if "stash" in command:
            apart.git("stash", "-q")
            apart.git("checkout", "-q", "ours")
            subprocess.run(["git", "stash", "pop"], capture_output=True)
        else:
            subprocess.run(["git", *command.split()], capture_output=True)
    assert RECORD.as_posix() in apart.git("ls-files", "--unmerged")
    execute("build", "--check", code=None)
    assert "git has not merged this file" in execute("status", code=None).err


def test_edits_that_contradict_are_for_people(repository: Repository, execute: Execute) -> None:
    branch(repository, execute, "theirs", "mass = 1", "mass = 4.5")
    branch(repository, execute, "ours", "mass = 1", "mass = 5.4")
    merge(repository)
    text = RECORD.read_text()
    assert "both branches changed" in execute("build", code=3).words
    assert "`git add` it to keep this text" in execute("build", "--check", code=3).words
    assert RECORD.read_text() == text
    edit(RECORD, "5.4", "4.9")
    execute("build")
    execute("build", "--check", code=1)
    repository.git("add", "-A")
    execute("build", "--check")
    assert "mass = 4.9" in RECORD.read_text()


@pytest.fixture(params=["markers", "driver", "failed driver", "revert"])
def contradictory(repository: Repository, execute: Execute, request: pytest.FixtureRequest) -> Repository:
    """Two branches tune one number, ours to 5.4, theirs to 4.5, and ours exports another inertia; git stops."""
    if request.param != "failed driver":
        Path(".gitattributes").write_text("*.mo merge=urdfsync\n" if request.param == "driver" else "")
        repository.commit()
    if request.param == "driver":
        execute("merge-driver", "--install")
    branch(repository, execute, "theirs", "mass = 1", "mass = 4.5")
    start = "main"
    if request.param == "revert":  # theirs is then the version before the reverted commit
        edit(RECORD, "mass = 4.5", "mass = 4")
        repository.commit()
        start = "theirs"
    repository.git("checkout", "-q", "-b", "ours", start)
    edit(RECORD, "mass = 4" if start == "theirs" else "mass = 1", "mass = 5.4")
    edit(Path("arm.urdf"), 'ixx="0.021"', 'ixx="0.025"')
    execute("build", "--merge")
    repository.commit()
    with pytest.raises(subprocess.CalledProcessError):
        repository.git(*("revert theirs" if start == "theirs" else "merge theirs").split())
    assert ("<<<<<<<" in RECORD.read_text()) == (request.param != "failed driver")
    return repository


@pytest.mark.slow
@pytest.mark.parametrize(("side", "mass"), [("mine", "5.4"), ("theirs", "4.5")])
def test_one_side_of_a_contradiction_can_be_chosen(
    contradictory: Repository, execute: Execute, side: str, mass: str
) -> None:
    before = RECORD.read_text()
    said = execute("build", code=3).words
    assert "--merge --prefer mine both sides' changes; yours (or `theirs`)" in said
    refused = execute("resolve", RECORD, "--merge", "--prefer", "generated", code=3).words
    assert "`--prefer` settles nothing here: git" in refused
    assert f"settle the conflict with `urdfsync resolve {RECORD} --merge --prefer mine`" in refused
    assert RECORD.read_text() == before
    execute("resolve", "--all", "--merge", "--prefer", side)
    assert f"mass = {mass}," in RECORD.read_text()
    assert "0.025" in RECORD.read_text()
    if RECORD.read_text() != before:  # else only `git add` shows that our text is left on purpose
        execute("build")
        execute("resolve", RECORD, "--undo", code=None)
        assert RECORD.read_text() == before
        execute("resolve", "--all", "--merge", "--prefer", side)
    contradictory.git("add", "-A")
    execute("build", "--check")
    assert f"mass = {mass}," in RECORD.read_text()


@pytest.mark.parametrize("contradictory", ["markers"], indirect=True)
@pytest.mark.parametrize("choice", ["--merge --prefer theirs", "--edit"])
def test_a_chosen_side_moves_with_its_element(
    contradictory: Repository, execute: Execute, editor: Editor, choice: str
) -> None:
    Path("arm.urdf").write_text(Path("arm.urdf").read_text().replace('"upper"', '"big"'))
    execute("build", code=3)
    editor(f"file.write_text({read_sides(RECORD.read_text())[1]!r})")
    execute("resolve", RECORD, *choice.split())
    assert "mass = 4.5," in RECORD.with_name("BigParameters.mo").read_text()
    assert not RECORD.exists()
    contradictory.git("add", "-A")
    execute("build", "--check")


@pytest.mark.parametrize(
    ("contradictory", "left"),
    [
        ("markers", "<<<<<<< HEAD"),
        ("driver", "||||||| base"),
        ("failed driver", "======="),
        ("revert", ">>>>>>> theirs"),
    ],
    indirect=["contradictory"],
)
def test_an_editor_sees_both_sides_and_may_leave_no_marker(
    contradictory: Repository, execute: Execute, editor: Editor, tmp_path: Path, left: str
) -> None:
    seen, text = tmp_path / "seen", RECORD.read_text()
    ours = read_sides(text)[0]
    marked = f"{left}\n{ours}"
    editor(f"Path({str(seen)!r}).write_text(file.read_text()); file.write_text({marked!r})")
    said = execute("resolve", RECORD, "--edit", code=2).err
    assert f"the edited text has the conflict marker `{left[:7]}` (line 1); nothing was changed" in said
    assert RECORD.read_text() == text
    marks = [line for line in seen.read_text().splitlines() if line[:7] in {"<" * 7, "|" * 7, "=" * 7, ">" * 7}]
    assert marks == ["<<<<<<< mine", "||||||| base", "=======", ">>>>>>> theirs"]
    editor(f"file.write_text({ours.replace('5.4', '5')!r})")
    execute("resolve", RECORD, "--edit")
    assert "mass = 5," in RECORD.read_text()
    execute("build")


def test_an_unmerged_source_is_not_in_step(repository: Repository, execute: Execute) -> None:
    for name, mass in (("theirs", "2"), ("ours", "3")):
        branch(repository, execute, name, '<mass value="1"/>', f'<mass value="{mass}"/>', Path("arm.urdf"))
    with pytest.raises(subprocess.CalledProcessError):
        repository.git("merge", "theirs")
    repository.git("checkout", "--ours", "--", "arm.urdf", "modelica")
    execute("build")
    assert "arm.urdf: warning: git has not merged" in execute("build", "--check", "--verbose", code=1).err
    repository.git("add", "-A")
    execute("build", "--check")


@pytest.mark.slow
def test_an_unmerged_file_that_the_source_names_is_not_in_step(repository: Repository, execute: Execute) -> None:
    """Our version stays without markers: only the index shows that theirs is missing."""
    text = Path("arm.urdf").read_text().replace("<robot ", '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" ')
    include = '<xacro:include filename="numbers/mass.xacro"/>\n<link'
    Path("arm.xacro").write_text(text.replace("<link", include, 1).replace('<mass value="1"', '<mass value="${mass}"'))
    edit(Path("urdfsync.toml"), "arm.urdf", "arm.xacro")
    write_numbers(1)
    repository.commit()
    for name, mass in (("theirs", 2), ("ours", 3)):
        repository.git("checkout", "-q", "-B", name, "main")
        write_numbers(mass)
        execute("build")
        repository.commit()
    merge(repository)
    repository.git("checkout", "--ours", "--", "numbers", "modelica")
    repository.git("add", "modelica", ".urdfsync")
    assert "numbers/mass.xacro: warning: git has not merged" in execute("build", "--check", "--verbose", code=1).err
    repository.git("add", "-A")
    execute("build", "--check")


def write_numbers(mass: float) -> None:
    macro = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">'
    Path("numbers").mkdir(exist_ok=True)  # git removes it with its last file
    Path("numbers/mass.xacro").write_text(f'{macro}<xacro:property name="mass" value="{mass}"/></robot>')


@pytest.mark.parametrize("inside", [False, True])
def test_an_unmerged_submodule_or_a_file_in_it_is_not_in_step(
    repository: Repository, execute: Execute, monkeypatch: pytest.MonkeyPatch, inside: bool
) -> None:
    cad = Repository(repository.folder / "cad", monkeypatch)
    for name, mass in (("theirs", 2), ("main", 3)):
        cad.git("checkout", "-q", "-B", name, *(["theirs~"] if name == "main" else []))
        cad.commit("before")
        shutil.copy("arm.urdf", "cad/arm.urdf")
        edit(Path("cad/arm.urdf"), '<mass value="1"/>', f'<mass value="{mass}"/>')
        cad.commit()
    edit(Path("urdfsync.toml"), "arm.urdf", "cad/arm.urdf")
    execute("build")
    repository.commit()
    execute("build", "--check")
    if inside:
        cad.merge("theirs")
        cad.git("merge", "--abort")
        with pytest.raises(subprocess.CalledProcessError):
            cad.git("merge", "theirs")
        shutil.copy("arm.urdf", "cad/arm.urdf")
        edit(Path("cad/arm.urdf"), '<mass value="1"/>', '<mass value="3"/>')
    else:
        commits = [cad.git("rev-parse", name).strip() for name in ("main~", "main", "theirs")]
        lines = "".join(f"160000 {commit} {stage}\tcad\n" for stage, commit in enumerate(commits, start=1))
        repository.git("update-index", "--force-remove", "cad")
        subprocess.run(["git", "update-index", "--index-info"], input=lines.encode(), check=True)
    assert "cad/arm.urdf: warning: git has not merged" in execute("build", "--check", "--verbose", code=1).err
    execute("status", code=1)


def test_a_file_elsewhere_does_not_count(repository: Repository, execute: Execute) -> None:
    for name in ("theirs", "ours"):
        repository.git("checkout", "-q", "-b", name, "main")
        Path("notes.txt").write_text(name)
        repository.commit()
    with pytest.raises(subprocess.CalledProcessError):
        repository.git("merge", "theirs")
    execute("build", "--check")


def test_a_saved_answer_ends_with_the_merge(apart: Repository, execute: Execute) -> None:
    """The text of our side stays, so that no file that a build reads changes but the index."""
    for _ in range(2):
        execute("status")
    index = apart.git("hash-object", "-w", str(RECORD)).strip()
    lines = "".join(f"100644 {index} {stage}\t{RECORD}\n" for stage in (1, 2, 3))
    subprocess.run(
        ["git", "update-index", "--index-info"], input=f"0 {'0' * 40}\t{RECORD}\n{lines}".encode(), check=True
    )
    execute("status", code=1)


def test_lines_that_two_branches_add_to_the_order_of_a_parent_package_both_stay(
    repository: Repository, execute: Execute
) -> None:
    """Two robots share this file; the first one's build writes both sides' lines, the other robot has nothing to do."""
    table = '\n[robots.leg]\nsource = "arm.urdf"\npackage = "Plant.Leg"\ncreate_parents = true\n'
    edit("urdfsync.toml", '"Arm"', '"Plant.Arm"\ncreate_parents = true')
    Path("urdfsync.toml").write_text(Path("urdfsync.toml").read_text() + table)
    execute("build")
    repository.commit()
    order = Path("modelica/Plant/package.order")
    for name in ("Yours", "Mine"):
        repository.git("checkout", "-q", "-b", name, "main")
        order.with_name(f"{name}.mo").write_text(f"within Plant;\nmodel {name}\nend {name};\n")
        edit(order, "Arm\n", f"Arm\n{name}\n")
        repository.commit()
    with pytest.raises(subprocess.CalledProcessError):
        repository.git("merge", "Yours")
    assert "1 file to write" in execute("build", "--check", code=1).words
    execute("build")
    assert order.read_text().split() == ["Arm", "Mine", "Yours", "Leg"]
    assert "to write" not in execute("build", "--check", code=1).words
    repository.git("add", "-A")
    execute("build", "--check")


@pytest.mark.parametrize("label", ["main", "elsewhere"])
def test_a_merge_of_two_other_files_is_no_version_of_a_file(
    repository: Repository, execute: Execute, label: str
) -> None:
    """If renames of both branches end at one path, the index may have git's merge there, with markers."""
    text = RECORD.read_text()
    merged = f"<<<<<<<< HEAD:Other.mo\nrecord Other\n========\n{text}>>>>>>>> {label}:{RECORD}\n"
    lines = f"0 {'0' * 40}\t{RECORD}\n"
    for stage, version in ((2, text), (3, merged)):
        Path("version").write_text(version)
        lines += f"100644 {repository.git('hash-object', '-w', 'version').strip()} {stage}\t{RECORD}\n"
    subprocess.run(["git", "update-index", "--index-info"], input=lines.encode(), check=True)
    execute("build")
    assert RECORD.read_text() == text
    repository.git("add", "-A")
    execute("build", "--check")
