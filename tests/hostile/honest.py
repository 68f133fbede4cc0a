"""Honest owners: each hands in a small job every fifth of a second and waits for its result, come what may.

A job begins when it is due, whether earlier ones have been answered or not: what clients wait for is counted for each of
them, as it is where clients do not know of each other.
"""
import collections
import hashlib
import http.client
import json
import threading
import time

from service_process import HOST, example

PACE = 0.2       # s between two jobs of an owner
IDLE = 50        # s after which a connection is not used again: the service closes it after 75 s
PATIENCE = 60    # s for which a client asks the service to wait
MOST_WAITING = 400  # jobs of an owner that wait for an answer; a job that is due beyond them is not sent, and counted

# begin: s of the monotonic clock when it was due; lateness: s from there until the client itself was there to send it;
# outcome: "right", "wrong", "not ready", a status with its type, or the name of an exception; value: what must be the same
# each time for the same number
Sample = collections.namedtuple("Sample", "begin seconds lateness outcome number value")


def request(number):
    document = example("column_winkler.json")
    document["model"]["foundations"][0]["stiffness"] = 10 + number / 20
    return json.dumps(document).encode()


def value_of(body):
    """The critical load factor with all its digits, and a digest of the result without the time that it took."""
    result = json.loads(body)
    result["diagnostics"].pop("wall_time_s")
    digest = hashlib.sha256(json.dumps(result, sort_keys=True).encode()).hexdigest()[:16]
    return [repr(result["summary"]["critical_load_factor"]), digest]


class Owner:
    """Sends jobs of `numbers` in turn from `owner`'s key; `right`: value by number, where known."""

    def __init__(self, port, owner, key, numbers, right, results):
        self.port = port
        self.owner = owner
        self.key = key
        self.requests = [(number, request(number)) for number in numbers]
        self.right = right
        self.results = results
        self.idle = []     # (monotonic s, connection): can be used again
        self.waiting = 0
        self.lock = threading.Lock()

    def run(self, seconds, delay):
        begin = time.monotonic() + delay
        threads = []
        for turn in range(int(seconds / PACE)):
            due = begin + turn * PACE
            time.sleep(max(0.0, due - time.monotonic()))
            number, document = self.requests[turn % len(self.requests)]
            if self.waiting >= MOST_WAITING:
                self.results.put(Sample(due, PATIENCE, 0.0, "not sent", number, None))
                continue
            threads = [thread for thread in threads if thread.is_alive()]
            threads.append(threading.Thread(target=self.submit, args=(due, number, document)))
            with self.lock:
                self.waiting += 1
            threads[-1].start()
        for thread in threads:
            thread.join()
        self.results.put(None)

    def submit(self, due, number, document):
        begin = time.monotonic()
        outcome, value = self.answer(number, document)
        end = time.monotonic()
        with self.lock:
            self.waiting -= 1
        self.results.put(Sample(due, end - begin, begin - due, outcome, number, value))

    def answer(self, number, document):
        headers = {"Authorization": f"Bearer {self.key}", "Content-Type": "application/json", "Cache-Control": "no-cache",
                   "Prefer": f"return=representation, wait={PATIENCE}"}
        connection = self.connection()
        try:
            connection.request("POST", "/v1/jobs", document, headers)
            response = connection.getresponse()
            body = response.read()
        except (OSError, http.client.HTTPException) as problem:
            connection.close()
            return type(problem).__name__, None
        with self.lock:
            self.idle.append((time.monotonic(), connection))
        return self.judge(number, response.status, body)

    def connection(self):
        with self.lock:
            since, connection = self.idle.pop() if self.idle else (0.0, None)
        if time.monotonic() - since < IDLE:
            return connection
        return http.client.HTTPConnection(HOST, self.port, timeout=PATIENCE + 30)

    def judge(self, number, status, body):
        if status == 202:
            return "not ready", None
        try:
            if status != 200:
                return f"{status} {json.loads(body)['type'].rsplit(':', 1)[-1]}", None
            value = value_of(body)
        except (ValueError, KeyError, TypeError) as problem:
            return f"{status} with {type(problem).__name__}", None
        known = self.right.get(number)
        return "right" if known in (None, value) else "wrong", value


def run(port, owner, key, numbers, right, results, seconds, delay):
    """The whole of an owner's process, which begins after `delay` seconds: owners do not keep step."""
    Owner(port, owner, key, numbers, right, results).run(seconds, delay)
