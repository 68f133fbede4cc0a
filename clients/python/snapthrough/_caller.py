"""Calls of the library that Ctrl-C can end: made on another thread while the main thread waits for signals."""
import os
import queue
import threading
from typing import Any, Callable, List, Optional

from ._progress import OnProgress, Progress


class _Worker:
    """A thread that makes one call after the other. Threads are kept: starting one takes longer than a small call."""

    def __init__(self) -> None:
        self.work: "queue.SimpleQueue[Callable[[], None]]" = queue.SimpleQueue()
        threading.Thread(target=self._run, name="snapthrough", daemon=True).start()

    def _run(self) -> None:
        while True:
            self.work.get()()


_idle: List[_Worker] = []


def _forget_workers() -> None:
    """After a fork the threads are those of the parent."""
    _idle.clear()


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget_workers)


class _Call:
    """One call on a worker; what it tells comes back in order."""

    def __init__(self, function: Callable[[Callable[[Progress], bool]], Any]) -> None:
        self._function = function
        self._told: "queue.SimpleQueue[Any]" = queue.SimpleQueue()
        self._latest: Optional[Progress] = None

    def run(self) -> None:
        """On the worker."""
        try:
            outcome = (True, self._function(self._step))
        except BaseException as error:  # handed to the thread that waits
            outcome = (False, error)
        self._told.put(outcome)

    def _step(self, progress: Progress) -> bool:
        """Leaves the progress for the main thread, which is woken unless it has yet to take the one before."""
        waiting, self._latest = self._latest is not None, progress
        if not waiting:
            self._told.put(None)
        return True

    def wait(self, on_progress: Optional[OnProgress], stop: Callable[[], None]) -> Any:
        """On the main thread: the outcome; calls on_progress here, where plots and notebooks expect it."""
        while True:
            outcome = self._told.get()
            if outcome is not None:
                return outcome
            progress, self._latest = self._latest, None
            if progress is not None and on_progress is not None and on_progress(progress) is False:
                stop()


def on_this_thread(function: Callable[[Callable[[Progress], bool]], Any], on_progress: Optional[OnProgress]) -> Any:
    """Makes a call; an exception of on_progress stops it and is raised when it has returned."""
    raised: List[BaseException] = []

    def step(progress: Progress) -> bool:
        try:
            return on_progress is None or on_progress(progress) is not False
        except BaseException as error:  # must not leave through C
            raised.append(error)
            return False

    answer = function(step)
    if raised:
        raise raised[0]
    return answer


def interruptible(function: Callable[[Callable[[Progress], bool]], Any], on_progress: Optional[OnProgress],
                  stop: Callable[[], None], interrupted: Callable[[Any], BaseException]) -> Any:
    """Makes a call that Ctrl-C ends within milliseconds, and gives what it returns.

    `function` is given a step function for the library's callback. `stop` asks the call to return early. At Ctrl-C
    the call is stopped, and `interrupted(what it returned)` raised; any other exception of on_progress stops it, too.
    """
    if threading.current_thread() is not threading.main_thread():
        return on_this_thread(function, on_progress)  # signals go to the main thread only
    worker = _idle.pop() if _idle else _Worker()
    call = _Call(function)
    worker.work.put(call.run)
    try:
        succeeded, value = call.wait(on_progress, stop)
    except BaseException as error:
        stop()
        succeeded, value = call.wait(None, stop)
        _idle.append(worker)
        if isinstance(error, KeyboardInterrupt) and succeeded:
            raise interrupted(value) from None
        raise
    _idle.append(worker)
    if not succeeded:
        raise value
    return value
