"""Makes the files of a package from a model. A text is rendered when it is read."""

from __future__ import annotations

import functools
import itertools
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Any

import msgspec

from urdfsync.common.dependencies.facts import read_unrecorded
from urdfsync.common.dependencies.reads import is_file, walk_files
from urdfsync.common.diagnostics import ConfigError, Diagnostic, OutputError, Severity
from urdfsync.common.files import Templates, digest, normalised, shown, text_hash
from urdfsync.domain import Artifact, Domain, Order, Role, Target, Version
from urdfsync.modelica.files import class_path
from urdfsync.modelica.literals import without_literals
from urdfsync.modelica.stamp import Stamp, stamped

if TYPE_CHECKING:
    from urdfsync.engine.package.render import Renderer

_FORBIDDEN = frozenset('\\:*?"<>|')
"""Characters that some systems forbid in paths."""


class Package:
    """A generated package: its text files and the names for each `package.order`, by POSIX path below the package."""

    def __init__(
        self,
        artifacts: Iterable[Artifact | Order],
        templates: Templates,
        name: str,
        noted: Mapping[str, tuple[str, str]] = {},
        stored: Callable[[str], str | None] = lambda _: None,
    ) -> None:
        """`name` is the package's full name.

        `noted` is a result of `notes`: texts that this machine has rendered with the same program are not rendered
        again. `stored` returns the text with a hash, from any machine; None if there is none.
        """
        in_order = sorted(artifacts, key=lambda artifact: artifact.path)
        self.artifacts: dict[str, Artifact] = {a.path: a for a in in_order if isinstance(a, Artifact)}
        self.orders: Mapping[str, tuple[str, ...]] = {a.path: a.names for a in in_order if isinstance(a, Order)}
        self._templates, self._name = templates, name
        self._texts: dict[str, bytes] = {}
        self._data_hashes: dict[str, str] = {}
        self._stored = stored
        self._hashes: dict[str, str] = {
            path: noted[path][1] for path in self.artifacts if path in noted and noted[path][0] == self._data_hash(path)
        }

    def content(self, path: str) -> bytes:
        """Return the text of one file. Raises ConfigError for a template that can't be used."""
        if path not in self._texts:
            stored = self._stored(self._hashes[path]) if path in self._hashes else None
            if stored is None:
                self._texts[path] = _render(_renderer(self._templates), self.artifacts[path], self._name)
            else:
                self._texts[path] = stored.encode()
        return self._texts[path]

    def hash(self, path: str) -> str:
        """Return the hash of one file's text."""
        if path not in self._hashes:
            self._hashes[path] = text_hash(self.content(path))
        return self._hashes[path]

    @property
    def owners(self) -> Mapping[str, str]:
        """The owner of each text file, by path."""
        return {path: artifact.owner for path, artifact in self.artifacts.items()}

    @functools.cached_property
    def paths_by_hash(self) -> Mapping[str, str]:
        """The path of each text, by its hash."""
        return {self.hash(path): path for path in self.artifacts}

    def find_like(self, path: str, owner: str) -> str | None:
        """Return the path of the owner's file with the template of the file at `path`; None if there is none."""
        template = self.artifacts[path].template
        return next((a.path for a in self.artifacts.values() if (a.owner, a.template) == (owner, template)), None)

    def notes(self) -> dict[str, tuple[str, str]]:
        """Return two hashes for each file with a known text: of its template with data, and of the text."""
        return {path: (self._data_hash(path), sha256) for path, sha256 in self._hashes.items()}

    def _data_hash(self, path: str) -> str:
        if path not in self._data_hashes:
            artifact = self.artifacts[path]
            # 0.0 == -0.0, but their texts and their JSON differ
            self._data_hashes[path] = digest(msgspec.json.encode((artifact.template, artifact.data), order="sorted"))
        return self._data_hashes[path]

    def changed_since(self, last: Package) -> frozenset[str]:
        """Return the paths whose text may differ from the text in another package with the same templates."""
        is_new = (
            path not in last.artifacts or self._data_hash(path) != last._data_hash(path) for path in self.artifacts
        )
        return frozenset(itertools.compress(self.artifacts, is_new))

    def changed_models(self, last: Package) -> set[str]:
        """Return the owners of files whose text differs from the text in another package; records are left out."""
        both = (path for path in self.changed_since(last) if self.artifacts[path].role is not Role.RECORD)
        changed = (path for path in both if path not in last.artifacts or self.hash(path) != last.hash(path))
        return {self.artifacts[path].owner for path in changed}


def generate(
    domain: Domain,
    version: Version,
    target: Target,
    options: Any,
    templates: Templates,
    noted: Mapping[str, tuple[str, str]] = {},
    stored: Callable[[str], str | None] = lambda _: None,
) -> Package:
    """Return the package of a model (see `Package`). Raises OutputError for forbidden paths."""
    snapshot, imports = version.snapshot, version.imports or {}
    # the key is JSON: 0.0 == -0.0, but their texts differ
    key = domain.artifacts, msgspec.json.encode((snapshot, imports, target, options))
    artifacts = _recent.pop(key, None)
    if artifacts is None:
        artifacts = tuple(domain.artifacts(snapshot, imports, target, options))
        check_paths([*(artifact.path for artifact in artifacts), *(entry.target for entry in imports.values())])
    _recent[key] = artifacts
    while len(_recent) > _MOST:
        del _recent[next(iter(_recent))]
    return Package(artifacts, templates, target.package, noted, stored)


_MOST = 4
_recent: dict[tuple[Any, bytes], tuple[Artifact | Order, ...]] = {}
"""The artifacts of the last models: saves the daemon 9 of 90 ms with 133 links (docs/speed.md).

Dropping it changes no byte: artifacts follow from the key.
"""


@functools.lru_cache(maxsize=4)
def _renderer(templates: Templates) -> Renderer:
    """Return one renderer for all robots with the same templates, so that each template is compiled once."""
    # Jinja takes 10 ms to import: most builds have nothing to render
    from urdfsync.engine.package.render import Renderer

    return Renderer(templates.folders)


def check_paths(paths: Sequence[str]) -> None:
    """Refuse paths that leave the package, and pairs of paths that differ only in case.

    Raises OutputError with all faults.
    """
    outside = [path for path in paths if not _is_inside(path)]
    clashes = list[tuple[str, str]]()
    files, folders = dict[str, str](), dict[str, str]()
    for path in paths:
        clashes += [(files[path.casefold()], path)] if path.casefold() in files else []
        files[path.casefold()] = path
        for folder in itertools.accumulate(path.split("/")[:-1], "{}/{}".format):
            other = folders.setdefault(folder.casefold(), folder)
            clashes += [(other, folder)] if other != folder else []
    classes = {folded.removesuffix(".mo"): path for folded, path in files.items() if folded.endswith(".mo")}
    clashes += [(path, f"{folders[name]}/") for name, path in classes.items() if name in folders]
    problems = [("outside", f"{path!r} is not a path inside the package") for path in outside]
    problems += [
        ("path-clash", f"`{first}` and `{second}` can't both be in the package")
        for first, second in dict.fromkeys(clashes)
    ]
    if problems:
        hint = "rename the element, the package or the class"
        raise OutputError(*(Diagnostic(Severity.ERROR, code, message, hint=hint) for code, message in problems))


def _is_inside(path: str) -> bool:
    whole = all(part and part == part.rstrip(". ") for part in path.split("/"))
    return whole and path.isprintable() and _FORBIDDEN.isdisjoint(path)


def _render(renderer: Renderer, artifact: Artifact, package: str) -> bytes:
    """Render one file. Raises ConfigError at the faulty line of a user's template."""
    import jinja2

    try:
        text = renderer.render(artifact.template, artifact.data)
        content = text.encode()
        if artifact.path.endswith(".mo") and renderer.comes_from_user(artifact.template):
            _check_text(renderer, artifact, package, text)
    except (jinja2.TemplateError, *_RENDERING) as error:
        problem = error
    else:
        return normalised(content)
    if missing := isinstance(problem, jinja2.UndefinedError) and _MISSING.fullmatch(str(problem)):
        reason = f"`{missing[1]}` has no value here: test it by `is defined`"
    elif isinstance(problem, RecursionError):
        reason = "it includes or calls itself without end"
    elif isinstance(problem, MemoryError):
        reason = "it needs more memory than its limit"
    else:
        reason = str(problem).rstrip(".") or type(problem).__name__
    message = f"the template can't be rendered for `{artifact.path}`: {reason}"
    file, line, frame = "", 0, problem.__traceback__
    while frame is not None:  # the innermost template in the traceback counts
        name = frame.tb_frame.f_code.co_filename
        if any(folder in Path(name).parents for folder in renderer.folders):
            file, line = name, frame.tb_lineno
        frame = frame.tb_next
    if isinstance(problem, jinja2.TemplateSyntaxError):
        message = str(problem.message).rstrip(".")
        file, line = problem.filename or problem.name or "", problem.lineno
    elif isinstance(problem, jinja2.TemplatesNotFound):
        message = reason
    elif isinstance(problem, jinja2.TemplateNotFound):
        message = f"there is no template `{problem.name}`"
    elif isinstance(problem, UnicodeDecodeError):  # this error names no file: find the file with these bytes
        message, content = "the template is not UTF-8", problem.object
        files = (path for folder in renderer.folders for path in sorted(walk_files(folder)))
        file = next((path for path in files if read_unrecorded(path) == content), "")
        line = content.count(b"\n", 0, problem.start) + 1
    raise _template_error(renderer.folders, artifact.template, file, line, message)


def _check_text(renderer: Renderer, artifact: Artifact, package: str, text: str) -> None:
    """Raise ConfigError if a text from a user's template is not the class of its file.

    If texts of one template differ only in literals and in the class's own name, one check serves all.
    """
    path = PurePosixPath(artifact.path)
    form = artifact.template, str(path.parent), without_literals(re.sub(rf"\b{re.escape(path.stem)}\b", "\0", text))
    if form in renderer.sound and "\\" not in text:  # a string may have a wrong escape
        return
    from urdfsync.modelica.layout import check_class_file  # imports the parser: 8 of 220 ms of a build

    findings = check_class_file(text, path, ".".join((package, *class_path(path).parts)))[1]
    for wrong in findings:
        if wrong.severity is Severity.ERROR:
            file, line = renderer.find_origin(artifact.template, artifact.data, text, wrong.line)
            message = f"the text for `{artifact.path}` is wrong: {wrong.message}"
            raise _template_error(renderer.folders, artifact.template, file, line, message)
    if stamped(text, Stamp("", "")) == text:
        file, line = renderer.find_origin(artifact.template, artifact.data, text, text.count("\n"))
        message = f"the text for `{artifact.path}` has an empty annotation: leave it out"
        raise _template_error(renderer.folders, artifact.template, file, line, message)
    renderer.sound.add(form)


def _template_error(folders: Sequence[Path], template: str, file: str, line: int, message: str) -> ConfigError:
    """Return the error at a line of a template folder's file; without a file, the error is in `template`."""
    file = file or next((str(folder / template) for folder in folders if is_file(folder / template)), template)
    is_own = any(folder in Path(file).parents for folder in folders[:-1])
    hint = "correct the template, or delete it to use urdfsync's template" if is_own else "install urdfsync again"
    if not is_own and len(folders) > 1 and file == template:  # the user can add it
        hint = f"write {shown(folders[0] / template)}"
    file = shown(Path(file)) if Path(file).is_absolute() else file
    return ConfigError.of("template", message, file, line, hint=hint)


_MISSING = re.compile("'dict object' has no attribute '(.+)'")
_RENDERING = (
    *(ArithmeticError, AssertionError, AttributeError, LookupError, MemoryError, NameError, RuntimeError),
    *(SyntaxError, TypeError, ValueError),
)
"""Errors that expressions in a template can raise."""
