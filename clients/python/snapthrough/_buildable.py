"""Bases of the builders: how their fields become documents, and shorter forms of places and targets."""
import dataclasses
import json
import keyword
from typing import Any, ClassVar, Dict, List, Mapping, Sequence, Tuple, TypeVar, Union

from . import documents

#: A place on the structure: the id of a node, (id of a member, fraction of its length), or the contract's object.
Place = Union[str, Tuple[str, float], documents.Location]

#: Where a parameter is written: a JSON Pointer, the contract's object, or a list of either.
Targets = Union[str, documents.SweepTarget, Sequence[Union[str, documents.SweepTarget]]]

#: How a sweep is refined: the pointer of the output that decides, or the contract's object.
Refine = Union[str, documents.SweepRefine]

_B = TypeVar("_B", bound="Buildable")


def given(fields: Mapping[str, Any]) -> Dict[str, Any]:
    """The fields that are not None: a field that is left out has the contract's default."""
    return {name: value for name, value in fields.items() if value is not None}


def as_place(place: Place) -> Any:
    """The contract's object of a place."""
    if isinstance(place, str):
        return {"node": place}
    if isinstance(place, Mapping):
        return place
    member, fraction = place
    return {"member": member, "fraction": fraction}


def as_targets(targets: Targets) -> List[Any]:
    """The contract's list of targets."""
    listed = [targets] if isinstance(targets, (str, Mapping)) else targets
    return [{"pointer": target} if isinstance(target, str) else target for target in listed]


def as_document(value: Any) -> Any:
    """The document of a builder; anything else is a document already."""
    return value.document if isinstance(value, (Buildable, AnalysisBase)) else value


def plain(value: Any) -> Any:
    """What json does not know: builders, and scalars and arrays of numpy, which is not needed for this."""
    if isinstance(value, (Buildable, AnalysisBase)):
        return value.document
    if isinstance(value, Mapping):
        return dict(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    if hasattr(value, "item"):
        return value.item()
    if isinstance(value, Sequence):
        return list(value)
    raise TypeError(f"a {type(value).__name__} has no place in a JSON document")


def to_json(document: Any) -> bytes:
    """The document as UTF-8 JSON. Numbers that are not finite are refused with ValueError: JSON has none."""
    return json.dumps(document, ensure_ascii=False, allow_nan=False, separators=(",", ":"),
                      default=plain).encode("utf-8")


class Buildable:
    """Something that becomes a document; each method that adds an item gives the builder itself back."""

    _required: ClassVar[Tuple[str, ...]] = ()

    def _add(self: _B, name: str, fields: Mapping[str, Any]) -> _B:
        getattr(self, name).append(given(fields))
        return self

    @property
    def document(self) -> Dict[str, Any]:
        """The document: the fields that are required, and others that are neither None nor an empty list."""
        fields = {field.name: as_document(getattr(self, field.name))
                  for field in dataclasses.fields(self)}
        return {name: value for name, value in fields.items()
                if name in self._required or (value is not None and value != [])}


class AnalysisBase:
    """An analysis of one type; fields that are None are left out of the document."""

    _type: ClassVar[str] = ""

    @property
    def document(self) -> Dict[str, Any]:
        """The analysis as it stands in a request."""
        fields = {field.name: getattr(self, field.name)
                  for field in dataclasses.fields(self)}
        return {"type": self._type, **{_contract_name(name): value for name, value in given(fields).items()}}


def _contract_name(name: str) -> str:
    bare = name.rstrip("_")
    return bare if keyword.iskeyword(bare) else name
