"""What the package raises and warns of; the same for the library and for a service."""
import os
import sys
import warnings
from typing import Any, Dict, Optional, Sequence, Union

from . import results
from ._result import Result
from ._table import Table


class SnapthroughWarning(UserWarning):
    """A warning of a result: something that its reader must know."""


class SnapthroughError(Exception):
    """Anything that the package raises, except for a wrong type of argument and Ctrl-C."""


class InvalidRequest(SnapthroughError):
    """The document has mistakes. `findings` lists each with its `pointer`, `code` and `detail`."""

    def __init__(self, findings: Sequence[results.Finding], detail: str = "") -> None:
        self.findings = findings
        lines = [f"{finding.pointer or 'document'}: {finding.detail} [{finding.code}]" for finding in findings]
        super().__init__("\n".join(lines) or detail)


class AnalysisFailed(SnapthroughError):
    """The document is right, but the analysis could not do what was asked.

    `code` and `detail` say why (docs/requests.md, How an analysis ends), `reached` is the result as far as it came,
    None where nothing is left of it.
    """

    def __init__(self, code: str, detail: str, reached: Optional[Result] = None) -> None:
        self.code = code
        self.detail = detail
        self.reached = reached
        super().__init__(f"{code}: {detail}")


class Cancelled(SnapthroughError):
    """The caller stopped it. `reached` is the result, or the table, as far as it came; None where a service had it."""

    def __init__(self, reached: Union[Result, Table, None] = None) -> None:
        self.reached = reached
        super().__init__("stopped by its caller")


class Interrupted(KeyboardInterrupt):
    """Ctrl-C stopped it. `reached` is the result, or the table, as far as it came; None where a service had it."""

    def __init__(self, reached: Union[Result, Table, None] = None) -> None:
        self.reached = reached
        super().__init__("interrupted")


class UsageError(SnapthroughError):
    """An argument breaks a rule of the library; the message names it."""


class LibraryNotFound(SnapthroughError):
    """There is no libsnapthrough where it was looked for; the message lists the places and how to install it."""


class ServiceError(SnapthroughError):
    """The service refused, or could not be reached.

    `status` is that of HTTP, 0 when there was no response; `problem` is its document, None when it sent another one.
    """

    def __init__(self, detail: str, status: int = 0, problem: Optional[results.Problem] = None) -> None:
        self.status = status
        self.problem = problem
        super().__init__(detail)


class WorkerDied(SnapthroughError):
    """Workers of an executor died whenever they had these points, from `first` to `last`."""

    def __init__(self, first: int, last: int, attempts: int, detail: str) -> None:
        self.first = first
        self.last = last
        super().__init__(f"points {first} to {last} could not be computed in {attempts} attempts: {detail}")


def invalid(problem: Dict[str, Any]) -> InvalidRequest:
    """The exception of a problem that lists mistakes."""
    findings = [results.Finding(finding) for finding in problem.get("errors", [])]
    return InvalidRequest(findings, str(problem.get("detail", "")))


def show_warnings(result: Result) -> None:
    """Tells the warnings of a result, as of the line outside this package that asked for it."""
    # The text of a result without warnings ends with their empty list. Looking there spares the parsing of a long result,
    # which takes longer than a short analysis.
    if result.json.endswith(b'"warnings":[]}') or not result.document.get("warnings"):
        return
    level, frame = 1, sys._getframe()
    while frame.f_back is not None and os.path.dirname(frame.f_code.co_filename) == os.path.dirname(__file__):
        level, frame = level + 1, frame.f_back
    for warning in result.document["warnings"]:
        warnings.warn(f"{warning['code']}: {warning['detail']}", SnapthroughWarning, stacklevel=level)
