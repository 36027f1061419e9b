"""A model to the files of its package, as bytes in memory."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path, PurePosixPath
from typing import Any

from urdfsync.diagnostics import ConfigError, Diagnostic, OutputError, Severity
from urdfsync.domain import Artifact, Domain, Import, Order, Role, Snapshot, Target

_FORBIDDEN = frozenset('\\:*?"<>|')
"""Characters that a path can't have on every system."""


@dataclasses.dataclass(frozen=True, slots=True)
class Output:
    """One generated text file."""

    role: Role
    owner: str
    content: bytes


@dataclasses.dataclass(frozen=True, slots=True)
class Generated:
    """The package: text files by their path, and the names for each `package.order`; POSIX, below the package."""

    files: Mapping[str, Output]
    orders: Mapping[str, tuple[str, ...]]


def generate(
    domain: Domain,
    snapshot: Snapshot,
    imports: Mapping[str, Import],
    target: Target,
    options: Any,
    folders: Sequence[Path],
) -> Generated:
    """Render every artifact with the templates in `folders`, best first.

    Raises ConfigError for a template that can't be used, OutputError for paths that can't be written.
    """
    artifacts = domain.artifacts(snapshot, imports, target, options)
    check_paths([artifact.path for artifact in artifacts] + [entry.target for entry in imports.values()])
    texts = [artifact for artifact in artifacts if isinstance(artifact, Artifact)]
    contents = _render(texts, folders)
    return Generated(
        {text.path: Output(text.role, text.owner, content) for text, content in zip(texts, contents, strict=True)},
        {order.path: order.names for order in artifacts if isinstance(order, Order)},
    )


def check_paths(paths: Iterable[str]) -> None:
    """Refuse paths that leave the package, and pairs that are one file or one class where case is folded.

    Raises OutputError with everything that is wrong.
    """
    problems: list[Diagnostic] = []
    files: dict[str, str] = {}
    folders: dict[str, str] = {}
    for path in paths:
        if not _is_inside(path):
            problems.append(_problem("outside", f"{path!r} is no path inside the package"))
            continue
        if path.casefold() in files:
            problems.append(_clash(files[path.casefold()], path))
        files[path.casefold()] = path
        parents = [str(parent) for parent in PurePosixPath(path).parents]
        others = [folders.setdefault(parent.casefold(), parent) for parent in parents]
        problems += [_clash(one, two) for one, two in zip(others, parents, strict=True) if one != two]
    classes = {folded.removesuffix(".mo"): path for folded, path in files.items() if folded.endswith(".mo")}
    problems += [_clash(path, f"{folders[name]}/") for name, path in classes.items() if name in folders]
    if problems:
        raise OutputError(*problems)


def _is_inside(path: str) -> bool:
    parts = path.split("/")
    whole = all(part not in ("", ".", "..") and part == part.rstrip(". ") for part in parts)
    return whole and path.isprintable() and not _FORBIDDEN & set(path)


def _clash(one: str, two: str) -> Diagnostic:
    return _problem("path-clash", f"`{one}` and `{two}` can't both be in the package")


def _problem(code: str, message: str) -> Diagnostic:
    return Diagnostic(Severity.ERROR, code, message, hint="rename the element, the package or the class")


def _render(artifacts: Sequence[Artifact], folders: Sequence[Path]) -> list[bytes]:
    import jinja2

    from urdfsync.render import Renderer

    renderer = Renderer(folders)
    contents = []
    for artifact in artifacts:
        try:
            text = renderer.render(artifact.template, artifact.data)
        except jinja2.TemplateSyntaxError as error:
            name = error.filename or error.name or artifact.template
            raise ConfigError(_template_problem(str(error.message), name, error.lineno)) from None
        except jinja2.TemplateNotFound as error:
            raise ConfigError(_template_problem(f"there is no template `{error.name}`", "", 0)) from None
        except (jinja2.TemplateError, ArithmeticError, AttributeError, LookupError, TypeError, ValueError) as error:
            message = f"the template can't be rendered for `{artifact.path}`: {error}"
            raise ConfigError(_template_problem(message, *_place(error, artifact.template))) from None
        contents.append(text.replace("\r\n", "\n").encode())
    return contents


def _template_problem(message: str, file: str, line: int) -> Diagnostic:
    return Diagnostic(Severity.ERROR, "template", message, file, line)


def _place(error: Exception, template: str) -> tuple[str, int]:
    """File and line of the innermost template that the error passed through; Jinja names them in the traceback."""
    file, line, frame = template, 0, error.__traceback__
    while frame is not None:
        name = frame.tb_frame.f_code.co_filename
        if name.endswith(".jinja"):
            file, line = name, frame.tb_lineno
        frame = frame.tb_next
    return file, line
