"""Tables as numpy structured arrays."""

from __future__ import annotations

import csv
import re
from typing import TYPE_CHECKING, Any, Collection, Mapping

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    import pandas  # type: ignore[import]

#: of one field
Numbers = npt.NDArray[Any]
#: structured, a field a column
Table = npt.NDArray[Any]


def table(columns: Mapping[str, Numbers], units: Mapping[str, str] | None = None) -> Table:
    kind: Any = np.dtype  # numpy's stubs do not know of metadata
    kinds = [(name, kind(values.dtype, metadata={"unit": units[name]}) if units else values.dtype)
             for name, values in columns.items()]
    made = np.empty(len(next(iter(columns.values()))), dtype=kinds)
    for name, values in columns.items():
        made[name] = values
    return made


def names_of(rows: Table) -> tuple[str, ...]:
    return rows.dtype.names or ()


def read_csv(text: str, words: Collection[str], plain: int = 0) -> tuple[Table, dict[str, str]]:
    """The rows of a command's CSV file and the units of their fields. `words`: headings of columns that are no numbers;
    the last `plain` headings have no unit."""
    lines = list(csv.reader(line for line in text.splitlines() if not line.startswith("#")))
    headings, rows = lines[0], lines[1:]
    units: dict[str, str] = {}
    columns: dict[str, Numbers] = {}
    for i, heading in enumerate(headings):
        match = re.fullmatch(r"(.*) \[([^\[\]]*)\]", heading) if i < len(headings) - plain else None
        name, unit = (match[1], match[2]) if match and match[1] not in columns else (heading, "")
        cells = [row[i] for row in rows]
        units[name] = unit
        columns[name] = np.array(cells, dtype=str) if heading in words else _numbers(cells)
    return table(columns, units), units


def _numbers(cells: list[str]) -> Numbers:
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        return np.array(cells, dtype=str)


def frame(rows: Table, units: Mapping[str, str], index: str | None = None) -> "pandas.DataFrame":
    import pandas

    columns = {name: rows[name] for name in names_of(rows) if name != index}
    made = pandas.DataFrame(
        columns, index=None if index is None else pandas.Index(rows[index], name=f"{index} [{units[index]}]"))
    made.attrs["units"] = dict(units)
    return made
