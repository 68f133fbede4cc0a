"""Many sweeps at the same time on hosts that share one PostgreSQL, while clients dismiss, retry, remove and read them and
worker hosts are killed.

  storm.py PROGRAM [--sweeps N] [--seconds S] [--workers N] [--kills N] [--seed N]

In the end every sweep that is there has ended; its counts are those of its table; it has a row for each point, in order,
unless it was dismissed; and values are those of the closed form."""

import argparse
import json
import math
import random
import sys
import threading
import time

from cluster import Client, Cluster, OWNERS, PATIENCE, sweep, wait_for

FINAL = ("successful", "failed", "dismissed")


class Storm:
    """What was handed in, and threads that do things with it."""

    def __init__(self, fleet, most, seed):
        self.fleet = fleet
        self.most = most
        self.seed = seed
        self.lock = threading.Lock()
        self.sweeps = {}  # path: (owner, points)
        self.removed = set()
        self.done = {"handed in": 0, "dismissed": 0, "tried again": 0, "removed": 0, "read": 0, "killed": 0}
        self.wrong = []
        self.stopping = False
        self.threads = [threading.Thread(target=self._run, args=(number,), daemon=True) for number in range(4)]
        for thread in self.threads:
            thread.start()

    def _run(self, number):
        chance = random.Random(self.seed * 1000 + number)
        owner = list(OWNERS)[number % 2]
        client = Client(self.fleet.fronts, owner)
        while not self.stopping:
            self._one(chance, owner, client)
            time.sleep(0.02)

    def _one(self, chance, owner, client):
        with self.lock:
            mine = [path for path, (whose, _) in self.sweeps.items() if whose == owner]
        what = chance.random()
        if not mine or (what < 0.4 and len(mine) < self.most):
            self._hand_in(chance, owner, client)
            return
        path = chance.choice(mine)
        if what < 0.6:
            self._did("dismissed", client.ask("POST", path + "/dismiss", "", tries=4))
        elif what < 0.75:
            self._did("tried again", client.ask("POST", path + "/retry", "", tries=4))
        elif what < 0.8:
            with self.lock:
                self.sweeps.pop(path, None)
                self.removed.add(path)
            self._did("removed", client.ask("DELETE", path, tries=4))
        else:
            self._did("read", client.ask("GET", path + "/table?format=ndjson", tries=4))

    def _hand_in(self, chance, owner, client):
        # small ones, large ones, those that others have computed already
        points = chance.choice([2, 3, 10, 100, 1000, 5000, 20000])
        analysis = chance.choice(["buckling", "buckling", "critical"]) if points < 500 else "buckling"
        headers = {"Cache-Control": "no-cache"} if chance.random() < 0.5 else {}
        status, body, answer = client.ask("POST", "/v1/sweeps", json.dumps(sweep(points, 4, analysis)), headers, tries=4)
        if status == 201:
            with self.lock:
                self.sweeps[answer["Location"]] = (owner, points)
            self.done["handed in"] += 1
        else:
            self.wrong.append(f"handing in gave {status}: {body[:200]}")

    def _did(self, what, answer):
        # 0: no answer but 5xx or none at all in four tries, though nobody harms fronts and database
        status = answer[0]
        if status in (0, 400, 401, 403):
            self.wrong.append(f"{what}: {status} {answer[1][:200]}")
        if status // 100 == 2:
            self.done[what] += 1

    def stop(self):
        self.stopping = True
        for thread in self.threads:
            thread.join()

    def check(self):
        """Waits until everything has ended; what is wrong."""
        left = dict(self.sweeps)

        def ended():
            for path, (owner, _) in list(left.items()):
                state = json.loads(Client(self.fleet.fronts, owner).ask("GET", path, tries=4)[1])
                if state["status"] in FINAL:
                    del left[path]
            return not left
        if wait_for(ended, PATIENCE, 0.5) is None:
            self.wrong.append(f"{len(left)} sweeps do not end: {list(left)[:3]}")
        for path, (owner, points) in self.sweeps.items():
            if path not in left:
                self.wrong += self._wrong_rows(path, owner, points)
        for path in self.removed:
            for owner in OWNERS:
                status = Client(self.fleet.fronts, owner).ask("GET", path, tries=4)[0]
                if status not in (404, 410):  # its owner is told that it was deleted
                    self.wrong.append(f"{path} was removed, and asked for it is {status}")
        return self.wrong

    def _wrong_rows(self, path, owner, points):
        client = Client(self.fleet.fronts, owner)
        state = json.loads(client.ask("GET", path, tries=4)[1])
        lines = client.ask("GET", path + "/table?format=csv", tries=4)[1].decode().splitlines()[1:]
        rows = [[float(text) if text else None for text in line.split(",")[:2]] for line in lines]
        counts = state["counts"]
        wrong = []
        if len(rows) != counts["successful"] + counts["failed"]:
            wrong.append(f"{len(rows)} rows, counts {counts}")
        if state["status"] != "dismissed" and len(rows) != points:
            wrong.append(f"{len(rows)} rows of {points}, {state['status']}")
        if counts["failed"] or (state["status"] == "failed"):
            wrong.append(f"failed: {counts}")
        stiffnesses = [row[0] for row in rows]
        if stiffnesses != sorted(set(stiffnesses)):
            wrong.append("points twice or out of order")
        # a cantilever; the critical load of the path is that of the axially soft column
        if any(abs(load / (math.pi ** 2 / 4 * stiffness) - 1) > 1e-3 for stiffness, load in rows):
            wrong.append("values that are wrong")
        return [f"{path} ({owner}, {points} points): {one}" for one in wrong]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--sweeps", type=int, default=100, help="of one owner at a time")
    parser.add_argument("--seconds", type=float, default=30)
    parser.add_argument("--workers", type=int, default=3)
    parser.add_argument("--kills", type=int, default=4)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    fleet = Cluster(arguments.program, 2, arguments.workers, ["--lease-s", "3", "--max-crashes", "100"])
    try:
        storm = Storm(fleet, arguments.sweeps, arguments.seed)
        for _ in range(arguments.kills):
            time.sleep(arguments.seconds / (arguments.kills + 1))
            victim = random.choice(fleet.workers)
            victim.kill()
            victim.start()
            storm.done["killed"] += 1
        time.sleep(arguments.seconds / (arguments.kills + 1))
        storm.stop()
        wrong = storm.check()
    finally:
        fleet.stop()
    print(", ".join(f"{name} {count}" for name, count in storm.done.items()))
    print(f"{len(storm.sweeps)} sweeps are there; wrong: {len(wrong)}")
    for one in wrong[:20]:
        print("  " + one)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
