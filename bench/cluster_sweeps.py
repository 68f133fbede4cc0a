"""Sweeps over two worker hosts that share one PostgreSQL.

  bench/cluster_sweeps.py overhead PROGRAM [--points N] [--rounds N]
  bench/cluster_sweeps.py million PROGRAM [--points N]

overhead: points of about a millisecond through two worker hosts beside the same points through the command line with two threads,
by turns: wall time, and processor time of everybody, database included.
million: exact columns, while one of the two hosts is killed twice and started again: every row once, memory of each process
while it runs, bytes a point in the database, and what vacuum did."""

import argparse
import json
import pathlib
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tests" / "cluster"))
import cluster  # noqa: E402
from cluster import Client, Cluster, sweep  # noqa: E402
from cluster_rates import cpu_seconds, database_processes, hand_in, wait_until_ended, with_children  # noqa: E402


def through_hosts(fleet, document):
    """Wall time, and processor time of the hosts and of the database."""
    client = Client(fleet.fronts)
    hosts = with_children([host.process.pid for host in fleet.hosts])  # their runners solve
    before = cpu_seconds(hosts), cpu_seconds(database_processes(fleet))
    start = time.time()
    path = hand_in(client, document, {"Cache-Control": "no-cache"})
    wait_until_ended(client, path)
    wall = time.time() - start
    return wall, cpu_seconds(hosts) - before[0], cpu_seconds(database_processes(fleet)) - before[1]


def through_command_line(program, file):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.time()
    subprocess.run([program, "sweep", "--ndjson", "--threads", "2", file], stdout=subprocess.DEVNULL, check=True)
    wall = time.time() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return wall, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, 0.0


def overhead(arguments):
    document = sweep(arguments.points, arguments.elements)
    fleet = Cluster(arguments.program, 1, 2, ["--max-sweep-points", "1000000"])
    rows = {"command line, two threads": [], "two worker hosts": []}
    try:
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            json.dump(document, file)
            file.flush()
            for _ in range(arguments.rounds):
                rows["command line, two threads"].append(through_command_line(arguments.program, file.name))
                rows["two worker hosts"].append(through_hosts(fleet, document))
    finally:
        fleet.stop()
    print("| | wall (s) | processor, programs (s) | processor, database (s) | ms a point |\n| --- | --- | --- | --- | --- |")
    for name, values in rows.items():
        wall, programs, database = (statistics.median(column) for column in zip(*values))
        print(f"| {name} | {wall:.2f} | {programs:.2f} | {database:.2f} | {1e3 * programs / arguments.points:.2f} |")
    ratios = [hosts[0] / line[0] for line, hosts in zip(*rows.values())]
    print("wall, hosts over command line, round by round: " + ", ".join(f"{ratio:.3f}" for ratio in ratios))


def memory_mib(host, name="VmRSS"):
    """Of a host with its children: resident now, or with VmHWM the most so far."""
    total = 0
    for pid in with_children([host.process.pid]):
        try:
            total += int(re.search(rf"{name}:\s+(\d+) kB", pathlib.Path(f"/proc/{pid}/status").read_text())[1]) / 1024
        except OSError:
            pass  # it has ended
    return total


PART = 200_000  # rows of a table in one answer


VACUUM = ("SELECT relname, n_tup_ins, n_tup_upd, n_tup_del, n_dead_tup, autovacuum_count, autoanalyze_count,"
          " pg_total_relation_size(relid) FROM pg_stat_user_tables WHERE relname LIKE 'sweep%' ORDER BY relname")


def million(arguments):
    document = sweep(arguments.points, analysis="buckling")
    fleet = Cluster(arguments.program, 1, 2, ["--max-sweep-points", "1000000", "--lease-s", "3"])
    try:
        watch_million(fleet, document, arguments.points)
    finally:
        fleet.stop()


def watch_million(fleet, document, points):
    client = Client(fleet.fronts)
    start = time.time()
    path = hand_in(client, document)
    victim = fleet.workers[1]
    kills = [0.25, 0.5]
    print("| s | rows | " + " | ".join(f"{host.name} (MiB)" for host in fleet.hosts) + " |\n|" + " --- |" * (2 + len(fleet.hosts)))
    state = None
    while state is None or state["status"] in ("accepted", "running"):
        time.sleep(min(1, points / 1e6))
        state = json.loads(client.ask("GET", path)[1])
        done = state["counts"]["successful"]
        print(f"| {time.time() - start:.1f} | {done} | "
              + " | ".join(f"{memory_mib(host):.0f}" for host in fleet.hosts) + " |", flush=True)
        if kills and done >= kills[0] * points:
            kills.pop(0)
            victim.kill()
            victim.start()
            print(f"| {time.time() - start:.1f} | {victim.name} killed and started again |", flush=True)
    assert not kills, "the sweep ended before both kills"
    wall = time.time() - start
    assert state["counts"]["successful"] == points and state["counts"]["failed"] == 0, state["counts"]
    start = time.time()
    parts = [client.ask("GET", f"{path}/table?format=csv&first={first}&count={PART}", timeout=300)[1]
             for first in range(0, points, PART)]
    table = b"".join(part.split(b"\n", 1)[1] for part in parts)
    seconds = time.time() - start
    assert table.count(b"\n") == points
    values = [float(line.split(b",", 1)[0]) for line in table.splitlines()]
    assert all(one < other for one, other in zip(values, values[1:])), "rows are not each once, in order"
    print(f"complete in {wall:.1f} s, each row once; table as CSV: {len(table) / 1e6:.0f} MB in {seconds:.1f} s")
    for host in fleet.hosts:
        print(f"{host.name}: at most {memory_mib(host, 'VmHWM'):.0f} MiB")
    time.sleep(65 if points > 100_000 else 0)  # a round of autovacuum
    print("| table | inserted | updated | deleted | dead | vacuums | analyzes | bytes |\n|" + " --- |" * 8)
    for row in fleet.database.query(VACUUM):
        print("| " + " | ".join(row) + " |")
    print(f"bytes a point, rows: {int(fleet.database.query('SELECT pg_total_relation_size(%r)' % 'sweep_rows')[0][0]) / points:.1f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(required=True)
    for name, points, run in (("overhead", 20_000, overhead), ("million", 1_000_000, million)):
        command = commands.add_parser(name)
        command.add_argument("program")
        command.add_argument("--points", type=int, default=points)
        command.add_argument("--elements", type=int, default=32)
        command.add_argument("--rounds", type=int, default=5)
        command.set_defaults(run=run)
    arguments = parser.parse_args()
    cluster.OWNERS = {}
    arguments.run(arguments)


if __name__ == "__main__":
    main()
