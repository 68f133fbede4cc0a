"""Requests to a service over kept connections: one a thread, tried again where that is safe."""
import gzip
import http.client
import json
import ssl
import threading
import time
import urllib.parse
from dataclasses import dataclass
from typing import Any, Dict, Mapping, Optional, Tuple

from . import results
from ._errors import ServiceError

_LOCAL_HOSTS = ("localhost", "127.0.0.1", "::1")
#: Seconds to wait where a refusal has no Retry-After.
_PAUSE = 1.0
#: Statuses that say: not now.
_BUSY = (429, 503)


@dataclass(frozen=True)
class Response:
    """A response that was read to its end."""

    status: int
    headers: Mapping[str, str]
    body: bytes

    def json(self) -> Any:
        """The body as a document."""
        try:
            return json.loads(self.body)
        except ValueError as error:
            raise ServiceError(f"the service answered {self.status} with a body that is no JSON: {error}",
                               self.status) from None


class _Kept:
    """A connection that waits for its next request; closed with the thread or the client that it belongs to."""

    def __init__(self, connection: http.client.HTTPConnection) -> None:
        self.connection = connection

    def __del__(self) -> None:
        self.connection.close()


class Transport:
    """Sends requests to one service. Thread-safe."""

    def __init__(self, url: str, key: Optional[str], timeout: float, patience: float,
                 context: Optional[ssl.SSLContext]) -> None:
        parts = urllib.parse.urlsplit(url if "//" in url else "http://" + url)
        if parts.scheme not in ("http", "https") or not parts.hostname:
            raise ValueError(f"url: {url!r} is no address such as http://127.0.0.1:8080 or https://host")
        if parts.query or parts.fragment:
            raise ValueError(f"url: {url!r} has more than scheme, host, port and path")
        self.url = url.rstrip("/")
        self._parts = parts
        self._prefix = parts.path.rstrip("/")
        self._timeout = timeout
        self._patience = patience
        self._context = context
        self._headers = {"Accept": "application/json", "User-Agent": "snapthrough-python"}
        if key is not None:
            self._headers["Authorization"] = "Bearer " + key
        # Compressing takes longer than the loopback device, and shorter than most networks.
        if parts.hostname not in _LOCAL_HOSTS:
            self._headers["Accept-Encoding"] = "gzip"
        self._of_thread = threading.local()

    def connection(self, timeout: Optional[float] = None) -> http.client.HTTPConnection:
        """A new connection."""
        host, port, seconds = self._parts.hostname or "", self._parts.port, timeout or self._timeout
        if self._parts.scheme == "https":
            return http.client.HTTPSConnection(host, port, timeout=seconds, context=self._context)
        return http.client.HTTPConnection(host, port, timeout=seconds)

    def send(self, method: str, path: str, body: Optional[bytes] = None,
             headers: Optional[Mapping[str, str]] = None) -> Response:
        """A response of any status but 429 and 503, which are waited for as long as patience lasts.

        A connection that the service had closed meanwhile is opened again. Raises ServiceError when there is no
        response. A request must be one that can be repeated: what creates something that is to be there once carries an
        Idempotency-Key.
        """
        end = time.monotonic() + self._patience
        while True:
            response = self._try(method, path, body, headers or {})
            if response.status not in _BUSY:
                return response
            pause = _retry_after(response)
            if time.monotonic() + pause > end:
                return response
            time.sleep(pause)

    def _try(self, method: str, path: str, body: Optional[bytes], headers: Mapping[str, str]) -> Response:
        kept: Optional[_Kept] = getattr(self._of_thread, "kept", None)
        try:
            if kept is not None:
                try:
                    return self._exchange(kept, method, path, body, headers)
                except (ConnectionError, http.client.CannotSendRequest):
                    pass  # it was closed while it was idle
            return self._exchange(_Kept(self.connection()), method, path, body, headers)
        except (OSError, http.client.HTTPException) as error:
            raise ServiceError(f"no answer from {self.url}: {error or type(error).__name__}") from error

    def _exchange(self, kept: _Kept, method: str, path: str, body: Optional[bytes],
                  headers: Mapping[str, str]) -> Response:
        self._of_thread.kept = None
        try:
            kept.connection.request(method, self._prefix + path, body, {**self._headers, **headers})
            response = kept.connection.getresponse()
            data = response.read()
        except BaseException:
            kept.connection.close()  # what comes next on it would be the answer to this request
            raise
        self._of_thread.kept = None if response.will_close else kept
        told = {name.lower(): value for name, value in response.getheaders()}
        if told.get("content-encoding") == "gzip":
            data = gzip.decompress(data)
        return Response(response.status, told, data)

    def stream(self, path: str,
               headers: Mapping[str, str]) -> Tuple[http.client.HTTPConnection, http.client.HTTPResponse]:
        """A response whose body the caller reads as it comes, and its connection, which the caller closes."""
        connection = self.connection()
        try:
            connection.request("GET", self._prefix + path, None, {**self._headers, "Accept-Encoding": "identity",
                                                                  "Connection": "close", **headers})
            return connection, connection.getresponse()
        except (OSError, http.client.HTTPException) as error:
            connection.close()
            raise ServiceError(f"no answer from {self.url}: {error or type(error).__name__}") from error


def _retry_after(response: Response) -> float:
    try:
        return max(0.0, float(response.headers.get("retry-after", _PAUSE)))
    except ValueError:
        return _PAUSE


def problem_of(response: Response) -> Optional[Dict[str, Any]]:
    """The problem document of a response; None when it has another one."""
    try:
        document = json.loads(response.body)
    except ValueError:
        return None
    return document if isinstance(document, dict) and "title" in document else None


def service_error(response: Response) -> ServiceError:
    """The exception of a response that is no success."""
    problem = problem_of(response)
    if problem is None:
        return ServiceError(f"the service answered {response.status}", response.status)
    kind = str(problem.get("type", "")).rsplit(":", 1)[-1]
    return ServiceError(f"{response.status} {kind}: {problem.get('detail') or problem['title']}", response.status,
                        results.Problem(problem))
