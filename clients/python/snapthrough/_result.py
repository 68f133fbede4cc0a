"""The result of an analysis: attributes for its fields, tables, plots."""
import json
import os
import sys
import warnings
from typing import Any, Dict, List, Optional, Tuple

from . import _plot, results
from ._errors import SnapthroughWarning

#: Names of columns, and their values: lists of equal length.
Columns = Tuple[List[str], List[List[Any]]]


def _ids(objects: List[Dict[str, Any]], name: str) -> List[str]:
    return list(dict.fromkeys(key for one in objects for key in one.get(name) or {}))


def _column(name: str, key: str) -> str:
    return key if name == "monitors" else f"{name}:{key}"


def _frequencies(rows: Optional[List[Optional[Dict[str, List[float]]]]]) -> Columns:
    """Columns of the frequencies of rows, null where a row has none."""
    names: List[str] = []
    columns: List[List[Any]] = []
    for field in ("omega_squared", "imaginary"):
        lists = [(row or {}).get(field) or [] for row in rows or []]
        for at in range(max(map(len, lists), default=0)):
            names.append(f"{field}:{at + 1}")
            columns.append([values[at] if at < len(values) else None for values in lists])
    return names, columns


def _points(document: Dict[str, Any]) -> Columns:
    branches = document["branches"]
    names, by_id = results.COLUMNS["Branch"]
    pairs = [(name, key) for name in by_id for key in _ids(branches, name)]
    columns: List[List[Any]] = [[] for _ in range(2 + len(names) + len(pairs))]
    for branch in branches:
        count = len(branch["load_factor"])
        series = [[branch["id"]] * count, list(range(count))] + [branch.get(name) for name in names]
        series += [(branch.get(name) or {}).get(key) for name, key in pairs]
        for column, values in zip(columns, series):
            column.extend((list(values or []) + [None] * count)[:count])
    more, frequencies = _frequencies([row for branch in branches for row in branch.get("frequencies") or []])
    return ["branch", "point", *names] + [_column(*pair) for pair in pairs] + more, columns + frequencies


def _critical_points(document: Dict[str, Any]) -> Columns:
    points = document["critical_points"]
    names, by_id = results.COLUMNS["CriticalPoint"]
    pairs = [(name, key) for name in by_id for key in _ids(points, name)]
    columns = [[point.get(name) for point in points] for name in names]
    columns += [[(point.get(name) or {}).get(key) for point in points] for name, key in pairs]
    return list(names) + [_column(*pair) for pair in pairs], columns


def _static(document: Dict[str, Any]) -> Columns:
    table = document["static"]
    names, by_id = results.COLUMNS["Static"]
    pairs = [(name, key) for name in by_id for key in _ids([table], name)]
    columns = [table.get(name) for name in names] + [table[name][key] for name, key in pairs]
    more, frequencies = _frequencies(table.get("frequencies"))
    return list(names) + [_column(*pair) for pair in pairs] + more, columns + frequencies


def _buckling(document: Dict[str, Any]) -> Columns:
    buckling = document["buckling"]
    loads = buckling["load_factors"]
    return ["mode", "load_factor", "error_estimate"], [list(range(1, len(loads) + 1)), loads,
                                                       buckling["error_estimates"]]


def _vibrations(document: Dict[str, Any]) -> Columns:
    rows: List[List[Any]] = []
    for vibration in document["vibrations"]:
        frequencies = vibration["frequencies"]
        squares = frequencies["omega_squared"]
        imaginary = frequencies.get("imaginary") or [0.0] * len(squares)
        rows += [[vibration["load_factor"], number, *values] for number, values in
                 enumerate(zip(squares, imaginary, vibration["error_estimates"]), start=1)]
    names = ["load_factor", "mode", "omega_squared", "imaginary", "error_estimate"]
    return names, [[row[at] for row in rows] for at in range(len(names))]


def _states(document: Dict[str, Any]) -> Columns:
    along_members, _ = results.COLUMNS["MemberState"]
    names = ["state", "branch", "load_factor", "member"]
    columns: List[List[Any]] = [[] for _ in range(len(names) + len(along_members))]
    for number, state in enumerate(document["states"]):
        for name, along in state["members"].items():
            count = len(along["s"])
            fixed = [[value] * count for value in (number, state["branch"], state["load_factor"], name)]
            for column, values in zip(columns, fixed + [along[field] for field in along_members]):
                column.extend(values)
    return names + list(along_members), columns


_TABLES = {"points": ("branches", _points), "critical_points": ("critical_points", _critical_points),
           "static": ("static", _static), "buckling": ("buckling", _buckling), "vibrations": ("vibrations", _vibrations),
           "states": ("states", _states)}


class Result(results.ResultFields):
    """The result of an analysis (docs/results.md). Its attributes are the fields of the contract.

    `document` is the whole as dictionaries and lists, `json` the bytes as they were received.
    """

    __slots__ = ("_json",)

    def __init__(self, text: bytes) -> None:
        """The text is that of a result, in UTF-8; it is parsed when something of it is asked for."""
        self._json = text

    def __getattr__(self, name: str) -> Any:
        if name != "_document":
            raise AttributeError(f"a result has no {name!r}; its fields are those of docs/results.md")
        self._document = json.loads(self._json)
        return self._document

    @classmethod
    def from_json(cls, text: bytes) -> "Result":
        """The result of its bytes, as stored by an earlier run. Raises ValueError when they are no result."""
        result = cls(text)
        if not isinstance(result.document, dict) or "summary" not in result.document:
            raise ValueError("this is not the document of a result: it has no summary")
        return result

    @property
    def json(self) -> bytes:
        """The document as it was received, byte for byte: UTF-8 JSON."""
        return self._json

    def tables(self) -> List[str]:
        """Names of the tables that this result has something for."""
        return [name for name, (source, _) in _TABLES.items() if self._document.get(source)]

    def columns(self, table: Optional[str] = None) -> Dict[str, List[Any]]:
        """A table as lists by column, those of the CSV table (docs/service.md).

        `table` is "points" (of paths), "critical_points", "static", "buckling", "vibrations" (one row a load factor and
        mode) or "states"; by default the first of points, vibrations, static, buckling and critical_points that is
        there.
        """
        usual = ("points", "vibrations", "static", "buckling")
        name = table or next((name for name in usual if name in self.tables()), "critical_points")
        if name not in _TABLES:
            raise ValueError(f"table: {name!r} is none of {', '.join(_TABLES)}")
        source, make = _TABLES[name]
        if source not in self._document:
            raise ValueError(f"table: this result has no {name}; it has {', '.join(self.tables()) or 'none'}")
        names, columns = make(self._document)
        return dict(zip(names, columns))

    def to_pandas(self, table: Optional[str] = None) -> Any:
        """A table as a pandas.DataFrame; see columns()."""
        import pandas
        return pandas.DataFrame(self.columns(table))

    def to_numpy(self, table: Optional[str] = None) -> Any:
        """A table as a numpy structured array, a field a column; numbers are floats, null is nan; see columns()."""
        import numpy
        columns = {name: numpy.array([float("nan") if value is None else value for value in values])
                   for name, values in self.columns(table).items()}
        rows = len(next(iter(columns.values()), ()))
        array = numpy.empty(rows, dtype=[(name, values.dtype) for name, values in columns.items()])
        for name, values in columns.items():
            array[name] = values
        return array

    def plot(self, kind: Optional[str] = None, ax: Any = None, points: bool = False) -> Any:
        """Draws with matplotlib and gives the axes back.

        `kind` is "path" (load factor over the first monitor, or over the arc length; dashed where it is unstable),
        "shape" (states over the unloaded axis), "static", "buckling" or "frequencies" (omega squared over the load
        factor, open marks where a pair flutters); by default what the result has. `points` marks the points of a path
        at which an equilibrium was solved.
        """
        return _plot.draw(self, kind, ax, points)

    def _repr_svg_(self) -> Optional[str]:
        """For notebooks: the drawing of libsnapthrough, where it is there; else notebooks show repr()."""
        from ._local import svg_of
        return svg_of(self)

    def __repr__(self) -> str:
        title = self.model.title
        lines = [f"Result{f' of {title!r}' if title else ''}: {self.summary.message}"]
        lines += [f"  warning {warning.code}: {warning.detail}" for warning in self.warnings]
        lines.append(f"  tables: {', '.join(self.tables()) or 'none'}; {self.diagnostics.wall_time_s * 1e3:.3g} ms")
        return "\n".join(lines)


def show_warnings(result: Result) -> None:
    """Tells the warnings of a result, as of the line outside this package that asked for it."""
    # Parsing a long result takes longer than a short analysis; without warnings its text ends like this.
    if result.json.endswith(b'"warnings":[]}') or not result.document.get("warnings"):
        return
    level, frame = 1, sys._getframe()
    while frame.f_back is not None and os.path.dirname(frame.f_code.co_filename) == os.path.dirname(__file__):
        level, frame = level + 1, frame.f_back
    for warning in result.document["warnings"]:
        warnings.warn(f"{warning['code']}: {warning['detail']}", SnapthroughWarning, stacklevel=level)
