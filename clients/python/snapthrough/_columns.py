"""Tables of a result as columns: of its points, its critical points, its states and so on."""
from typing import Any, Dict, List, Optional, Tuple

from . import results

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
            for column, values in zip(columns, fixed + [along.get(field) or [None] * count for field in along_members]):
                column.extend(values)
    return names + list(along_members), columns


#: The tables by name: the field of the document that each is of, and what makes its columns.
_TABLES = {"points": ("branches", _points), "critical_points": ("critical_points", _critical_points),
           "static": ("static", _static), "buckling": ("buckling", _buckling),
           "vibrations": ("vibrations", _vibrations), "states": ("states", _states)}


def tables_of(document: Dict[str, Any]) -> List[str]:
    """Names of the tables that the document of a result has something for."""
    return [name for name, (source, _) in _TABLES.items() if document.get(source)]


def columns_of(document: Dict[str, Any], table: Optional[str] = None) -> Dict[str, List[Any]]:
    """A table of the document of a result as lists by column; see Result.columns."""
    usual = ("points", "vibrations", "static", "buckling")
    name = table or next((name for name in usual if name in tables_of(document)), "critical_points")
    if name not in _TABLES:
        raise ValueError(f"table: {name!r} is none of {', '.join(_TABLES)}")
    source, make = _TABLES[name]
    if source not in document:
        raise ValueError(f"table: this result has no {name}; it has {', '.join(tables_of(document)) or 'none'}")
    names, columns = make(document)
    return dict(zip(names, columns))
