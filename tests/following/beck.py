#!/usr/bin/env python3
"""Checks the flutter load of random cantilevers under following forces beside structures that the forces do not reach.

  beck.py BINARY [--count 100] [--seed 1] [--jobs 2] [--seconds 60]
  beck.py BINARY --show SEED      the request of one structure, nothing solved

Each structure has one to three of Beck's columns, of any length, stiffness, mass and direction, of which some carry a constant
following force too, and 0 to 12 members that are not joined to them: cantilevers and pinned struts that are up to 1e4 times softer,
with masses or (every other structure) some without. The load factor at which the first column flutters is the least of
(beta EI / L^2 - C) / P with Beck's beta = 20.0509536; EA L^2 / EI is 1e7 to 1e9, so that the columns' shortening changes it by less
than 2.1e-5. Checked are type, load (1e-3, and its own estimate with what the shortening changes) and that a static analysis at 0.97 and 1.03 of it
gives the first row and refuses the second (`beyond_critical_point`). Ends with status 1 where one is wrong or refused.
"""
import collections
import json
import math
import pathlib
import random
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent)]
import command_line  # noqa: E402

BETA = 20.0509536  # Beck 1952: cos and cosh of the two roots of the frequency equation coincide
# Tolerance: a column shortens by P / EA, which changes its load by twice that share. EA L2 / EI is 1e7 at the softest
# column. Only the growing part of the force is compared, which is at least a fifth of it.
SHORTENING = 2 * BETA / 1e7 / (1 - 0.8)


class Drawing:
    def __init__(self, rng):
        self.rng = rng
        self.model = {"nodes": [], "sections": [], "members": [], "supports": [], "loads": []}
        self.loads = []
        self.massless = rng.random() < 0.5
        for n in range(rng.randint(1, 3)):
            self.column(n)
        for n in range(rng.randint(0, 12)):
            self.other(n)

    def member(self, name, stiff, length, mass):
        rng = self.rng
        x, y, angle = rng.uniform(0, 50), rng.uniform(0, 50), rng.uniform(0, 2 * math.pi)
        along = [math.cos(angle), math.sin(angle)]
        self.model["nodes"] += [{"id": f"{name}a", "x": x, "y": y}, {"id": f"{name}b", "x": x + length * along[0], "y": y + length * along[1]}]
        section = {"id": name, "EA": stiff / length ** 2 * 10 ** rng.uniform(7, 9), "EI": stiff}
        if mass:
            section["mass"] = mass
        self.model["sections"].append(section)
        self.model["members"].append({"id": name, "start": f"{name}a", "end": f"{name}b", "section": name})
        return along

    def column(self, n):
        rng, name = self.rng, f"beck{n}"
        length, stiff = 10 ** rng.uniform(-0.3, 0.7), 10 ** rng.uniform(0, 2)
        along = self.member(name, stiff, length, 10 ** rng.uniform(-2, 1))
        self.model["supports"].append({"node": f"{name}a", "fixed": ["x", "y", "rotation"]})
        limit = BETA * stiff / length ** 2
        force = limit * 10 ** rng.uniform(-2, 0)
        constant = limit * rng.uniform(0.1, 0.8) if rng.random() < 0.3 else 0.0
        for size, pattern in ((force, "proportional"), (constant, "constant")):
            if size:
                self.model["loads"].append({"type": "point", "at": {"node": f"{name}b"}, "force": [-size * along[0], -size * along[1]],
                                            "follows": True, "pattern": pattern})
        self.loads.append((limit - constant) / force)

    def other(self, n):
        rng, name = self.rng, f"soft{n}"
        mass = 0.0 if self.massless and rng.random() < 0.3 else 10 ** rng.uniform(-2, 1)
        self.member(name, 10 ** rng.uniform(-4, 0), 10 ** rng.uniform(-0.3, 0.7), mass)
        if rng.random() < 0.6:
            self.model["supports"].append({"node": f"{name}a", "fixed": ["x", "y", "rotation"]})
        else:
            self.model["supports"] += [{"node": f"{name}a", "fixed": ["x", "y"]}, {"node": f"{name}b", "fixed": ["x", "y"]}]

    def request(self, analysis):
        return {"model": self.model, "analysis": analysis}


def check(options, seed):
    rng = random.Random(seed)
    drawing = Drawing(rng)
    limit = min(drawing.loads)
    kind = rng.choice(("critical", "path"))
    analysis = {"type": kind} if kind == "critical" else {"type": kind, "stop": {"load_factor": [-0.01 * limit, 1.2 * limit]}}
    answer = command_line.solve(options.binary, drawing.request(analysis), options.seconds)
    found = []
    if answer.failure():
        found.append(f"{kind}: {answer.failure()} {answer.detail()[:150]}, right {limit:.6g}")
    else:
        summary = answer.document["summary"]
        load, estimate = summary["critical_load_factor"], summary["error_estimate"] or 0.0
        if load is None or summary["critical_type"] != "flutter":
            found.append(f"{kind}: {summary['critical_type']} at {load}, right: flutter at {limit:.6g}")
        elif abs(load - limit) > min(1e-3, estimate + SHORTENING) * limit:
            found.append(f"{kind}: {load:.7g}, estimate {estimate:.2g}, right {limit:.7g}")
    factors = [0.97 * limit, 1.03 * limit]
    rows = command_line.solve(options.binary, drawing.request({"type": "static", "load_factors": factors}), options.seconds)
    given = len(rows.document["static"]["load_factor"]) if rows.document else 0
    if (given, rows.failure()) != (1, "beyond_critical_point"):
        found.append(f"static at 0.97 and 1.03 of it: {given} rows, {rows.failure() or 'no failure'}; right: the first, and beyond_critical_point")
    return len(drawing.model["members"]), found


def main():
    parser = command_line.seeded_parser(__doc__, count=100, seconds=60.0)
    parser.add_argument("--show", type=int)
    options = parser.parse_args()
    if options.show is not None:
        print(json.dumps(Drawing(random.Random(options.show)).request({"type": "critical"}), indent=1))
        return 0
    counts = collections.Counter()
    for seed, (members, found) in command_line.for_each(range(options.seed, options.seed + options.count), lambda n: check(options, n), options.jobs):
        counts["wrong or refused" if found else "right"] += 1
        for sentence in found:
            print(f"seed {seed}, {members} members: {sentence}", flush=True)
    print(", ".join(f"{key} {count}" for key, count in sorted(counts.items())))
    return 1 if counts["wrong or refused"] else 0


if __name__ == "__main__":
    sys.exit(main())
