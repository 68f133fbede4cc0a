"""Client: analyses and sweeps by a service over HTTP."""
import json
import ssl
import urllib.parse
import uuid
from typing import Any, Dict, Iterator, List, Mapping, Optional, Sequence, Union

from . import _events, _spans, results
from ._engine import Batch
from ._errors import AnalysisFailed, Cancelled, Interrupted, ServiceError, SnapthroughError, invalid, show_warnings
from ._events import Event
from ._http import Response, Transport, problem_of, service_error
from ._local import as_bytes
from ._model import request_of
from ._progress import OnProgress, Progress, Stop
from ._result import Result
from ._sweeping import Batches, SweepRun
from ._table import Table

#: Seconds that the service lets a request wait for an end.
_WAIT = 10
#: Rows of one request for a part of a table.
_ROWS = 5000
_ENDED = ("successful", "failed", "dismissed")

#: A job or sweep, or its id.
JobId = Union[str, results.Job]
SweepId = Union[str, results.Sweep]


class Client:
    """Solves by a service; the same interface as Local, and jobs and sweeps besides. Thread-safe.

    Arguments:
        url: Address of the service, such as "http://127.0.0.1:8080".
        key: Key of the service, where it wants one.
        timeout: Seconds in which the service must answer, more than it lets a request wait (10).
        patience: Seconds for which a request is repeated that the service refuses for now (429, 503), after the pauses
            that it asks for.
        context: For https: which certificates are trusted; by default those of the system.
    """

    def __init__(self, url: str, key: Optional[str] = None, *, timeout: float = 60.0, patience: float = 60.0,
                 context: Optional[ssl.SSLContext] = None) -> None:
        self._http = Transport(url, key, timeout, patience, context)

    @property
    def url(self) -> str:
        """Address of the service."""
        return self._http.url

    # Analyses

    def solve(self, model: Any, analysis: Any = None, *, on_progress: Optional[OnProgress] = None,
              stop: Optional[Stop] = None, label: Optional[str] = None,
              metadata: Optional[Mapping[str, str]] = None) -> Result:
        """Solves a request; see Local.solve. A request that the service knows is answered from its store.

        Arguments:
            model: A Model, or the document of one; without an analysis a whole request, as a document or JSON text.
            analysis: Critical, Path, Buckling, Static, Vibration, or the document of one.
            on_progress: Called while the path grows; False stops the analysis.
            stop: Stops the analysis from another thread.
            label: Name under which the job can be found.
            metadata: At most 16 texts by name.

        Raises InvalidRequest, AnalysisFailed with `reached`, Cancelled, ServiceError, and at Ctrl-C Interrupted. What
        a stopped analysis reached stays with the service, so `reached` of the last two is None.
        """
        body = _enveloped(as_bytes(request_of(model, analysis)), "request", label, metadata)
        try:
            result = self._solve(body, on_progress, stop)
        except KeyboardInterrupt:
            raise Interrupted() from None
        show_warnings(result)
        return result

    def submit(self, model: Any, analysis: Any = None, *, label: Optional[str] = None,
               metadata: Optional[Mapping[str, str]] = None, callback: Optional[str] = None) -> results.Job:
        """Hands a request in and does not wait for its end; raises InvalidRequest.

        `callback` is an address that the service tells the end to, where it is allowed to.
        """
        body = _enveloped(as_bytes(request_of(model, analysis)), "request", label, metadata, callback)
        return results.Job(self._checked(self._post(body, "respond-async", str(uuid.uuid4()))).json())

    def job(self, job: JobId) -> results.Job:
        """Status of a job."""
        return results.Job(self._json("GET", _job(job)))

    def wait(self, job: JobId) -> results.Job:
        """Waits for a job's end and gives its status."""
        return results.Job(self._wait(_job(job)))

    def result(self, job: JobId) -> Result:
        """Result of a job that has ended; raises AnalysisFailed where it failed, ServiceError where it has none."""
        return self._result(self._http.send("GET", _job(job) + "/result"))

    def request(self, job: JobId) -> Dict[str, Any]:
        """The request document of a job."""
        document: Dict[str, Any] = self._json("GET", _job(job) + "/request")
        return document

    def events(self, job: JobId, last_id: str = "") -> Iterator[Event]:
        """Events of a job until its end; those after `last_id` where one is given."""
        return _events.follow(self._http, _job(job) + "/events", last_id)

    def dismiss(self, job: JobId) -> results.Job:
        """Stops a job; ServiceError with the status 409 when it had ended."""
        return results.Job(self._json("POST", _job(job) + "/dismiss", b""))

    def remove(self, job: JobId) -> None:
        """Removes a job with its result; stops it first where need be."""
        self._json("DELETE", _job(job))

    def jobs(self, **filters: Any) -> Iterator[results.Job]:
        """Jobs that meet every filter, newest first: status, label, analysis, created_after, created_before."""
        for page in self._pages("/v1/jobs", filters):
            yield from results.JobList(page).jobs

    # Sweeps

    def sweep(self, sweep: Any, *, on_progress: Optional[OnProgress] = None, progress: Optional[bool] = None,
              stop: Optional[Stop] = None, label: Optional[str] = None,
              metadata: Optional[Mapping[str, str]] = None) -> SweepRun:
        """Has a sweep computed; rows come as the service has them.

        Arguments:
            sweep: A Sweep, or the document of one, as a dictionary or JSON text.
            on_progress: Called as rows come; False stops the sweep.
            progress: Whether a bar is shown on standard error; by default on a terminal and in a notebook.
            stop: Stops the sweep from another thread.
            label: Name under which the sweep can be found.
            metadata: At most 16 texts by name.

        Raises InvalidRequest at once when the sweep has mistakes. Points that fail are rows with an "error".
        """
        document = as_bytes(sweep)
        status = self.submit_sweep(document, label=label, metadata=metadata)
        ends = stop or Stop()
        first = self._part(status, 0, 1)
        about: Dict[str, Any] = {"program": first.program, "request_sha256": first.request_sha256}
        batches = self._batches(status, ends, about, first.refined)
        return SweepRun(first.columns, status.points, batches, on_progress, progress, ends, about, document)

    def submit_sweep(self, sweep: Any, *, label: Optional[str] = None, metadata: Optional[Mapping[str, str]] = None,
                     callback: Optional[str] = None) -> results.Sweep:
        """Hands a sweep in and does not wait for its end; raises InvalidRequest."""
        body = _enveloped(as_bytes(sweep), "sweep", label, metadata, callback)
        headers = {"Content-Type": "application/json", "Idempotency-Key": str(uuid.uuid4())}
        return results.Sweep(self._checked(self._http.send("POST", "/v1/sweeps", body, headers)).json())

    def sweep_status(self, sweep: SweepId) -> results.Sweep:
        """Status and counts of a sweep."""
        return results.Sweep(self._json("GET", _sweep(sweep)))

    def wait_sweep(self, sweep: SweepId) -> results.Sweep:
        """Waits for a sweep's end and gives its status."""
        return results.Sweep(self._wait(_sweep(sweep)))

    def table(self, sweep: SweepId, first: int = 0, count: Optional[int] = None) -> Table:
        """The rows that are there of points from `first` on, in the order of points.

        Of a refined sweep `first` and `count` number its curves or surfaces.
        """
        status = sweep if isinstance(sweep, results.Sweep) else self.sweep_status(sweep)
        table = self._part(status, first, status.points if count is None else count)
        if table.refined:
            table.with_sweep(self._json("GET", _sweep(sweep) + "/request"))
        return table

    def sweep_events(self, sweep: SweepId, last_id: str = "") -> Iterator[Event]:
        """Events of a sweep until its end; those after `last_id` where one is given."""
        return _events.follow(self._http, _sweep(sweep) + "/events", last_id)

    def dismiss_sweep(self, sweep: SweepId) -> results.Sweep:
        """Stops a sweep; its rows stay. ServiceError with the status 409 when it had ended."""
        return results.Sweep(self._json("POST", _sweep(sweep) + "/dismiss", b""))

    def retry_sweep(self, sweep: SweepId) -> results.Sweep:
        """Computes the failed points again, and those that a dismissed sweep had not come to."""
        return results.Sweep(self._json("POST", _sweep(sweep) + "/retry?status=failed", b""))

    def remove_sweep(self, sweep: SweepId) -> None:
        """Removes a sweep with its rows."""
        self._json("DELETE", _sweep(sweep))

    def sweeps(self, **filters: Any) -> Iterator[results.Sweep]:
        """Sweeps that meet every filter, newest first: status, label, analysis, created_after, created_before."""
        for page in self._pages("/v1/sweeps", filters):
            yield from results.SweepList(page).sweeps

    # The service

    def check(self, model: Any, analysis: Any = None) -> results.Check:
        """Finds every mistake of a request or a sweep without computing anything; see Check."""
        body = as_bytes(request_of(model, analysis))
        response = self._http.send("POST", "/v1/check", body, {"Content-Type": "application/json"})
        problem = problem_of(response) if response.status == 400 else None
        if problem is not None and "errors" in problem:
            return results.Check({"valid": False, "errors": problem["errors"], "size": None})
        return results.Check(self._checked(response).json())

    def limits(self) -> results.Limits:
        """The numbers that bound the service."""
        return results.Limits(self._json("GET", "/v1/limits"))

    def examples(self) -> Dict[str, Any]:
        """Request documents to begin with, by name."""
        return {example["name"]: example["request"] for example in self._json("GET", "/v1/examples")["examples"]}

    def __repr__(self) -> str:
        return f"Client({self.url!r})"

    # How a job is followed to its result

    def _solve(self, body: bytes, on_progress: Optional[OnProgress], stop: Optional[Stop]) -> Result:
        """Asks for the result if it is known, else for the job, whose id is needed to stop it."""
        response = self._post(body, "return=representation, wait=0")
        if response.status != 202:
            return self._result(response)
        job = results.Job(response.json())
        path = _job(job)
        detach = stop.attach(lambda: self._dismiss_quietly(path)) if stop else None
        try:
            if on_progress is None:
                self._wait(path)
            else:
                self._tell(job, on_progress)
            return self.result(job)
        except BaseException:
            self._dismiss_quietly(path)
            raise
        finally:
            if detach:
                detach()

    def _tell(self, job: results.Job, on_progress: OnProgress) -> None:
        for event in self.events(job):
            data = event.data
            if isinstance(data, results.JobProgressEvent) and on_progress(
                    Progress(data.step, 0, data.load_factor, data.branch, data.negative_eigenvalues)) is False:
                self._dismiss_quietly(_job(job))

    def _post(self, body: bytes, prefer: str, key: Optional[str] = None) -> Response:
        headers = {"Content-Type": "application/json", "Prefer": prefer}
        if key is not None:
            headers["Idempotency-Key"] = key
        return self._http.send("POST", "/v1/jobs", body, headers)

    def _result(self, response: Response) -> Result:
        if response.status == 200:
            return Result(response.body)
        problem = problem_of(response) or {}
        kind = str(problem.get("type", "")).rsplit(":", 1)[-1]
        if kind == "dismissed":
            raise Cancelled()
        if kind == "analysis-failed":
            text = _spans.member_text(response.body.decode("utf-8"), "reached")
            reached = Result(text.encode("utf-8")) if text else None
            raise AnalysisFailed(problem["code"], problem.get("detail", ""), reached)
        self._checked(response)
        raise service_error(response)

    def _wait(self, path: str) -> Dict[str, Any]:
        while True:
            document: Dict[str, Any] = self._json("GET", path, None, {"Prefer": f"wait={_WAIT}"})
            if document["status"] in _ENDED:
                return document

    def _dismiss_quietly(self, path: str) -> None:
        """Stops a job or a sweep; that it had ended is as good."""
        response = self._http.send("POST", path + "/dismiss", b"")
        if response.status not in (200, 404, 409):
            raise service_error(response)

    def _part(self, status: results.Sweep, first: int, count: int) -> Table:
        """The rows that are there of points, or of curves or surfaces of a refined sweep."""
        end = min(status.points, first + count)
        table: Optional[Table] = None
        for begin in range(first, max(end, first + 1), _ROWS):
            part = f"?format=json&first={begin}&count={max(1, min(_ROWS, end - begin))}"
            text = self._checked(self._http.send("GET", _sweep(status) + "/table" + part)).body.decode("utf-8")
            others, rows = _spans.parts_of_table(text)
            table = table or Table(others["columns"], status.points, others)
            for point, (row, own) in zip(others["points"], rows):
                table.append(point, row, own)
        assert table is not None
        if table.refined and first == 0 and end == status.points:
            table.done = status.points - status.counts.remaining
        return table

    def _next_batch(self, status: results.Sweep, first: int, about: Dict[str, Any], refined: bool) -> Batch:
        """The rows that follow those of the first points; one curve or surface at a time of a refined sweep.

        Only the rows of one curve tell by their being there that it is done: rows do not say which curve they are of.
        """
        table = self._part(status, first, 1 if refined else _ROWS)
        about["program"] = table.program
        rows = [(number, (row, table.text_of(index)))
                for index, (number, row) in enumerate(zip(table.points, table.rows))
                if refined or number == first + index]
        return (min(1, len(rows)) if refined else len(rows)), rows

    def _batches(self, status: results.Sweep, stop: Stop, about: Dict[str, Any], refined: bool) -> Batches:
        """Rows as they come, in the order of points; whatever ends this early dismisses the sweep.

        `about` gets what computed them.
        """
        point = 0
        path = _sweep(status)
        detach = stop.attach(lambda: self._dismiss_quietly(path))
        try:
            for _ in self.sweep_events(status):
                while point < status.points:
                    batch = self._next_batch(status, point, about, refined)
                    if not batch[1]:
                        break
                    point += batch[0]
                    yield batch
            if stop.requested:
                raise Cancelled()
            if point < status.points:
                raise ServiceError(f"the sweep {status.id} ended with {point} of {status.points} rows: "
                                   f"{self.sweep_status(status).message}")
        except BaseException:
            self._dismiss_quietly(path)
            raise
        finally:
            detach()

    # Responses

    def _json(self, method: str, path: str, body: Optional[bytes] = None,
              headers: Optional[Mapping[str, str]] = None) -> Any:
        response = self._checked(self._http.send(method, path, body, headers))
        return response.json() if response.body else None

    def _checked(self, response: Response) -> Response:
        if response.status < 400:
            return response
        problem = problem_of(response)
        if problem and "errors" in problem:
            raise invalid(problem)
        if problem and str(problem.get("type", "")).endswith(":malformed-json"):
            raise invalid(problem)
        raise service_error(response)

    def _pages(self, path: str, filters: Mapping[str, Any]) -> Iterator[Dict[str, Any]]:
        target: Optional[str] = path + ("?" + urllib.parse.urlencode(filters) if filters else "")
        while target:
            page: Dict[str, Any] = self._json("GET", target)
            yield page
            links: Sequence[Dict[str, str]] = page["links"]
            nexts: List[str] = [link["href"] for link in links if link["rel"] == "next"]
            target = nexts[0] if nexts else None


def _job(job: JobId) -> str:
    return "/v1/jobs/" + urllib.parse.quote(job if isinstance(job, str) else job.id, safe="")


def _sweep(sweep: SweepId) -> str:
    return "/v1/sweeps/" + urllib.parse.quote(sweep if isinstance(sweep, str) else sweep.id, safe="")


def _enveloped(document: bytes, name: str, label: Optional[str], metadata: Optional[Mapping[str, str]],
               callback: Optional[str] = None) -> bytes:
    """The document, inside an envelope where there is something to write on it."""
    around = {"label": label, "metadata": dict(metadata) if metadata else None, "callback": callback}
    given = {key: value for key, value in around.items() if value is not None}
    if not given:
        return document
    return json.dumps(given)[:-1].encode("utf-8") + b', "' + name.encode("ascii") + b'": ' + document + b"}"
