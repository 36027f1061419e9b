"""Renders templates: the Jinja environment, with the literals of Modelica as filters.

Modelica uses braces for arrays, so the delimiters are `<< >>`, `<% %>` and `<# #>`. Strings from a source reach
Modelica only through `string` or `html`, numbers only through `real`, `vector` or `matrix`. So no value can end a
literal or a line.
"""

from __future__ import annotations

import contextlib
import functools
import importlib.util
import math
import re
import signal
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import jinja2
import msgspec
from jinja2 import compiler, nodes
from jinja2.bccache import Bucket
from jinja2.compiler import CodeGenerator, Frame
from jinja2.exceptions import SecurityError
from jinja2.runtime import Context
from jinja2.sandbox import ImmutableSandboxedEnvironment

from urdfsync.common.dependencies.places import named, place
from urdfsync.common.dependencies.reads import walk_files
from urdfsync.common.files import put
from urdfsync.modelica import literals

if TYPE_CHECKING:
    from jinja2.ext import Extension
    from jinja2.lexer import Token, TokenStream

if sys.platform == "linux":
    import resource

    _ADDRESS_SPACE = resource.getrlimit(resource.RLIMIT_AS)
    """The memory limit of this process, outside of rendering."""


_FILTERS = (
    *(literals.real, literals.vector, literals.matrix, literals.string, literals.html),
    *(literals.modifiers, literals.capitalize_first),
)
"""The filters; each has the name of its function."""

MAX_MEMORY = 2_000_000_000
"""The greatest number of bytes of memory for rendering one text."""
MAX_SECONDS = 60.0
"""The greatest number of seconds for one text. A whole build of 3,000 links, with 12,000 texts, takes 7 s."""
MAX_OUTPUT = 200_000_000
"""The greatest number of characters of one text."""
_MARK = re.compile(r"\0([^\0]*)\0([0-9]*)\0")
"""A template's file and line, in front of their text; no text of a model contains NUL."""
_BLANK = re.compile(r"\A(?:\0[^\0]*\0[0-9]*\0|\s)*")
"""The marks and blanks at the beginning of a line."""
GRACE = 30.0
"""Seconds of CPU time beyond `MAX_SECONDS` after which the system ends the process.

Python can't interrupt its own steps, such as a power of large numbers, or a comparison of nested lists.
"""


class _CodeGenerator(CodeGenerator):
    """Compiles loops so that each pass checks the clock."""

    def visit_For(self, node: nodes.For, frame: Frame) -> None:  # noqa: N802 - Jinja's name
        """See Jinja."""
        check = nodes.Call(nodes.EnvironmentAttribute("check_time"), [], [], None, None)
        node.body.insert(0, nodes.ExprStmt(check).set_lineno(node.lineno))
        super().visit_For(node, frame)


class _CodeCache(jinja2.BytecodeCache):
    """Compiled templates of an installed package, in the folder of urdfsync's compiled modules.

    Serves the rows "first build" of docs/speed.md: compiling takes a third of the time with 11 links. Compiled code is
    valid while the template, Python, and the modules that compile it are unchanged. These include the filters: Jinja
    applies filters to constants when it compiles.
    """

    def __init__(self, folder: Path) -> None:
        """`folder` has the installed templates."""
        self._folder = str(folder / "_").removesuffix("_")  # with a separator at its end
        self._stem = importlib.util.cache_from_source(__file__).removesuffix(".pyc")
        files = [Path(file) for file in (__file__, literals.__file__, compiler.__file__)]
        self._compiler = repr([(file, file.stat().st_size, file.stat().st_mtime_ns) for file in files])

    def get_cache_key(self, name: str, filename: str | None = None) -> str:
        """See Jinja. The user's own templates have no key: each process compiles them."""
        return super().get_cache_key(name, filename) if (filename or "").startswith(self._folder) else ""

    def get_source_checksum(self, source: str) -> str:
        """See Jinja, which adds Python's version."""
        return super().get_source_checksum(f"{self._compiler}\0{source}")

    def load_bytecode(self, bucket: Bucket) -> None:
        """See Jinja."""
        # a damaged pickle can raise any exception, and a user's template has no file; Jinja then compiles the template
        with contextlib.suppress(Exception), open(f"{self._stem}.{bucket.key}", "rb") as file:  # noqa: PTH123
            bucket.load_bytecode(file)

    def dump_bytecode(self, bucket: Bucket) -> None:
        """Save a compiled template; if the cache cannot be written, each process compiles it again."""
        if bucket.key and not sys.dont_write_bytecode:
            with contextlib.suppress(OSError):
                put(Path(f"{self._stem}.{bucket.key}"), bucket.bytecode_to_string())


@contextlib.contextmanager
def _limited_process() -> Iterator[None]:
    """Limit the memory (on Linux) and the CPU time (not on Windows) of this process.

    Python raises MemoryError if the process needs `MAX_MEMORY` more than now. If a text takes `GRACE` longer than
    `MAX_SECONDS`, the system ends the process with SIGVTALRM. This stops filters over long texts and single steps of
    Python: only loops and calls check the clock.
    """
    if sys.platform == "linux":
        with open("/proc/self/statm", "rb", buffering=0) as file:  # noqa: PTH123 - called for each text
            now = int(file.read().split()[0]) * resource.getpagesize()
        soft, hard = _ADDRESS_SPACE
        allowed = [limit for limit in (soft, hard) if limit != resource.RLIM_INFINITY]
        resource.setrlimit(resource.RLIMIT_AS, (min([now + MAX_MEMORY, *allowed]), hard))
    if sys.platform != "win32":
        signal.setitimer(signal.ITIMER_VIRTUAL, MAX_SECONDS + GRACE)
    try:
        yield
    finally:
        if sys.platform != "win32":
            signal.setitimer(signal.ITIMER_VIRTUAL, 0)
        if sys.platform == "linux":
            resource.setrlimit(resource.RLIMIT_AS, _ADDRESS_SPACE)


@functools.cache
def _mark_lines() -> type[Extension]:
    """Return the extension that puts a `_MARK` before each line of a template's text, in macros and blocks, too."""
    from jinja2.ext import Extension  # takes 4 of 250 ms: only for faults in users' templates
    from jinja2.lexer import Token

    class MarkLines(Extension):
        def filter_stream(self, stream: TokenStream) -> Iterator[Token]:
            for token in stream:
                value = token.value
                if token.type == "data":
                    lines = enumerate(value.split("\n"), token.lineno)
                    value = "\n".join(f"\0{stream.filename}\0{number}\0{line}" for number, line in lines)
                yield Token(token.lineno, token.type, value)

    return MarkLines


class _Loader(jinja2.FileSystemLoader):
    """Reads templates, perhaps in a clone; their file names are those of the user's repository."""

    def __init__(self, folders: Sequence[Path]) -> None:
        super().__init__(folders)
        self._folders = folders

    def get_source(self, environment: jinja2.Environment, template: str) -> tuple[str, str, Callable[[], bool]]:
        """Return the text of a template, its file, and a function that returns whether it is unchanged."""
        self.searchpath = [*map(place, self._folders)]  # a renderer may outlive a clone
        text, file, is_unchanged = super().get_source(environment, template)
        return text, named(file), is_unchanged


class Renderer(ImmutableSandboxedEnvironment):
    """Renders templates from `folders` in Jinja's sandbox, with limits: strangers may have written the templates.

    A template hides templates of the same name in later folders. Memory is limited by `_limited_process`, ranges by
    Jinja. After a change of a template, make a new renderer.
    """

    code_generator_class = _CodeGenerator

    def __init__(self, folders: Sequence[Path]) -> None:
        super().__init__(
            loader=_Loader(folders),
            variable_start_string="<<",
            variable_end_string=">>",
            block_start_string="<%",
            block_end_string="%>",
            comment_start_string="<#",
            comment_end_string="#>",
            undefined=jinja2.StrictUndefined,
            trim_blocks=True,
            lstrip_blocks=True,
            keep_trailing_newline=True,
            auto_reload=False,
            bytecode_cache=_CodeCache(folders[-1]),
            autoescape=False,  # the text is Modelica, not HTML; the filters above escape
        )
        self.filters.update({function.__name__: function for function in _FILTERS})
        for name in ("lipsum", "random"):  # these give another text each time
            self.globals.pop(name, None)
            self.filters.pop(name, None)
        self.folders = tuple(folders)
        self.sound = set[tuple[str, ...]]()
        """Texts that `generate` has checked, without literals and own names."""
        self.deadline = math.inf
        self.pieces: dict[str, set[str]] = {}
        """The templates that each rendered template includes or imports."""
        own = [(folder, Path(path)) for folder in folders[:-1] for path in walk_files(folder)]
        self._users_names = {path.relative_to(folder).as_posix() for folder, path in own}

    def join_path(self, template: str, parent: str) -> str:
        """See Jinja."""
        self.pieces.setdefault(parent, set()).add(template)
        return template

    def check_time(self) -> None:
        """Raise SecurityError if the text takes too long."""
        if time.monotonic() > self.deadline:
            raise SecurityError(f"it takes more than {MAX_SECONDS:g} s")

    def call(self, context: Context, function: Any, /, *arguments: Any, **named: Any) -> Any:
        """See Jinja; recursion without a loop checks the clock here."""
        self.check_time()
        return super().call(context, function, *arguments, **named)

    def getattr(self, obj: Any, attribute: str) -> Any:
        """See Jinja. If the dict `x` has the key `items`, `x.items` is the value of this key, not the method.

        The sandbox allows such values, and the fields of structs: they are data.
        """
        if type(obj) is dict and attribute in obj:
            return obj[attribute]
        if isinstance(obj, msgspec.Struct) and attribute in obj.__struct_fields__:
            return getattr(obj, attribute)
        return super().getattr(obj, attribute)

    def render(self, template: str, data: Mapping[str, Any]) -> str:
        """Render a template with `data`.

        Raises jinja2.TemplateError for a faulty template, SecurityError or MemoryError for forbidden code or an
        exceeded limit.
        """
        self.deadline = time.monotonic() + MAX_SECONDS
        with _limited_process():
            pieces, size = [], 0
            for piece in self.get_template(template).generate(data):
                pieces.append(piece)
                size += len(piece)
                if size > MAX_OUTPUT:
                    raise SecurityError(f"the text has more than {MAX_OUTPUT:,} characters")
            return "".join(pieces)

    def comes_from_user(self, template: str) -> bool:
        """Whether a rendered template includes a user's file."""
        names = [template]
        for name in names:
            names += self.pieces.get(name, set()).difference(names)
        return not self._users_names.isdisjoint(names)

    def find_origin(self, template: str, data: Mapping[str, Any], text: str, line: int) -> tuple[str, int]:
        """Return the file and line of a user's template that rendered this line of the text, or the text before.

        Returns an empty name and 0 if they are unknown. Raises the errors of `render`.
        """
        marked = self.overlay(extensions=[_mark_lines()]).render(template, data)
        if _MARK.sub("", marked) != text:  # the marks change the text: for example, a filter counts characters
            return "", 0
        *before, last = marked.split("\n")[: max(line, 1)]
        places = _MARK.findall("\n".join((*before, *_BLANK.findall(last))))
        users = [place for place in places if any(folder in Path(place[0]).parents for folder in self.folders[:-1])]
        file, number = users[-1] if users else ("", 0)
        return file, int(number)
