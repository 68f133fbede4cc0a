"""Rates of the service on PostgreSQL and on SQLite, beside each other in one run.

  bench/cluster_rates.py PROGRAM LOADER [--points N] [--jobs N] [--rounds N]

PROGRAM is snapthrough, LOADER bench_service_load. SQLite: one process with two workers. PostgreSQL: one front and two worker
processes on a database of its own that syncs to disk. By turns, so that both have the same machine."""

import argparse
import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tests" / "cluster"))
import cluster  # noqa: E402
from cluster import Client, Cluster, Host, column, sweep  # noqa: E402


MANY = ["--max-sweep-points", "1000000"]


class Single:
    """One process on SQLite."""

    def __init__(self, program):
        self.folder = tempfile.TemporaryDirectory()
        self.hosts = [Host(program, self.folder.name, "single", f"{self.folder.name}/store.db", 2, True, MANY)]
        self.fronts = self.hosts

    def stop(self):
        self.hosts[0].stop()
        self.folder.cleanup()


def cpu_seconds(pids):
    total = 0.0
    for pid in pids:
        try:
            fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
            total += (int(fields[11]) + int(fields[12])) / 100.0
        except OSError:
            pass
    return total


def with_children(pids):
    listed = ",".join(map(str, pids))
    return [*pids, *subprocess.run(["pgrep", "-P", listed], capture_output=True, text=True, check=False).stdout.split()]


def database_processes(fleet):
    return with_children([(fleet.database.folder / "data" / "postmaster.pid").read_text().split()[0]])


def hand_in(client, document, headers=None):
    status, body, headers = client.ask("POST", "/v1/sweeps", json.dumps(document), headers)
    assert status == 201, body
    return headers["Location"]


def ended(client, path):
    state = json.loads(client.ask("GET", path, headers={"Prefer": "wait=30"}, timeout=60)[1])
    return state if state["status"] not in ("accepted", "running") else None


def wait_until_ended(client, path):
    while (state := ended(client, path)) is None:
        pass
    assert state["counts"]["successful"] == sum(state["counts"].values()), state["counts"]
    return state


def timed_sweep(service, document):
    """Points a second, and seconds for its table as CSV."""
    client = Client(service.fronts)
    start = time.time()
    path = hand_in(client, document, {"Cache-Control": "no-cache"})
    counts = wait_until_ended(client, path)["counts"]
    seconds = time.time() - start
    start = time.time()
    table = client.ask("GET", path + "/table?format=csv", timeout=120)[1]
    assert table.count(b"\n") == counts["successful"] + 1
    return seconds, time.time() - start


def job_rates(service, loader):
    """Durable submissions a second, and jobs a second that are handed in, solved and answered; without keys."""
    port = str(service.fronts[0].port)
    load = subprocess.run([loader, port, "5", "16"], capture_output=True, text=True, check=True, cwd="/tmp").stdout
    drained = re.compile(rb"snapthrough_jobs_waiting 0(\.0*)?\n")
    assert cluster.wait_for(lambda: drained.search(Client(service.fronts).ask("GET", "/metrics")[1]), 120, 0.5) is not None
    time.sleep(11)  # what waits is counted every 10 s
    solved = subprocess.run([loader, port, "5", "16", "0"], capture_output=True, text=True, check=True, cwd="/tmp").stdout
    return float(re.search(r"durable submissions (\d+)", load)[1]), float(re.search(r"solved (\d+)", solved)[1])


def start_latency(service, count=60):
    """Milliseconds from handing a job in until it begins: median and 99th of a hundred."""
    client = Client(service.fronts)
    paths = []
    for i in range(count):
        paths.append(client.ask("POST", "/v1/jobs", json.dumps(column(2 + i * 1e-3)), {"Prefer": "respond-async"})[2]["Location"])
        time.sleep(0.15)
    def moment(text):
        whole, fraction = text.rstrip("Z").split(".")
        return sum(float(part) * unit for part, unit in zip(whole.split("T")[1].split(":"), (3600, 60, 1))) + float("0." + fraction)
    waits = []
    for path in paths:
        job = json.loads(client.ask("GET", path)[1])
        waits.append(1e3 * (moment(job["started"]) - moment(job["created"])))
    waits.sort()
    return statistics.median(waits), waits[int(0.99 * (count - 1))]


def list_pages(service, database, jobs):
    """Milliseconds a page of a list of so many jobs: the first, and one in the middle."""
    database.query("ALTER TABLE jobs DISABLE TRIGGER USER; INSERT INTO jobs (id, status, attempt, analysis_type, created_us,"
                   " started_us, finished_us, owner) SELECT lpad(n::text, 36, '0'), 'successful', 1, 'path', n, n, n, 'ann'"
                   f" FROM generate_series(1, {jobs}) AS n; ALTER TABLE jobs ENABLE TRIGGER USER; ANALYZE jobs")
    client = Client(service.fronts)
    path = "/v1/jobs?limit=100"
    times = []
    for _ in range(50):
        start = time.time()
        page = json.loads(client.ask("GET", path)[1])
        times.append(1e3 * (time.time() - start))
        path = next(link["href"] for link in page["links"] if link["rel"] == "next")
    return times[0], statistics.median(times)


def idle(program, workers=20, seconds=20):
    """Statements a second, and share of a core that the database uses, of an idle fleet."""
    fleet = Cluster(program, 2, workers)
    try:
        time.sleep(5)
        def transactions():
            return int(fleet.database.query("SELECT xact_commit FROM pg_stat_database WHERE datname = 'snapthrough'")[0][0])
        transactions()
        time.sleep(1.5)
        used, done = cpu_seconds(database_processes(fleet)), transactions()
        time.sleep(seconds)
        return (transactions() - done) / seconds, (cpu_seconds(database_processes(fleet)) - used) / seconds
    finally:
        fleet.stop()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("loader")
    parser.add_argument("--points", type=int, default=100_000)
    parser.add_argument("--jobs", type=int, default=1_000_000)
    parser.add_argument("--rounds", type=int, default=2)
    arguments = parser.parse_args()
    cluster.OWNERS = {}  # the loader has no key
    rows = {}
    for round_number in range(arguments.rounds):
        for name, make in (("sqlite", Single), ("postgresql", lambda program: Cluster(program, 1, 2, MANY))):
            service = make(arguments.program)
            try:
                submitted, solved = job_rates(service, arguments.loader)
                exact, table = timed_sweep(service, sweep(arguments.points, analysis="buckling"))
                latency = start_latency(service)
                rows.setdefault(name, []).append((submitted, solved, arguments.points / exact, table, *latency))
                if name == "postgresql" and round_number == 0:
                    bytes_a_point = int(service.database.query("SELECT pg_total_relation_size('sweep_rows')")[0][0]) / arguments.points
                    pages = list_pages(service, service.database, arguments.jobs)
            finally:
                service.stop()
    heads = ("durable submissions/s", "jobs solved and answered/s", "points/s", "table as CSV (s)", "to start, median (ms)",
             "to start, 99 % (ms)")
    print("| | " + " | ".join(heads) + " |\n|" + " --- |" * (len(heads) + 1))
    for name, values in rows.items():
        print(f"| {name} | " + " | ".join(f"{statistics.median(column):.4g}" for column in zip(*values)) + " |")
    print(f"list of {arguments.jobs} jobs: first page {pages[0]:.1f} ms, median of 50 pages {pages[1]:.1f} ms")
    print(f"database: {bytes_a_point:.0f} bytes a point")
    statements, share = idle(arguments.program)
    print(f"idle: 2 fronts and 20 workers make {statements:.0f} transactions a second, {100 * share:.1f} % of a core in the database")


if __name__ == "__main__":
    main()
