"""Shares the points of a sweep out among the workers of an executor and puts their rows in order."""
import concurrent.futures
import os
from collections import deque
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from typing import Any, Callable, Deque, Dict, Iterable, Iterator, List, Optional, Sequence, Tuple, Union

from ._errors import SnapthroughError, WorkerDied
from ._spans import Element

#: Processor seconds that one chunk is to take: long beside the milliseconds that an engine needs for it, short beside
#: what a person waits for.
_CHUNK_SECONDS = 0.2
#: A chunk is at most this many times as large as the one that told how long points take.
_GROWTH = 4
#: How often a chunk is tried whose worker died.
_ATTEMPTS = 3

#: What a worker gives back: status and text of the library's document, and the processor seconds that it took.
Part = Tuple[int, bytes, float]
#: Computes `count` points from `first` on. Executors of other processes pickle it.
Task = Callable[[int, int], Part]
#: Number of a row's point, and the row with its text.
Row = Tuple[int, Element]
#: The rows of a part; raises what the library told instead.
RowsOf = Callable[[int, bytes], List[Row]]
#: How many points have their row by a batch, and these rows; of a refined sweep, how many curves or surfaces.
Batch = Tuple[int, List[Row]]
#: An executor, or what makes a new one when workers of the last one died.
ExecutorOrFactory = Union[Executor, Callable[[], Executor]]
#: First point, number of points.
Span = Tuple[int, int]


def available_cores() -> int:
    """Cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


class InThisThread(Executor):
    """Computes at once what it is given, where there are no other threads."""

    _max_workers = 1

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> "Future[Any]":
        """A future that has its result or exception."""
        future: "Future[Any]" = Future()
        try:
            future.set_result(fn(*args, **kwargs))
        except Exception as error:
            future.set_exception(error)
        return future


@dataclass
class _Chunk:
    first: int
    count: int
    attempts: int = 0

    @property
    def last(self) -> int:
        return self.first + self.count - 1


class Pool:
    """An executor that can be replaced. What was made here is shut down here; what was given is left alone."""

    def __init__(self, executor: ExecutorOrFactory) -> None:
        self._factory = None if isinstance(executor, Executor) else executor
        self._executor: Optional[Executor] = executor if isinstance(executor, Executor) else None

    @property
    def replaceable(self) -> bool:
        """Whether another executor can be made."""
        return self._factory is not None

    def get(self) -> Executor:
        """The executor."""
        if self._executor is None:
            assert self._factory is not None
            self._executor = self._factory()
        return self._executor

    def workers(self) -> int:
        """How many there are, where the executor tells; else as many as cores."""
        told = getattr(self.get(), "_max_workers", None)
        return told if isinstance(told, int) and told > 0 else available_cores()

    def replace(self) -> None:
        """Gives the executor up; the next get() makes another one."""
        self.close(wait=False)
        self._executor = None

    def close(self, wait: bool) -> None:
        """Shuts the executor down, if it was made here."""
        if self._factory is not None and self._executor is not None:
            self._executor.shutdown(wait=wait)


class Engine:
    """Computes the spans that are wanted, in chunks of whole items, and gives rows as they come."""

    def __init__(self, task: Task, rows_of: RowsOf, spans: Sequence[Span], unit: int, pool: Pool,
                 workers: Optional[int]) -> None:
        self._task = task
        self._rows_of = rows_of
        self._spans: Deque[Span] = deque(spans)
        self._left = sum(count for _, count in spans)
        self._unit = unit
        self._pool = pool
        self._workers = workers or pool.workers()
        self._size = unit
        self._again: Deque[_Chunk] = deque()
        self._suspects = 0
        self._running: "Dict[Future[Any], _Chunk]" = {}

    def run(self) -> Iterator[Tuple[int, Batch]]:
        """First points and batches of chunks, in the order in which they end."""
        try:
            while self._spans or self._again or self._running:
                self._fill()
                done, _ = concurrent.futures.wait(self._running, return_when=concurrent.futures.FIRST_COMPLETED)
                yield from self._collect(done)
        except BaseException:
            self.cancel()
            raise
        self._pool.close(wait=True)

    def cancel(self) -> None:
        """Takes back what has not begun; does not wait for what has."""
        for future in self._running:
            future.cancel()
        self._pool.close(wait=False)

    def _fill(self) -> None:
        """Keeps workers busy; after a death chunks that may have caused it run one at a time, so that it is known."""
        limit = 1 if self._suspects else 2 * self._workers
        while len(self._running) < limit and (self._again or self._spans):
            if self._suspects and not self._again:
                return
            chunk = self._again.popleft() if self._again else self._next_chunk()
            try:
                future = self._pool.get().submit(self._task, chunk.first, chunk.count)
            except concurrent.futures.BrokenExecutor as error:
                self._died([chunk], error)
                continue
            self._running[future] = chunk

    def _next_chunk(self) -> _Chunk:
        """The next points. Towards the end chunks get smaller, so that all workers end at about the same time."""
        first, count = self._spans.popleft()
        share = -(-self._left // (2 * self._workers))
        items = max(1, min(self._size, share, count) // self._unit)
        size = min(count, items * self._unit)
        if size < count:
            self._spans.appendleft((first + size, count - size))
        self._left -= size
        return _Chunk(first, size)

    def _collect(self, done: "Iterable[Future[Any]]") -> Iterator[Tuple[int, Batch]]:
        broken: List[_Chunk] = []
        cause: Optional[BaseException] = None
        for future in done:
            chunk = self._running.pop(future)
            error = _error_of(future)
            if isinstance(error, SnapthroughError):
                raise error
            if error is not None:
                broken.append(chunk)
                cause = error
                continue
            status, text, seconds = future.result()
            self._learn(chunk, seconds)
            self._suspects = max(0, self._suspects - 1) if chunk.attempts else self._suspects
            yield chunk.first, (chunk.count, self._rows_of(status, text))
        if cause is not None:
            self._died(broken, cause)

    def _learn(self, chunk: _Chunk, seconds: float) -> None:
        wanted = int(chunk.count * _CHUNK_SECONDS / max(seconds, 1e-6))
        self._size = max(self._unit, min(wanted, _GROWTH * chunk.count))

    def _died(self, broken: List[_Chunk], cause: BaseException) -> None:
        """Chunks that were lost are tried again; with a broken executor those that still run are lost, too."""
        if isinstance(cause, concurrent.futures.BrokenExecutor):
            broken = broken + list(self._running.values())
            self._running.clear()
            if not self._pool.replaceable:
                raise WorkerDied(broken[0].first, broken[0].last, 1, f"{cause or type(cause).__name__}; give a "
                                 "function that makes an executor instead of one, and they are tried again") from cause
            self._pool.replace()
        for chunk in broken:
            chunk.attempts += 1
            if chunk.attempts >= _ATTEMPTS and len(broken) == 1:
                raise WorkerDied(chunk.first, chunk.last, chunk.attempts, str(cause) or type(cause).__name__) from cause
        self._again.extend(sorted(broken, key=lambda chunk: chunk.first))
        self._suspects = len(self._again)


def _error_of(future: "Future[Any]") -> Optional[BaseException]:
    if future.cancelled():
        return concurrent.futures.CancelledError()
    return future.exception()


def missing_spans(total: int, unit: int, there: Sequence[int]) -> List[Span]:
    """Runs of whole items, `unit` points each, of which some point has no row."""
    known = set(there)
    if not known:
        return [(0, total)]
    spans: List[Span] = []
    for first in range(0, total, unit):
        count = min(unit, total - first)
        if all(point in known for point in range(first, first + count)):
            continue
        if spans and sum(spans[-1]) == first:
            spans[-1] = (spans[-1][0], spans[-1][1] + count)
        else:
            spans.append((first, count))
    return spans


def in_order(batches: Iterator[Tuple[int, Batch]], known: Dict[int, Element], total: int) -> Iterator[Batch]:
    """Rows in the order of their points: those that were known and those that come, each when its turn is there."""
    waiting: Dict[int, Element] = dict(known)
    point = 0

    def ready() -> List[Tuple[int, Element]]:
        nonlocal point
        rows = []
        while point in waiting:
            rows.append((point, waiting.pop(point)))
            point += 1
        return rows

    first_rows = ready()
    if first_rows:
        yield len(first_rows), first_rows
    for _, (_, rows) in batches:
        waiting.update(rows)
        now = ready()
        if now:
            yield len(now), now
    if point < total:
        raise SnapthroughError(f"rows from point {point} on are missing")


def curves_in_order(batches: Iterator[Tuple[int, Batch]], total: int) -> Iterator[Batch]:
    """Batches of a refined sweep in the order of its curves or surfaces, whose numbers of rows are not known before."""
    waiting: Dict[int, Batch] = {}
    done = 0
    for first, batch in batches:
        waiting[first] = batch
        while done in waiting:
            now = waiting.pop(done)
            done += now[0]
            yield now
    if done < total:
        raise SnapthroughError(f"rows of the curves or surfaces from number {done} on are missing")
