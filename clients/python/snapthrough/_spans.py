"""Parses JSON and keeps the text of parts of it, so that numbers keep the digits that they were received with."""
import json
import re
from typing import Any, Dict, Iterator, List, Tuple

_DECODER = json.JSONDecoder()
_SPACE = re.compile(r"[ \t\r\n]*")

#: The value of an element and its text.
Element = Tuple[Any, str]


def _skip(text: str, at: int) -> int:
    match = _SPACE.match(text, at)
    return match.end() if match else at


def members(text: str) -> Iterator[Tuple[str, int]]:
    """Names of an object's members, each with the place where its value begins. The text is valid JSON."""
    at = _skip(text, _skip(text, 0) + 1)
    while text[at] != "}":
        name, at = _DECODER.raw_decode(text, at)
        at = _skip(text, _skip(text, at) + 1)
        yield name, at
        _, at = _DECODER.raw_decode(text, at)
        at = _skip(text, at)
        if text[at] == ",":
            at = _skip(text, at + 1)


def elements(text: str, at: int = 0) -> Tuple[List[Element], int]:
    """Elements of the list that begins at a place, each with its text; and the place after the list."""
    found: List[Element] = []
    at = _skip(text, _skip(text, at) + 1)
    decode = _DECODER.raw_decode
    while text[at] != "]":
        value, end = decode(text, at)
        found.append((value, text[at:end]))
        at = end if text[end] in ",]" else _skip(text, end)
        if text[at] == ",":
            at = _skip(text, at + 1)
    return found, at + 1


def parts_of_table(text: str) -> Tuple[Dict[str, Any], List[Element]]:
    """The members of a table's document, except for its rows; and the rows with their texts."""
    others: Dict[str, Any] = {}
    rows: List[Element] = []
    at = _skip(text, _skip(text, 0) + 1)
    while text[at] != "}":
        name, at = _DECODER.raw_decode(text, at)
        at = _skip(text, _skip(text, at) + 1)
        if name == "rows":
            rows, at = elements(text, at)
        else:
            others[name], at = _DECODER.raw_decode(text, at)
        at = _skip(text, at)
        if text[at] == ",":
            at = _skip(text, at + 1)
    return others, rows


def value_text(text: str, at: int) -> str:
    """The text of the value that begins at a place."""
    return text[at:_DECODER.raw_decode(text, at)[1]]


def member_text(text: str, name: str) -> str:
    """The text of one member of an object; empty when it is not there."""
    for found, at in members(text):
        if found == name:
            return value_text(text, at)
    return ""
