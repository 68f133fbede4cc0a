"""Sweeps that are refined: the member `refine` of their documents, and the columns that their tables have for it."""
import json
import math
import numbers
from dataclasses import dataclass
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

from . import documents
from ._buildable import Refine, as_document, given

#: Columns of a refined sweep after its outputs: number of the row's piece, and what changed where the piece begins.
PIECE, CHANGE = "piece", "change"

_MEMBERS = tuple(documents.SweepRefine.__annotations__)


def is_refined(columns: Sequence[str]) -> bool:
    """Whether the columns are those of a refined sweep.

    The last output is followed by "piece", "change" and "error"; a parameter that has one of these names stands
    before the outputs.
    """
    return list(columns[-3:]) == [PIECE, CHANGE, "error"] and len(columns) > 3 and columns[-4].startswith("/")


def names_of(columns: Sequence[str]) -> Tuple[List[str], List[str]]:
    """The names of the parameters and the pointers of the outputs among the columns of a table."""
    own = list(columns[:-3] if is_refined(columns) else columns[:-1])
    first = next((at for at, name in enumerate(own) if name.startswith("/")), len(own))
    return own[:first], own[first:]


def _is_number(value: Any) -> bool:
    return isinstance(value, numbers.Real) and not isinstance(value, bool) and math.isfinite(value)


def _is_count(value: Any) -> bool:
    return isinstance(value, numbers.Integral) and not isinstance(value, bool)


def as_refine(refine: Union[Refine, Mapping[str, Any]]) -> Dict[str, Any]:
    """The contract's object of `refine`, which may be the pointer of the output alone.

    Raises ValueError for a member that is unknown, missing or of a wrong value.
    """
    if isinstance(refine, str):
        return {"output": refine}
    if not isinstance(refine, Mapping):
        raise ValueError(f"refine: {refine!r} is neither the pointer of an output nor a dictionary")
    for name in refine:
        if name not in _MEMBERS:
            raise ValueError(f"refine: {name!r} is none of {', '.join(_MEMBERS)}")
    document = given(refine)
    if not isinstance(document.get("output"), str):
        raise ValueError("refine: output must be the pointer of an output, such as "
                         '"/summary/critical_load_factor"')
    within = document.get("within", 0.01)
    if not _is_number(within) or within <= 0:
        raise ValueError(f"refine: within is {within!r}; it must be a share greater than 0, such as 0.01")
    parameters = document.get("parameters", 1)
    if not _is_count(parameters) or parameters not in (1, 2):
        raise ValueError(f"refine: parameters is {parameters!r}; it must be 1 or 2")
    most = document.get("most", 1)
    if not _is_count(most) or most < 1:
        raise ValueError(f"refine: most is {most!r}; it must be a whole number of rows greater than 0")
    return document


def check_refined(sweep: Mapping[str, Any]) -> None:
    """Raises ValueError where other members of a sweep document do not allow for its `refine`."""
    if sweep["design"] != "grid":
        raise ValueError(f'refine: the design must be "grid"; it is {sweep["design"]!r}')
    if "follow" in sweep:
        raise ValueError("refine: a sweep has follow or refine, not both")
    if sweep["refine"]["output"] not in sweep["outputs"]:
        raise ValueError(f"refine: {sweep['refine']['output']!r} must be one of the outputs of the sweep")
    count = sweep["refine"].get("parameters", 1)
    if len(sweep["parameters"]) < count:
        raise ValueError(f"refine: {count} of the parameters must be refined; the sweep has "
                         f"{len(sweep['parameters'])}")
    for parameter in sweep["parameters"][-count:]:
        if parameter.get("range") is None:
            raise ValueError(f"refine: the parameter {parameter['name']!r} needs a range, because points are added "
                             "over it; it has values")


@dataclass(frozen=True)
class Axis:
    """A refined parameter: its name, and whether straight lines are straight over its logarithm."""

    name: str
    is_log: bool = False

    def place(self, value: Any) -> Optional[float]:
        """The parameter's value, or its logarithm; None for a value that has no logarithm.

        Raises ValueError for what is no finite number.
        """
        if not _is_number(value):
            raise ValueError(f"values: {self.name!r} is {value!r}; a refined parameter must be a finite number")
        if not self.is_log:
            return float(value)
        return math.log(value) if value > 0 else None


@dataclass(frozen=True)
class Refinement:
    """What a sweep document says about its refined table: the output, and the refined parameters in their order."""

    output: str
    axes: Tuple[Axis, ...]


def refinement_of(sweep: Any) -> Refinement:
    """The refinement of a Sweep, or of the document of one, as a dictionary or JSON text.

    Raises ValueError for a sweep that is not refined.
    """
    document = json.loads(sweep) if isinstance(sweep, (str, bytes)) else as_document(sweep)
    if not isinstance(document, Mapping) or document.get("refine") is None:
        raise ValueError("sweep: it is no document of a sweep with the member refine")
    refined = document["parameters"][-document["refine"].get("parameters", 1):]
    return Refinement(document["refine"]["output"], tuple(
        Axis(parameter["name"], (parameter.get("range") or {}).get("spacing") == "log") for parameter in refined))
