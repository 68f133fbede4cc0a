"""Equilibrium paths and critical loads of slender structures on elastic bases.

    import snapthrough as st

    model = (st.Model("Column on an elastic base")
             .node("foot", 0, 0).node("head", 0, 5)
             .section("shaft", EA=1e6, EI=100)
             .member("column", "foot", "head", "shaft")
             .support("foot", ["x", "y"]).support("head", ["x"])
             .foundation("base", "column", 10)
             .point_load("head", [0, -1]))
    print(st.solve(model, st.Critical()).summary.critical_load_factor)

solve(), check() and sweep() use libsnapthrough in this process where it is there, or the service that connect() names.
Local and Client are the same by name. The standard library is enough; numpy, pandas, matplotlib and tqdm are imported
where they are there and asked for.
"""
import pathlib
from typing import Any, Union

try:
    from . import _builders, documents, results
except ImportError as _error:  # a checkout in which nothing was built
    _generator = pathlib.Path(__file__).resolve().parent.parent / "generate.py"
    raise ImportError("The parts of snapthrough that follow the interface of the service are not there. "
                      f"Make them: python3 {_generator}") from _error

from ._builders import Buckling, Critical, Path, Static, Vibration
from ._client import Client
from ._errors import (AnalysisFailed, Cancelled, Interrupted, InvalidRequest, LibraryNotFound, ServiceError,
                      SnapthroughError, SnapthroughWarning, UsageError, WorkerDied)
from ._events import Event
from ._local import Local, default_local
from ._model import Model, Sweep
from ._progress import Progress, Stop
from ._result import Result
from ._sweeping import SweepRun
from ._table import Table, read_table

__all__ = ["AnalysisFailed", "Buckling", "Cancelled", "Client", "Critical", "Event", "Interrupted", "InvalidRequest",
           "LibraryNotFound", "Local", "Model", "Path", "Progress", "Result", "ServiceError", "SnapthroughError",
           "SnapthroughWarning", "Static", "Stop", "Sweep", "SweepRun", "Table", "UsageError", "Vibration", "WorkerDied",
           "check", "connect", "documents", "read_table", "results", "solve", "sweep"]

#: That of the project; the library says its own: Local().version.
__version__ = "0.1.0"

_connected: "Union[Client, None]" = None


def connect(url: str, key: Union[str, None] = None, **options: Any) -> Client:
    """Has solve(), check() and sweep() ask a service from now on; gives its Client, whose options these are."""
    global _connected
    _connected = Client(url, key, **options)
    return _connected


def _backend() -> Union[Client, Local]:
    return _connected or default_local()


def solve(model: Any, analysis: Any = None, **options: Any) -> Result:
    """Solves a request; see Local.solve, and Client.solve after connect()."""
    return _backend().solve(model, analysis, **options)


def check(model: Any, analysis: Any = None) -> results.Check:
    """Finds every mistake of a request or a sweep without computing anything."""
    return _backend().check(model, analysis)


def sweep(sweep: Any, **options: Any) -> SweepRun:
    """Computes a sweep; see Local.sweep, and Client.sweep after connect()."""
    return _backend().sweep(sweep, **options)
