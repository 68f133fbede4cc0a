"""libsnapthrough through ctypes: finding it, and its calls as bytes in and bytes out. Nothing else knows ctypes."""
import ctypes
import ctypes.util
import os
import pathlib
from dataclasses import dataclass
from typing import Any, Callable, List, Optional, Tuple, Union

from ._errors import LibraryNotFound
from ._progress import Progress

NAME = "snapthrough.dll" if os.name == "nt" else "libsnapthrough.so.1"
#: Names that begin with SNAPTHROUGH_ are settings of the service, which refuses those that it does not know.
VARIABLE = "PYTHONSNAPTHROUGH_LIBRARY"

DONE, WRONG_USE, WRONG_REQUEST, NOT_COMPLETED, CANCELLED, OUT_OF_MEMORY, INTERNAL_ERROR = range(7)


class _Document(ctypes.Structure):
    _fields_ = [("text", ctypes.c_void_p), ("length", ctypes.c_size_t), ("status", ctypes.c_int)]


class _Progress(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("done", ctypes.c_uint64), ("total", ctypes.c_uint64),
                ("load_factor", ctypes.c_double), ("branch", ctypes.c_int), ("negative_eigenvalues", ctypes.c_int)]


class _Options(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("stop", ctypes.c_void_p)]


_Callback = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.POINTER(_Progress), ctypes.c_void_p)


@dataclass(frozen=True)
class Answer:
    """What a call came to: its status and the bytes of its document."""

    status: int
    text: bytes


class NativeStop:
    """snapthrough_stop: stops the calls that were given it, from any thread."""

    def __init__(self, library: Any) -> None:
        self._library = library
        self.handle = library.snapthrough_stop_new()
        if not self.handle:
            raise MemoryError("snapthrough_stop_new")

    def request(self) -> None:
        """Stops them."""
        self._library.snapthrough_stop_request(self.handle)

    def __del__(self) -> None:
        if getattr(self, "handle", None):
            self._library.snapthrough_stop_free(self.handle)


class Library:
    """The functions of libsnapthrough. Thread-safe; ctypes releases the interpreter's lock during a call."""

    def __init__(self, path: Optional[Union[str, "os.PathLike[str]"]] = None) -> None:
        self.path, self._functions = _load(path)
        pointer = ctypes.POINTER(_Document)
        signatures = {
            "version": (ctypes.c_char_p, []),
            "stop_new": (ctypes.c_void_p, []),
            "stop_request": (None, [ctypes.c_void_p]),
            "stop_free": (None, [ctypes.c_void_p]),
            "solve": (pointer, [ctypes.c_char_p, ctypes.c_size_t, ctypes.POINTER(_Options), _Callback,
                                ctypes.c_void_p]),
            "check": (pointer, [ctypes.c_char_p, ctypes.c_size_t]),
            "sweep": (pointer, [ctypes.c_char_p, ctypes.c_size_t, ctypes.c_uint64, ctypes.c_uint64,
                                ctypes.POINTER(_Options), _Callback, ctypes.c_void_p]),
            "free": (None, [pointer]),
        }
        self.can_plot = hasattr(self._functions, "snapthrough_plot")
        if self.can_plot:
            signatures["plot"] = (pointer, [ctypes.c_char_p, ctypes.c_size_t, ctypes.c_char_p, ctypes.c_size_t])
        for name, (result, arguments) in signatures.items():
            function = getattr(self._functions, "snapthrough_" + name)
            function.restype, function.argtypes = result, arguments

    def version(self) -> str:
        """The library's version."""
        return str(self._functions.snapthrough_version().decode("ascii"))

    def new_stop(self) -> NativeStop:
        """A means to stop calls."""
        return NativeStop(self._functions)

    def solve(self, request: bytes, stop: Optional[NativeStop] = None,
              step: Optional[Callable[[Progress], bool]] = None) -> Answer:
        """Solves a request; `step` is called on this thread, and its False stops the call."""
        options = _Options(ctypes.sizeof(_Options), stop.handle if stop else None)
        return self._take(self._functions.snapthrough_solve(request, len(request), ctypes.byref(options),
                                                            _callback(step), None))

    def check(self, document: bytes) -> Answer:
        """Finds the mistakes of a request or a sweep."""
        return self._take(self._functions.snapthrough_check(document, len(document)))

    def sweep(self, document: bytes, first: int, count: int, stop: Optional[NativeStop] = None) -> Answer:
        """Rows of points from `first` on."""
        options = _Options(ctypes.sizeof(_Options), stop.handle if stop else None)
        return self._take(self._functions.snapthrough_sweep(document, len(document), first, count,
                                                            ctypes.byref(options), _callback(None), None))

    def plot(self, document: bytes, options: bytes) -> Answer:
        """An SVG of a result or a table. Only where `can_plot`."""
        return self._take(self._functions.snapthrough_plot(document, len(document), options or None, len(options)))

    def _take(self, pointer: Any) -> Answer:
        if not pointer:
            return Answer(OUT_OF_MEMORY, b'{"title": "Out of memory", "code": "out_of_memory"}')
        document = pointer.contents
        answer = Answer(document.status, ctypes.string_at(document.text, document.length))
        self._functions.snapthrough_free(pointer)
        return answer


def _callback(step: Optional[Callable[[Progress], bool]]) -> Any:
    if step is None:
        return _NO_CALLBACK
    given = step

    def call(pointer: Any, _: Any) -> int:
        now = pointer.contents
        progress = Progress(now.done, now.total, now.load_factor, now.branch, now.negative_eigenvalues)
        return 0 if given(progress) else 1

    return _Callback(call)


_NO_CALLBACK = _Callback(0)


#: What a processor needs for the faster one of two libraries in the package, as Linux names it in /proc/cpuinfo.
_X86_64_V3 = {"abm", "avx", "avx2", "bmi1", "bmi2", "f16c", "fma", "movbe"}


def _has_x86_64_v3() -> bool:
    """Whether the processor has the instructions of x86-64-v3; False where nobody says so."""
    try:
        with open("/proc/cpuinfo", encoding="ascii", errors="replace") as file:
            flags = next((line for line in file if line.startswith("flags")), "")
    except OSError:
        return False
    return _X86_64_V3 <= set(flags.partition(":")[2].split())


def _in_package() -> List[str]:
    """Libraries that a wheel brings, in folders that are named by what a processor must have; the fastest that may run first."""
    folder = pathlib.Path(__file__).resolve().parent / "native"
    found = sorted(folder.glob("*/" + NAME), key=lambda path: path.parent.name, reverse=True)
    return [str(path) for path in found if path.parent.name != "x86-64-v3" or _has_x86_64_v3()]


def _in_checkouts() -> List[str]:
    """Build folders of the checkout that the package stands in."""
    for folder in pathlib.Path(__file__).resolve().parents:
        if (folder / "clients" / "python" / "snapthrough").is_dir() and (folder / "build").is_dir():
            found = sorted((folder / "build").glob("*/" + NAME))
            return [str(path) for path in sorted(found, key=lambda path: path.parent.name != "release")]
    return []


def _load(path: Optional[Union[str, "os.PathLike[str]"]]) -> Tuple[str, Any]:
    """The path that worked and the loaded library; a path that was given is the only one that is tried."""
    given = path or os.environ.get(VARIABLE)
    places = [os.fspath(given)] if given else _in_package() + _in_checkouts() + [NAME]
    tried = []
    for place in places:
        try:
            return place, ctypes.CDLL(place)
        except OSError as error:
            tried.append(f"  {place}: {error}")
    raise LibraryNotFound(
        "libsnapthrough was not found. Tried:\n" + "\n".join(tried) + "\n"
        "Install the Debian package of snapthrough, or build it in a checkout (cmake --build build/release --target "
        f"snapthrough_shared), or name the file: Local(\"/path/{NAME}\") or the environment variable {VARIABLE}. "
        "A service needs no library: snapthrough.connect(\"http://host:8080\").")
