"""The result of an analysis: attributes for its fields, tables, plots."""
import json
from typing import Any, Callable, Dict, List, Optional

from . import _columns, _plot, results

#: Draws a result as SVG text; None where it cannot. _local sets the drawing of libsnapthrough.
svg_of: "Callable[[Result], Optional[str]]" = lambda _: None


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
        return _columns.tables_of(self._document)

    def columns(self, table: Optional[str] = None) -> Dict[str, List[Any]]:
        """A table as lists by column, those of the CSV table (docs/service.md).

        `table` is "points" (of paths), "critical_points", "static", "buckling", "vibrations" (one row a load factor and
        mode) or "states"; by default the first of points, vibrations, static, buckling and critical_points that is
        there.
        """
        return _columns.columns_of(self._document, table)

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
        return svg_of(self)

    def __repr__(self) -> str:
        title = self.model.title
        lines = [f"Result{f' of {title!r}' if title else ''}: {self.summary.message}"]
        lines += [f"  warning {warning.code}: {warning.detail}" for warning in self.warnings]
        lines.append(f"  tables: {', '.join(self.tables()) or 'none'}; {self.diagnostics.wall_time_s * 1e3:.3g} ms")
        return "\n".join(lines)
