"""HTTP as the soak test speaks it: requests that state the answers they accept, events, findings, the pace."""
import collections
import gzip
import http.client
import json
import random
import threading
import time


class Wrong(Exception):
    """An answer that is not the right one."""


class Answer:
    def __init__(self, response):
        self.status = response.status
        self.headers = response.headers
        self.body = response.read()
        if self.headers["Content-Encoding"] == "gzip":
            self.body = gzip.decompress(self.body)

    def json(self):
        return json.loads(self.body)


class Connection(http.client.HTTPConnection):
    """A connection that remembers its last request and answer, for findings, and how often it met which 503."""

    repeated = ("overloaded",)  # types of 503 after which a request is sent again

    def __init__(self, port):
        super().__init__("127.0.0.1", port, timeout=90)
        self.last = "nothing asked yet"
        self.refusals = collections.Counter()  # by type

    def call(self, method, path, document=None, expect=(200,), **headers):
        """The answer, its status among `expect`; a request that is refused for the moment is sent again.

        A document is sent as JSON, bytes as they are; the keyword If_None_Match is the header If-None-Match.
        """
        fields = {name.replace("_", "-"): value for name, value in headers.items()}
        body = document if document is None or isinstance(document, bytes) else json.dumps(document).encode()
        if method == "POST":
            fields["Content-Type"] = "application/json"
            body = body or b""
        elif method == "GET" and random.random() < 0.3:
            fields["Accept-Encoding"] = "gzip"
        answer = self.ask(method, path, body, fields)
        while answer.status == 503 and (kind := answer.json()["type"].rsplit(":", 1)[1]) in self.repeated:
            self.refusals[kind] += 1
            time.sleep(int(answer.headers["Retry-After"]))
            answer = self.ask(method, path, body, fields)
        check(answer.status in expect, f"status {answer.status}, expected one of {expect}")
        return answer

    def ask(self, method, path, body, fields):
        self.last = f"{method} {path} {fields} {(body or b'')[:1500].decode()}"
        self.request(method, path, body, fields)
        answer = Answer(self.getresponse())
        self.last += f"\n  -> {answer.status} {dict(answer.headers)} {answer.body[:700].decode(errors='replace')}"
        return answer

    def post(self, path, document=None, expect=(200,), **headers):
        return self.call("POST", path, document, expect, **headers)

    def events(self, path):
        """(id, kind, data) of a stream of events, to its end."""
        self.last = f"GET {path}"
        self.request("GET", path)
        response = self.getresponse()
        check(response.status == 200, f"status {response.status} of a stream")
        event = {}
        for line in response:
            name, _, value = line.decode().rstrip("\r\n").partition(": ")
            if name:
                event[name] = value
            elif "event" in event:
                self.last = f"GET {path}\n  -> ... {event}"
                yield int(event["id"]), event["event"], json.loads(event["data"])
                event = {}


def check(right, what):
    if not right:
        raise Wrong(what)


class Findings:
    """Counts what went wrong; prints the first of it as it comes."""

    MOST = 200

    def __init__(self):
        self.count = 0
        self.refusals = collections.Counter()  # by type
        self.lock = threading.Lock()

    def add(self, text):
        with self.lock:
            self.count += 1
            if self.count <= self.MOST:
                print(f"ERROR {time.strftime('%H:%M:%S')} {text}", flush=True)

    def add_refusals(self, refusals):
        with self.lock:
            self.refusals += refusals


class Pace:
    """Lets actions begin at a rate; as fast as they end while the rate is None."""

    def __init__(self):
        self.rate = None
        self.due = time.monotonic()
        self.lock = threading.Lock()

    def wait(self, stop):
        if self.rate is None:
            return
        with self.lock:
            now = time.monotonic()
            self.due = max(self.due + 1 / self.rate, now - 1)  # a pause is caught up with for a second at most
            pause = self.due - now
        stop.wait(max(0.0, pause))


class Load:
    """Threads that take actions at random, by weight: functions of a Connection and a Random."""

    def __init__(self, port, actions, clients, findings):
        self.port = port
        self.actions = actions
        self.findings = findings
        self.pace = Pace()
        self.stop = threading.Event()
        self.done = collections.Counter()  # actions by name
        self.threads = [threading.Thread(target=self.run, args=(number,)) for number in range(clients)]

    def start(self):
        for thread in self.threads:
            thread.start()

    def end(self):
        self.stop.set()
        for thread in self.threads:
            if thread.ident:
                thread.join()

    def run(self, number):
        draw = random.Random(number)
        while not self.stop.is_set():
            self.pace.wait(self.stop)
            action = draw.choices(list(self.actions), list(self.actions.values()))[0]
            self.take(action, draw)
            self.done[action.__name__] += 1

    def take(self, action, draw):
        connection = Connection(self.port)
        try:
            action(connection, draw)
        except Exception as problem:  # whatever it is, the answer was not as it should be
            self.findings.add(f"{action.__name__}: {problem!r}\n  {connection.last}")
        self.findings.add_refusals(connection.refusals)
        connection.close()


def probe(port, results):
    """Times /livez and a small job five times a second, for ever: ("livez", s), ("job", s), ("wrong", text).

    Runs in a process of its own, where the load's threads don't delay it.
    """
    example = json.load(open("examples/column_between_springs.json"))
    right = None
    due = time.monotonic()
    while True:
        connection = Connection(port)
        try:
            begin = time.perf_counter()
            connection.call("GET", "/livez")
            results.put(("livez", time.perf_counter() - begin))
            begin = time.perf_counter()
            summary = connection.post("/v1/jobs", example, Cache_Control="no-cache").json()["summary"]
            results.put(("job", time.perf_counter() - begin))
            right = right or summary
            check(summary == right, "another result than the first time")
        except Exception as problem:
            results.put(("wrong", f"probe: {problem!r}\n  {connection.last}"))
        connection.close()
        due = max(due + 0.2, time.monotonic() - 1)
        time.sleep(max(0.0, due - time.monotonic()))
