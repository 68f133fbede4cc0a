"""Values between the rows of a refined sweep, by straight lines and by blends of two curves.

A place is the value of a refined parameter, or its logarithm where the parameter's range has the spacing log. A curve
has the rows along the last parameter for one choice of the other parameters. Rows with different numbers of their piece
are not joined.
"""
from bisect import bisect_left
from itertools import groupby
from typing import Any, Dict, Hashable, List, Mapping, Optional, Sequence, Tuple

from ._refine import PIECE, Refinement, names_of

#: Place of a row on the last parameter, its value if it has one, and the number of its piece.
CurveRow = Tuple[float, Optional[float], int]


def _blend(before: float, after: float, share: float) -> float:
    """The number at a share of the way; `before` itself where both are equal, and both ends exactly."""
    if share >= 1:
        return after
    return before + share * (after - before)


def _blended(before: Optional[float], after: Optional[float], share: float) -> Optional[float]:
    return None if before is None or after is None else _blend(before, after, share)


def _piece(row: CurveRow) -> int:
    return row[2]


def _ends(piece: Sequence[CurveRow]) -> Tuple[float, float]:
    """The lowest and highest place of a piece, without the last row of a piece with values if it has none itself."""
    places = [place for place, value, _ in piece if value is not None] or [place for place, _, _ in piece]
    return min(places), max(places)


class Curve:
    """Rows along the last parameter for one choice of the other parameters."""

    def __init__(self, rows: Sequence[CurveRow]) -> None:
        ordered = sorted(rows, key=lambda row: row[0])
        self._places = [place for place, _, _ in ordered]
        self._values = [value for _, value, _ in ordered]
        self._pieces = [piece for _, _, piece in ordered]
        #: Lowest and highest place of each piece, by its number.
        self.ends = [_ends(list(piece)) for _, piece in groupby(sorted(rows, key=_piece), _piece)]

    def value_at(self, place: float) -> Optional[float]:
        """The value on the straight line; None between two pieces, outside the rows, and where rows have no value."""
        after = bisect_left(self._places, place)
        if after == len(self._places):
            return None
        if self._places[after] == place:
            return self._values[after]
        if after == 0 or self._pieces[after] != self._pieces[after - 1]:
            return None
        before = after - 1
        share = (place - self._places[before]) / (self._places[after] - self._places[before])
        return _blended(self._values[before], self._values[after], share)

    def value_in(self, piece: int, share: float) -> Optional[float]:
        """The value at a share of the length of a piece."""
        first, last = self.ends[piece]
        return self.value_at(min(max(_blend(first, last, share), first), last))


def between(before: Curve, after: Curve, share: float, place: float) -> Optional[float]:
    """The value between two curves, at a share of the way from one to the other; None between two pieces.

    Where both curves have the same number of pieces, a piece reaches from the blend of its lowest places to the blend
    of its highest ones, and values are blended at the same share of its length. Otherwise they are blended at the
    place.
    """
    if len(before.ends) != len(after.ends):
        return _blended(before.value_at(place), after.value_at(place), share)
    for piece, (own, other) in enumerate(zip(before.ends, after.ends)):
        first, last = _blend(own[0], other[0], share), _blend(own[1], other[1], share)
        if first <= place <= last:
            along = (place - first) / (last - first) if last > first else 0.0
            return _blended(before.value_in(piece, along), after.value_in(piece, along), share)
    return None


class Surface:
    """Curves at places of the first of two refined parameters; a single curve where one parameter is refined."""

    def __init__(self) -> None:
        self._rows: Dict[float, List[CurveRow]] = {}
        self._places: List[float] = []
        self._curves: List[Curve] = []

    def add(self, outer: float, row: CurveRow) -> None:
        """Adds a row; `outer` is the place on the first of two refined parameters."""
        self._rows.setdefault(outer, []).append(row)

    def build(self) -> None:
        """Makes the curves when every row has been added."""
        self._places = sorted(self._rows)
        self._curves = [Curve(self._rows[place]) for place in self._places]

    def value_at(self, outer: float, place: float) -> Optional[float]:
        """The value at two places; None where there is none."""
        after = bisect_left(self._places, outer)
        if after == len(self._places):
            return None
        if self._places[after] == outer:
            return self._curves[after].value_at(place)
        if after == 0:
            return None
        before = after - 1
        share = (outer - self._places[before]) / (self._places[after] - self._places[before])
        return between(self._curves[before], self._curves[after], share, place)


def _key(value: Any) -> Hashable:
    """A value of a parameter that is not refined, so that equal values are found in a dictionary."""
    if isinstance(value, Mapping):
        return frozenset((name, _key(one)) for name, one in value.items())
    if isinstance(value, (list, tuple)):
        return tuple(map(_key, value))
    own: Hashable = value
    return own


class Interpolation:
    """Values of the refined output between the rows of a table."""

    def __init__(self, columns: Sequence[str], rows: Sequence[Sequence[Any]], refinement: Refinement) -> None:
        self._axes = refinement.axes
        parameters, outputs = names_of(columns)
        names = [axis.name for axis in self._axes]
        if parameters[len(parameters) - len(names):] != names or refinement.output not in outputs:
            raise ValueError(f"sweep: it refines {refinement.output} over {', '.join(names)}; the table has the "
                             f"columns {', '.join(columns)}")
        self._others = parameters[:len(parameters) - len(names)]
        self._surfaces: Dict[Hashable, Surface] = {}
        output = len(parameters) + outputs.index(refinement.output)
        piece = columns.index(PIECE, len(parameters))
        for row in rows:
            self._add(row, row[output], row[piece])
        for surface in self._surfaces.values():
            surface.build()

    def _add(self, row: Sequence[Any], value: Any, piece: Any) -> None:
        """Adds a row to its surface; a row without values of the refined parameters says that all of it failed."""
        first = len(self._others)
        surface = self._surfaces.setdefault(_key(list(row[:first])), Surface())
        refined = row[first:first + len(self._axes)]
        places = [None if one is None else axis.place(one) for axis, one in zip(self._axes, refined)]
        outer = places[0] if len(places) > 1 else 0.0
        number = float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else None
        if outer is not None and places[-1] is not None:
            surface.add(outer, (places[-1], number, piece))

    def value_at(self, values: Mapping[str, Any]) -> Optional[float]:
        """The value at given values of all parameters; None where there is none.

        Raises ValueError where a parameter is unknown or missing, or one that is not refined has a value without rows.
        """
        names = self._others + [axis.name for axis in self._axes]
        for name in values:
            if name not in names:
                raise ValueError(f"values: {name!r} is none of the parameters {', '.join(names)}")
        missing = [name for name in names if name not in values]
        if missing:
            raise ValueError(f"values: {', '.join(missing)} must have a value, too")
        surface = self._surfaces.get(_key([values[name] for name in self._others]))
        if surface is None and not self._others:
            return None
        if surface is None:
            asked = ", ".join(f"{name} {values[name]!r}" for name in self._others)
            raise ValueError(f"values: no row has {asked}; these parameters are not refined, so that they "
                             "must have a value of the table")
        places = [axis.place(values[axis.name]) for axis in self._axes]
        outer = places[0] if len(places) > 1 else 0.0
        return None if outer is None or places[-1] is None else surface.value_at(outer, places[-1])
