#!/usr/bin/env python3
"""Refined sweeps over two parameters against own solves: how far off is a value that is read between rows?

  tests/accuracy/charts.py SNAPTHROUGH [--families 12] [--points 500] [--seed 1]

A family is one of the gallery's charts over random parts of the ranges of its two parameters. Its surface is made with
`refine` within 1 %. Random points of it are interpolated by the Python client (clients/python, which shares no code
with the program) and solved on their own. Written: rows and solves of the surface, its curves and pieces, the largest
error, points more than 1 % off, and points at a jump, where there is no value between rows. Exit status 1 when more
than one of 500 points is off, or more than five are at a jump.
"""
import argparse
import json
import math
import pathlib
import random
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "clients" / "python"))
import snapthrough  # noqa: E402

CHARTS = ["column_between_walls", "portal", "tunnel_arch", "buried_pipe", "masonry_arch", "braced_bay", "film", "pile_clay",
          "column_between_walls", "portal", "tunnel_arch", "braced_bay"]
WITHIN = 0.01


def bounds(parameter):
    """(least, largest, whether logarithmic) of a chart's parameter."""
    if "values" in parameter:
        return min(parameter["values"]), max(parameter["values"]), False
    values = parameter["range"]
    return values["from"], values["to"], values.get("spacing") == "log"


def part_of(parameter, count, rng):
    """The parameter over a random part, at least half, of its range."""
    low, high, logarithmic = bounds(parameter)
    share = rng.uniform(0.5, 1.0)
    start = rng.uniform(0.0, 1.0 - share)
    place = (lambda t: low * (high / low) ** t) if logarithmic else (lambda t: low + t * (high - low))
    spacing = {"spacing": "log"} if logarithmic else {}
    whole = {"from": place(start), "to": place(start + share), "count": count, **spacing}
    return {"name": parameter["name"], "targets": parameter["targets"], "range": whole}


def family(name, rng):
    document = json.loads((ROOT / "examples" / "gallery" / "charts" / f"{name}.json").read_text(encoding="utf-8"))
    if len(document["parameters"]) == 1:  # the film: over its bending stiffness, too
        document["parameters"].insert(0, {"name": "EI", "targets": [{"pointer": "/model/sections/0/EI"}], "values": [0.5, 2.0]})
    outer, inner = document["parameters"]
    document["parameters"] = [part_of(outer, 5, rng), part_of(inner, 9, rng)]
    document["refine"] = {"output": document["outputs"][0], "within": WITHIN, "parameters": 2}
    return document


def sweep(program, document):
    done = subprocess.run([program, "sweep", "-"], input=json.dumps(document), capture_output=True, text=True, check=False)
    if done.returncode not in (0, 3):
        raise SystemExit(f"exit status {done.returncode}: {done.stderr}")
    return json.loads(done.stdout)


def solves(program, document, count, rng):
    """Random points of a family, and the output of each solved alone."""
    alone = {key: value for key, value in document.items() if key != "refine"} | {"design": "zip"}
    points = []
    for _ in range(count):
        point = []
        for parameter in document["parameters"]:
            low, high, logarithmic = bounds(parameter)
            t = rng.random()
            point.append(low * (high / low) ** t if logarithmic else low + t * (high - low))
        points.append(point)
    alone["parameters"] = [{"name": parameter["name"], "targets": parameter["targets"], "values": [point[i] for point in points]}
                           for i, parameter in enumerate(document["parameters"])]
    output = alone["outputs"].index(document["refine"]["output"])
    return points, [row[2 + output] for row in sweep(program, alone)["rows"]]


def measure(program, name, count, rng):
    """(points off, points at a jump) of a family; writes its row."""
    document = family(name, rng)
    start = time.monotonic()
    made = sweep(program, document)
    seconds = time.monotonic() - start
    rows = made["rows"]
    if rows[0][0] is None:
        print(f"| {name} | {rows[0][-1]['detail']} |", flush=True)
        return count, 0
    table = read(made, document)
    names = [parameter["name"] for parameter in document["parameters"]]
    largest, off, between = 0.0, 0, 0
    for point, found in zip(*solves(program, document, count, rng)):
        read_off = table.interpolated(dict(zip(names, point)))
        if read_off is None or found is None:
            between += 1
            continue
        error = abs(read_off / found - 1.0)
        largest, off = max(largest, error), off + (error > WITHIN)
    curves = len({row[0] for row in rows})
    pieces = 1 + max(row[-3] for row in rows)
    failed = sum(row[-1] is not None for row in rows)
    print(f"| {name} | {len(rows)} | {curves} | {pieces} | {failed} | {100 * largest:.2f} % | {off} | {between} | {seconds:.1f} s |",
          flush=True)
    return off, between


def read(made, document):
    """The client's table of what the program wrote."""
    path = pathlib.Path("/tmp") / f"charts_{id(made)}.json"
    path.write_text(json.dumps(made, indent=1), encoding="utf-8")  # on one line it would be taken for NDJSON
    try:
        return snapthrough.read_table(path, sweep=document)
    finally:
        path.unlink()


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("program")
    parser.add_argument("--families", type=int, default=12)
    parser.add_argument("--points", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    rng = random.Random(arguments.seed)
    print("| family | rows | curves | pieces | failed rows | largest error | off | at a jump | time |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |")
    wrong = False
    for i in range(arguments.families):
        off, between = measure(arguments.program, CHARTS[i % len(CHARTS)], arguments.points, rng)
        wrong = wrong or off > math.ceil(arguments.points / 500) or between > 5 * math.ceil(arguments.points / 500)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
