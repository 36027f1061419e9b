"""Results of simulations as OpenModelica writes them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
from scipy.io import savemat


def write_trajectory(file: Path, constants: Mapping[str, float], series: Mapping[str, Sequence[float]]) -> None:
    """Write a result as OpenModelica does; a name that begins with - is stored negated, as an alias is."""
    names = [*series, *constants]
    width = max(map(len, names))
    letters = zip(*(name.removeprefix("-").ljust(width) for name in names), strict=True)  # a column for each name
    rows = {name: (2, number) for number, name in enumerate(series, 1)}
    rows |= {name: (1, number) for number, name in enumerate(constants, 2)}
    info = [[table, -row if name[0] == "-" else row, 0, -1] for name, (table, row) in rows.items()]
    ends = [series["time"][0], series["time"][-1]]
    tables = {
        "data_1": np.array([ends, *([value, value] for value in constants.values())]),
        "data_2": np.array([np.negative(one) if name[0] == "-" else one for name, one in series.items()]),
    }
    savemat(
        file,
        {"name": np.array(["".join(row) for row in letters]), "dataInfo": np.array(info, dtype=np.int32).T, **tables},
        format="4",
    )
