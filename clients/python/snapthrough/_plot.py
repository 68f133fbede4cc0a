"""Drawings of results with matplotlib, which is imported when something is drawn."""
from functools import partial
from typing import Any, Callable, Dict, Iterator, List, Optional, Tuple

from ._columns import columns_of
from .results import Branch, ResultFields

_KINDS = ("path", "shape", "static", "buckling", "frequencies")
_PARTS = 8  # straight lines that a cubic between two rows is drawn with


def draw(result: ResultFields, kind: Optional[str], ax: Any, points: bool = False) -> Any:
    """Draws a result of one of _KINDS on the axes, or on new ones, which are given back.

    `points` marks each point of a path at which an equilibrium was solved.
    """
    chosen = kind or _default_kind(result)
    if chosen not in _KINDS:
        raise ValueError(f"kind: {kind!r} is none of {', '.join(_KINDS)}")
    if ax is None:
        from matplotlib import pyplot
        _, ax = pyplot.subplots()
    drawings: Dict[str, Callable[[ResultFields, Any], None]] = {
        "path": partial(_path, points=points), "shape": _shape, "static": _static, "buckling": _buckling,
        "frequencies": _frequencies}
    drawings[chosen](result, ax)
    if result.model.title:
        ax.set_title(result.model.title, fontsize="medium", wrap=True)
    return ax


def _default_kind(result: ResultFields) -> str:
    document = result.document
    for kind, source in (("path", "branches"), ("frequencies", "vibrations"), ("static", "static"),
                         ("buckling", "buckling"), ("shape", "states")):
        if document.get(source):
            return kind
    raise ValueError("this result has nothing to draw: no paths, frequencies, rows, buckling loads or states")


def _unit(result: ResultFields, quantity: str) -> str:
    unit = result.model.units.get(quantity)
    return f" [{unit}]" if unit else ""


def _runs(counts: List[Optional[int]]) -> Iterator[Tuple[int, int, bool]]:
    """Runs of equal stability: first point, end, and whether they are stable; each begins where the last one ends."""
    first = 0
    for at in range(1, len(counts) + 1):
        if at == len(counts) or bool(counts[at]) != bool(counts[first]):
            yield max(0, first - 1), at, not counts[first]
            first = at


def _cubics(arcs: List[float], values: List[float], rates: List[float]) -> List[float]:
    """Values of rows, and _PARTS - 1 values between neighbours on the cubic with the values and the rates of both."""
    drawn = values[:1]
    for at in range(1, len(values)):
        length, rise = arcs[at] - arcs[at - 1], values[at] - values[at - 1]
        begin, end = length * rates[at - 1] - rise, length * rates[at] - rise
        for share in (part / _PARTS for part in range(1, _PARTS)):
            drawn.append(values[at - 1] + share * (rise + (1 - share) * ((1 - share) * begin - share * end)))
        drawn.append(values[at])
    return drawn


def _branch(branch: Branch, monitor: Optional[str], ax: Any, points: bool) -> None:
    """Draws a branch over a monitor, or over its arc length."""
    arcs, rates = branch.arc_length, branch.rates
    along = branch.monitors[monitor] if monitor else arcs
    counts: List[Optional[int]] = list(branch.negative_eigenvalues)
    if rates:  # a branch with rates has a row at each change of stability, and the row counts for what is beyond it
        counts = counts[:1] + counts[:-1]
    colour = None
    for first, end, stable in _runs(counts):
        rows = slice(first, end)
        x, y = along[rows], branch.load_factor[rows]
        if rates:
            own = rates.monitors[monitor][rows] if monitor else [1.0] * len(x)
            x, y = _cubics(arcs[rows], x, own), _cubics(arcs[rows], y, rates.load_factor[rows])
        line, = ax.plot(x, y, "-" if stable else "--", color=colour)
        colour = line.get_color()
    if points:
        computed = range(len(along)) if branch.computed is None else branch.computed
        ax.plot([along[row] for row in computed], [branch.load_factor[row] for row in computed], ".", color=colour,
                markersize=5)


def _path(result: ResultFields, ax: Any, points: bool) -> None:
    monitor = next((name for branch in result.branches for name in branch.monitors), None)
    for branch in result.branches:
        _branch(branch, monitor, ax, points)
    marks = {"limit_max": "^", "limit_min": "v", "flutter": "X", "capacity": "_"}
    for point in result.critical_points:
        at = point.monitors[monitor] if monitor else point.arc_length
        ax.plot([at], [point.load_factor], marks.get(point.type, "o"), color="black", markersize=5)
    ax.set_xlabel(f"{monitor}{_unit(result, 'length')}" if monitor else "arc length")
    ax.set_ylabel("load factor")


def _shape(result: ResultFields, ax: Any) -> None:
    if not result.states:
        raise ValueError("kind: there are no states to draw; ask for them with analysis.output.states")
    for member in result.states[0].members.values():
        ax.plot(member.x0, member.y0, ":", color="grey")
    for number, state in enumerate(result.states):
        for member in state.members.values():
            ax.plot(member.x, member.y, color=f"C{number % 10}")
        ax.plot([], [], color=f"C{number % 10}", label=f"load factor {state.load_factor:.5g}")
    ax.set_aspect("equal")
    ax.set_xlabel("x" + _unit(result, "length"))
    ax.set_ylabel("y" + _unit(result, "length"))
    ax.legend(fontsize="small")


def _static(result: ResultFields, ax: Any) -> None:
    columns = columns_of(result.document, "static")
    monitors: Dict[str, List[float]] = result.document["static"]["monitors"]
    for name, values in (monitors or {"row": list(range(len(columns["load_factor"])))}).items():
        ax.plot(values, columns["load_factor"], "o-", label=name)
    ax.set_xlabel("monitors" + _unit(result, "length"))
    ax.set_ylabel("load factor")
    ax.legend(fontsize="small")


def _buckling(result: ResultFields, ax: Any) -> None:
    if result.buckling is None:
        raise ValueError("kind: the result has no buckling loads")
    for number, (load, mode) in enumerate(zip(result.buckling.load_factors, result.buckling.modes)):
        for member in mode.members.values():
            size = [(u * u + v * v) ** 0.5 for u, v in zip(member.u, member.v)]
            ax.plot(member.s, size, color=f"C{number % 10}")
        ax.plot([], [], color=f"C{number % 10}", label=f"load factor {load:.5g}")
    ax.set_xlabel("s along each member" + _unit(result, "length"))
    ax.set_ylabel("displacement of the mode, largest 1")
    ax.legend(fontsize="small")


def _frequency_rows(document: Dict[str, Any]) -> Iterator[List[Tuple[float, Dict[str, Any]]]]:
    """For each list of points of a result, those with natural frequencies: load factor, frequencies."""
    tables = document["branches"] + ([document["static"]] if document.get("static") else [])
    for table in tables:
        yield [row for row in zip(table["load_factor"], table.get("frequencies") or []) if row[1]]
    yield [(one["load_factor"], one["frequencies"]) for one in document.get("vibrations") or []]


def _frequencies(result: ResultFields, ax: Any) -> None:
    found = [rows for rows in _frequency_rows(result.document) if rows]
    if not found:
        raise ValueError("kind: the result has no frequencies; ask for them with analysis.output.frequencies")
    for rows in found:
        for number in range(max(len(frequencies["omega_squared"]) for _, frequencies in rows)):
            there = [(load, one["omega_squared"][number], bool((one.get("imaginary") or [0] * (number + 1))[number]))
                     for load, one in rows if number < len(one["omega_squared"])]
            colour = f"C{number % 10}"
            ax.plot([load for load, _, _ in there], [square for _, square, _ in there], "-", color=colour)
            for flutters, face in ((False, colour), (True, "none")):
                marked = [(load, square) for load, square, own in there if own == flutters]
                ax.plot([load for load, _ in marked], [square for _, square in marked], "o", color=colour,
                        markerfacecolor=face, markersize=4)
    ax.set_xlabel("load factor")
    ax.set_ylabel("omega squared")
