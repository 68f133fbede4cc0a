"""Parts of documents that were received: an object with attributes, a list of them, a map of them by id."""
from typing import Any, Callable, Dict, Iterator, List, Mapping, Optional, Sequence, TypeVar, Union, overload

_P = TypeVar("_P")

# Characters of a value that repr() shows.
_SHOWN = 60


def _short(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= _SHOWN else text[:_SHOWN - 4] + " ..."


class Part:
    """An object of a document. Attributes are its fields; `document` is the object as it was received."""

    __slots__ = ("_document",)

    def __init__(self, document: Dict[str, Any]) -> None:
        self._document = document

    @property
    def document(self) -> Dict[str, Any]:
        """The object as it was received, not a copy."""
        return self._document

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Part) and self._document == other._document

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        fields = ", ".join(f"{name}={_short(value)}" for name, value in self._document.items())
        return f"{type(self).__name__}({fields})"


def or_none(make: Callable[[Dict[str, Any]], _P]) -> Callable[[Optional[Dict[str, Any]]], Optional[_P]]:
    """What makes an item that may be null, for PartList and PartMap."""
    return lambda document: None if document is None else make(document)


class PartList(Sequence[_P]):
    """A list of parts. `document` is the list as it was received."""

    __slots__ = ("_make", "_documents")

    def __init__(self, make: Callable[[Dict[str, Any]], _P], documents: List[Dict[str, Any]]) -> None:
        self._make = make
        self._documents = documents

    @property
    def document(self) -> List[Dict[str, Any]]:
        """The list as it was received, not a copy."""
        return self._documents

    def __len__(self) -> int:
        return len(self._documents)

    @overload
    def __getitem__(self, index: int) -> _P: ...

    @overload
    def __getitem__(self, index: slice) -> List[_P]: ...

    def __getitem__(self, index: Union[int, slice]) -> Union[_P, List[_P]]:
        if isinstance(index, slice):
            return [self._make(document) for document in self._documents[index]]
        return self._make(self._documents[index])

    def __repr__(self) -> str:
        return repr(list(self))


class PartMap(Mapping[str, _P]):
    """Parts by id, in the order in which they were received. `document` is the object as it was received."""

    __slots__ = ("_make", "_documents")

    def __init__(self, make: Callable[[Dict[str, Any]], _P], documents: Dict[str, Dict[str, Any]]) -> None:
        self._make = make
        self._documents = documents

    @property
    def document(self) -> Dict[str, Dict[str, Any]]:
        """The object as it was received, not a copy."""
        return self._documents

    def __len__(self) -> int:
        return len(self._documents)

    def __iter__(self) -> Iterator[str]:
        return iter(self._documents)

    def __getitem__(self, name: str) -> _P:
        return self._make(self._documents[name])

    def __repr__(self) -> str:
        return f"{type(self).__name__}({list(self._documents)})"
