"""Local: analyses and sweeps in this process, by libsnapthrough."""
import functools
import json
import os
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Callable, Dict, Iterator, List, Optional, Sequence, Tuple, Union

from . import _caller, _chunks, _engine, _library, _result, _spans, results
from ._browser import BrowserLibrary
from ._buildable import to_json
from ._errors import (AnalysisFailed, Cancelled, Interrupted, LibraryNotFound, SnapthroughError, UsageError, invalid,
                      show_warnings)
from ._library import Answer, Library
from ._model import request_of
from ._progress import OnProgress, Progress, Stop
from ._refine import is_refined
from ._result import Result
from ._spans import Element
from ._sweeping import Batches, SweepRun
from ._table import Table, read_table

#: A table that has rows already, or the path of one.
Resume = Union[Table, str, "os.PathLike[str]"]


class Local:
    """Solves in this process with libsnapthrough; the same interface as Client.

    `library` is the path of libsnapthrough.so.1. By default that of the environment variable
    PYTHONSNAPTHROUGH_LIBRARY, else that of a checkout's build folder when the package stands in one, else the one
    that the system's loader finds. In a browser (Pyodide) it is the module that the page registered, whatever
    `library` is. Raises LibraryNotFound. Methods can be called from several threads at once.
    """

    def __init__(self, library: Optional[Union[str, "os.PathLike[str]"]] = None) -> None:
        self._library = BrowserLibrary() if _caller.IN_BROWSER else Library(library)

    @property
    def version(self) -> str:
        """The version of the library, such as "0.1.0"."""
        return self._library.version()

    @property
    def library(self) -> str:
        """The path by which the library was loaded."""
        return self._library.path

    def solve(self, model: Any, analysis: Any = None, *, on_progress: Optional[OnProgress] = None,
              stop: Optional[Stop] = None) -> Result:
        """Solves a request.

        Arguments:
            model: A Model, or the document of one; without an analysis a whole request, as a document or JSON text.
            analysis: Critical, Path, Buckling, Static, Vibration, or the document of one.
            on_progress: Called as the path grows, on the thread of the caller; False stops the analysis.
            stop: Stops the analysis from another thread.

        Raises InvalidRequest, AnalysisFailed, Cancelled, and at Ctrl-C Interrupted; the last three have `reached`.
        """
        request = as_bytes(request_of(model, analysis))
        native = self._library.new_stop()
        detach = stop.attach(native.request) if stop else None
        try:
            if on_progress is None:
                answer = _caller.interruptible(lambda _: self._library.solve(request, native), None, native.request,
                                               _interrupted)
            else:
                answer = _caller.interruptible(lambda step: self._library.solve(request, native, step), on_progress,
                                               native.request, _interrupted)
        finally:
            if detach:
                detach()
        result = result_of(answer)
        show_warnings(result)
        return result

    def check(self, model: Any, analysis: Any = None) -> results.Check:
        """Finds every mistake of a request or a sweep without computing anything; see Check."""
        answer = self._library.check(as_bytes(request_of(model, analysis)))
        if answer.status not in (_library.DONE, _library.WRONG_REQUEST):
            raise failure_of(answer)
        return results.Check(json.loads(answer.text))

    def sweep(self, sweep: Any, *, executor: Optional[_engine.ExecutorOrFactory] = None,
              workers: Optional[int] = None, on_progress: Optional[OnProgress] = None,
              progress: Optional[bool] = None, stop: Optional[Stop] = None,
              resume: Optional[Resume] = None) -> SweepRun:
        """Computes a sweep; rows are those of `snapthrough sweep`, bit for bit, however they are shared out.

        Arguments:
            sweep: A Sweep, or the document of one, as a dictionary or JSON text.
            executor: Any concurrent.futures.Executor, or a function that makes one, so that the points of a worker
                that died are tried again; by default threads of this process.
            workers: Number of the executor's workers, where it does not tell; for the default executor its threads.
            on_progress: Called as rows come; False stops the sweep.
            progress: Whether a bar is shown on standard error; by default on a terminal and in a notebook.
            stop: Stops the sweep from another thread.
            resume: Rows that are there already, as a Table or the path of a JSON table or NDJSON; they are not
                computed again. A path that does not exist is a table without rows. Not for a refined sweep.

        Raises InvalidRequest at once when the sweep has mistakes. Points that fail are rows with an "error".
        """
        document = as_bytes(sweep)
        head, _ = self._part(document, self._library.sweep(document, 0, 0))
        columns, total, unit = head["columns"], head["total"], head["unit"]
        known = _known_rows(resume, columns, total)
        native = self._library.new_stop()
        ends = stop or Stop()
        if executor is None:
            threads = functools.partial(ThreadPoolExecutor, workers or _engine.available_cores())
            pool = _engine.Pool(_engine.InThisThread if _caller.IN_BROWSER else threads)
            task = functools.partial(_chunks.timed_chunk, self._library, document, native)
        else:
            pool = _engine.Pool(executor)
            path = os.path.abspath(self.library) if os.path.exists(self.library) else None
            task = functools.partial(_chunks.compute_chunk, document, path)
        spans = _engine.missing_spans(total, unit, list(known))
        parts = _engine.Engine(task, functools.partial(_rows_of, document), spans, unit, pool, workers).run()
        ordered = (_engine.curves_in_order(parts, total) if is_refined(columns)
                   else _engine.in_order(parts, known, total))
        batches = _stopped(ordered, native.request, ends)
        return SweepRun(columns, total, batches, on_progress, progress, ends, head, document)

    def plot(self, document: Any, **options: Any) -> str:
        """Draws a result or a table as SVG text, as `snapthrough plot` does.

        `document` is a Result, a Table, or the JSON text of one. `options` are the choices of
        docs/howto/plot-results.md: kind ("path", "shape", "sections", "mode", "model", "law", "laws",
        "frequencies", "stiffness", "sweep" or "heatmap"), width, height, dark, state, mode, monitor and so on;
        solved_request={"model": model, "analysis": analysis} lets supports, ground and loads be drawn.
        Raises InvalidRequest with a pointer that begins with "choices:" where one is wrong, and UsageError when the
        library is too old to plot.
        """
        if not self._library.can_plot:
            raise UsageError(f"{self.library} (version {self.version}) has no snapthrough_plot")
        text = document.json if isinstance(document, Result) else document
        text = document.to_json() if isinstance(document, Table) else text
        answer = self._library.plot(as_bytes(text), to_json(options) if options else b"")
        if answer.status != _library.DONE:
            raise failure_of(answer)
        return answer.text.decode("utf-8")

    def _part(self, document: bytes, answer: Answer) -> Tuple[Dict[str, Any], List[Element]]:
        if answer.status != _library.DONE:
            raise failure_of(answer)
        return _spans.parts_of_table(answer.text.decode("utf-8"))

    def __repr__(self) -> str:
        return f"Local({self.library!r}, version {self.version})"


def as_bytes(document: Any) -> bytes:
    """A document as JSON in UTF-8; text is taken as it is."""
    if isinstance(document, bytes):
        return document
    return document.encode("utf-8") if isinstance(document, str) else to_json(document)


def failure_of(answer: Answer) -> SnapthroughError:
    """The exception of an answer that is a problem."""
    problem = json.loads(answer.text)
    detail = problem.get("detail") or problem.get("title", "")
    if answer.status == _library.WRONG_REQUEST:
        return invalid(problem)
    if answer.status == _library.WRONG_USE:
        return UsageError(detail)
    return AnalysisFailed(problem.get("code", "internal_error"), detail)


def result_of(answer: Answer) -> Result:
    """The result of an answer; raises what it came to instead."""
    if answer.status not in (_library.DONE, _library.NOT_COMPLETED, _library.CANCELLED):
        raise failure_of(answer)
    result = Result(answer.text)
    if answer.status == _library.CANCELLED:
        raise Cancelled(result)
    if answer.status == _library.NOT_COMPLETED:
        failure = result.document["failure"]
        raise AnalysisFailed(failure["code"], failure["detail"], result)
    return result


def _interrupted(answer: Answer) -> Interrupted:
    try:
        return Interrupted(result_of(answer))
    except (AnalysisFailed, Cancelled) as error:
        reached = error.reached
        return Interrupted(reached)
    except SnapthroughError:
        return Interrupted()


def _rows_of(document: bytes, status: int, text: bytes) -> List[_engine.Row]:
    if status == _library.CANCELLED:
        raise Cancelled()
    if status != _library.DONE:
        raise failure_of(Answer(status, text))
    others, rows = _spans.parts_of_table(text.decode("utf-8"))
    return list(zip(others["points"], rows))


def _stopped(batches: Batches, action: Callable[[], None], stop: Stop) -> Batches:
    """Passes rows on; whatever ends this early stops the points that are being computed."""
    detach = stop.attach(action)
    try:
        yield from batches
    except BaseException:
        action()
        raise
    finally:
        detach()


def _known_rows(resume: Optional[Resume], columns: Sequence[str], total: int) -> Dict[int, Element]:
    """Rows by point of a table that is there already."""
    if resume is None or (not isinstance(resume, Table) and not os.path.exists(resume)):
        return {}
    table = resume if isinstance(resume, Table) else read_table(resume)
    if len(table) and is_refined(columns):
        raise UsageError("resume: rows of a refined sweep cannot be taken over; they do not say whether their curve is "
                         "complete")
    if len(table) and table.columns != list(columns):
        raise UsageError(f"resume: its columns are {table.columns}, those of the sweep {list(columns)}")
    if any(point >= total for point in table.points):
        raise UsageError(f"resume: it has point {max(table.points)}, the sweep has {total} points")
    return {point: (row, table.text_of(index)) for index, (point, row) in enumerate(zip(table.points, table.rows))}


@functools.lru_cache(maxsize=1)
def default_local() -> Local:
    """The library that is found without being named; loaded once."""
    return Local()


def _svg_of(result: Result) -> Optional[str]:
    """The library's drawing of a result; None where there is none."""
    try:
        return default_local().plot(result)
    except (LibraryNotFound, SnapthroughError):
        return None


_result.svg_of = _svg_of
