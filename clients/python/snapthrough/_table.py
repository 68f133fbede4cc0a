"""Tables of sweeps: rows with the digits that they were received with, as CSV, JSON, NDJSON and data frames."""
import json
import os
from typing import IO, Any, Dict, Iterator, List, Mapping, Optional, Sequence, Union

from . import _spans, _table_plot
from ._interpolation import Interpolation
from ._refine import Refinement, is_refined, names_of, refinement_of

#: A file by its path, or one that is open for text.
Target = Union[str, "os.PathLike[str]", IO[str]]


def _dump(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"))


def csv_field(field: str) -> str:
    """A field of CSV: quoted where it has a comma, a quote or the end of a line."""
    if any(mark in field for mark in ',"\r\n'):
        return '"' + field.replace('"', '""') + '"'
    return field


def csv_text(text: str) -> str:
    """A text as a field: one that a spreadsheet would take for a formula begins with an apostrophe."""
    first = text.lstrip(" \t\r\n\v\f")[:1]
    formula = first and first in "=+-@\uff1d\uff0b\uff0d\uff20" or text[:1] and text[0] in "\t\r"
    return csv_field("'" + text if formula else text)


def csv_value(value: Any, text: str) -> str:
    """A value as a field: null is empty, a text is itself, anything else is its JSON text."""
    if value is None:
        return ""
    return csv_text(value) if isinstance(value, str) else csv_field(text)


class Table:
    """Rows of a sweep in the order of their points.

    `columns` are the names of the parameters, the pointers of the outputs, and "error"; `rows` are lists in that
    order; `points` has the number of each row's point, from 0; `total` is the number of points of the sweep. A row's
    "error" is None, or {"code", "detail"} of a point that failed. Iterating gives each row as a dictionary. `program`
    and `request_sha256` tell what computed the rows, and of which document; None where that is not known.

    The table of a refined sweep has two columns before "error". "piece" counts from 0 along each curve of the last
    parameter, and rows of different pieces must not be joined by a line. A single row without value between two rows
    with values belongs to the piece before it. "change" is a text in the first row of each piece but the first, such as
    "type: limit_max to bifurcation", "jump" or "no value". `total` is the number of such curves (of surfaces, where two
    parameters are refined), and the numbers in `points` have gaps. A curve or surface that failed as a whole is one
    row, in which the refined parameters, "piece" and "change" are None.
    """

    def __init__(self, columns: Sequence[str], total: int, about: Optional[Mapping[str, Any]] = None) -> None:
        self._about: Mapping[str, Any] = {} if about is None else about
        self.columns: List[str] = list(columns)
        self.total = total
        self.rows: List[List[Any]] = []
        self.points: List[int] = []
        #: Number of points that have their row; of a refined sweep, number of curves or surfaces with all their rows.
        self.done = 0
        self._texts: List[str] = []
        self._refined = is_refined(self.columns)
        self._refinement: Optional[Refinement] = None
        self._interpolation: Optional[Interpolation] = None

    def append(self, point: int, row: List[Any], text: str) -> None:
        """Adds a row and the JSON text that it came as; the caller counts `done` where the sweep is refined."""
        self.rows.append(row)
        self.points.append(point)
        self._texts.append(text)
        self._interpolation = None
        if not self._refined:
            self.done += 1

    @property
    def program(self) -> Optional[Dict[str, str]]:
        """What computed the rows, by name, version, build and target; None where that is not known (yet)."""
        program: Optional[Dict[str, str]] = self._about.get("program")
        return program

    @property
    def request_sha256(self) -> Optional[str]:
        """The SHA-256 of the canonical sweep document; None where that is not known."""
        digest: Optional[str] = self._about.get("request_sha256")
        return digest

    @property
    def refined(self) -> bool:
        """Whether the sweep was refined, so that the table has the columns "piece" and "change"."""
        return self._refined

    def with_sweep(self, sweep: Any) -> "Table":
        """Tells the table of a refined sweep which parameters were refined, and gives the table itself.

        `sweep` is the Sweep that the table is of, or its document as a dictionary or JSON text. interpolated() needs it
        where the table was read from a file. Raises ValueError for a sweep that is not refined.
        """
        if self._refined:
            self._refinement = refinement_of(sweep)
            self._interpolation = None
        return self

    @property
    def refinement(self) -> Optional[Refinement]:
        """The refined output and parameters; None where the table does not know the document of the sweep."""
        return self._refinement

    @property
    def parameters(self) -> List[str]:
        """The names of the parameters among the columns."""
        return names_of(self.columns)[0]

    @property
    def outputs(self) -> List[str]:
        """The pointers of the outputs among the columns."""
        return names_of(self.columns)[1]

    @property
    def complete(self) -> bool:
        """Whether every point of the sweep has its row, or every curve of a refined sweep its rows."""
        return self.done == self.total

    @property
    def failed(self) -> int:
        """Number of rows with an error."""
        return sum(row[-1] is not None for row in self.rows)

    def column(self, name: str) -> List[Any]:
        """The values of a column, one a row."""
        at = self.columns.index(name)
        return [row[at] for row in self.rows]

    def interpolated(self, values: Mapping[str, Any]) -> Optional[float]:
        """The refined output between the rows of a refined sweep.

        Arguments:
            values: A value for each parameter by its name. A refined parameter may have any number; the others must
                have a value, or the label of a value, that is in the table.

        Where one parameter is refined, the value lies on the straight line between two neighbouring rows of the same
        piece. Where two are, it is blended from the curves on both sides: pieces reach from the blend of their first
        rows to the blend of their last ones with a value if both curves have as many, else the values at the same
        place are blended. Lines are straight over the logarithm of a parameter whose range has the spacing log.

        Returns None between two pieces, outside the rows, and where rows have no value. Raises ValueError for values
        that do not fit the table, and for a table that is not refined or does not know the document of its sweep.

            table.interpolated({"EI": 100, "K": 12.5})
        """
        if not self._refined:
            raise ValueError("interpolated: the sweep of this table was not refined")
        if self._refinement is None:
            raise ValueError("interpolated: the table does not know which parameters were refined; give it the "
                             "document of its sweep: table.with_sweep(document)")
        if self._interpolation is None:
            self._interpolation = Interpolation(self.columns, self.rows, self._refinement)
        return self._interpolation.value_at(values)

    def plot(self, output: Optional[str] = None, ax: Any = None) -> Any:
        """Draws an output over the last parameter with matplotlib and gives the axes back.

        Rows with equal values of all other parameters are a line, which breaks where a row has no value. The lines of
        a refined sweep also break between pieces. A ring marks the row at which a piece begins, and at most six changes
        are named, the first of each kind before others. `output` is a pointer, by default that of the refined output or
        else of the first one.
        """
        return _table_plot.draw(self.columns, self.rows, self._refinement, output, ax)

    def text_of(self, index: int) -> str:
        """The JSON text of a row, as it was received."""
        return self._texts[index]

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[Dict[str, Any]]:
        return (dict(zip(self.columns, row)) for row in self.rows)

    def __getitem__(self, index: int) -> Dict[str, Any]:
        return dict(zip(self.columns, self.rows[index]))

    def __repr__(self) -> str:
        failed = f", {self.failed} with an error" if self.failed else ""
        rows = f"{len(self.rows)} of {self.total} rows"
        if self._refined:
            rows = f"{len(self.rows)} rows" + ("" if self.complete else ", not complete")
        return f"Table({rows}{failed}; columns {', '.join(self.columns)})"

    def to_pandas(self) -> Any:
        """A pandas.DataFrame with the columns of the table, and the numbers of points as its index."""
        import pandas
        return pandas.DataFrame(self.rows, columns=self.columns, index=pandas.Index(self.points, name="point"))

    def to_numpy(self, *columns: str) -> Any:
        """A numpy.ndarray of 64-bit floats of shape (rows, columns); a value that is no number is nan.

        By default every column of which all values are numbers or null.
        """
        import numpy
        names = columns or [name for name in self.columns if self._is_numeric(name)]
        lists = [[value if _is_number(value) else float("nan") for value in self.column(name)] for name in names]
        return numpy.array(lists, dtype=float).reshape(len(names), len(self.rows)).T

    def _is_numeric(self, name: str) -> bool:
        values = self.column(name)
        return any(_is_number(value) for value in values) and all(
            value is None or _is_number(value) for value in values)

    def to_csv(self, target: Optional[Target] = None) -> Optional[str]:
        """Writes what `snapthrough sweep --csv` writes, byte for byte; without a target the text is returned."""
        return _deliver(self._csv_lines(), target)

    def to_json(self, target: Optional[Target] = None) -> Optional[str]:
        """Writes what `snapthrough sweep` writes, byte for byte; without a target the text is returned."""
        return _deliver(self._json_pieces(), target)

    def to_ndjson(self, target: Optional[Target] = None) -> Optional[str]:
        """Writes what `snapthrough sweep --ndjson` writes, byte for byte; without a target the text is returned."""
        keys = [_dump(name) for name in self.columns]
        return _deliver((ndjson_line(keys, text, point) for text, point in zip(self._texts, self.points)), target)

    def _csv_lines(self) -> Iterator[str]:
        yield ",".join(csv_text(name) for name in self.columns) + "\n"
        for text in self._texts:
            values, _ = _spans.elements(text)
            yield ",".join(csv_value(value, own) for value, own in values) + "\n"

    def _json_pieces(self) -> Iterator[str]:
        yield (f'{{"kind": "table", "program": {_dump(self.program)}, "request_sha256": {_dump(self.request_sha256)},\n'
               ' "columns": ' + _dump(self.columns) + ',\n "rows": [')
        for index, text in enumerate(self._texts):
            yield (",\n  " if index else "\n  ") + text
        yield '\n ],\n "points": [' + ",".join(map(str, self.points)) + "]}\n"


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def ndjson_line(keys: Sequence[str], text: str, point: int) -> str:
    """A line of NDJSON; `keys` are the columns' names as JSON texts."""
    values, _ = _spans.elements(text)
    pairs = ",".join(f"{key}:{own}" for key, (_, own) in zip(keys, values))
    return f'{{{pairs},"point":{point}}}\n'


def _deliver(pieces: Iterator[str], target: Optional[Target]) -> Optional[str]:
    if target is None:
        return "".join(pieces)
    if isinstance(target, (str, os.PathLike)):
        with open(target, "w", encoding="utf-8", newline="") as file:
            file.writelines(pieces)
    else:
        target.writelines(pieces)
    return None


def read_table(path: Union[str, "os.PathLike[str]"], sweep: Any = None) -> Table:
    """Reads a JSON table or NDJSON, as the package, the command line and the service write them.

    A last line of NDJSON that was cut off, as when its writer was killed, is left out. `sweep` is what
    Table.with_sweep() takes; the table of a refined sweep needs it to interpolate.
    """
    with open(path, encoding="utf-8", newline="") as file:
        text = file.read()
    first = text.split("\n", 1)[0].rstrip()
    if first.endswith("}") and first.startswith("{"):
        return _told(_read_ndjson(text), sweep)
    others, rows = _spans.parts_of_table(text)
    points = others.get("points") or range(len(rows))
    table = Table(others["columns"], len(rows), others)
    for point, (row, own) in zip(points, rows):
        table.append(point, row, own)
    table.done = table.total
    return _told(table, sweep)


def _told(table: Table, sweep: Any) -> Table:
    return table if sweep is None else table.with_sweep(sweep)


def _read_ndjson(text: str) -> Table:
    table: Optional[Table] = None
    for line in text.split("\n")[:-1]:
        row = json.loads(line)
        point = row.pop("point")
        texts = [_spans.value_text(line, at) for name, at in _spans.members(line) if name != "point"]
        table = table or Table(list(row), 0)
        table.append(point, list(row.values()), "[" + ",".join(texts) + "]")
    result = table or Table([], 0)
    result.total = result.done = len(result.rows)
    return result
