"""What other classes can see of a file of Modelica: no values, equations, places in the text."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable

import msgspec

from urdfsync.modelica.lexer import Fault
from urdfsync.modelica.syntax import Class, Component, Extends, ImportClause, Modifier, Name, StoredText

_ENCODER = msgspec.msgpack.Encoder(order="deterministic")
_DECODER = msgspec.msgpack.Decoder(StoredText)


def encode_interface(text: StoredText) -> bytes:
    """Return the interface of a file as bytes; the same for files of which others see the same."""
    classes = [_class(one) for one in text.classes]
    faults = [Fault("", 0)] if text.is_broken else []
    return _ENCODER.encode(StoredText(faults, text.within, 0, classes, text.libraries))


def decode_interface(content: bytes) -> StoredText:
    """Return an interface as classes. Raises msgspec.MsgspecError for other bytes."""
    return _DECODER.decode(content)


def interface_digest(content: bytes) -> str:
    """Return a short hash of an encoded interface."""
    return hashlib.blake2b(content, digest_size=16).hexdigest()


def _class(one: Class) -> Class:
    return Class(
        _name(one.name),
        one.kind,
        one.prefixes,
        _extends(one.alias),
        one.literals,
        one.is_extension,
        one.is_derivative,
        _modifiers(one.arguments),
        _extends(one.constraint),
        [ImportClause(_name(i.name), {key: _name(name) for key, name in i.names.items()}) for i in one.imports],
        [Extends(_name(base.type), _modifiers(base.arguments)) for base in one.extends],
        list(map(_class, one.classes)),
        list(map(_component, one.components)),
    )


def _component(one: Component) -> Component:
    arguments, constraint = _modifiers(one.arguments), _extends(one.constraint)
    return Component(_name(one.name), _name(one.type), one.prefixes, arguments, (), constraint)


def _extends(one: Extends | None) -> Extends | None:
    return one and Extends(_name(one.type), _modifiers(one.arguments))


def _modifiers(arguments: Iterable[Modifier]) -> tuple[Modifier, ...]:
    """Return those modifiers that declare an element anew, or hold one that does: others change no name."""
    found = []
    for one in arguments:
        inner = _modifiers(one.arguments)
        if inner or one.type or one.constraint:
            new_type, constraint = _extends(one.type), _extends(one.constraint)
            found.append(Modifier(_name(one.name), inner, (), one.is_redeclared, new_type, constraint))
    return tuple(found)


def _name(name: Name) -> Name:
    return Name(name.parts, 0, name.is_global)
