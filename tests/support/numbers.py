"""Packages, compared with the second reading of their sources."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from support.packages import Package, generate
from urdfsync.domain import Companion, Target
from urdfsync.domain.experiment import Mismatch, Numbers, Sample
from urdfsync.formats.urdf.second.comparison import compare_numbers

BOT = Target("Bot", "Bot")


def compare(
    source: Path | bytes,
    change: Callable[[Mapping[str, str]], Mapping[str, str]] = lambda texts: texts,
    companions: Sequence[Companion] = (),
    **options: Any,
) -> Numbers:
    """The numbers of the package of a source, whose texts somebody has changed."""
    package = generate(source, BOT, *companions, **{"approach": ("package", "record"), **options})
    content = source if isinstance(source, bytes) else source.read_bytes()
    return of_package(package, content, change(package.texts), *companions)


def of_package(package: Package, content: bytes, texts: Mapping[str, str], *companions: Companion) -> Numbers:
    sample = Sample(content, "a.urdf", package.target, package.options, package.facts, companions=companions)
    (numbers,) = compare_numbers(sample, package.robot, [{path: text.encode() for path, text in texts.items()}])
    return numbers


def differences(source: Path | bytes, companions: Sequence[Companion] = (), **options: Any) -> list[Mismatch]:
    return list(compare(source, companions=companions, **options).differences)
