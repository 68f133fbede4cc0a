"""Server-sent events of jobs and sweeps."""
import http.client
import json
import time
from dataclasses import dataclass
from typing import Any, Callable, Dict, Iterator, List, Optional

from . import results
from ._errors import ServiceError
from ._http import Response, Transport, service_error
from ._part import Part

#: How often a stream that broke is taken up again without an event in between.
_ATTEMPTS = 5
#: Seconds before the first time, twice as many before the second, and so on.
_PAUSE = 0.1


@dataclass(frozen=True)
class Event:
    """An event of a job or a sweep.

    Fields:
        name: "status", "progress", "points", "critical_point" or "end" (docs/service.md).
        data: Attributes of its document: Job or Sweep for status and end, JobProgressEvent or SweepProgressEvent,
            PathPointsEvent, CriticalPointEvent.
        id: Its id, with which a stream can be taken up again.
    """

    name: str
    data: Part
    id: str


_OF_JOBS: Dict[str, Callable[[Dict[str, Any]], Part]] = {
    "status": results.Job, "end": results.Job, "progress": results.JobProgressEvent,
    "points": results.PathPointsEvent, "critical_point": results.CriticalPointEvent}
_OF_SWEEPS: Dict[str, Callable[[Dict[str, Any]], Part]] = {
    "status": results.Sweep, "end": results.Sweep, "progress": results.SweepProgressEvent}


def follow(transport: Transport, path: str, last_id: str = "") -> Iterator[Event]:
    """Events until the end, which is the last one; a stream that breaks is taken up after what was seen."""
    made = _OF_SWEEPS if path.startswith("/v1/sweeps/") else _OF_JOBS
    broken = 0
    while True:
        headers = {"Accept": "text/event-stream", **({"Last-Event-ID": last_id} if last_id else {})}
        connection, response = transport.stream(path, headers)
        try:
            if response.status == 204:
                return
            if response.status != 200:
                raise service_error(Response(response.status, {}, response.read()))
            for event in _events(response, made):
                last_id, broken = event.id or last_id, 0
                yield event
                if event.name == "end":
                    return
        except (OSError, http.client.HTTPException) as error:
            cause = str(error) or type(error).__name__
        else:
            cause = "it ended before the end of what it tells of"
        finally:
            response.close()
            connection.close()
        broken += 1
        if broken >= _ATTEMPTS:
            raise ServiceError(f"the events of {path} broke off {broken} times: {cause}")
        time.sleep(_PAUSE * broken)


def _events(response: http.client.HTTPResponse, made: Dict[str, Callable[[Dict[str, Any]], Part]]) -> Iterator[Event]:
    """The events of one stream, by the rules of the HTML standard; names that are not known are left out."""
    name, event_id = "", ""
    data: List[str] = []
    while True:
        line = _line(response)
        if line is None:
            return
        if not line:
            if data and name in made:
                yield Event(name, made[name](json.loads("\n".join(data))), event_id)
            name, data = "", []
            continue
        field, _, value = line.partition(":")
        value = value[1:] if value.startswith(" ") else value
        if field == "event":
            name = value
        elif field == "data":
            data.append(value)
        elif field == "id":
            event_id = value


def _line(response: http.client.HTTPResponse) -> Optional[str]:
    raw = response.readline()
    return raw.decode("utf-8").rstrip("\r\n") if raw else None
