"""The XML of a URDF without its meaning: what copies are made of, and what the reference reads by itself."""

from __future__ import annotations

from collections.abc import Iterator

from lxml import etree

from urdfsync.urdf.parse import xml

Element = etree._Element


def parse(content: bytes) -> Element:
    """The root element of a URDF that has been read without errors."""
    return xml.parse_tree(content)


def children(element: Element, tag: str) -> Iterator[Element]:
    """The children of that name, those with a prefix left out."""
    return (child for child in element.iterchildren("{*}" + tag) if child.prefix is None)


def child(element: Element, tag: str) -> Element | None:
    """The first child of that name."""
    return next(children(element, tag), None)


def attribute(element: Element, tag: str, name: str, default: str = "") -> str:
    """An attribute of a child element; the default if there is no such element or attribute."""
    found = child(element, tag)
    return default if found is None else found.get(name, default)
