"""How far one PostgreSQL carries workers: a discrete-event model of a sweep, from costs that were measured.

  bench/cluster_simulation.py [--claim-cpu MS] [--put-cpu MS] [--lock MS] [--commit MS] [--svg FILE]

Each worker core takes a lease, computes for a tenth of a second, up to a second where its rounds of the database take more
than a twentieth of that (chunk_seconds() of server/sweeps/scheduler.h), stores its rows, and begins again. The database has
cores that claims and puts take turns on; claims of one sweep take turns on the row they split; a commit takes its time besides.
Prints a table; the plot shows computed time as a share of what the cores could do."""

import argparse
import heapq
import pathlib
import random
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "scripts"))
from lib.chart import Axes, Curve, chart  # noqa: E402


class Servers:
    """So many that serve one after the other."""

    def __init__(self, count):
        self.free = [0.0] * count

    def serve(self, now, seconds):
        """When it is done."""
        start = max(now, heapq.heappop(self.free))
        heapq.heappush(self.free, start + seconds)
        return start + seconds


def simulate(workers, cores, costs, longest, sweeps, until=20.0, seed=1):
    """Share of the workers' time that they compute, and the seconds of a round of the database: median, 99 %."""
    draw = random.Random(seed)
    database = Servers(cores)
    locks = [Servers(1) for _ in range(sweeps)]
    events = [(0.1 * draw.random(), worker) for worker in range(workers)]
    took = [0.0] * workers  # by the database, about
    heapq.heapify(events)
    computed, rounds = 0.0, []
    while events:
        now, worker = heapq.heappop(events)
        if now > until:
            break
        stored = database.serve(now, costs["put_cpu"]) + costs["commit"]
        claimed = database.serve(locks[worker % sweeps].serve(stored, costs["lock"]), costs["claim_cpu"])
        took[worker] = 0.5 * (took[worker] + claimed - now) if took[worker] else claimed - now
        length = min(max(took[worker] / 0.05, 0.1), longest) * draw.uniform(0.75, 1.25)
        if now > 0.25 * until:  # after it has settled
            rounds.append(claimed - now)
            computed += length
        heapq.heappush(events, (claimed + length, worker))
    rounds.sort()
    return computed / (0.75 * until * workers), rounds[len(rounds) // 2], rounds[int(0.99 * len(rounds))]


def svg(curves, file):
    """Computed share over worker cores, on a logarithmic scale."""
    axes = Axes("Share of the workers' time that they compute", "worker cores", "share of time", y_range=(0, 1), logarithmic="x", percent=True)
    drawn = [Curve(name, [points], number, mark="dot", dashed=True) for number, (name, points) in enumerate(curves)]
    pathlib.Path(file).write_text(chart(axes, drawn), encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, default in (("claim-cpu", 0.4), ("put-cpu", 1.2), ("lock", 0.3), ("commit", 3.0)):
        parser.add_argument(f"--{name}", type=float, default=default, help="milliseconds")
    parser.add_argument("--svg")
    given = parser.parse_args()
    costs = {"claim_cpu": given.claim_cpu / 1e3, "put_cpu": given.put_cpu / 1e3, "lock": given.lock / 1e3, "commit": given.commit / 1e3}
    cases = [("2 cores, one sweep", 2, 1.0, 1), ("8 cores, one sweep", 8, 1.0, 1), ("8 cores, eight sweeps", 8, 1.0, 8),
             ("8 cores, eight sweeps, leases of 0.1 s always", 8, 0.1, 8)]
    print("| worker cores | " + " | ".join(name for name, *_ in cases) + " |\n|" + " --- |" * (len(cases) + 1))
    curves = [(name, []) for name, *_ in cases]
    for workers in (10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000):
        cells = []
        for (_, cores, longest, sweeps), (_, points) in zip(cases, curves):
            until = 20.0 if workers <= 1000 else 8.0
            share, median, worst = simulate(workers, cores, costs, longest, sweeps, max(until, 40 * longest))
            points.append((workers, share))
            cells.append(f"{share:.0%}, {1e3 * median:.0f} / {1e3 * worst:.0f} ms")
        print(f"| {workers} | " + " | ".join(cells) + " |", flush=True)
    if given.svg:
        svg(curves, given.svg)


if __name__ == "__main__":
    main()
