"""Makes the page of a robot: one HTML file that needs no server, no network and no other file.

Texts of a source are shown as text. The page forbids all scripts and styles other than its own.
"""

from __future__ import annotations

import base64
import gzip
import hashlib
import itertools
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import markupsafe
import msgspec

from urdfsync.analysis.checks.report import to_section as check_section
from urdfsync.analysis.checks.results import CheckResult
from urdfsync.analysis.pages import threejs
from urdfsync.analysis.pages.content import Content
from urdfsync.analysis.simulation.files import check_file, not_writable
from urdfsync.analysis.simulation.results import SimulateResult
from urdfsync.common import system
from urdfsync.common.spelling import counted
from urdfsync.common.version import __version__
from urdfsync.domain.experiment import Deviation
from urdfsync.domain.scene import PageMesh
from urdfsync.output.conflicts import difference_lines, settle_hint
from urdfsync.output.edits import to_section as edits_section
from urdfsync.output.markdown import html_environment, words
from urdfsync.output.phrases import reason
from urdfsync.output.sections import findings_table

SCRIPTS = (
    *("robot.js", "meshes.js", "loops.js", "orbit.js", "panels.js", "motion.js"),
    *("poses.js", "drag.js", "stage.js", "marks.js", "page.js"),
)
"""The scripts of urdfsync, in their order: each may use declarations of earlier scripts."""
FOLLOWER = "follow.js"
"""The last script of a page that a daemon serves."""
_FOLDER = Path(__file__).parent
_MOST_INSTANTS = 1000
"""The greatest number of instants of a simulation on the page."""
_LEAST = 1e-17
"""The least relative error on the scale of a check."""
_DATA = "against statuses renamed changes edited files diagram findings".split()
"""The fields of the content that the scripts read."""
_SUFFIXES = (".html", ".htm")
_GENERATOR, _BEGINNING = b'<meta name="generator" content="urdfsync', 2000
"""The mark of each page, and the number of first bytes that contain this mark."""
_ESCAPES = {ord(char): f"\\u{ord(char):04x}" for char in "<>&\u2028\u2029"}


def page(
    content: Content,
    simulation: SimulateResult | None = None,
    check: CheckResult | None = None,
    build: int | None = None,
) -> bytes:
    """Return the page, with a simulation that plays, and a check. Raises UrdfsyncError if three.js can't be had.

    With the number of a `build`, the page follows the daemon that serves the page.
    """
    library = threejs.load()
    names = SCRIPTS if build is None else (*SCRIPTS, FOLLOWER)
    scripts = [library.text, *((_FOLDER / name).read_text("utf-8") for name in names)]
    style = (_FOLDER / "page.css").read_text("utf-8")
    styles = [style, *(part.partition("</style>")[0] for part in content.diagram.split("<style>")[1:])]
    environment = html_environment(_FOLDER)
    environment.filters |= {"words": words, "findings": findings_table, "counted": counted}
    environment.globals |= {"difference_lines": difference_lines, "reason": reason, "settle_hint": settle_hint}
    curves = check.curves if check else ()
    picture = content.picture
    data = {name: getattr(content, name) for name in _DATA} | {
        "robot": content.robot.name,
        "now": picture.now,
        "before": picture.before,
        "poses": picture.poses,
        "notes": picture.notes,
        "meshes": {name: [mesh.points, mesh.faces, *mesh.box] for name, mesh in picture.meshes.items()},
        "motion": simulation and _motion(simulation),
        "curves": curves,
        "build": build,
    }
    text = environment.get_template("page.html.jinja").render(
        version=__version__,
        policy=_policy(scripts, styles, "'none'" if build is None else "'self'"),
        style=markupsafe.Markup(style),  # noqa: S704 - our own
        scripts=[markupsafe.Markup(script) for script in scripts],  # noqa: S704 - scripts of urdfsync and of trimesh
        data=markupsafe.Markup(_json(data)),  # noqa: S704 - escaped for a script element
        meshes={name: _packed(mesh) for name, mesh in picture.meshes.items()},
        content=content,
        edits=edits_section(content.edits),
        motion=simulation,
        check=check,
        check_section=check and check_section(check),
        compared=_compared(check) if check else (),
        curves=curves,
        build=build,
        library=library,
    )
    return text.encode("utf-8", "replace")


def check_page(file: Path, inputs: Mapping[str, Path]) -> None:
    """Raise OutputError for a page that can't be written, or that would replace one of `inputs`."""
    if file.suffix.lower() not in _SUFFIXES:
        raise not_writable(file, "a page's name ends with .html", "name such a file")
    check_file(file, inputs)


def is_page(file: Path) -> bool:
    """Return whether a file is a page that urdfsync wrote."""
    if not file.is_file():  # reading a pipe would wait
        return False
    with open(file, "rb", opener=system.open_file) as opened:
        return _GENERATOR in opened.read(_BEGINNING)


def _policy(scripts: Sequence[str], styles: Sequence[str], connections: str) -> str:
    """Return the content security policy: only these scripts and styles, and nothing from elsewhere."""
    hashes = [" ".join(map(_hash, dict.fromkeys(texts))) for texts in (scripts, styles)]
    own = f"script-src {hashes[0]}; style-src {hashes[1]}; connect-src {connections}; img-src data: blob:"
    return f"default-src 'none'; {own}; base-uri 'none'; form-action 'none'"


def _hash(text: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def _json(values: Any) -> str:
    """Return JSON that ends no script element and begins no comment. NaN and infinity become null."""
    return msgspec.json.encode(values).decode().translate(_ESCAPES)


def _packed(mesh: PageMesh) -> str:
    """Return the content of a mesh; the page's data have the numbers of points and faces."""
    return base64.b64encode(gzip.compress(mesh.content, 6, mtime=0)).decode()


# --- a simulation ---------------------------------------------------------------------------------------------------


def _motion(result: SimulateResult) -> dict[str, Any]:
    """Return the joints of one robot, and the series of their variables at the page's times.

    `former` are the series of an older version; null after its end.
    """
    robots = [joint.robot for joint in result.joints]
    robot = "robot" if "robot" in robots else next(iter(robots), "")
    joints = [joint for joint in result.joints if joint.robot == robot]
    ranges = [each for joint in joints for each in (joint.position, joint.speed, joint.effort) if each is not None]
    step = math.ceil(result.points / _MOST_INSTANTS)

    def sampled(values: Sequence[float]) -> list[float]:
        padded = *values[: result.points], *itertools.repeat(math.nan, result.points - len(values))
        return [float(f"{value:.7g}") for value in (*padded[:-1:step], padded[-1])]

    series = {name: sampled(result.series[name]) for name in ("time", *(each.variable for each in ranges))}
    former = {name: sampled(values) for name, values in result.former.items()}
    return {"joints": joints, "series": series, "former": former}


def _compared(result: CheckResult) -> list[tuple[Deviation, float, float]]:
    """Return all compared quantities, the worst first, with the logarithms of errors and tolerances."""
    deviations = sorted(result.deviations or (), key=lambda each: each.relative / each.tolerance, reverse=True)
    sizes = ((each.relative, each.tolerance) for each in deviations)
    logs = [[math.log10(min(max(size, _LEAST), 1.0)) for size in pair] for pair in sizes]
    return [(each, round(log, 2), round(most, 2)) for each, (log, most) in zip(deviations, logs, strict=True)]
