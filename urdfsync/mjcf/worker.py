"""The program that translates one MJCF into URDF, within limits; `engine.expansion` starts it.

A stranger may have written the MJCF, and MuJoCo is native code. So MuJoCo gets all bytes from memory, and this process
may write no file.
"""

from __future__ import annotations

import os
import sys

import msgspec

from urdfsync.engine.exchange import Answer, Problem, Request, encode
from urdfsync.mjcf.document import Document, read_document
from urdfsync.processes import limits, reserve_stdout
from urdfsync.translation.files import Files, TranslationError

_COMPILED = b"1\xd4\0\0"
"""The first bytes of a compiled model (MJB)."""
_ARGUMENTS = ("body",)


def translate(request: Request) -> Answer:
    """Translate a file, or compare its translation."""
    try:
        from urdfsync.mjcf import comparison, urdf
    except ImportError as error:
        return Answer(problem=Problem("not-installed", f"MuJoCo can't be loaded: {error}", request.source))
    files = Files(request.contents, (request.folder, os.path.dirname(request.source)))  # noqa: PTH120
    unknown = tuple(name for name in request.arguments if name not in _ARGUMENTS)
    answer, problem, body = Answer(), None, request.arguments.get("body", "")
    try:
        with limits(request.seconds, request.memory):
            document = _read(request.source, files)
            if request.text:
                compared, differences = comparison.compare(document, request.text, body)
                answer = Answer(compared=compared, differences=differences)
            else:
                text, places = urdf.translated(document, body)
                answer = Answer(text, places)
    except TranslationError as error:
        problem = error.problem("mjcf")
    except MemoryError:
        problem = Problem("mjcf-limits", "")
    except RecursionError:
        problem = Problem("mjcf", "its elements are nested too deep", request.source)
    return msgspec.structs.replace(answer, files=files.hashes, unknown=unknown, problem=problem)


def _read(source: str, files: Files) -> Document:
    if files.read(source).startswith(_COMPILED):
        raise TranslationError(
            "this is a compiled model of MuJoCo (MJB)", (source, 0), "name the XML file of the model"
        )
    return read_document(source, files)


def main() -> None:
    """Translate the file that stdin names."""
    request = msgspec.json.decode(sys.stdin.buffer.read(), type=Request)
    with reserve_stdout() as answers:
        answers.write(encode(translate(request), "mjcf"))


if __name__ == "__main__":
    main()
