"""What the clients of the soak test do, and what is right for an answer. Every action takes a Connection and a Random.

Results and tables are compared with those that the program gives on the command line.
"""
import json
import pathlib
import subprocess
import tempfile
import time
import uuid

from lib.soak_client import check

EXAMPLES = pathlib.Path("examples")
FINAL = ("successful", "failed", "dismissed")
LONGEST = 60  # s that a job or sweep may take


def plain(result):
    """A result document without the time that it took."""
    result["diagnostics"].pop("wall_time_s")
    return result


class Catalogue:
    """Requests and sweeps, each with the answer of the command line, as (document, right)."""

    def __init__(self, program):
        self.program = program
        requests = [json.loads(file.read_text()) for file in sorted(EXAMPLES.glob("*.json"))]
        slow = json.loads((EXAMPLES / "arch_no_base.json").read_text())
        slow["analysis"]["discretization"] = {"elements": 2000}
        self.jobs = [(request, plain(self.answer("solve", request))) for request in requests]
        self.slow = (slow, plain(self.answer("solve", slow)))
        self.sweeps = [(sweep, self.answer("sweep", sweep)) for sweep in self.sweep_documents()]

    def answer(self, command, document):
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            json.dump(document, file)
            file.flush()
            run = subprocess.run([self.program, command, file.name], capture_output=True, check=True)
        return json.loads(run.stdout)

    @staticmethod
    def sweep_documents():
        """Some hundreds of points each: samples of several seeds, a part of a grid, a followed curve."""
        def read(name):
            return json.loads((EXAMPLES / "sweeps" / name).read_text())
        for seed in range(1, 9):
            sweep = read("column_random.json")
            sweep["design"]["latin_hypercube"] = {"samples": 300, "seed": seed}
            yield sweep
        grid = read("columns_with_one_spring.json")
        grid["parameters"][1]["range"]["count"] = 5
        grid["parameters"][2]["range"]["count"] = 20
        yield grid
        yield read("ring_followed.json")
        yield read("lining_thickness.json")


class Actions:
    """The actions, and what they share: the catalogue and the account of callbacks."""

    def __init__(self, catalogue, receiver):
        self.catalogue = catalogue
        self.receiver = receiver
        self.account = receiver.account

    def weights(self):
        """How often which action is taken."""
        return {self.solve: 30, self.hand_in: 24, self.solve_once: 6, self.remove_job: 6, self.dismiss_job: 4,
                self.follow_job: 5, self.list_label: 4, self.list_pages: 4, self.refuse: 4, self.sweep: 6,
                self.remove_sweep: 2, self.retry_sweep: 2, self.follow_sweep: 2}

    # Jobs

    def solve(self, connection, draw):
        """A synchronous job, in a part of the cases one that was solved before."""
        request, right = draw.choice(self.catalogue.jobs)
        prefer = draw.choice([{}, {"Prefer": "wait=60"}, {"Prefer": "return=representation, wait=60"}])
        fresh = {"Cache_Control": "no-cache"} if draw.random() < 0.7 else {}
        answer = connection.post("/v1/jobs", request, **prefer, **fresh)
        check(plain(answer.json()) == right, "another result than the command line's")

    def hand_in(self, connection, draw):
        """An asynchronous job with a callback; its result is read in every form."""
        request, right = draw.choice(self.catalogue.jobs)
        job = self.new_job(connection, draw, request)
        ended = self.wait(connection, f"/v1/jobs/{job['id']}")
        check(ended["status"] == "successful", f"the job is {ended['status']}")
        if "callback" in ended:
            self.account.expect(ended)
        self.read_result(connection, job["id"], request, right)

    def new_job(self, connection, draw, request, callback=0.7, **headers):
        """The status of a job under a label of its own."""
        envelope = {"label": f"soak {uuid.uuid4()}", "metadata": {"site": "north"}, "request": request}
        if draw.random() < callback:
            envelope["callback"] = self.receiver.address
        fresh = {"Cache_Control": "no-cache"} if draw.random() < 0.7 else {}
        job = connection.post("/v1/jobs", envelope, (200, 201), Prefer="respond-async", **fresh, **headers).json()
        check(job["label"] == envelope["label"] and job["metadata"] == envelope["metadata"], "annotations differ")
        return job

    @staticmethod
    def wait(connection, path):
        """The status document at the end."""
        late = time.monotonic() + LONGEST
        while time.monotonic() < late:
            status = connection.call("GET", path, Prefer="wait=20").json()
            if status["status"] in FINAL:
                return status
        check(False, f"no end within {LONGEST} s")

    @staticmethod
    def read_result(connection, job, request, right):
        path = f"/v1/jobs/{job}"
        result = connection.call("GET", path + "/result")
        check(plain(result.json()) == right, "another result than the command line's")
        connection.call("GET", path + "/result", None, (304,), If_None_Match=result.headers["ETag"])
        table = connection.call("GET", path + "/result?format=csv").body.decode().splitlines()
        check(len(table) > 1 and len({line.count(",") for line in table}) == 1, "no table")
        check(connection.call("GET", path + "/request").json() == request, "another request than was handed in")

    def solve_once(self, connection, draw):
        """Two requests with one idempotency key are one job."""
        request, right = draw.choice(self.catalogue.jobs)
        key = str(uuid.uuid4())
        first = connection.post("/v1/jobs", request, Idempotency_Key=key)
        second = connection.post("/v1/jobs", request, Idempotency_Key=key)
        check(first.headers["Location"] == second.headers["Location"], "two jobs for one idempotency key")
        check(first.body == second.body and plain(first.json()) == right, "another result")

    def remove_job(self, connection, draw):
        """A job that waits, runs or has ended, removed."""
        request = draw.choice([self.catalogue.slow, *self.catalogue.jobs])[0]
        job = self.new_job(connection, draw, request)
        time.sleep(draw.uniform(0, 0.2))
        self.account.forgive(job["id"])
        self.remove(connection, f"/v1/jobs/{job['id']}")

    @staticmethod
    def remove(connection, path):
        connection.call("DELETE", path, None, (204,))
        connection.call("GET", path, None, (404,))
        connection.call("DELETE", path, None, (404,))

    def dismiss_job(self, connection, draw):
        """A job that is stopped at a random moment is dismissed or had ended; whoever waits is told."""
        job = self.new_job(connection, draw, self.catalogue.slow[0])
        path = f"/v1/jobs/{job['id']}"
        time.sleep(draw.uniform(0, 0.3))
        dismissal = connection.post(path + "/dismiss", None, (200, 409))
        ended = self.wait(connection, path)
        right = "dismissed" if dismissal.status == 200 else "successful"
        check(ended["status"] == right, f"the job is {ended['status']} after {dismissal.status}")
        if "callback" in ended:
            self.account.expect(ended)

    def follow_job(self, connection, draw):
        request = draw.choice([self.catalogue.slow, *self.catalogue.jobs])[0]
        job = self.new_job(connection, draw, request)
        path = f"/v1/jobs/{job['id']}"
        events = self.follow(connection, path)
        ended = self.wait(connection, path)
        check(events[-1][2]["status"] == ended["status"] == "successful", "the last event has another status")
        points = connection.call("GET", path + "/result").json()["critical_points"]
        last = [data for _, kind, data in events if kind == "critical_point" and data["final"]]
        check([point["load_factor"] for point in last] == [point["load_factor"] for point in points],
              "the events have other critical points than the result")
        if "callback" in ended:
            self.account.expect(ended)

    @staticmethod
    def follow(connection, path):
        """The events of a job or sweep from its beginning to its end."""
        events = list(connection.events(path + "/events"))
        check(events and events[-1][1] == "end", "no event at the end")
        numbers = [number for number, _, _ in events]
        check(numbers == sorted(numbers), f"the ids of events do not grow: {numbers}")
        connection.call("GET", path + "/events", None, (204,), Last_Event_ID=str(numbers[-1]))
        return events

    # Lists

    def list_label(self, connection, draw):
        """Just the jobs of one label, in pages of two."""
        label = f"soak {uuid.uuid4()}"
        given = set()
        for request, _ in draw.sample(self.catalogue.jobs, 5):
            envelope = {"label": label, "request": request}
            given.add(connection.post("/v1/jobs", envelope, (200, 201), Prefer="return=minimal").json()["id"])
        label = label.replace(" ", "%20")
        found = [job["id"] for job in self.pages(connection, f"/v1/jobs?limit=2&label={label}", 4)]
        check(sorted(found) == sorted(given), f"jobs {found} of the label, handed in were {given}")

    def list_pages(self, connection, draw):
        """Four pages of all jobs or sweeps that meet filters."""
        status, analysis = draw.choice([*FINAL, "running", ""]), draw.choice(["path", "critical", "buckling", ""])
        kind = draw.choice(["jobs", "sweeps"])
        path = f"/v1/{kind}?limit={draw.choice([5, 50])}"
        path += f"&status={status}" * bool(status) + f"&analysis={analysis}" * bool(analysis)
        found = self.pages(connection, path, 4)
        check(all(status in ("", one["status"]) and analysis in ("", one["analysis"]) for one in found),
              f"an item that does not meet the filters of {path}")
        created = [one["created"] for one in found]
        check(created == sorted(created, reverse=True), f"not the newest first: {created}")
        check(len({one["id"] for one in found}) == len(found), "an item twice")

    @staticmethod
    def pages(connection, path, most):
        kind = path.split("?")[0].rsplit("/", 1)[1]
        found = []
        while path and most > 0:
            answer = connection.call("GET", path)
            found += answer.json()[kind]
            link = answer.headers["Link"]
            path = link[link.index("<") + 1:link.index(">")] if link else None
            most -= 1
        return found

    def refuse(self, connection, draw):
        """Wrong requests, each refused with its place."""
        request = json.loads(json.dumps(draw.choice(self.catalogue.jobs)[0]))
        request["model"]["members"][0]["section"] = "nowhere"
        problem = connection.post("/v1/jobs", request, (422,)).json()
        check(any(error["pointer"] == "/model/members/0/section" for error in problem["errors"]), "another place")
        connection.post("/v1/jobs", b'{"model": ', (400,))
        callback = {"callback": "https://elsewhere.example/", "request": request}
        problem = connection.post("/v1/jobs", callback, (422,)).json()
        check(any(error["pointer"] == "/callback" for error in problem["errors"]), "the callback is not refused")

    # Sweeps

    def new_sweep(self, connection, draw, sweep, callback=0.7, **headers):
        envelope = {"label": f"soak {uuid.uuid4()}", "sweep": sweep}
        if draw.random() < callback:
            envelope["callback"] = self.receiver.address
        fresh = {"Cache_Control": "no-cache"} if draw.random() < 0.7 else {}
        return connection.post("/v1/sweeps", envelope, (201,), **fresh, **headers).json()

    def sweep(self, connection, draw):
        """A sweep to its end, its table in two forms, one of its points as a job."""
        document, right = draw.choice(self.catalogue.sweeps)
        sweep = self.new_sweep(connection, draw, document)
        self.finish_sweep(connection, f"/v1/sweeps/{sweep['id']}", right)
        if "follow" not in document:
            self.point_as_job(connection, draw, sweep["id"], right)

    def finish_sweep(self, connection, path, right):
        ended = self.wait(connection, path)
        check(ended["status"] == "successful" and ended["counts"]["remaining"] == 0, f"the sweep ended as {ended}")
        if "callback" in ended:
            self.account.expect(ended)
        answer = connection.call("GET", path + "/table")
        table = answer.json()
        check(answer.headers["X-Complete"] == "true" and table["points"] == list(range(ended["points"])),
              "rows are missing")
        check(table["columns"] == right["columns"] and table["rows"] == right["rows"],
              "other rows than the command line's")
        lines = connection.call("GET", path + "/table?format=csv").body.decode().splitlines()
        check(len(lines) == ended["points"] + 1, "another number of lines of CSV")

    @staticmethod
    def point_as_job(connection, draw, sweep, right):
        """The job of a point has the number of its row."""
        point = draw.randrange(len(right["rows"]))
        result = connection.post(f"/v1/sweeps/{sweep}/points/{point}/job").json()
        row = dict(zip(right["columns"], right["rows"][point]))
        for pointer in (column for column in row if column.startswith("/")):
            value = result
            for key in pointer.split("/")[1:]:
                value = value[int(key) if isinstance(value, list) else key]
            check(value == row[pointer], f"{pointer} is {value} in the job of point {point}, {row[pointer]} in its row")

    def remove_sweep(self, connection, draw):
        sweep = self.new_sweep(connection, draw, draw.choice(self.catalogue.sweeps)[0])
        time.sleep(draw.uniform(0, 0.3))
        self.account.forgive(sweep["id"])
        self.remove(connection, f"/v1/sweeps/{sweep['id']}")

    def retry_sweep(self, connection, draw):
        """A sweep that is stopped at a random moment keeps its rows, and is complete when it is tried again."""
        document, right = draw.choice(self.catalogue.sweeps)
        path = f"/v1/sweeps/{self.new_sweep(connection, draw, document, callback=0)['id']}"
        time.sleep(draw.uniform(0, 0.1))
        if connection.post(path + "/dismiss", None, (200, 409)).status == 200:
            table = connection.call("GET", path + "/table").json()
            rows = [right["rows"][point] for point in table["points"]]
            check(table["rows"] == rows, "other rows than the command line's")
            connection.post(path + "/retry?status=failed")
        self.finish_sweep(connection, path, right)

    def follow_sweep(self, connection, draw):
        document, right = draw.choice(self.catalogue.sweeps)
        path = f"/v1/sweeps/{self.new_sweep(connection, draw, document)['id']}"
        events = self.follow(connection, path)
        counts = [data["remaining"] for _, kind, data in events if kind == "progress"]
        check(counts == sorted(counts, reverse=True), f"the points that remain grow: {counts}")
        self.finish_sweep(connection, path, right)
