"""The program that expands one xacro file, within limits; `expansion` starts it.

A stranger may have written the xacro file. The file may read other files and environment variables, which the answer
lists. `xacro_expressions` forbids everything else to expressions.
"""

from __future__ import annotations

import contextlib
import io
import math
import os
import re
import signal
import sys
import time
import types
import xml.dom
import xml.dom.minidom
from collections import UserDict
from collections.abc import Iterator, Mapping, Sequence
from fnmatch import filter as filter_names
from glob import has_magic
from pathlib import Path
from typing import IO, Any, cast
from xml.dom import expatbuilder
from xml.parsers import expat

from msgspec.structs import replace

from urdfsync.common.dependencies.facts import MAX_FILE, read_unrecorded
from urdfsync.common.dependencies.places import place
from urdfsync.common.dependencies.reads import list_folder
from urdfsync.common.diagnostics import Diagnostic
from urdfsync.common.files import text_digest
from urdfsync.common.processes import limits
from urdfsync.engine.sources import ros_packages
from urdfsync.engine.sources.exchange import Answer, Request, fault, serve, too_large
from urdfsync.engine.sources.file_kinds import find_conflict, find_kind

if sys.platform != "win32":
    import resource

_GRACE = 2
"""Seconds of CPU time beyond the limit, for native code."""
_PLACE = "place"
_LONGEST = 500
"""The greatest number of characters of a message: a quoted expression may have any length."""
_SAID_WHERE = ("in file:", "when processing file:", "when instantiating macro:", "instantiated from:", "included from:")
"""Beginnings of lines in which xacro states its place."""


class TimeLimitError(Exception):
    """The expansion has used all its CPU time."""


class TooLargeError(Exception):
    """The expanded text is larger than a source may be."""


class PackageNotFoundError(Exception):
    """There is no ROS package of this name."""


class PatternError(Exception):
    """A pattern has wildcards outside of the file's name."""


class NotTextError(Exception):
    """A file is not text."""

    def __init__(self, file: str, content: bytes) -> None:
        super().__init__(file)
        self.file, self.content = file, content


class _Asked(UserDict[str, str]):
    """A mapping that records its requested keys."""

    def __init__(self, values: Mapping[str, str]) -> None:
        self.asked: dict[str, None] = {}
        super().__init__(values)

    def __contains__(self, key: object) -> bool:
        self.asked[str(key)] = None
        return super().__contains__(key)

    def __getitem__(self, key: str) -> str:
        self.asked[key] = None
        return super().__getitem__(key)


def find_matches(pattern: str) -> list[str]:
    """Return the files that a pattern matches, sorted; leave out hidden files, as xacro does.

    Only the file's name may have wildcards: a search through folders and links may take forever.
    """
    folder, name = os.path.split(pattern)
    try:
        names = list_folder(folder)
    except (OSError, ValueError):  # a stranger may have written an invalid pattern
        return []
    is_hidden = name.startswith(".")
    matches = [match for match in filter_names(names, name) if match.startswith(".") == is_hidden]
    return sorted(os.path.join(folder, match) for match in matches)  # noqa: PTH118


class _Files:
    """Opens and finds files and packages for xacro, and records all of them."""

    def __init__(self, packages: ros_packages.Packages, contents: Mapping[str, bytes]) -> None:
        """`contents` of files override the disk."""
        self._contents = contents
        self.hashes: dict[str, str | None] = {}
        self.patterns: dict[str, None] = {}
        self._packages = packages

    def find(self, name: str) -> str:
        """Return the folder of a ROS package. Raises PackageNotFoundError."""
        if (folder := self._packages.folder(name)) is None:
            raise PackageNotFoundError(name)
        return str(folder)

    def glob(self, pattern: str) -> list[str]:
        """Return the files that a pattern matches. Raises PatternError."""
        pattern = os.path.abspath(pattern)  # noqa: PTH100
        folder = os.path.dirname(pattern)  # noqa: PTH120
        if has_magic(folder) and not os.path.isdir(place(folder)):  # noqa: PTH112
            raise PatternError(f"{pattern}: only the file's name may have wildcards")
        self.patterns[pattern] = None
        return find_matches(pattern)

    def open(self, path: object) -> IO[Any]:
        """Open a file as text; XML parsers get the bytes. Raises OSError, TypeError."""
        if not isinstance(path, str):  # a YAML file may give bytes as a name
            raise TypeError(f"the name of a file must be text, not {path!r}")
        path = os.path.abspath(path)  # noqa: PTH100 - links are not followed
        self.hashes[path] = None
        content = self._contents[path] if path in self._contents else read_unrecorded(path)
        self.hashes[path] = text_digest(content)
        file = _OpenedFile(io.BytesIO(content), encoding="utf-8")
        file.name = path
        return file


class _OpenedFile(io.TextIOWrapper):
    """A text with the name of its file, for messages about YAML."""

    name = ""

    def read(self, size: int | None = -1) -> str:
        """Read some or all of the text. Raises NotTextError."""
        try:
            return super().read(size)
        except UnicodeDecodeError:
            raise NotTextError(self.name, cast(io.BytesIO, self.buffer).getvalue()) from None


class _DocumentBuilder(expatbuilder.ExpatBuilderNS):
    """Builds a document; each element knows its file and line."""

    file = ""

    def start_element_handler(self, name: str, attributes: list[str]) -> None:
        """Build an element."""
        super().start_element_handler(name, attributes)
        self.curNode.setUserData(_PLACE, (self.file, self.getParser().CurrentLineNumber), _Copied())


class _Copied(xml.dom.UserDataHandler):
    """Gives a copy of an element, such as in a macro, the place of the original."""

    def handle(self, operation: int, key: str, data: Any, src: Any, dst: Any) -> None:  # noqa: ARG002 - DOM's signature
        """Record the place of a copied element."""
        if operation == self.NODE_CLONED and dst is not None:
            dst.setUserData(key, data, self)


_macros = set[str]()
"""Names of the macros in all files that were read."""
_defaults = set[str]()
"""Names of the arguments with a default in all files that were read."""
_uses: dict[str, None] = {}
"""Names of the arguments in all files that were read, in order of use."""


def _parse(file: _OpenedFile) -> Any:
    """Parse a file as `minidom.parse` does. Raises ExpatError."""
    builder = _DocumentBuilder()
    builder.file = file.name
    document = builder.parseFile(file.buffer)
    _macros.update(macro.getAttribute("name") for macro in document.getElementsByTagName("xacro:macro"))
    declared = document.getElementsByTagName("xacro:arg")
    _defaults.update(each.getAttribute("name") for each in declared if each.hasAttribute("default"))
    text = re.sub(
        r"<!--.*?(?:-->|\Z)", "", cast(io.BytesIO, file.buffer).getvalue().decode(errors="replace"), flags=re.DOTALL
    )
    _uses.update(dict.fromkeys(re.findall(r"\$\(arg\s+([^\s)]+)\s*\)", text)))
    return document


def expand(request: Request) -> Answer:
    """Expand a file as the program `xacro` does, without the comment at the top. Changes modules of this process."""
    try:
        import xacro

        from urdfsync.engine.sources import xacro_expressions
    except ImportError as error:
        return Answer(problem=fault("not-installed", f"xacro can't be loaded: {error}"))
    packages = ros_packages.Packages(list(map(Path, request.package_paths)), Path(request.source))
    files = _Files(packages, request.contents)
    said = io.StringIO()
    # xacro asks ROS 2 for packages; ROS 2 need not be installed
    ament = types.ModuleType("ament_index_python.packages")
    ament.get_package_share_directory = files.find  # type: ignore[attr-defined]
    sys.modules.update({"ament_index_python": types.ModuleType("ament_index_python"), ament.__name__: ament})
    xacro_expressions.install()
    xacro.open, xacro.glob, xacro.root_dir = files.open, files, request.folder
    xml.dom.minidom.parse = _parse  # type: ignore[assignment]
    arguments, environment = _Asked(request.arguments), _Asked(os.environ)
    os.environ = environment  # type: ignore[assignment] # noqa: B003 - this mapping only records which variables are read
    text, problem = "", None
    places: tuple[tuple[int, str, int], ...] = ()
    try:
        _raise_at_limit(request.seconds)
        with limits(request.seconds, request.memory), contextlib.redirect_stderr(said):
            xacro.init_stacks(request.source)
            document = xacro.parse(None, request.source)
            xacro.process_doc(document, mappings=arguments)
            text = _text(document, packages.places())
            places = tuple(_places(document, text))
            for element in document.getElementsByTagName("*"):
                if element.tagName in _macros:
                    name, (_, line) = element.tagName, element.getUserData(_PLACE)
                    said.write(f"warning: <{name}> of line {line} calls no macro: write <xacro:{name} …>\n")
    except Exception as error:  # noqa: BLE001 - expressions may raise any exception
        unset = [name for name in _uses if name not in _defaults.union(request.arguments)]
        problem = _problem(error, xacro.filestack[-1] if xacro.filestack else request.source, packages.places(), unset)
    lines = [line.strip() for line in said.getvalue().splitlines()]
    return Answer(
        text,
        places,
        files.hashes,
        tuple(files.patterns),
        tuple(environment.asked),
        packages.places(),
        tuple(name for name in request.arguments if name not in arguments.asked),
        tuple(dict.fromkeys(line for line in lines if line and not line.startswith(_SAID_WHERE))),
        problem,
    )


def _text(document: Any, packages: Mapping[str, str | None]) -> str:
    """Return the text of a document, the same on every machine. Raises TooLargeError before steps that take seconds."""
    text: str = document.toprettyxml(indent="  ")
    if len(text) > MAX_FILE:
        raise TooLargeError
    folders = [(name, folder) for name, folder in packages.items() if folder]
    for name, folder in sorted(folders, key=lambda item: -len(item[1])):
        text = re.sub(rf"(?<![\w./-])(?:file://)?{re.escape(folder)}/", f"package://{name}/", text)
    return text


def _raise_at_limit(seconds: float) -> None:
    """Raise TimeLimitError when the CPU time is over, so that the message can name the place.

    Python can't raise this error within native code: there, `limits` ends the process a little later.
    """

    def stop(*_: object) -> None:
        raise TimeLimitError

    if sys.platform != "win32":
        signal.signal(signal.SIGPROF, stop)
        end, hardest = math.ceil(time.process_time() + seconds) + _GRACE, resource.getrlimit(resource.RLIMIT_CPU)[1]
        if hardest == resource.RLIM_INFINITY or end < hardest:
            resource.setrlimit(resource.RLIMIT_CPU, (end, hardest))


def _places(document: Any, text: str) -> Iterator[tuple[int, str, int]]:
    """Yield the line of each element in a text, and the element's original place."""
    lines = list[int]()
    parser = expat.ParserCreate()
    parser.StartElementHandler = lambda *_: lines.append(parser.CurrentLineNumber)
    parser.Parse(text.encode(), True)  # noqa: FBT003 - this method has no keywords
    elements = document.getElementsByTagName("*")
    for line, element in zip(lines, elements, strict=True):
        file, origin = element.getUserData(_PLACE)
        yield line, file, origin


def _problem(
    error: BaseException, current: str, packages: Mapping[str, str | None], unset: Sequence[str]
) -> Diagnostic:
    """Return why an expansion failed: the innermost cause, and the place; `current` is xacro's present file.

    `packages` has the folders of the ROS packages that the file named, `unset` has arguments without a value.
    """
    place, frame = None, error.__traceback__
    while frame is not None:  # the innermost element that xacro is processing
        names = frame.tb_frame.f_locals
        node = next((names[name] for name in ("node", "elt", "tag") if hasattr(names.get(name), "getUserData")), None)
        node = node if node is None or node.nodeType == node.ELEMENT_NODE else node.parentNode
        place = (node.getUserData(_PLACE) if node is not None else None) or place
        frame = frame.tb_next
    cause = error
    while (inner := getattr(cause, "exc", None)) is not None:  # the cause of a XacroException
        cause = inner
    file, line = place or (current, 0)
    match cause:
        case PackageNotFoundError():
            return fault("no-package", f"there is no package `{cause}`", file, line)
        case RecursionError():
            return fault("xacro", "it includes or calls itself without end", file, line)
        case MemoryError() | TimeLimitError():
            return fault("xacro-limits", "", file, line)
        case TooLargeError():
            return too_large("xacro")
        case expat.ExpatError() if (kind := _kind(read_unrecorded(current))) is not None:
            return replace(kind, file=current)
        case NotTextError():
            kind = _kind(cause.content) or fault("xacro", "this is not UTF-8", line=1, hint="save it as UTF-8")
            return replace(kind, file=cause.file)
        case expat.ExpatError():
            return fault("xacro", f"this is no XML: {expat.errors.messages[cause.code]}", current, cause.lineno)
        case OSError() if cause.filename:
            message = f"{cause.filename} can't be read: {cause.strerror}"
            missing = Path(cause.filename).parents if isinstance(cause, FileNotFoundError) else ()
            package = next((name for name, folder in packages.items() if folder and Path(folder) in missing), None)
            # packages may install files into other folders, as the demos of ros2_control do
            hint = f"if package `{package}` has this file once it is installed, name the installed xacro file as source"
            return fault("xacro", message, file, line, hint if package else "")
    if type(cause).__name__ == "ArgException":
        others = ", ".join(f"`{name}`" for name in unset if name != str(cause))
        return fault(
            "no-argument", f"the argument `{cause}` is not set{f', nor is {others}' if others else ''}", file, line
        )
    if (mark := getattr(cause, "problem_mark", None)) is not None:  # of YAML
        return fault("xacro", f"this YAML can't be used: {cause.problem}", mark.name, mark.line + 1)  # type: ignore[attr-defined]
    message = str(cause if str(error).startswith("<class") else error)
    return fault("xacro", message[:_LONGEST] or type(cause).__name__, file, line)


def _kind(content: bytes) -> Diagnostic | None:
    """Return the kind of a file that is neither xacro nor YAML."""
    return find_kind(content) or find_conflict(content.decode(errors="replace").replace("\r", ""))


def main() -> None:
    """Expand the file that stdin names."""
    serve(expand, "xacro")


if __name__ == "__main__":
    main()
