"""The frame of a program that translates one file into URDF, within limits."""

from __future__ import annotations

from collections.abc import Callable, Collection

from msgspec.structs import replace

from urdfsync.common.processes import limits
from urdfsync.engine.sources.exchange import Answer, Request, fault
from urdfsync.formats.translation.files import Files, TranslationError


def answer(
    request: Request,
    files: Files,
    code: str,
    arguments: Collection[str],
    translate: Callable[[], Answer],
) -> Answer:
    """Return the answer of `translate`, or its fault as a problem of `code`, with all files that were read.

    `arguments` are those that the translator knows.
    """
    made, problem = Answer(), None
    try:
        with limits(request.seconds, request.memory):
            made = translate()
    except TranslationError as error:
        problem = error.problem(code)
    except MemoryError:
        problem = fault(f"{code}-limits", "")
    except RecursionError:
        problem = fault(code, "its parts are nested too deep", request.source)
    unknown = tuple(name for name in request.arguments if name not in arguments)
    return replace(made, files=files.hashes, unknown=unknown, problem=problem)
