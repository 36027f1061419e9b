"""A recorded state may be a stranger's: no state makes a wrong package count as in step, or loses a person's text.

The tests judge a project with edits, a user's class and an export that was not built, by its honest and by forged
states. `URDFSYNC_FORGERIES=1000` makes 1000 forgeries, with fresh seeds.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any, TypeAlias

import msgspec
import pytest
from support import states
from support.networks import edit
from support.replay import contents
from support.urdfs import joint, limit, link, robot

from urdfsync.common.dependencies import localfile
from urdfsync.common.files import text_hash
from urdfsync.domain import Import
from urdfsync.engine.actions import FileStatus, Reason
from urdfsync.engine.build import build
from urdfsync.engine.inspect.package_files import bare_hash
from urdfsync.engine.options import BuildOptions
from urdfsync.engine.result import Result
from urdfsync.modelica.stamp import split
from urdfsync.project import config
from urdfsync.project.state import bases, statefile
from urdfsync.project.state.record import Generator, Record, as_recorded

COUNT = int(os.environ.get("URDFSYNC_FORGERIES", "25"))
SEEDS = [*range(COUNT)] if "URDFSYNC_FORGERIES" not in os.environ else [Random().getrandbits(32) for _ in range(COUNT)]
ARM, LEG = Path("modelica/Arm"), Path("modelica/Leg")
STATE = Path(".urdfsync/robots/arm.state")
Forgery: TypeAlias = Callable[[Record, Random], Record]


def source(*, mass: float = 1, tool: bool = True) -> str:
    links = [link("base"), link("upper", mass), link("fore", 2), *([link("tool", 3)] if tool else [])]
    joints = [
        joint("shoulder", "revolute", "base", "upper", axis="0 0 1"),
        joint("elbow", "revolute", "upper", "fore", axis="0 1 0", inside=[limit(effort=10)]),
        *([joint("grip", "fixed", "fore", "tool")] if tool else []),
    ]
    return robot(*links, *joints)


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A project: edited files with and without new texts, a class and a line of the user's, and a removed link."""
    folder = tmp_path_factory.mktemp("honest")
    (folder / "arm.urdf").write_text(source())
    (folder / "leg.urdf").write_text(source(tool=False))
    (folder / "urdfsync.toml").write_text(
        '[robots.arm]\nsource = "arm.urdf"\npackage = "Arm"\n\n[robots.leg]\nsource = "leg.urdf"\npackage = "Leg"\n'
    )
    build_all(folder)
    edit(folder / ARM / "Joints/Elbow.mo", "end Elbow;", "  // mine\nend Elbow;")
    edit(folder / ARM / "Links/UpperParameters.mo", "mass = 1", "mass = 7")
    edit(folder / ARM / "Links/Tool.mo", "end Tool;", "  // mine\nend Tool;")
    (folder / ARM / "Links/Mine.mo").write_text('within Arm.Links;\nmodel Mine "Of the user\'s"\nend Mine;\n')
    edit(folder / ARM / "Links/package.order", "Upper\n", "Mine\nUpper\n")
    (folder / ARM / "Resources").mkdir(exist_ok=True)
    (folder / ARM / "Resources/mine.csv").write_text("1, 2\n")
    (folder / "arm.urdf").write_text(source(mass=1.5, tool=False))
    return folder


def build_all(folder: Path, **given: Any) -> dict[str, Result]:
    loaded = config.load(folder / "urdfsync.toml")
    return {result.robot: result for result in build(loaded, loaded.robots, BuildOptions(**given))}


# Forgeries


def texts_on_disk() -> dict[str, str]:
    """Hashes of all files of the package by key, the user's own included."""
    files = [path for path in ARM.rglob("*") if path.is_file() and path.name != "package.order"]
    return {path.as_posix(): bare_hash(path.read_bytes()) for path in files}


def take_what_is_there(record: Record, random: Random) -> Record:
    """Record a file by the text that is there, as if urdfsync had written it."""
    key, sha256 = random.choice(sorted(texts_on_disk().items()))
    add_base(Path(key))
    return msgspec.structs.replace(record, files={**record.files, key: sha256})


def take_all_that_is_there(record: Record, _: Random) -> Record:
    for key in texts_on_disk():
        add_base(Path(key))
    return msgspec.structs.replace(record, files=texts_on_disk())


def add_base(path: Path) -> None:
    """Store a text as a generated one."""
    text = split(path.read_text())[0]
    sha256 = text_hash(text.encode())
    file = Path(".urdfsync/bases/arm") / sha256[0]
    file.write_bytes(file.read_bytes() + bases.dumps({sha256: text}))


def exchange_hashes(record: Record, random: Random) -> Record:
    one, other = random.sample(sorted(record.files), 2)
    files = {**record.files, one: record.files[other], other: record.files[one]}
    return msgspec.structs.replace(record, files=files)


def forget_files(record: Record, random: Random) -> Record:
    gone = random.sample(sorted(record.files), random.randint(1, len(record.files)))
    return msgspec.structs.replace(record, files={k: file for k, file in record.files.items() if k not in gone})


def invent_files(record: Record, random: Random) -> Record:
    names = [f"{ARM}/Links/{name}.mo" for name in ("Mine", "Ghost", "Upper2")] + [f"{ARM}/Resources/mine.csv"]
    made = {name: f"{random.getrandbits(64):016x}" for name in names}
    return msgspec.structs.replace(record, files={**record.files, **made})


def another_number(record: Record, random: Random) -> Record:
    model = msgspec.json.decode(msgspec.json.encode(record.snapshot))
    name = random.choice(sorted(model["links"]))
    model["links"][name] = model["links"][random.choice(sorted(model["links"]))]
    return msgspec.structs.replace(record, snapshot=model)


def another_element(record: Record, random: Random) -> Record:
    """Add, remove or rename an element."""
    model = msgspec.json.decode(msgspec.json.encode(record.snapshot))
    kind = random.choice(["links", "joints"])
    name = random.choice(sorted(model[kind]))
    if random.random() < 0.7:
        model[kind][random.choice(["mine", "ghost", "upper", "tool"])] = model[kind][name]
    if random.random() < 0.7:
        del model[kind][name]
    return msgspec.structs.replace(record, snapshot=model)


def no_model(record: Record, random: Random) -> Record:
    odd: list[Any] = [None, {}, {"links": 3}, {"links": {"a": None}, "joints": []}, {"joints": {"elbow": {"type": 1}}}]
    return msgspec.structs.replace(record, snapshot=random.choice(odd))


def the_model_now(record: Record, _: Random) -> Record:
    """Record the export as built."""
    from urdfsync.formats.urdf.domain import DOMAIN

    reading = DOMAIN.read(source(mass=1.5, tool=False).encode(), "arm.urdf", DOMAIN.options())
    return msgspec.structs.replace(record, snapshot=as_recorded(reading.snapshot))


def other_headings(record: Record, random: Random) -> Record:
    changes: list[dict[str, Any]] = [
        {"package": "Leg", "folder": "modelica/Leg", "files": {}},
        {"class_": "Other"},
        {"folder": "packages/Arm", "files": {}},
        {"generator": Generator("other", "0.0.1", "")},
        {"generator": Generator("urdf", "0.0.1", "00")},
        {"options": {"base": "floating"}},
        {"options": {"base": 3, "nothing": None}},
    ]
    return msgspec.structs.replace(record, **random.choice(changes))


def invent_an_import(record: Record, _: Random) -> Record:
    file = ARM / "Resources/mine.csv"
    entry = Import("Resources/mine.csv", "0" * 64, text_hash(file.read_bytes()), {})
    files = {**record.files, file.as_posix(): text_hash(file.read_bytes())}
    return msgspec.structs.replace(record, imports={"mine": entry}, files=files)


def exchange_robots(record: Record, random: Random) -> Record:
    """Replace the state of one robot by another's."""
    other = states.record(Path(".urdfsync/robots/leg.state"))
    if random.random() < 0.5:  # with the name of this package
        files = {key.replace("Leg", "Arm"): file for key, file in other.files.items()}
        other = msgspec.structs.replace(other, package="Arm", class_="Arm", folder=record.folder, files=files)
    return other


FORGERIES: tuple[Forgery, ...] = (
    *(take_what_is_there, take_all_that_is_there, exchange_hashes, forget_files, invent_files),
    *(another_number, another_element, no_model, the_model_now, other_headings, invent_an_import, exchange_robots),
)


def forge(random: Random) -> list[str]:
    """Forge the state in the working folder in one to three ways; return their names."""
    record = states.record(STATE)
    # some forgeries need a model
    chosen = sorted(random.sample(FORGERIES, random.randint(1, 3)), key=lambda forgery: forgery is no_model)
    for forgery in chosen:
        record = forgery(record, random) if len(record.files) > 1 else record  # another forgery has removed the files
    text = statefile.dumps(record)
    if random.random() < 0.15:
        text = text[: random.randrange(len(text))]
    STATE.write_text(text)
    if random.random() < 0.15:
        shutil.rmtree(".urdfsync/bases")
    return [forgery.__name__ for forgery in chosen]


# What must hold


@pytest.mark.parametrize(
    ("seed", "noted"),
    [
        pytest.param(seed, number % 2 > 0, id=f"{seed} {'where it was built' if number % 2 else 'in a clone'}")
        for number, seed in enumerate(SEEDS)
    ],
)
def test_nothing_wrong_is_in_step_and_nothing_is_lost(
    project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, seed: int, noted: bool
) -> None:
    random = Random(seed)
    for name in ("honest", "forged"):
        shutil.copytree(project, tmp_path / name)
        if noted:
            rebind(tmp_path / name)
        else:
            shutil.rmtree(tmp_path / name / ".urdfsync/notes")
    monkeypatch.chdir(tmp_path / "forged")
    done = forge(random)
    before = contents(ARM)
    honest, forged = build_all(tmp_path / "honest", dry=True)["arm"], build_all(Path.cwd(), dry=True)["arm"]
    assert not forged.failed, (done, forged.diagnostics)
    found = {action.path: action.status for action in forged.actions}
    for action in honest.actions:
        if action.generated and action.status in (FileStatus.STALE, FileStatus.CONFLICT, FileStatus.MISSING):
            assert found[action.path] is not FileStatus.IN_STEP, (done, action.path, action.status)

    assert not build_all(tmp_path / "honest")["arm"].failed
    assert not build_all(Path.cwd())["arm"].failed, done
    after, kept = contents(ARM), contents(tmp_path / "honest" / ARM)
    aside = {content for path, content in contents(Path(".urdfsync")).items() if path.startswith("aside/")}
    # a record that has the text of a person's file as generated: the file is put aside, with the record beside it
    aside_too = {path for path in ("Links/Mine.mo", "Links/Tool.mo", "Resources/mine.csv") if before[path] in aside}
    aside_too |= {"Links/ToolParameters.mo"} if "Links/Tool.mo" in aside_too else set()
    for path in kept:
        assert path in after or path in aside_too, (done, path, "is deleted, which the honest state keeps")
        if path.endswith("package.order"):
            lost = {*kept[path].split()} - {*after[path].split()} - {Path(file).stem.encode() for file in aside_too}
            assert not lost, (done, path, lost)
    for path in ("Joints/Elbow.mo", "Links/UpperParameters.mo", "Links/Tool.mo", "Links/Mine.mo", "Resources/mine.csv"):
        assert before[path] in (after.get(path), *after.values()) or before[path] in aside, (done, path)
    assert contents(LEG) == contents(tmp_path / "honest" / LEG)


def test_a_recorded_exchange_of_names_moves_no_edit(
    project: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The records on disk are not those of the recorded model: `upper` is still the former `upper`."""
    monkeypatch.chdir(shutil.copytree(project, tmp_path / "forged"))
    shutil.rmtree(".urdfsync/notes")
    text = msgspec.json.encode(states.record(STATE).snapshot).replace(b'"upper"', b'"-"').replace(b'"fore"', b'"upper"')
    model = msgspec.json.decode(text.replace(b'"-"', b'"fore"'))
    states.rewrite(STATE, snapshot=model)
    actions = {action.path: action.reason for action in build_all(Path.cwd())["arm"].actions}
    assert actions[f"{ARM.as_posix()}/Links/UpperParameters.mo"] is Reason.ASKED
    assert "mass = 7" in (ARM / "Links/UpperParameters.mo").read_text()


def rebind(folder: Path) -> None:
    """Make copied notes count as written in their present place."""
    for file in (folder / ".urdfsync/notes").iterdir():
        content = file.read_bytes().partition(b"\n")[2]
        file.unlink()
        localfile.write(file, content)
