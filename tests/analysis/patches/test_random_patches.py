"""Random edits of numbers in records of real robots: what a patch takes over is gone, and nothing else changes.

`URDFSYNC_CASES=500` makes so many edits, over all robots of the corpus, with fresh seeds.
"""

from __future__ import annotations

import itertools
import os
import re
from pathlib import Path
from random import Random

import pytest
from support import corpus
from support.cases import CASES, sampled
from support.commands import Execute
from support.git import NEEDS_GIT, Repository
from support.patches import patch_and_told

from urdfsync.analysis.patches.literals import NUMBER, decoded
from urdfsync.modelica.stamp import split
from urdfsync.modelica.values import read_values

pytestmark = [pytest.mark.slow, NEEDS_GIT]

FAULTY = "robots/random/spot_ros/spot_description/urdf/spot_arm.urdf"
"""No package can be made of this robot."""
LARGEST = 150_000
"""Bytes of a source that a test of xacro expands many times."""
ROBOTS = [file for file in corpus.robots() if file != FAULTY]
SMALL = [
    file
    for file in ROBOTS
    if file == corpus.ABSENT
    or ((path := corpus.FOLDER / file).stat().st_size < LARGEST and b"<xacro:" not in path.read_bytes())
]
EDITS = max(12, -(-CASES // (2 * len(ROBOTS))))
"""Edits of each robot, in URDF and in xacro."""
OPTIONS = 'meshes = "skip"\nallow = ["stray-inertial", "loop-joint"]\n'
CONFIG = '[robots.bot]\nsource = "{}"\npackage = "Bot"\n'
TALLY = os.environ.get("URDFSYNC_TALLY", "")
"""A file that gets one line for each robot: the edits of each outcome."""
_PLAIN = re.compile(r'(?<=["\s])-?\d+(?:\.\d+)?(?=["\s])')


def respelled(random: Random, content: bytes) -> bytes:
    """The source with other quotes, line ends, exponents or encoding, now and then."""
    text = content.decode("utf-8-sig").replace("\r\n", "\n")
    if random.random() < 0.3 and "'" not in text:
        text = text.replace('"', "'")
    if random.random() < 0.3:
        text = re.sub(r"(?<=[\"'\s])(\d\.\d+)(?=[\"'\s])", lambda match: f"{float(match[1]):.17e}", text, count=40)
    if random.random() < 0.3:
        text = text.replace("\n", "\r\n")
    encoding = random.choice(("utf-8", "utf-8", "utf-8-sig", "latin-1", "utf-16"))
    head = re.match(r"\ufeff?\s*<\?xml.*?\?>\s*", text, re.DOTALL)
    text = text[head.end() :] if head else text
    declared = (
        f'<?xml version="1.0" encoding="{"iso-8859-1" if encoding == "latin-1" else encoding[:6].rstrip("-")}"?>\n'
    )
    try:
        return (declared.replace("utf-8-", "utf-8") + text).encode(encoding)
    except UnicodeEncodeError:
        return text.encode()


def as_xacro(random: Random, text: str) -> dict[str, str]:
    """The files of a xacro that expands to a URDF: its numbers come from properties, arguments and a YAML."""
    names, declared, included, rows = dict[str, str](), list[str](), list[str](), list[str]()
    numbers = itertools.count()
    body = re.sub(r"^.*?<robot[^>]*>|<!--.*?-->|<gazebo.*?</gazebo>", "", text, flags=re.DOTALL)

    def place(match: re.Match[str]) -> str:
        number, name = match[0], f"n{next(numbers)}"
        if random.random() < 0.7:
            return number
        if number in names and random.random() < 0.2:
            return f"${{{names[number]}}}"
        where = random.choice(("property", "include", "arg", "yaml", "expression"))
        names[number] = {"yaml": f"data['{name}']", "arg": f"float('$(arg {name})')"}.get(where, name)
        if where == "arg":
            declared.append(f'<xacro:arg name="{name}" default="{number}"/>')
            return f"$(arg {name})"
        if where == "yaml":
            rows.append(f"{name}: {number}")
        elif where == "expression":
            declared.append(f'<xacro:property name="{name}" value="{number}"/>')
            return f"${{1.0*{name}}}" if random.random() < 0.5 else f"${{{name} + 0}}"
        else:
            (included if where == "include" else declared).append(f'<xacro:property name="{name}" value="{number}"/>')
        return f"${{{names[number]}}}"

    body = re.sub(r"<(?:mass|inertia|limit|origin|dynamics)\b[^>]*>", lambda tag: _PLAIN.sub(place, tag[0]), body)
    drake = ' xmlns:drake="http://drake.mit.edu"' if "drake:" in text else ""
    head = f'<robot name="bot" xmlns:xacro="http://www.ros.org/wiki/xacro"{drake}>'
    load = '<xacro:property name="data" value="${xacro.load_yaml(\'data.yaml\')}"/>\n' if rows else ""
    include = '<xacro:include filename="numbers.xacro"/>\n'
    return {
        "bot.urdf.xacro": f"{head}\n{load}{include}{chr(10).join(declared)}{body}",
        "numbers.xacro": f"{head}\n{chr(10).join(included)}\n</robot>\n",
        "data.yaml": "\n".join(rows) + "\n",
    }


def other_number(random: Random, word: str) -> str:
    """Another number near a number, in one of several spellings that records have, too."""
    value = float(word)
    new = random.choice((value * 1.25, value * 0.9, -value, value + 0.01, value or 0.5, round(value + 1, 3)))
    return str(int(new)) if new == int(new) else repr(new)


def edit_records(random: Random, package: Path, count: int) -> set[tuple[Path, str]]:
    """Edit numbers in records of a package, at most `count`; return the file and the path of each edited value."""
    edited = set[tuple[Path, str]]()
    records = sorted(package.rglob("*Parameters.mo")) + sorted(package.glob("*Start.mo"))
    for _ in range(20 * count):
        file = random.choice(records)
        text = file.read_text()
        values = [value for value in read_values(text) if NUMBER.search(value.text) and value.text[:1] not in '"f']
        if not values or len(edited) == count:
            continue
        value = random.choice(values)
        spots = re.finditer(rf"\b{value.path.rpartition('.')[2]} = ({re.escape(value.text)})", text)
        spot = next((spot for spot in spots if text.count("\n", 0, spot.start()) + 1 == value.line), None)
        if spot is None or (file, value.path) in edited:
            continue
        word = random.choice(list(NUMBER.finditer(text, *spot.span(1))))
        new = other_number(random, word[0])
        if float(new) != float(word[0]):
            file.write_text(f"{text[: word.start()]}{new}{text[word.end() :]}")
            edited.add((file, value.path))
    return edited


def run(seed: str, folder: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch, files: dict[str, bytes]) -> None:
    """Edit a built robot, patch its source, and build again."""
    random, repository, source = Random(seed), Repository(folder, monkeypatch), next(iter(files))
    for name, content in files.items():
        (folder / name).write_bytes(content)
    (folder / "urdfsync.toml").write_text(CONFIG.format(source) + OPTIONS)
    execute("build", "--quiet")
    edited = edit_records(random, folder / "modelica/Bot", EDITS)
    package = {path: split(path.read_text())[0] for path in sorted(folder.rglob("modelica/Bot/*/*.mo"))}
    patch, told = patch_and_told()
    if patch:
        (folder / "fix.patch").write_bytes(patch)
        repository.git("apply", "fix.patch")
    for name, content in files.items():
        old, new = decoded(content), decoded((folder / name).read_bytes())
        if len(NUMBER.findall(old)) == len(NUMBER.findall(new)):  # nothing was inserted
            assert NUMBER.sub("#", old) == NUMBER.sub("#", new), name
    execute("build", "--quiet")
    execute("build", "--check", "--quiet")
    assert {path: split(path.read_text())[0] for path in package} == package, "the source says more than the edits"
    left = remaining(execute)
    staying = {(file, path) for file, path in edited if _is_told(folder, file, path, told)}
    assert {file for file, _ in staying} == {folder / file for file in left}, (left, told)
    for file in left:
        values = {path for edited_file, path in staying if edited_file == folder / file}
        assert all(any(path.endswith(part.split(" ")[0]) for path in values) for part in left[file]), (left, told)
    if TALLY:
        with Path(TALLY).open("a") as tally:
            tally.write(f"{seed}\t{source}\t{len(edited) - len(staying)}\t{len(staying)}\t{' | '.join(told)}\n")


def remaining(execute: Execute) -> dict[str, list[str]]:
    """The parts that are still edited, by file."""
    (robot,) = execute("diff", "--edits", "--format=json").json["results"]
    return {
        file["path"]: [edit["part"] or edit["element"].split("`")[1] for edit in file["edits"]]
        for file in robot["files"]
    }


def _is_told(folder: Path, file: Path, path: str, told: list[str]) -> bool:
    return any(line.startswith(f"{file.relative_to(folder)}: {path} ") for line in told)


@pytest.mark.parametrize("file", sampled(ROBOTS, 1 if CASES else 12))
def test_edits_of_a_urdf(
    file: str, corpus: Path, folder: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    seed = str(Random().random()) if CASES else file
    content = respelled(Random(seed), (corpus / file).read_bytes())
    run(seed, folder, execute, monkeypatch, {"bot.urdf": content})


@pytest.mark.parametrize("file", sampled(SMALL, 1 if CASES else 12))
def test_edits_of_a_xacro(
    file: str, corpus: Path, folder: Path, execute: Execute, monkeypatch: pytest.MonkeyPatch
) -> None:
    seed = str(Random().random()) if CASES else file
    files = as_xacro(Random(seed), (corpus / file).read_bytes().decode("utf-8-sig"))
    run(seed, folder, execute, monkeypatch, {name: text.encode() for name, text in files.items()})
