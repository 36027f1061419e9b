"""Finds the program that turns a source into text of its domain: xacro, or the translator of another format."""

from __future__ import annotations

import re
from pathlib import Path

from urdfsync.common.extras import install_command
from urdfsync.domain import Translator, registry

XACRO = Translator(
    "xacro",
    "urdfsync.engine.sources.xacro_worker",
    {
        "not-installed": install_command("xacro"),
        "no-argument": "set it in `arguments`, or give it a default in the file, above its first use",
        "no-package": "add the folder around it to `package_paths`, ROS_PACKAGE_PATH or AMENT_PREFIX_PATH",
        "xacro": "correct it, then build again",
        "xacro-limits": "look for a macro or an expression that never ends",
    },
)

_COMMENT = re.compile(rb"<!--.*?(?:-->|\Z)", re.DOTALL)
_XACRO = re.compile(rb"<xacro:(?:macro|if|unless|insert_block|call|element|attribute)\b|\$\{")


def find_translator(domain: str, file: Path, content: bytes, *, has_arguments: bool = False) -> Translator | None:
    """Return the program that translates a source; None if the domain reads the source itself.

    A source with arguments is xacro, unless it is in another format.
    """
    for translator in registry.translators(domain):
        if translator.mark.match(content):
            return translator
    return XACRO if has_arguments or is_xacro(file, content) else None


def is_xacro(file: Path, content: bytes) -> bool:
    """Return whether a file is xacro, by its name or by its elements.

    An expanded URDF may still have elements of xacro, unused or in comments; but it has links, and no `${…}`.
    """
    if file.suffix == ".xacro" or b"xmlns:xacro" not in content:
        return file.suffix == ".xacro"
    text = _COMMENT.sub(b"", content)
    return b"<xacro:" in text and (b"<link" not in text or _XACRO.search(text) is not None)
