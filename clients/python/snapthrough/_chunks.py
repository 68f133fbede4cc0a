"""What a worker of an executor does: some points of a sweep by the library that is there."""
import functools
import os
import time
from typing import Optional

from ._engine import Part
from ._library import Library, NativeStop


#: The thread's own time; Python in a browser has one thread, and its process's time.
_own_time = getattr(time, "thread_time", time.process_time)


@functools.lru_cache(maxsize=None)
def _library(path: Optional[str], _: int) -> Library:
    """The library of this process; the path of the caller's one, where a file is there."""
    return Library(path if path and os.path.exists(path) else None)


def compute_chunk(document: bytes, path: Optional[str], first: int, count: int) -> Part:
    """Computes points of a sweep in another process; picklable, as is what it gives back."""
    return timed_chunk(_library(path, os.getpid()), document, None, first, count)


def timed_chunk(library: Library, document: bytes, stop: Optional[NativeStop], first: int, count: int) -> Part:
    """Computes points of a sweep; `stop` ends it early. Time is the thread's own, whatever else the machine does."""
    start = _own_time()
    answer = library.sweep(document, first, count, stop)
    return answer.status, answer.text, _own_time() - start
