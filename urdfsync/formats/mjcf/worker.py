"""The program that translates one MJCF into URDF, within limits; `engine.sources.expansion` starts it.

A stranger may have written the MJCF, and MuJoCo is native code. So MuJoCo gets all bytes from memory, and this process
may write no file.
"""

from __future__ import annotations

import os

from urdfsync.engine.sources.exchange import Answer, Request, fault, serve
from urdfsync.formats.mjcf.document import read_document
from urdfsync.formats.translation import program
from urdfsync.formats.translation.files import Files, TranslationError

_COMPILED = b"1\xd4\0\0"
"""The first bytes of a compiled model (MJB)."""


def translate(request: Request) -> Answer:
    """Translate a file, or compare its translation."""
    try:
        from urdfsync.formats.mjcf import comparison, urdf
    except ImportError as error:
        return Answer(problem=fault("not-installed", f"MuJoCo can't be loaded: {error}", request.source))
    files = Files(request.contents, (request.folder, os.path.dirname(request.source)))  # noqa: PTH120

    def translate_or_compare() -> Answer:
        if files.read(request.source).startswith(_COMPILED):
            message = "this is a compiled model of MuJoCo (MJB)"
            raise TranslationError(message, (request.source, 0), "name the XML file of the model")
        document, body = read_document(request.source, files), request.arguments.get("body", "")
        if request.text:
            compared, differences = comparison.compare(document, request.text, body)
            return Answer(compared=compared, differences=differences)
        return Answer(*urdf.translated(document, body))

    return program.answer(request, files, "mjcf", ("body",), translate_or_compare)


def main() -> None:
    """Translate the file that stdin names."""
    os.environ["MUJOCO_GL"] = "disable"  # else MuJoCo loads a library for windows: 0.1 of 0.5 s
    serve(translate, "mjcf")


if __name__ == "__main__":
    main()
