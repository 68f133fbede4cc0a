#!/usr/bin/env python3
"""Compares the rows of paths, and the cubics through them, with 2 000 corrected points of the same paths.

  path_rows.py BINARY [--count 40] [--seed 1] [--jobs 2] [--seconds 300] [--only NAME]

The paths are those of the examples, each with its numbers as they are and then with stiffnesses and gaps multiplied by random
factors. For each branch and each monitor the distance of a point from a curve is measured in the plane of the load factor over the
monitor, both over their ranges. The reference is the same analysis with `output.path_points`: each of its points is an equilibrium.

Prints for each path: rows and computed rows, factorisations with and without the added rows, and the largest distance of the
reference's points from straight lines between the rows and from the cubics. Ends with status 1 where a line is 1 % off or a cubic
0.2 %, and where fewer than half of the paths could be compared.
"""
import copy
import json
import math
import pathlib
import random
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent)]
import command_line  # noqa: E402

LINE, CUBIC = 0.01, 0.002
POINTS = 2000


def cubic(s, values, rates, parts):
    """Points of the piecewise cubic through values with rates at s."""
    out = [values[0]]
    for i in range(len(s) - 1):
        h = s[i + 1] - s[i]
        for k in range(1, parts + 1):
            t = k / parts
            out.append((1 + 2 * t) * (1 - t) ** 2 * values[i] + t * t * (3 - 2 * t) * values[i + 1]
                       + h * t * (1 - t) ** 2 * rates[i] + h * t * t * (t - 1) * rates[i + 1])
    return out


def distance(point, line):
    """Distance of a point from a polyline."""
    best = math.inf
    px, py = point
    for (ax, ay), (bx, by) in zip(line, line[1:]):
        dx, dy = bx - ax, by - ay
        length = dx * dx + dy * dy
        t = 0.0 if length == 0 else min(1.0, max(0.0, ((px - ax) * dx + (py - ay) * dy) / length))
        best = min(best, math.hypot(px - ax - t * dx, py - ay - t * dy))
    return best


def off(points, line):
    """Largest distance of points from a polyline, each looked for near the place of the point before."""
    worst, at = 0.0, 0
    for point in points:
        low, high = max(0, at - 40), min(len(line), at + 120)
        near = [math.hypot(x - point[0], y - point[1]) for x, y in line[low:high]]
        at = low + near.index(min(near))
        away = distance(point, line[max(0, at - 3):at + 4])
        worst = max(worst, away if away < CUBIC / 10 else distance(point, line))
    return worst


def compare(rows, reference, least):
    """Largest distances of a branch's reference from the lines and from the cubics of its rows, over all monitors.

    least: a displacement that only rounding makes
    """
    lines, cubics = 0.0, 0.0
    load = reference["load_factor"]
    tall = max(load) - min(load) or 1.0
    for name, values in reference["monitors"].items():
        wide = max(values) - min(values)
        if wide <= least:
            continue
        points = [(x / wide, y / tall) for x, y in zip(values, load)]
        lines = max(lines, off(points, [(x / wide, y / tall) for x, y in zip(rows["monitors"][name], rows["load_factor"])]))
        curve = zip(cubic(rows["arc_length"], rows["monitors"][name], rows["rates"]["monitors"][name], 16),
                    cubic(rows["arc_length"], rows["load_factor"], rows["rates"]["load_factor"], 16))
        cubics = max(cubics, off(points, [(x / wide, y / tall) for x, y in curve]))
    return lines, cubics


def varied(request, rng):
    """The request with stiffnesses and gaps times random factors."""
    request = copy.deepcopy(request)

    def walk(value):
        if isinstance(value, dict):
            for key, item in value.items():
                if key in ("EI", "stiffness", "gap") and isinstance(item, (int, float)):
                    value[key] = item * 10 ** rng.uniform(-0.5, 0.5)
                else:
                    walk(item)
        elif isinstance(value, list):
            for item in value:
                walk(item)

    walk(request["model"])
    return request


def requests(rng, count):
    """Named requests of paths: the examples, then variations of them."""
    root = HERE.parent.parent / "examples"
    found = []
    for file in sorted(root.glob("*.json")) + sorted(root.glob("gallery/*.json")):
        request = json.loads(file.read_text(encoding="utf-8"))
        if "model" in request and request.get("analysis", {}).get("type") == "path" and request["model"].get("monitors"):
            request["analysis"]["output"] = {}
            found.append((file.stem, request))
    out = found[:count]
    while len(out) < count:
        name, request = rng.choice(found)
        out.append((f"{name} varied {len(out)}", varied(request, rng)))
    return out


def with_points(request, points):
    request = copy.deepcopy(request)
    request["analysis"]["output"]["path_points"] = points
    return request


def one(options, request):
    """Counts and distances of a path, or None and the reason."""
    rows = command_line.solve(options.binary, request, options.seconds)
    if not rows.document or not rows.document["branches"]:
        return None, rows.failure()
    plain = command_line.solve(options.binary, with_points(request, 2), options.seconds)
    reference = command_line.solve(options.binary, with_points(request, POINTS), 4 * options.seconds)
    if not plain.document or not reference.document:
        return None, "no reference"
    worst, count, computed = (0.0, 0.0), 0, 0
    places = [abs(node[axis]) for node in request["model"]["nodes"] for axis in ("x", "y")]
    least = 1e-9 * max(places)
    for mine, other in zip(rows.document["branches"], reference.document["branches"]):
        if len(other["load_factor"]) > 1:
            worst = tuple(map(max, worst, compare(mine, other, least)))
        count += len(mine["load_factor"])
        computed += len(mine["computed"])
    before = sum(len(branch["load_factor"]) for branch in plain.document["branches"])
    work = [answer.document["diagnostics"]["factorizations"] for answer in (plain, rows)]
    return (before, count, computed, *work, *worst), rows.failure()


def main():
    parser = command_line.seeded_parser(__doc__, count=40, seconds=300.0)
    parser.add_argument("--only", default="", help="paths whose name contains this text")
    options = parser.parse_args()
    cases = [case for case in requests(random.Random(options.seed), options.count) if options.only in case[0]]
    print("| path | rows without | rows | computed | factorisations without | with | lines off, % | cubics off, % |")
    print("| --- | --- | --- | --- | --- | --- | --- | --- |")
    missed, compared = [], 0
    for case, (found, failure) in command_line.for_each(cases, lambda case: one(options, case[1]), options.jobs):
        name = case[0]
        if found is None:
            print(f"| {name} | {failure} | | | | | | |", flush=True)
            continue
        compared += 1
        before, rows, computed, plain, work, lines, cubics = found
        print(f"| {name} | {before} | {rows} | {computed} | {plain} | {work} | {100 * lines:.3f} | {100 * cubics:.3f} |", flush=True)
        if lines > LINE or cubics > CUBIC:
            missed.append(name)
    print(f"{compared} of {len(cases)} compared, {len(missed)} missed: {', '.join(missed)}")
    return 1 if missed or 2 * compared < len(cases) else 0


if __name__ == "__main__":
    sys.exit(main())
