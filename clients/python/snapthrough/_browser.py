"""The solver in Python that runs as WebAssembly itself (Pyodide): the same calls as those of _library, by a JavaScript object.

The page gives the object, a started Module of the npm package snapthrough-solver, before the first call:
pyodide.registerJsModule("snapthrough_solver", module).
"""
import importlib
from typing import Any, Callable, Optional

from ._errors import LibraryNotFound
from ._library import Answer, Library, NativeStop
from ._progress import Progress

NAME = "snapthrough_solver"


class BrowserStop(NativeStop):
    """Stops the calls that were given it, from within their callbacks: there are no other threads."""

    def __init__(self) -> None:
        self.requested = False

    def request(self) -> None:
        """Stops them."""
        self.requested = True


class BrowserLibrary(Library):
    """The functions of libsnapthrough, by the module that the page registered."""

    def __init__(self) -> None:
        self.path = NAME
        self.can_plot = True
        try:
            self._module: Any = importlib.import_module(NAME)
        except ImportError as error:
            raise LibraryNotFound(
                f"The page has not given the solver: call pyodide.registerJsModule(\"{NAME}\", module) with a started Module "
                "of the npm package snapthrough-solver. A service needs none: snapthrough.connect(\"http://host:8080\").") from error

    def version(self) -> str:
        return str(self._module.version)

    def new_stop(self) -> NativeStop:
        return BrowserStop()

    def solve(self, request: bytes, stop: Optional[NativeStop] = None,
              step: Optional[Callable[[Progress], bool]] = None) -> Answer:
        return _answer(self._module.solve(request.decode("utf-8"), _callback(stop, step)))

    def check(self, document: bytes) -> Answer:
        return _answer(self._module.check(document.decode("utf-8")))

    def sweep(self, document: bytes, first: int, count: int, stop: Optional[NativeStop] = None) -> Answer:
        return _answer(self._module.sweep(document.decode("utf-8"), first, count, _callback(stop, None)))

    def plot(self, document: bytes, options: bytes) -> Answer:
        return _answer(self._module.plot(document.decode("utf-8"), options.decode("utf-8")))


def _callback(stop: Optional[NativeStop], step: Optional[Callable[[Progress], bool]]) -> Callable[[Any], bool]:
    def call(now: Any) -> bool:
        if isinstance(stop, BrowserStop) and stop.requested:
            return True
        return step is not None and not step(
            Progress(now.done, now.total, now.loadFactor, now.branch, now.negativeEigenvalues))

    return call


def _answer(given: Any) -> Answer:
    return Answer(given.status, given.text.encode("utf-8"))
