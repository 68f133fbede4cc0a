"""Drawings of tables of sweeps with matplotlib, which is imported when something is drawn."""
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Set

from ._refine import CHANGE, PIECE, Refinement, is_refined, names_of

_NAMED_CURVES = 10  # a legend with more lines hides the drawing
_NAMED_CHANGES = 6
_LONGEST_CHANGE = 40  # characters


class _Row(NamedTuple):
    x: float
    y: float  # nan where the row has no value
    piece: Any  # None in tables of sweeps that are not refined
    change: Optional[str]


class _Break(NamedTuple):
    x: float
    y: float
    change: str


def draw(columns: Sequence[str], rows: Sequence[Sequence[Any]], refinement: Optional[Refinement],
         output: Optional[str], ax: Any) -> Any:
    """Draws an output of a table over its last parameter on the axes, or on new ones, which are given back."""
    parameters, outputs = names_of(columns)
    if ax is None:
        from matplotlib import pyplot
        _, ax = pyplot.subplots()
    chosen = output or (refinement.output if refinement else outputs[0])
    if chosen not in outputs:
        raise ValueError(f"output: {chosen!r} is none of {', '.join(outputs)}")
    curves = _curves(columns, rows, chosen)
    breaks = [found for name, curve in curves.items() for found in _draw_curve(curve, name, ax)]
    ax.plot([found.x for found in breaks], [found.y for found in breaks], "o", color="black", markersize=5,
            markerfacecolor="none")
    for found in _named(breaks):
        ax.annotate(_shortened(found.change), (found.x, found.y), xytext=(0, 6), textcoords="offset points",
                    ha="center", fontsize="x-small")
    if refinement and refinement.axes[-1].is_log:
        ax.set_xscale("log")
    ax.set_xlabel(parameters[-1])
    ax.set_ylabel(chosen)
    if 1 < len(curves) <= _NAMED_CURVES:
        ax.legend(fontsize="small")
    return ax


def _number(value: Any) -> Optional[float]:
    return float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else None


def _curves(columns: Sequence[str], rows: Sequence[Sequence[Any]], output: str) -> Dict[str, List[_Row]]:
    """The rows of each line, by the values of all parameters but the last; rows without a number of it are left out."""
    parameters, outputs = names_of(columns)
    last = len(parameters) - 1
    value = last + 1 + outputs.index(output)
    piece, change = (columns.index(name, last + 1) if is_refined(columns) else None for name in (PIECE, CHANGE))
    curves: Dict[str, List[_Row]] = {}
    for row in rows:
        x, y = _number(row[last]), _number(row[value])
        if row[last] is not None and x is None:
            raise ValueError(f"plot: {parameters[last]!r} has values that are no numbers; "
                             "Local().plot(table) draws over names")
        if x is None:
            continue
        name = ", ".join(f"{parameter} {_text(own)}" for parameter, own in zip(parameters[:last], row))
        curves.setdefault(name, []).append(_Row(x, float("nan") if y is None else y,
                                                None if piece is None else row[piece],
                                                None if change is None else row[change]))
    return curves


def _text(value: Any) -> str:
    return f"{value:.5g}" if isinstance(value, float) else str(value)


def _draw_curve(rows: List[_Row], name: str, ax: Any) -> List[_Break]:
    """Draws the pieces of a curve in one colour, and gives the places at which a piece begins but the first."""
    breaks: List[_Break] = []
    first, colour = 0, None
    for at in range(1, len(rows) + 1):
        if at < len(rows) and rows[at].piece == rows[first].piece:
            continue
        piece = rows[first:at]
        style = "-" if sum(row.y == row.y for row in piece) > 1 else "."  # a line needs two values
        line, = ax.plot([row.x for row in piece], [row.y for row in piece], style, color=colour,
                        label=name if colour is None else None)
        colour = line.get_color()
        if first:
            breaks += _break_between(rows[first - 1], rows[first])
        first = at
    return breaks


def _break_between(before: _Row, after: _Row) -> List[_Break]:
    """The break at the first row of a piece, or at the row before it where only that one has a value."""
    for row in (after, before):
        if row.y == row.y:  # not nan
            return [_Break(row.x, row.y, after.change or "")]
    return []


def _named(breaks: List[_Break]) -> List[_Break]:
    """The breaks whose changes are named: the first break of each change, then the others."""
    fresh: List[_Break] = []
    again: List[_Break] = []
    known: Set[str] = set()
    for found in breaks:
        if found.change:
            (again if found.change in known else fresh).append(found)
            known.add(found.change)
    return (fresh + again)[:_NAMED_CHANGES]


def _shortened(change: str) -> str:
    """The change without the words that every change of a type begins with, cut where it is long."""
    text = change[len("type: "):] if change.startswith("type: ") else change
    return text if len(text) <= _LONGEST_CHANGE else text[:_LONGEST_CHANGE - 4] + " ..."
