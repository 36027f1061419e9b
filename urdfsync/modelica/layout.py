"""Checks texts as files of one class, and files as a package, by the specification 3.6, section 13.4."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from pathlib import PurePosixPath

from urdfsync.common.diagnostics import Diagnostic, Severity
from urdfsync.common.spelling import nearest
from urdfsync.modelica.files import PACKAGE_FILE, class_parts
from urdfsync.modelica.lexer import Fault, find_markers, lex
from urdfsync.modelica.names import within
from urdfsync.modelica.parser import parse
from urdfsync.modelica.syntax import StoredText

_BYTE_ORDER_MARK = "\ufeff"
_ALLOWED_TWICE = ("has the equation", "connects", "extends")  # the language allows repetitions


def with_within(text: str, name: str) -> str:
    """Return the text of a file with the `within` clause for a class of this full name."""
    tokens = lex(text)[0]
    end = next((number for number, token in enumerate(tokens) if token.text == ";"), 0)
    if tokens[0].text != "within" or not end:
        return text
    return text[: tokens[0].start] + within(name) + text[tokens[end].start + 1 :]


def first_fault(text: str, declared: StoredText) -> Fault:
    """Return the most important fault of a text with faults: a merge marker, else a syntax error, else a repetition."""
    faults = find_markers(text) or [fault for fault in declared.faults if not fault.is_repetition] or declared.faults
    return min(faults, key=lambda fault: fault.line)


def check_class_file(
    text: str, path: PurePosixPath, name: str, stored: StoredText | None = None
) -> tuple[StoredText | None, list[Diagnostic]]:
    """Check one file; returns its declarations (None for an unreadable file), and findings without file.

    `name` is the full name of the file's class; `stored` is the parsed text, if it is known.
    """
    findings: list[Diagnostic] = []

    def say(severity: Severity, code: str, message: str, line: int = 0, hint: str = "") -> None:
        findings.append(Diagnostic(severity, code, message, line=line, hint=hint))

    if text.startswith(_BYTE_ORDER_MARK):
        hint = "save the file without this mark: some compilers refuse it"
        say(Severity.WARNING, "byte-order-mark", "the file begins with a byte order mark", 1, hint)
    declared = stored or parse(text)
    if declared.is_broken:  # report only one fault: other faults may follow from it
        first = first_fault(text, declared)
        hint = "correct this first: other errors in the file may follow from it" if declared.faults[1:] else ""
        say(Severity.ERROR, "syntax", f"the file {first.reason}", first.line, hint)
        return None, findings
    for fault in declared.faults:
        if fault.reason.startswith(_ALLOWED_TWICE):
            say(Severity.WARNING, "repeated", f"the file {fault.reason}", fault.line)
        else:
            say(Severity.ERROR, "syntax", f"the file {fault.reason}", fault.line)
    parent, _, expected = name.rpartition(".")
    if not declared.classes:
        hint = f"write the class `{expected}`, or delete the file"
        say(Severity.ERROR, "no-class", "the file holds no class", 0, hint)
        return declared, findings
    if (declared.within or "") != parent:
        message, hint = f"the file lacks `{within(name)}`", "add it as the first line"
        if declared.within is not None:
            message = f"the file says `within {declared.within};`, but stands in `{parent or 'no package'}`"
            hint = f"write `{within(name)}`"
        say(Severity.ERROR, "wrong-within", message, declared.within_line or 1, hint)
    main = next(
        (definition for definition in declared.classes if str(definition.name) == expected), declared.classes[0]
    )
    if str(main.name) != expected:
        place = "folder" if path.name == PACKAGE_FILE else "file"
        message = f"the class is called `{main.name}`, but its {place} `{expected}`"
        say(Severity.ERROR, "wrong-name", message, main.name.line, f"give class and {place} the same name")
    for other in declared.classes:
        if other is not main:
            message = f"the file holds `{other.name}` besides `{main.name}`"
            hint = "move this class to a file of its own: a file in a package holds one class"
            say(Severity.ERROR, "second-class", message, other.name.line, hint)
    return declared, findings


def check_places(
    paths: Iterable[str], declarations: Mapping[str, Mapping[str, int]]
) -> Iterator[tuple[str, Diagnostic]]:
    """Yield a finding for each class that is stored in two places of a package.

    `paths` are the files of the package, `declarations` has the lines of classes in each `package.mo`.
    """
    places, hint = dict[tuple[str, ...], str](), "put the whole class into one file, and delete the other file"
    for path in sorted(path for path in paths if path.endswith(".mo")):
        parts = class_parts(path)
        if (first := places.setdefault(parts, path)) != path:
            message = f"`{parts[-1]}` has two files, this one and {path}"
            yield first, Diagnostic(Severity.ERROR, "class-twice", message, hint=hint)
    for path, lines in declarations.items():
        for name, line in lines.items():
            if other := places.get((*class_parts(path), name)):
                message = f"`{name}` is declared here, and also has the file {other}"
                yield path, Diagnostic(Severity.ERROR, "class-twice", message, line=line, hint=hint)


def check_order(text: str, present: Collection[str], others: Collection[str] | None) -> Iterator[Diagnostic]:
    """Check whether a `package.order` names each class that is `present` in its folder exactly once.

    It may name `others`, too. If `others` is None (`package.mo` can't be read), any name is allowed.
    """
    names = [line.strip() for line in text.removeprefix(_BYTE_ORDER_MARK).split("\n")]
    lacking = sorted({*present}.difference(names))
    for name in lacking:
        hint = "add a line for this class: without a line, tools list the class last, or warn"
        yield Diagnostic(Severity.WARNING, "order-lacks", f"`{name}` is not named", hint=hint)
    lines: dict[str, int] = {}
    for number, name in enumerate(names, start=1):
        first = lines.setdefault(name, number)
        if name and first != number:
            message, hint = f"`{name}` is named twice, first in line {first}", "delete one of the lines"
            yield Diagnostic(Severity.WARNING, "order-twice", message, line=number, hint=hint)
        elif name and others is not None and name not in present and name not in others:
            near = nearest(name, lacking)
            message = f"`{name}` is named, but the package has no such class or constant"
            hint = f"did you mean `{near}`?" if near else "delete the line, or restore the class"
            yield Diagnostic(Severity.ERROR, "order-unknown", message, line=number, hint=hint)
