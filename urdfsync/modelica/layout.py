"""Checks texts as files of one class, and files as a package, by the specification 3.6, section 13.4."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from pathlib import PurePosixPath

from urdfsync.diagnostics import Diagnostic, Severity
from urdfsync.modelica.files import PACKAGE_FILE, class_parts
from urdfsync.modelica.lexer import Fault, find_markers, lex
from urdfsync.modelica.names import within
from urdfsync.modelica.parser import parse
from urdfsync.modelica.syntax import StoredText
from urdfsync.spelling import nearest

_BYTE_ORDER_MARK = "\ufeff"
_ALLOWED_TWICE = ("has the equation", "connects", "extends")  # the language allows these twice


def with_within(text: str, name: str) -> str:
    """Return the file of a class with this full name, with its `within` clause."""
    tokens = lex(text)[0]
    end = next((number for number, token in enumerate(tokens) if token.text == ";"), 0)
    if tokens[0].text != "within" or not end:
        return text
    return text[: tokens[0].start] + within(name) + text[tokens[end].start + 1 :]


def first_fault(text: str, declared: StoredText) -> Fault:
    """Return the first fault of a text that has some: a marker of a merge, else a break, else a repetition."""
    faults = find_markers(text) or [fault for fault in declared.faults if not fault.is_repetition] or declared.faults
    return min(faults, key=lambda fault: fault.line)


def check_class_file(
    text: str, path: PurePosixPath, name: str, stored: StoredText | None = None
) -> tuple[StoredText | None, list[Diagnostic]]:
    """Check one file; returns its declarations, None if it can't be read, and findings without their file.

    `name` is the full name of the file's class; `stored` is the text, if it was parsed before.
    """
    findings: list[Diagnostic] = []

    def say(severity: Severity, code: str, message: str, line: int = 0, hint: str = "") -> None:
        findings.append(Diagnostic(severity, code, message, line=line, hint=hint))

    if text.startswith(_BYTE_ORDER_MARK):
        hint = "save it without: some compilers refuse it"
        say(Severity.WARNING, "byte-order-mark", "the file begins with a byte order mark", 1, hint)
    declared = stored or parse(text)
    if declared.is_broken:  # report only the first place: others may follow from it
        first = first_fault(text, declared)
        hint = "correct it first: other errors in the file may follow from it" if declared.faults[1:] else ""
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
        message, hint = f"the file lacks `{within(name)}`", "put it into the first line"
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
            hint = "move it to a file of its own: a file in a package holds one class"
            say(Severity.ERROR, "second-class", message, other.name.line, hint)
    return declared, findings


def check_places(
    paths: Iterable[str], declarations: Mapping[str, Mapping[str, int]]
) -> Iterator[tuple[str, Diagnostic]]:
    """Yield a finding for each class of a package that has two places, at one of them.

    `paths` are its files, and `declarations` the lines of classes in each `package.mo`.
    """
    places, hint = dict[tuple[str, ...], str](), "put all of it into one file, and delete the other"
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
    """Check whether a `package.order` names each class that is `present` in its folder once.

    It may name `others`, too. None means that `package.mo` can't be read: then any name is allowed.
    """
    names = [line.strip() for line in text.removeprefix(_BYTE_ORDER_MARK).split("\n")]
    lacking = sorted({*present}.difference(names))
    for name in lacking:
        hint = "add a line for it: without one, tools put it last, or warn"
        yield Diagnostic(Severity.WARNING, "order-lacks", f"`{name}` is not named", hint=hint)
    lines: dict[str, int] = {}
    for number, name in enumerate(names, start=1):
        first = lines.setdefault(name, number)
        if name and first != number:
            message, hint = f"`{name}` is named twice, first in line {first}", "take one of the lines out"
            yield Diagnostic(Severity.WARNING, "order-twice", message, line=number, hint=hint)
        elif name and others is not None and name not in present and name not in others:
            near = nearest(name, lacking)
            message = f"`{name}` is named, but is no class and no constant of the package"
            hint = f"did you mean `{near}`?" if near else "take the line out, or bring the class back"
            yield Diagnostic(Severity.ERROR, "order-unknown", message, line=number, hint=hint)
