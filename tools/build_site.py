"""Builds the documentation site: `python tools/build_site.py FOLDER`, with the extra `docs`. A warning is an error.

The pages are README.md, `docs/` and what they link to, as they are. A page per command is made from its parser, and
the page of the functions from their docstrings. The README's lists are the navigation.
"""

from __future__ import annotations

import argparse
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import urdfsync
from urdfsync.commands import cli

REPOSITORY = Path(__file__).parents[1]
PAGES = ("CHANGELOG.md", "SECURITY.md", "LICENSE")
"""Beside the README."""


def main(folder: Path) -> int:
    """Build the site in a folder; returns the exit code of Sphinx, which names its warnings."""
    with tempfile.TemporaryDirectory() as place:
        source = Path(place) / "source"
        write_sources(source)
        options = ("-q", "-W", "--keep-going", "-b", "html", "-c", REPOSITORY / "docs", "-d", Path(place) / "doctrees")
        command = [sys.executable, "-m", "sphinx", *options, source, folder]
        return subprocess.run(command, check=False).returncode  # noqa: S603


def write_sources(source: Path) -> None:
    """Write all pages as Sphinx reads them."""
    shutil.copytree(REPOSITORY / "docs", source / "docs")
    for page in PAGES:
        shutil.copy(REPOSITORY / page, source)
    readme = (REPOSITORY / "README.md").read_text(encoding="utf-8")
    (source / "commands").mkdir()
    commands = [f"commands/{name}" for name in cli._COMMANDS]
    for name, page in zip(cli._COMMANDS, commands, strict=True):
        (source / f"{page}.md").write_text("\n".join(command_page(name)), encoding="utf-8")
    (source / "functions.md").write_text("\n".join(functions_page()), encoding="utf-8")
    trees = {**navigation(readme), "Commands": commands, "Functions": ["functions"]}
    hidden = (
        "\n".join(["```{toctree}", ":hidden:", f":caption: {caption}", "", *pages, "```"])
        for caption, pages in trees.items()
    )
    (source / "index.md").write_text("\n\n".join([readme, *hidden, ""]), encoding="utf-8")


def navigation(readme: str) -> dict[str, list[str]]:
    """Return the pages of each list at the end of the README, by the line before it."""
    lists = re.findall(r"^(\w[^\n]*):\n\n((?:- .*\n|  .*\n)+)", readme.partition("## Read on")[2], re.MULTILINE)
    return {caption: re.findall(r"\]\(([^)#]*)\.md\)", items) for caption, items in lists}


def command_page(name: str) -> Iterator[str]:
    """Yield the lines of a command's page."""
    (every,) = cli._parser([name])._subparsers._group_actions
    parser = every.choices[name]
    yield from (
        f"# {parser.prog}",
        "",
        str(parser.description),
        "",
        "```text",
        parser.format_usage().rstrip(),
        "```",
        "",
    )
    for group in parser._action_groups:
        if group._group_actions:
            yield from (f"## {str(group.title).capitalize()}", "")
        for action in group._group_actions:
            names = action.option_strings or [str(action.metavar or action.dest)]
            value = "" if action.nargs == 0 or not action.option_strings else f" {_value(action)}"
            yield from (", ".join(f"`{name}{value}`" for name in names), f": {action.help}", "")
    yield from ("## Examples", "", "```text", str(parser.epilog), "```", "")


def _value(action: argparse.Action) -> str:
    return str(action.metavar or "|".join(map(str, action.choices or [action.dest.upper()])))


def functions_page() -> Iterator[str]:
    """Yield the lines of the page of the API."""
    yield from ("# Functions", "", "```{eval-rst}")
    for name in urdfsync.__all__:
        value = getattr(urdfsync, name)
        if callable(value):
            kind = "class" if isinstance(value, type) else "function"
            yield from (f".. auto{kind}:: urdfsync.{name}", *(["   :members:"] * (kind == "class")), "")
    yield "```"


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]).absolute()))
