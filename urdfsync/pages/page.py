"""The page of a robot as one HTML file, which needs nothing else: no server, no network, no other file.

Whatever is in a source is shown as text. The page forbids every script and style that it was not written with.
"""

from __future__ import annotations

import base64
import gzip
import hashlib
import json
import math
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import jinja2
import markupsafe
import msgspec

from urdfsync import __version__
from urdfsync.checks.report import to_section as check_section
from urdfsync.checks.results import CheckResult, agrees, relative, tolerance
from urdfsync.output.conflicts import DisputedFile, describe, difference_lines, settle_hint
from urdfsync.output.edits import to_section as edits_section
from urdfsync.output.markdown import Table, findings_table
from urdfsync.output.phrases import reason
from urdfsync.pages import threejs
from urdfsync.pages.content import Content
from urdfsync.scene import Scene, Triangles
from urdfsync.simulation.files import check_file, not_writable
from urdfsync.simulation.results import SimulateResult

SCRIPTS = ("robot.js", "orbit.js", "panels.js", "motion.js", "page.js")
"""Our own scripts, in the order in which they run: each may use what those before it declare."""
_FOLDER = Path(__file__).parent
_STYLE = re.compile("<style>(.*?)</style>", re.DOTALL)
_CODE = re.compile("`([^`]+)`")
_MOST_INSTANTS = 1000
"""Instants of a simulation that the page has."""
_MOST_COMPARED, _LEAST = 300, 1e-17
"""Deviations of a check that the page lists, and the least one that its scale has."""
_MOST_LINES = 400
"""Lines of one difference that are shown."""
_SUFFIXES = (".html", ".htm")
_GENERATOR, _BEGINNING = b'<meta name="generator" content="urdfsync', 2000
"""What every page has in so many of its first bytes."""
_ESCAPES = {ord(char): f"\\u{ord(char):04x}" for char in "<>&\u2028\u2029"}


def page(content: Content, simulation: SimulateResult | None = None, check: CheckResult | None = None) -> bytes:
    """Return the page, with a simulation that plays, and a check. Raises UrdfsyncError if three.js can't be had."""
    library = threejs.load()
    scripts = [library.text, *((_FOLDER / name).read_text("utf-8") for name in SCRIPTS)]
    style = (_FOLDER / "page.css").read_text("utf-8")
    styles = [style, *_STYLE.findall(content.diagram)]
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(_FOLDER),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        autoescape=True,
    )
    environment.filters["words"] = _words
    edits = edits_section(content.edits)
    section = content.section
    text = environment.get_template("page.html.jinja").render(
        robot=content.robot,
        version=__version__,
        policy=_policy(scripts, styles),
        style=markupsafe.Markup(style),  # noqa: S704 - our own
        scripts=[markupsafe.Markup(script) for script in scripts],  # noqa: S704 - our own, and those of trimesh
        data=markupsafe.Markup(_json(_data(content) | {"motion": simulation and _motion(simulation)})),  # noqa: S704 - escaped for a script element
        meshes=_packed(content.meshes.values()),
        section=section,
        findings=findings_table(section.findings),
        tables=[table for table in section.tables if table.rows],
        elements={*content.statuses, *content.changes},
        edits=[table for table in edits.tables if table.rows],
        edits_summary=edits.summary,
        edited=[_edited(file.path, file.base, file.mine) for file in content.edits.files if file.base is not None],
        conflicts=list(map(_conflict, content.conflicts)),
        notes=content.notes,
        motion=simulation and _motion_words(simulation),
        check=check and _check(check),
        against=content.against,
        has_diagram=bool(content.diagram),
        bodies=content.now.bodies,
        library=library,
    )
    return text.encode("utf-8", "replace")


def check_page(file: Path, inputs: Mapping[str, Path]) -> None:
    """Raise OutputError for a page that can't be written, or would replace one of `inputs`."""
    if file.suffix.lower() not in _SUFFIXES:
        raise not_writable(file, "a page's name ends with .html", "name such a file")
    check_file(file, inputs)


def is_page(file: Path) -> bool:
    """Return whether a file is a page that urdfsync wrote."""
    if not file.is_file():  # nothing waits for a pipe
        return False
    with file.open("rb") as opened:
        return _GENERATOR in opened.read(_BEGINNING)


def _policy(scripts: Sequence[str], styles: Sequence[str]) -> str:
    """Return the content security policy: these scripts and styles alone, and nothing from elsewhere."""
    return "; ".join(
        (
            "default-src 'none'",
            f"script-src {' '.join(map(_hash, dict.fromkeys(scripts)))}",
            f"style-src {' '.join(map(_hash, dict.fromkeys(styles)))}",
            "img-src data: blob:",
            "base-uri 'none'",
            "form-action 'none'",
        )
    )


def _hash(text: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def _json(values: Any) -> str:
    """Return JSON that ends no script element and begins no comment, whatever texts are in it."""
    return json.dumps(values, ensure_ascii=False, separators=(",", ":"), allow_nan=False).translate(_ESCAPES)


def _data(content: Content) -> dict[str, Any]:
    """Return what the scripts need."""
    names = {name: f"m{number}" for number, name in enumerate(content.meshes)}
    return {
        "robot": content.robot.name,
        "now": _scene(content.now, names),
        "before": _scene(content.before, names) if content.before else None,
        "against": content.against,
        "meshes": [[len(mesh.points), len(mesh.faces)] for mesh in content.meshes.values()],
        "statuses": content.statuses,
        "renamed": content.renamed,
        "changes": content.changes,
        "files": content.files,
        "diagram": content.diagram,
    }


def _scene(scene: Scene, names: Mapping[str, str]) -> dict[str, Any]:
    """Return a scene whose meshes are named by their numbers; without shapes that can't be shown."""
    values: dict[str, Any] = msgspec.to_builtins(scene)
    for body in values["bodies"]:
        for shape in body["shapes"]:
            shape["mesh"] = names.get(shape["mesh"], "")
        body["shapes"] = [shape for shape in body["shapes"] if shape["form"] != "mesh" or shape["mesh"]]
    return values


def _packed(meshes: Iterable[Triangles]) -> str:
    """Return the points and the faces of meshes, one after the other; `_data` says how many there are of each.

    GLB by trimesh would hold the same numbers, and takes 0.7 s to import: more than all else of a small robot.
    """
    content = b"".join(
        part.astype(kind).tobytes() for each in meshes for part, kind in ((each.points, "<f4"), (each.faces, "<u4"))
    )
    return base64.b64encode(gzip.compress(content, 6, mtime=0)).decode() if content else ""


# --- a simulation ---------------------------------------------------------------------------------------------------


def _motion(result: SimulateResult) -> dict[str, Any]:
    """Return the series of the joints of one robot, in so many instants as a page shows; what is no number is null."""
    robots = [joint.robot for joint in result.joints]
    robot = "robot" if "robot" in robots else next(iter(robots), "")
    step = math.ceil(len(result.series["time"]) / _MOST_INSTANTS)

    def values(name: str) -> list[float | None]:
        series = result.series[name]
        return [float(f"{value:.7g}") if math.isfinite(value) else None for value in [*series[:-1:step], series[-1]]]

    joints = []
    for joint in result.joints:
        if joint.robot == robot:
            ranges = {name: getattr(joint, name) for name in ("position", "speed", "effort")}
            quantities = {
                name: {
                    "values": values(each.variable),
                    "unit": each.unit,
                    "least": each.least if math.isfinite(each.least) else 0.0,
                    "greatest": each.greatest if math.isfinite(each.greatest) else 0.0,
                    "lower": each.lower,
                    "upper": each.upper,
                }
                for name, each in ranges.items()
                if each is not None
            }
            joints.append({"element": joint.element, **quantities, "passed": [each.quantity for each in joint.passed]})
    return {"times": values("time"), "joints": joints}


def _motion_words(result: SimulateResult) -> dict[str, Any]:
    findings = msgspec.structs.replace(findings_table(result.diagnostics), title="Findings of the simulation")
    return {"model": result.model, "stop": f"{result.series['time'][-1]:g}", "findings": findings}


# --- a check ------------------------------------------------------------------------------------------------------


def _check(result: CheckResult) -> dict[str, Any]:
    """Return the verdict, all that was compared, the worst first, and what each edit does."""
    section = check_section(result, strict=False)
    deviations = sorted(result.deviations, key=lambda each: relative(each) / tolerance(each), reverse=True)
    compared = [
        {
            "element": each.element,
            "what": f"{each.quantity}{f', {each.detail}' if each.detail else ''}",
            "amount": f"{each.difference:.2g} {each.unit} of {each.size:.4g}",
            "relative": f"{each.relative:.1e}",
            "log": f"{math.log10(min(max(relative(each), _LEAST), 1.0)):.2f}",
            "most": f"{math.log10(tolerance(each)):.2f}",
            "agrees": agrees(each),
        }
        for each in deviations
    ]
    effects = [
        (", ".join(effect.files), each.element, str(each.quantity), f"{each.difference:.4g} {each.unit}".rstrip())
        for effect in result.effects
        for each in effect.deviations
    ]
    return {
        "section": section,
        "findings": msgspec.structs.replace(findings_table(section.findings), title="Findings of the check"),
        "reference": result.reference,
        "compared": compared[:_MOST_COMPARED],
        "rest": max(0, len(compared) - _MOST_COMPARED),
        "effects": Table("What your edits change", ("Files", "Element", "Quantity", "By up to"), effects),
    }


# --- texts ----------------------------------------------------------------------------------------------------------


def _words(text: str) -> markupsafe.Markup:
    """Return text with what stands between ` as code."""
    return markupsafe.Markup("").join(
        markupsafe.Markup("<code>{}</code>").format(piece) if number % 2 else piece
        for number, piece in enumerate(_CODE.split(text))
    )


def _edited(path: str, base: str | None, mine: str) -> dict[str, Any]:
    return {"path": path, "lines": _difference(base or "", mine, "as generated", "yours")}


def _conflict(target: DisputedFile) -> dict[str, Any]:
    """Return a conflict: what happened, each side's changes, and what settles it."""
    texts, differences = target.texts, list[dict[str, Any]]()
    if texts is not None and texts.base is not None:
        sides = {"Your changes": texts.mine, "What is new": texts.generated}
        differences = [
            {"title": title, "lines": _difference(texts.base, text, "base", title)} for title, text in sides.items()
        ]
    elif texts is not None:
        lines = _difference(texts.mine, texts.generated, "yours", "generated")
        differences = [{"title": "Yours, and what would be generated", "lines": lines}]
    if texts is not None and texts.merge is not None:
        lines = _difference(texts.mine, texts.merge.proposal, "yours", "merged")
        differences.append({"title": "The merge that is proposed", "lines": lines})
    return {
        "path": target.shown,
        "owner": target.action.owner,
        "why": f"{reason(target.action, target.result.changes, brief=True)}: {describe(target)}",
        "settle": settle_hint(target.result).strip(),
        "differences": differences,
    }


def _difference(old: str, new: str, old_name: str, new_name: str) -> list[str]:
    """Return how two texts differ, line by line."""
    lines = [str(text).removeprefix("    ") for text in difference_lines(old, new, old_name, new_name)]
    rest = len(lines) - _MOST_LINES
    return [*lines[:_MOST_LINES], f"… and {rest} more lines"] if rest > 0 else lines
