"""Model and Sweep: the generated builders, and what is shorter to say by hand."""
import math
from dataclasses import dataclass
from typing import Any, Dict, List, Optional, TypeVar, Union

from . import documents
from ._buildable import AnalysisBase
from ._builders import Buckling, Critical, ModelFields, Path, Static, SweepFields, Vibration
from ._refine import as_refine, check_refined

_M = TypeVar("_M", bound="Model")

#: Any analysis: a builder, or the document of one.
Analysis = Union[Buckling, Critical, Path, Static, Vibration, documents.Analysis]


@dataclass
class Model(ModelFields):
    """A structure, what holds it and what acts on it; every method adds one item and gives the model back.

    The fields and methods are those of the contract (docs/requests.md), so `document` is exactly the `model` of a
    request. A place is the id of a node, (id of a member, fraction of its length), or the contract's object.

        model = (Model("Column on an elastic base", units={"length": "m", "force": "kN"})
                 .node("foot", 0, 0).node("head", 0, 5)
                 .section("shaft", EA=1e6, EI=100)
                 .member("column", "foot", "head", "shaft")
                 .support("foot", ["x", "y"]).support("head", ["x"])
                 .foundation("base", "column", 10)
                 .point_load("head", [0, -1]))
    """

    def arch(self: _M, id: documents.Id, start: documents.Id, end: documents.Id, section: documents.Id, rise: float,
             *, release: Optional[documents.MemberRelease] = None) -> _M:
        """A circular arch by its rise; both nodes must be there already.

        Arguments:
            id: Name of the member.
            start: Id of the node that s is counted from.
            end: Id of the other node.
            section: Id of the section.
            rise: Rise of the crown along the left normal of the chord, not 0: positive bulges upwards for a member
                drawn from left to right [length].
            release: Internal hinges.
        """
        if not rise:
            raise ValueError("rise: an arch needs a rise that is not 0; use line_member for a straight one")
        first, last = self._place_of(start), self._place_of(end)
        chord = math.hypot(last["x"] - first["x"], last["y"] - first["y"])
        sweep = -4 * math.degrees(math.atan2(2 * rise, chord))
        return self.arc_member(id, start, end, section, sweep, release=release)

    def _place_of(self, name: str) -> documents.Node:
        for node in self.nodes:
            if node["id"] == name:
                return node
        raise ValueError(f"an arch needs its nodes first: there is no node {name!r} yet")


@dataclass
class Sweep(SweepFields):
    """Many variations of one request, answered as a table (docs/sweeps.md).

        sweep = Sweep(model, Critical(), "grid", ["/summary/critical_load_factor"])
        sweep.parameter("K", "/model/foundations/0/stiffness", range={"from": 1, "to": 1000, "count": 50})

    With `refine` points are added over the last parameter, or over the last two, until straight lines between rows
    are near enough to an output. It is the pointer of that output, for lines within 1 % of its value, or a dictionary
    (documents.SweepRefine). The design must be "grid", and a refined parameter must have a range; else `document`
    raises ValueError.

        sweep = Sweep(model, Critical(), "grid", ["/summary/critical_load_factor"],
                      refine={"output": "/summary/critical_load_factor", "within": 0.001})
    """

    def __post_init__(self) -> None:
        if self.refine is not None:
            as_refine(self.refine)  # so that a mistake is told where it is made

    @property
    def document(self) -> Dict[str, Any]:
        """The document: the fields that are required, and others that are neither None nor an empty list."""
        fields = super().document
        if self.refine is not None:
            fields["refine"] = as_refine(self.refine)
            check_refined(fields)
        return fields


def request_of(model: Any, analysis: Optional[Any] = None) -> Any:
    """The request of a model and an analysis, or what stands in the model's place: a request or its text."""
    if isinstance(model, (str, bytes)) and analysis is None:
        return model
    if isinstance(model, AnalysisBase):
        raise TypeError("the first argument is the model or the request, the second the analysis")
    if analysis is None:
        if isinstance(model, Model):
            raise TypeError("a model needs an analysis: solve(model, Critical())")
        return model
    return request_document(model, analysis)


def request_document(model: Any, analysis: Any) -> Dict[str, Any]:
    """{"model", "analysis"} of builders or documents."""
    parts: List[Any] = [part.document if isinstance(part, (ModelFields, AnalysisBase)) else part
                        for part in (model, analysis)]
    return {"model": parts[0], "analysis": parts[1]}
