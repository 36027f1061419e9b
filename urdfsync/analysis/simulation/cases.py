"""Reads the cases of `--vary`: a CSV file, or values and distributions of parameters, `robot.elbow.phi_start=0..1`."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, Literal, NoReturn

import msgspec

from urdfsync.analysis.simulation.motion import read_rows
from urdfsync.analysis.simulation.values import read_values
from urdfsync.common.diagnostics import ConfigError, SourceError
from urdfsync.common.files import shown

MOST_CASES = 1_000_000
SAMPLES = 100
"""Number of samples of distributions, unless the user gives a number."""
_SAMPLED = {"uniform": 2, "normal": 2}
"""The distributions, with their numbers of arguments."""
_CALL = re.compile(r"(\w+)\((.*)\)")
_HINT = "write NAME=0.8..1.2, NAME=0.8..1.2/5, NAME=[1,2,3], NAME=uniform(0.8,1.2) or NAME=normal(1,0.1)"


class Sampling(msgspec.Struct, frozen=True):
    """How to sample distributions."""

    count: int | None = None
    """Number of samples; None leaves the number to the program."""
    seed: int = 0
    kind: Literal["latin", "random"] = "latin"
    """A Latin hypercube, or independent random numbers."""


class Spread(msgspec.Struct, frozen=True):
    """The values of one parameter."""

    name: str
    kind: Literal["values", "uniform", "normal"]
    numbers: tuple[float, ...]
    """The values themselves; for `uniform` both bounds; for `normal` mean and standard deviation."""


class Cases(msgspec.Struct, frozen=True):
    """The varied parameters, and their values in each case."""

    names: tuple[str, ...]
    rows: Sequence[tuple[float, ...]]

    def settings(self, number: int) -> list[str]:
        """Return the values of a case, counted from 0, as `--set` takes them."""
        return [f"{name}={value!r}" for name, value in zip(self.names, self.rows[number], strict=True)]


def read_cases(given: Sequence[str], sampling: Sampling) -> Cases:
    """Return the cases that the user describes. Raises ConfigError, and SourceError for a file.

    Values form a grid. Each point of the grid gets the same samples of all distributions.
    """
    # the name of a file may have `=`; no SPEC ends with `.csv`
    files = [text for text in given if "=" not in text or text.lower().endswith(".csv")]
    if files and len(given) > 1:
        _refuse(f"`{files[0]}` is a file with all cases, so it must be the only `--vary`", _HINT)
    if files and not Path(files[0]).exists():
        _refuse(f"there is no file `{files[0]}`", f"name a CSV file, or {_HINT}")
    if files and sampling.count:
        _refuse(f"`--cases` is a number of samples, and `{files[0]}` has the cases", "leave `--cases` out")
    if files:
        return _read_file(Path(files[0]))
    spreads = [read_spread(text) for text in given]
    read_values(f"{spread.name}=0" for spread in spreads)  # refuses double names
    grid, sampled = ([each for each in spreads if (each.kind == "values") == is_grid] for is_grid in (True, False))
    if sampling.count and not sampled:
        _refuse("`--cases` is a number of samples, and no distribution is sampled", "leave `--cases` out")
    count = (sampling.count or SAMPLES) if sampled else 1
    total = count * math.prod(len(each.numbers) for each in grid)
    if total > MOST_CASES:
        _refuse(f"these are {total} cases, more than {MOST_CASES}", "name fewer values")
    samples = _samples(sampled, count, sampling) if sampled else [()]
    names = [each.name for each in (*grid, *sampled)]
    order = [names.index(each.name) for each in spreads]  # columns stand as the user named them
    points = itertools.product(itertools.product(*(each.numbers for each in grid)), samples)
    rows = [tuple((*point, *sample)[place] for place in order) for point, sample in points]
    return Cases(tuple(each.name for each in spreads), rows)


def read_spread(text: str) -> Spread:
    """Return the values in `NAME=SPEC`. Raises ConfigError."""
    name, _, spec = (part.strip() for part in text.partition("="))
    read_values([f"{name}=0"])  # refuses names that are no parameter
    if call := _CALL.fullmatch(spec):
        kind, numbers = call[1], _numbers(text, call[2].split(","))
        if kind not in _SAMPLED or len(numbers) != _SAMPLED[kind]:
            _refuse(f"`{spec}` is no distribution", _HINT)
        if kind == "normal":
            if numbers[1] < 0:
                _refuse(f"`{text}` has the negative standard deviation {numbers[1]:g}", "give 0 or more")
            return Spread(name, "normal", numbers)
        return Spread(name, "uniform", _ordered(text, numbers))
    if spec.startswith("[") and spec.endswith("]"):
        return Spread(name, "values", _numbers(text, spec[1:-1].split(",")))
    bounds, is_counted, count = spec.partition("/")
    lower, is_range, upper = bounds.partition("..")
    if not is_range:
        _refuse(f"`{text}` gives no values to vary", _HINT)
    numbers = _ordered(text, _numbers(text, (lower, upper)))
    if not is_counted:
        return Spread(name, "uniform", numbers)
    if not (count.strip().isascii() and count.strip().isdecimal() and 2 <= int(count) <= MOST_CASES):
        _refuse(f"`{count}` in `{text}` is no number of values", "give 2 or more: NAME=0.8..1.2/5")
    import numpy as np  # takes 100 ms, which other commands save

    return Spread(name, "values", tuple(np.linspace(numbers[0], numbers[1], int(count)).tolist()))


def _numbers(text: str, words: Iterable[str]) -> tuple[float, ...]:
    numbers = []
    for word in words:
        try:
            numbers.append(float(word))
        except ValueError:
            numbers.append(math.nan)
        if not math.isfinite(numbers[-1]) or "_" in word:
            what = f"`{word.strip()}` in `{text}` is no number" if word.strip() else f"in `{text}` a number is missing"
            _refuse(what, _HINT)
    return tuple(numbers)


def _ordered(text: str, numbers: tuple[float, ...]) -> tuple[float, ...]:
    if numbers[0] > numbers[1]:
        _refuse(f"in `{text}` the lower bound is above the upper one", "exchange them")
    if not math.isfinite(numbers[1] - numbers[0]):
        _refuse(f"the distance of the bounds in `{text}` is no finite number", "give bounds nearer to each other")
    return numbers


def _samples(spreads: Sequence[Spread], count: int, sampling: Sampling) -> list[tuple[float, ...]]:
    """Return samples of distributions; the same seed gives the same samples."""
    import numpy as np
    from scipy.special import ndtri  # the import takes 0.3 s
    from scipy.stats.qmc import LatinHypercube

    generator = np.random.default_rng(sampling.seed)
    if sampling.kind == "latin":
        shares = LatinHypercube(len(spreads), seed=generator).random(count)
    else:
        shares = generator.random((count, len(spreads)))
    shares = np.clip(shares, np.finfo(float).tiny, 1 - np.finfo(float).epsneg)  # 0 and 1 have no normal number
    with np.errstate(over="ignore"):
        columns = [_at(spread, shares[:, column], ndtri) for column, spread in enumerate(spreads)]
    for spread, column in zip(spreads, columns, strict=True):
        if not np.isfinite(column).all():
            _refuse(f"a sample of `{spread.name}` is no finite number", "give a smaller standard deviation")
    return list(zip(*(column.tolist() for column in columns), strict=True))


def _at(spread: Spread, shares: Any, normal: Any) -> Any:
    """Return the values of a distribution below which these shares of all values lie."""
    first, second = spread.numbers
    if spread.kind == "normal":
        return first + second * normal(shares)
    return (first + shares * (second - first)).clip(first, second)


def _read_file(file: Path) -> Cases:
    """Read a CSV file: a header with parameters, and a row for each case. Raises SourceError."""
    (line, header), *rows = read_rows(
        file, "vary", MOST_CASES, "cases", "write a header with parameters, and a row per case"
    )
    names = [cell.strip() for cell in header]
    try:
        read_values(f"{name}=0" for name in names)
    except ConfigError as error:
        (finding,) = error.diagnostics
        hint = finding.hint or "the first line names the parameters, as `--set` does"
        raise SourceError.of("vary", f"in the header, {finding.message}", shown(file), line, hint=hint) from None
    cases = []
    for line, row in rows:
        if len(row) != len(names):
            message = f"the row has {len(row)} cells, the header {len(names)}"
            raise SourceError.of("vary", message, shown(file), line, hint="give each parameter a number")
        try:
            cases.append(_numbers(file.name, row))
        except ConfigError as error:
            message = error.diagnostics[0].message
            raise SourceError.of("vary", message, shown(file), line, hint="write numbers") from None
    return Cases(tuple(names), cases)


def _refuse(message: str, hint: str) -> NoReturn:
    raise ConfigError.of("vary", message, hint=hint)
