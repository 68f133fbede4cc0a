#!/usr/bin/env python3
"""Sends random requests of every operation of the published interface, and holds each answer against it.

  schema_requests.py PROGRAM [--count 1500] [--seed N] [--keep FOLDER]

Operations, parameters and bodies are those of /v1/openapi.json. A third of the bodies is drawn from the schema or is an
example that is drawn anew at one place, a third is spoilt at one place, the rest is spoilt more or is nearly no JSON. Ids are
those of jobs and sweeps that earlier requests made, or strange.

Asked: no answer is 5xx; each status and media type is published for its operation; JSON is valid by the schema of its status
(by the package jsonschema if it is there, else by the subset of json_schema.py), and so are the events of streams; the
service lives and ends with 0. Exit status 1 when one is missed; --keep writes the requests that did.
"""
import argparse
import collections
import http.client
import json
import pathlib
import random
import socket
import sys
import tempfile
import time
import urllib.parse

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import json_schema  # noqa: E402
from schema_draw import Drawer  # noqa: E402
from service_process import HOST, ROOT, ServiceProcess, Verdict, leave_by_exception  # noqa: E402

METHODS = ("get", "post", "delete")
# Events by stream and name, with their schemas; the document has them as text.
EVENTS = {"jobs": {"status": "Job", "end": "Job", "progress": "JobProgressEvent", "points": "PathPointsEvent",
                   "critical_point": "CriticalPointEvent"},
          "sweeps": {"status": "Sweep", "end": "Sweep", "progress": "SweepProgressEvent"}}
STREAM_SECONDS = 2.0  # for which a stream is read
# Bounds that let no request take long, and none end for want of memory of the machine
SETTINGS = {"max_run_s": 3, "max_job_memory_bytes": 200_000_000, "default_wait_s": 1, "longest_wait_s": 30, "max_sweep_points": 500,
            "max_sweeps": 100_000}
STRANGE = ("0", "none", "../x", "%2e%2e", "%00", "%ff", "%c3%28", "a" * 300, "00000000-0000-7000-8000-000000000000", "é", "1e3", "-1",
           "99999999999999999999", " ")
PREFERENCES = ("wait=0", "wait=1", "wait=2, return=minimal", "respond-async", "return=representation", "return=minimal", "wait=-1",
               "wait=x", "wait=1e9", 'foo="bar, wait=2"', "return=representation, wait=1", ";;,=")
ACCEPTED = ("*/*", "application/json", "text/csv", "application/x-ndjson", "text/csv;q=0.1, application/json;q=0.2", "image/png",
            "application/json;q=2", ",")


class Operation:
    """An operation of the document."""

    def __init__(self, document, path, method, about):
        self.path = path
        self.method = method.upper()
        self.body = about.get("requestBody", {}).get("content", {}).get("application/json", {}).get("schema")
        self.responses = about["responses"]
        shared = document["paths"][path].get("parameters", [])
        self.parameters = [*shared, *about.get("parameters", [])]

    def __str__(self):
        return f"{self.method} {self.path}"


class Requests:
    """Draws requests; learns the ids of jobs and sweeps from the answers."""

    def __init__(self, document, examples, seed):
        self.random = random.Random(seed)
        self.schemas = json_schema.Schemas(document)
        self.drawer = Drawer(self.schemas, self.random)
        self.operations = [Operation(document, path, method, about) for path, item in document["paths"].items()
                           for method, about in item.items() if method in METHODS]
        self.weights = [4 if operation.body else 1 for operation in self.operations]
        self.ids = {"jobs": [], "sweeps": [], "hops": []}
        # Documents that fit the body of an operation, by operation
        self.examples = {str(operation): [one for one in examples if self.schemas.is_valid(operation.body, one)]
                         for operation in self.operations if operation.body}

    def next(self):
        """(operation, target, headers, body)"""
        operation = self.random.choices(self.operations, self.weights)[0]
        target, query, headers = operation.path, [], {}
        for parameter in map(self.schemas.resolved, operation.parameters):
            name, place = parameter["name"], parameter["in"]
            if place == "path":
                target = target.replace("{" + name + "}", self.path_part(operation, name))
            elif place == "query" and self.random.random() < 0.3:
                query.append(f"{name}={self.query_value(parameter['schema'])}")
            elif place == "header" and self.random.random() < 0.4:
                headers[name] = self.header_value(name)
        if self.random.random() < 0.05:
            query.append(self.random.choice(["unknown=1", "limit", "=", "format=csv&format=json", "%zz=1"]))
        if self.random.random() < 0.15:
            headers["Accept"] = self.random.choice(ACCEPTED)
        body = b"" if operation.method == "POST" else None
        if operation.body:
            body, headers["Content-Type"] = self.body(operation), "application/json"
            if self.random.random() < 0.03:
                headers["Content-Type"] = self.random.choice(["text/plain", "application/json; charset=latin1", ""])
        return operation, target + ("?" + "&".join(query) if query else ""), headers, body

    def path_part(self, operation, name):
        known = self.ids[operation.path.split("/")[2]]
        if name == "n":
            return self.random.choice(["0", "1", "2", "499", *STRANGE[-4:-1]])
        if known and self.random.random() < 0.85:
            return self.random.choice(known[-30:])
        return urllib.parse.quote(self.random.choice(STRANGE), safe="%")

    def query_value(self, schema):
        value = self.drawer.value(schema) if self.random.random() < 0.8 else self.random.choice(STRANGE)
        text = value if isinstance(value, str) else json.dumps(value)
        return urllib.parse.quote(text, safe="%" if value in STRANGE else "")

    def header_value(self, name):
        choices = {"Prefer": PREFERENCES, "Cache-Control": ("no-cache", "max-age=0", "no-cache, no-store"),
                   "Last-Event-ID": ("0", "1", "5", "99999999", "x", "-1"),
                   "Idempotency-Key": ("one", "two", "three", "x" * 300, "", "a b"), "If-None-Match": ("*", '"x"', "x", 'W/"x"')}
        return self.random.choice(choices.get(name, STRANGE[:2]))

    def body(self, operation):
        chance, fitting = self.random.random(), self.examples[str(operation)]
        value = self.random.choice(fitting) if fitting and self.random.random() < 0.7 else self.drawer.value(operation.body)
        if chance < 0.35:
            value = self.drawer.varied(operation.body, value)
        elif chance < 0.65:
            value = self.drawer.spoilt(value)
        elif chance < 0.85:
            for _ in range(self.random.randint(2, 10)):
                value = self.drawer.spoilt(value)
        else:
            return self.drawer.spoilt_text(value)
        return json.dumps(value, ensure_ascii=self.random.random() < 0.5).encode("utf-8", "surrogatepass")

    def learn(self, operation, status, answer):
        if operation.path in ("/v1/jobs", "/v1/sweeps") and status in (200, 201, 202) and isinstance(answer, dict) and "id" in answer:
            self.ids[operation.path.split("/")[2]].append(answer["id"])
        elif operation.path == "/v1/hops" and isinstance(answer, list):
            self.ids["hops"] = [one["Name"] for one in answer if isinstance(one, dict) and "Name" in one]


class Judge:
    """Holds answers against the document."""

    def __init__(self, schemas):
        self.schemas = schemas
        self.events = 0
        self.validated = 0

    def faults(self, operation, response, body):
        """(sentences about what is wrong, the JSON of the answer)"""
        published = operation.responses.get(str(response.status))
        wrong = [f"status {response.status}"] if response.status >= 500 else []
        if published is None:
            return [*wrong, f"status {response.status} is not published: {body[:200]!r}"], None
        content = self.schemas.resolved(published).get("content")
        if content is None or response.status in (204, 304):
            return wrong + ([f"a body of {len(body)} bytes with status {response.status}"] if body else []), None
        kind = response.headers.get_content_type()
        if kind not in content:
            return [*wrong, f"{kind} is not published for {response.status}: {body[:200]!r}"], None
        if kind == "text/event-stream":
            return wrong + self.event_faults(operation, body), None
        if kind == "application/x-ndjson":
            return wrong + self.line_faults(body), None
        if not kind.endswith("json"):
            return wrong, None
        try:
            answer = json.loads(body)
        except ValueError as problem:
            return [*wrong, f"the answer is no JSON: {problem}"], None
        self.validated += 1
        return wrong + self.schemas.faults(content[kind].get("schema", {}), answer)[:5], answer

    def line_faults(self, body):
        """Each line is a JSON object."""
        try:
            lines = [json.loads(line) for line in body.decode().splitlines()]
        except ValueError as problem:
            return [f"a line is no JSON: {problem}"]
        self.validated += len(lines)
        return [f"a line is no object: {line!r:.200}" for line in lines if not isinstance(line, dict)]

    def event_faults(self, operation, body):
        found, kinds = [], EVENTS[operation.path.split("/")[2]]
        for block in body.decode().split("\n\n")[:-1]:
            fields = dict(line.split(": ", 1) for line in block.split("\n") if ": " in line and line[0] != ":")
            if "event" not in fields:
                continue
            self.events += 1
            if fields["event"] not in kinds:
                found.append(f"an event {fields['event']!r} that is not known")
                continue
            schema = {"$ref": f"#/components/schemas/{kinds[fields['event']]}"}
            found += [f"event {fields['event']}: {fault}" for fault in self.schemas.faults(schema, json.loads(fields["data"]))[:3]]
        return found


def send(port, operation, target, headers, body):
    """(response, body); of a stream what comes within STREAM_SECONDS."""
    connection = http.client.HTTPConnection(HOST, port, timeout=60)
    try:
        connection.connect()
        client = connection.sock  # http.client forgets it when the response ends the connection
        connection.request(operation.method, target, body, headers)
        response = connection.getresponse()
        if response.headers.get_content_type() != "text/event-stream":
            return response, response.read()
        client.settimeout(STREAM_SECONDS)
        text, late = b"", time.monotonic() + STREAM_SECONDS
        try:
            while time.monotonic() < late and (piece := response.read1(65536)):
                text += piece
        except socket.timeout:
            pass
        return response, text
    finally:
        connection.close()


def examples_of(service):
    """Requests, sweeps and calls of components that are right."""
    found = service.json("/v1/examples")
    values = list(found.values()) if isinstance(found, dict) else found
    values = [inner for one in values for inner in (one if isinstance(one, list) else [one])]
    documents = [one.get("request", one.get("document", one)) for one in values if isinstance(one, dict)]
    for file in sorted((ROOT / "examples" / "sweeps").glob("*.json")):
        documents.append(json.loads(file.read_text(encoding="utf-8")))
        if "latin_hypercube" in documents[-1]["design"]:
            documents[-1]["design"]["latin_hypercube"]["samples"] = 5
    for component in service.json("/v1/hops"):
        values = [{"ParamName": one["Name"], "InnerTree": {"{0}": [{"type": one["ResultType"], "data": json.dumps(one.get("Default"))}]}}
                  for one in component["Inputs"]]
        documents.append({"pointer": f"v1/hops/{component['Name']}", "algo": None, "cachesolve": False, "modelunits": "Meters",
                          "values": values})
    return documents


def exchange(service, requests, judge, counts):
    """Sends one request; (sentences about what is wrong, the request as text)."""
    operation, target, headers, body = requests.next()
    told = f"{operation.method} {target} {headers}\n{(body or b'').decode(errors='backslashreplace')}"
    begin = time.monotonic()
    try:
        response, answer = send(service.port, operation, target, headers, body)
    except (OSError, http.client.HTTPException, UnicodeError) as problem:
        return [f"{operation} -> {type(problem).__name__} {problem} after {time.monotonic() - begin:.1f} s"], told
    counts[f"{operation} {response.status}"] += 1
    found, value = judge.faults(operation, response, answer)
    requests.learn(operation, response.status, value)
    return [f"{operation} -> {response.status}: {fault}" for fault in found], told


def conclude(arguments, operations, judge, counts, wrong, kinds, ended):
    verdict = Verdict()
    statuses = collections.Counter()
    for key, count in counts.items():
        statuses[key.rsplit(" ", 1)[1]] += count
    verdict.ask(f"answers that are not as published, of {arguments.count}", "0", str(wrong), wrong == 0)
    unused = [str(one) for one in operations if not any(key.rsplit(" ", 1)[0] == str(one) for key in counts)]
    verdict.ask(f"operations of {len(operations)} that were not used", "0", ", ".join(unused) or "0", not unused or arguments.count < 500)
    verdict.ask("exit status of the service", "0", str(ended[1]), ended[1] == 0)
    by = "jsonschema" if json_schema.jsonschema else "the subset of json_schema.py"
    print(f"\n{verdict.table()}\n\nseed {arguments.seed}; {judge.validated} documents and {judge.events} events validated by {by};"
          f" statuses {dict(sorted(statuses.items()))}")
    print("\n".join(f"{count} x {kind}" for kind, count in kinds.most_common(30)))
    return 1 if verdict.missed else 0


def run(arguments, folder):
    service = ServiceProcess(arguments.program, folder, **SETTINGS)
    counts, kinds, wrong = collections.Counter(), collections.Counter(), 0
    service.start()
    try:
        requests = Requests(service.json("/v1/openapi.json"), examples_of(service), arguments.seed)
        judge = Judge(requests.schemas)
        for number in range(arguments.count):
            found, told = exchange(service, requests, judge, counts)
            wrong += bool(found)
            for fault in found:
                kinds[fault.split("{")[0][:110] if "{id}" not in fault else fault[:130]] += 1
                print(f"{number}: {fault}", flush=True)
            if found and arguments.keep:
                arguments.keep.mkdir(parents=True, exist_ok=True)
                (arguments.keep / f"{arguments.seed}-{number}.txt").write_text(told + "\n\n" + "\n".join(found) + "\n", encoding="utf-8")
        ended = service.terminate()
    finally:
        service.kill()
    return conclude(arguments, requests.operations, judge, counts, wrong, kinds, ended)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--count", type=int, default=1500)
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(1 << 32))
    parser.add_argument("--keep", type=pathlib.Path, metavar="FOLDER")
    arguments = parser.parse_args()
    leave_by_exception()
    with tempfile.TemporaryDirectory(prefix="snapthrough-schema-") as folder:
        return run(arguments, pathlib.Path(folder))


if __name__ == "__main__":
    sys.exit(main())
