"""All that the shipped templates write is in golden texts, so each changed statement of a template changes one.

A fault in a line shows if a golden text has the line. A fault in a tag shows if the golden texts need the tag: each
condition is true for one text and false for another, and a loop's items differ. The tests plant these faults.

`tests/formats/urdf/second/test_comparison.py` has faults in numbers and attributes,
`tests/analysis/checks/test_seen_faults.py` has those in motion, and `tests/modelica/test_visualizers.py` those in the
library's drawings.
"""

from __future__ import annotations

import functools
import re
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import pytest
from jinja2.exceptions import UndefinedError
from support.golden import GOLDEN, TEMPLATES, VARIANTS, Piece, of_variants, pieces
from support.marks import lines_shown, marked_lines

from urdfsync.domain import Artifact
from urdfsync.engine.package.render import Renderer


def test_each_line_of_each_template_is_in_a_golden_text() -> None:
    """So are both alternatives of `"a" if … else "b"`, and the absence of `"a" if …`.

    What no variant shows needs one, or a larger source. No kind of sensor shows a single number.
    """
    shown = lines_shown(pieces())
    missing = [line for number, line in enumerate(marked_lines()) if number not in shown]
    missing = [line for line in missing if not line.startswith("nothing unless output.is_vector in ")]
    assert missing == [], "run `python -m tests --renew`; what stays needs a variant in tests/support/golden.py"
    assert len(shown) > 1000


def test_a_documentation_names_nothing_that_the_robot_lacks() -> None:
    """A name in `<code>` stands in another text of the golden package, too, or ends names there."""
    for variant in VARIANTS:
        texts = [piece.text() for piece in of_variants() if piece.file.is_relative_to(GOLDEN / variant)]
        code = re.sub("<html>.*?</html>", "", "\n".join(texts), flags=re.DOTALL)
        names = {name for text in texts for name in re.findall(r"<code>(\w+)</code>", text)}
        assert {name for name in names - {"Axis", "Support"} if not re.search(rf"\b{name}\b", code)} == set()


# Faults in tags


_TAG = re.compile(r"<(?P<open>[%<])-?\s*(?P<body>.*?)\s*-?[%>]>", re.DOTALL)
_FOR = re.compile(r"for (?P<variable>\w+) in (?P<items>.+?)(?: if (?P<filter>.+))?", re.DOTALL)
_IF = re.compile(r"(?:el)?if (?P<condition>.+)", re.DOTALL)
_PART = re.compile(r"(?:(?<= and )|(?<= or )|(?<=^)|(?<=\()|(?<=not ))(?!not |\()(?:(?! and | or |\)).)+")
_INLINE = re.compile(r' if (?P<condition>[^"]+?)(?= else |\)|$)')


class Fault(NamedTuple):
    """A tag of a template that says something else, in the text from `begin` to `end`."""

    template: str
    begin: int
    end: int
    tag: str

    def __str__(self) -> str:
        return f"{self.template}: {self.tag}"

    @property
    def text(self) -> str:
        """The whole template."""
        sound = (TEMPLATES / self.template).read_text("utf-8")
        return sound[: self.begin] + self.tag + sound[self.end :]


def faults(template: str) -> Iterator[Fault]:
    """Yield one fault for each answer of a condition, and for each use of a loop."""
    text, loops = (TEMPLATES / template).read_text("utf-8"), list[re.Match[str] | None]()
    for tag in _TAG.finditer(text):
        body, span = tag["body"], tag.span("body")

        def fault(match: re.Match[str], group: str | int, new: str) -> Fault:
            before, after = body[: match.start(group)], body[match.end(group) :]  # noqa: B023
            return Fault(template, *span, before + new + after)  # noqa: B023

        is_statement = tag["open"] == "%"
        if is_statement and body == "endfor":
            loops.pop()
        elif is_statement and body.startswith("for "):
            loops.append(loop := _FOR.fullmatch(body))
            if loop:  # else of several variables
                yield fault(loop, "items", f"({loop['items']})[1:]")
                yield fault(loop, "items", f"({loop['items']}) | reverse")
            if loop and loop["filter"]:
                yield from (fault(loop, "filter", answer) for answer in ("true", "false"))
            continue
        elif is_statement and (condition := _IF.fullmatch(body)):
            for answer in ("true", "false"):
                yield fault(condition, "condition", answer)
                if " and " in body or " or " in body:
                    begin = condition.start("condition")
                    yield from (fault(part, 0, answer) for part in _PART.finditer(body, begin))
        if not is_statement or body.startswith("set "):
            for inline in _INLINE.finditer(body):
                yield from (fault(inline, "condition", answer) for answer in ("true", "false"))
        for loop in filter(None, loops):
            for use in re.finditer(rf'(?<![\w."]){loop["variable"]}\.', body):
                yield fault(use, 0, f"({loop['items']})[0].")


@functools.cache
def sound() -> list[tuple[Piece, str, str]]:
    """The golden texts that templates write, with their templates."""
    return [
        (piece, piece.artifact.template, piece.text()) for piece in pieces() if isinstance(piece.artifact, Artifact)
    ]


@functools.cache
def users(template: str) -> frozenset[str]:
    """The templates that need a template: itself, and those that import or include it."""
    names = {path.relative_to(TEMPLATES).as_posix(): path.read_text("utf-8") for path in TEMPLATES.rglob("*.jinja")}
    direct = {name for name, text in names.items() if re.search(rf'(?:import|include) "{template}"', text)}
    return frozenset({template}.union(*map(users, direct)))


def is_seen(fault: Fault, folder: Path) -> bool:
    """Whether a golden text is another one with the fault, or can't be rendered."""
    own = Path(tempfile.mkdtemp(dir=folder))
    (own / fault.template).parent.mkdir(parents=True, exist_ok=True)
    (own / fault.template).write_text(fault.text, "utf-8")
    renderer, concerned = Renderer([own, TEMPLATES]), users(fault.template)
    try:
        return any(piece.text(renderer) != text for piece, template, text in sound() if template in concerned)
    except (UndefinedError, TypeError):
        return True


_SMALL = 3000
"""Bytes of a template whose faults take less than two seconds."""
UNSEEN = {
    "robot/robot.mo.jinja: if joint.followers or false",
    "robot/robot.mo.jinja: if joint.followers or (joints)[0].gears",
    'robot/robot.mo.jinja: if (joints)[0].source.type == "continuous"',
    "robot/robot.mo.jinja: for joint in (joints)[1:] if joint.coupling",
    "robot/robot.mo.jinja: for coupling in (joint.followers) | reverse",
    "robot/robot.mo.jinja: for drive in (drives)[1:] if drive.gear",
    'robot/run.mo.jinja: "[3]" if true',
    'robot/run.mo.jinja: "each " if true',
    "robot/test.mo.jinja: if (drives)[0].reach",
    "robot/test.mo.jinja: (drives)[0].reach.parameter",
}
"""Faults that no golden text shows: of a sensor that shows one number, which no kind does, of endless joints with two
followers, and of a robot that begins with a follower, with a shared gear, or with a loop that Test does not drive to
its ends."""


def test_faults_are_planted_in_all_kinds_of_tags() -> None:
    names = [path.relative_to(TEMPLATES).as_posix() for path in TEMPLATES.rglob("*.jinja")]
    planted = [str(fault) for name in names for fault in faults(name)]
    assert len(planted) > 700
    kinds = (" | reverse", ")[1:]", ")[0].", ": if true", ": elif false", " or false", " if true", " and false")
    assert [kind for kind in kinds if not any(kind in fault for fault in planted)] == []


@pytest.mark.parametrize("template", [
    pytest.param(path.relative_to(TEMPLATES).as_posix(), marks=[pytest.mark.slow] * (path.stat().st_size > _SMALL))
    for path in sorted(TEMPLATES.rglob("*.jinja"))
])  # fmt: skip
def test_a_fault_in_a_tag_changes_a_golden_text(template: str, tmp_path: Path) -> None:
    """If the answer of a condition does not matter, the golden texts need a case for it: another source or variant."""
    unseen = {str(fault) for fault in faults(template) if not is_seen(fault, tmp_path)}
    assert unseen == {name for name in UNSEEN if name.startswith(f"{template}: ")}
