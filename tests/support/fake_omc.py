"""Stands for `omc`: listens as it does, and answers from a JSON file beside it (`answers.json`).

That file maps the beginning of an expression to the answer; `getMessagesStringInternal()` has none to give, other
expressions are answered with `true` and no messages. What was asked is written to `asked.txt`.
"""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path

import zmq


def main() -> None:
    """Answer until told to quit."""
    here = Path(__file__).parent
    answers = json.loads((here / "answers.json").read_text())
    socket = zmq.Context().socket(zmq.REP)
    port = socket.bind_to_random_port("tcp://127.0.0.1")
    file = Path(tempfile.gettempdir()) / "fake-omc.port"
    file.write_text(f"tcp://127.0.0.1:{port}")
    sys.stdout.write(f"Started\nDumped server port in file: {file}\n")
    sys.stdout.flush()
    with (here / "asked.txt").open("a") as asked:
        while (expression := socket.recv_string()) != "quit()":
            asked.write(f"{expression}\n")
            asked.flush()
            silent = "{}\n" if expression == "getMessagesStringInternal()" else 'true\n""\n'
            socket.send_string(next((answers[key] for key in answers if expression.startswith(key)), silent))
    socket.send_string("")


if __name__ == "__main__":
    main()
