"""Replaces `omc SCRIPT.mos`: prints an answer to each call of a script, as the compiler does.

`answers.json` beside the program maps the beginning of a call to its answer; other calls give `true` without messages.
A call with an empty answer ends the program with exit code 3. `asked.txt` lists all calls.
"""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Mapping
from pathlib import Path

VERSION = '"OpenModelica 1.26.0"\n""\n'


def install(folder: Path, answers: Mapping[str, str] | None = None) -> None:
    """Write the program `omc` into a folder, with its answers."""
    folder.mkdir(parents=True, exist_ok=True)
    program = folder / "omc"
    program.write_text(f"#!{sys.executable}\n{Path(__file__).read_text()}")
    program.chmod(0o755)
    (folder / "answers.json").write_text(json.dumps(answers or {}))


def main() -> None:
    """Answer all calls of the script."""
    here, script = Path(__file__).parent, Path(sys.argv[1]).read_text()
    answers = {"getVersion": VERSION, **json.loads((here / "answers.json").read_text())}
    for call in re.findall(r"^(.*); getErrorString\(\);$", script, re.MULTILINE):
        with (here / "asked.txt").open("a") as asked:
            asked.write(f"{call}\n")
        if not (answer := next((answers[key] for key in answers if call.startswith(key)), 'true\n""\n')):
            sys.exit(3)
        sys.stdout.write(answer)


if __name__ == "__main__":
    main()
