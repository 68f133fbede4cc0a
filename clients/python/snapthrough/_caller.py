"""Calls of the library that Ctrl-C can end, although the interpreter runs no code during them."""
import os
import signal
import socket
import sys
import threading
from types import FrameType
from typing import Any, Callable, List, Optional, Tuple

from ._progress import OnProgress, Progress

#: Whether Python itself runs as WebAssembly (Pyodide): it has one thread and loads no library.
IN_BROWSER = sys.platform == "emscripten"
#: Given to the library's callback: false stops the call.
Step = Callable[[Progress], bool]


class _Watcher:
    """A thread that learns of signals while the main thread is in C, and stops the calls that run there."""

    def __init__(self) -> None:
        self._reader, self._writer = socket.socketpair()
        self._writer.setblocking(False)  # what signal.set_wakeup_fd() asks for
        self._calls: List[Tuple[Callable[[], None], int]] = []
        threading.Thread(target=self._run, name="snapthrough", daemon=True).start()

    def begin(self, stop: Callable[[], None]) -> None:
        """From now on a SIGINT calls `stop`; other signals are passed on to who learned of them before."""
        self._calls.append((stop, signal.set_wakeup_fd(self._writer.fileno(), warn_on_full_buffer=False)))

    def end(self) -> None:
        """Ends the last begin()."""
        signal.set_wakeup_fd(self._calls.pop()[1])

    def _run(self) -> None:
        while True:
            signals = self._reader.recv(64)
            calls = list(self._calls)
            if signal.SIGINT in signals:
                for stop, _ in calls:
                    stop()
            if calls and calls[0][1] >= 0:
                try:
                    os.write(calls[0][1], signals)
                except OSError:
                    continue  # it is full, and will be read all the same


_watcher: Optional[_Watcher] = None


def _forget_watcher() -> None:
    """After a fork the thread is the parent's."""
    global _watcher
    _watcher = None


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_forget_watcher)


def _plain(function: Callable[[Step], Any], on_progress: Optional[OnProgress], stopped: Callable[[], bool]) -> Any:
    """Makes a call; an exception of on_progress stops it and is raised when it has returned."""
    raised: List[BaseException] = []

    def step(progress: Progress) -> bool:
        if stopped():
            return False
        try:
            return on_progress is None or on_progress(progress) is not False
        except BaseException as error:  # must not leave through C
            raised.append(error)
            return False

    answer = function(step)
    if raised:
        raise raised[0]
    return answer


def interruptible(function: Callable[[Step], Any], on_progress: Optional[OnProgress], stop: Callable[[], None],
                  interrupted: Callable[[Any], BaseException]) -> Any:
    """Makes a call that Ctrl-C ends within milliseconds, and gives what it returns.

    `function` is given a step function for the library's callback, `stop` asks it to return early. At Ctrl-C it is
    stopped, and `interrupted(what it returned)` raised. That holds on the main thread, to which signals go, with
    Python's own handler of SIGINT; a program's own handler runs when the call has returned.
    """
    global _watcher
    if (IN_BROWSER or threading.current_thread() is not threading.main_thread()
            or signal.getsignal(signal.SIGINT) is not signal.default_int_handler):
        return _plain(function, on_progress, lambda: False)
    pressed: List[int] = []

    def note(number: int, _: Optional[FrameType]) -> None:
        pressed.append(number)

    _watcher = _watcher or _Watcher()
    _watcher.begin(stop)
    try:
        signal.signal(signal.SIGINT, note)  # so that what the call returns is not lost
        answer = _plain(function, on_progress, lambda: bool(pressed))
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        _watcher.end()
    if pressed:
        raise interrupted(answer)
    return answer
