#!/usr/bin/env python3
"""The thinnest wall with which a buried pipe carries a wanted load, by Newton's method.

usage: pipe_wall.py build/release/snapthrough [wanted load factor]

Each analysis gives the critical load and its derivatives by A = t and I = t^3/12, so d load / d t, and with it
the next wall t. In the logarithms of load and wall the curve is nearly straight.
"""

import json
import math
import pathlib
import subprocess
import sys

CLOSE = 1e-6  # of the load


def analyse(program, request):
    """The first critical point."""
    run = subprocess.run([program, "solve", "-"], input=json.dumps(request), capture_output=True, text=True, check=True)
    return json.loads(run.stdout)["critical_points"][0]


def main():
    program = sys.argv[1]
    wanted = float(sys.argv[2]) if len(sys.argv) > 2 else 4.0
    request = json.loads(pathlib.Path(__file__).with_name("pipe_wall.json").read_text(encoding="utf-8"))
    section = request["model"]["sections"][0]
    wall = section["A"]
    for analyses in range(1, 11):
        section.update(A=wall, I=wall**3 / 12.0)
        point = analyse(program, request)
        load = point["load_factor"]
        print(f"analysis {analyses}: wall {1e3 * wall:.5f} mm, load factor {load:.7f}")
        if abs(load / wanted - 1.0) <= CLOSE:
            return 0
        by = {one["pointer"]: one["derivative"] for one in point["sensitivities"]}
        slope = by["/model/sections/0/A"] + by["/model/sections/0/I"] * wall**2 / 4.0
        wall *= math.exp(math.log(wanted / load) / (slope * wall / load))
    return 1


if __name__ == "__main__":
    sys.exit(main())
