#!/usr/bin/env python3
"""Looks for critical points that the steps of a path hide.

  pairs.py BINARY [--count 400] [--range 1e4 3e5] [--accuracy 1e-3 1e-6] [--half-angle 10 14 28]
           [--stiffness 1e5 1e6 1e7] [--reaction bilateral compression_only] [--keep FOLDER]

Pinned arches of half angle A under a crown load, with a base inside: EI = R = 1, EA = EA R^2/EI, base stiffness
k = K R^4/EI in COUNT values, evenly in log k. Each path is followed with the steps that the program chooses and
with steps a tenth of their median; number, kinds and loads of the critical points must be equal. Along k they
change only where two points meet: a value that differs from both of its neighbours, which agree, is told as "lonely".
Prints each difference and where the kinds change along k, and ends with status 1 if there were differences.
"""
import argparse
import collections
import copy
import itertools
import statistics
import sys

import program
import structures

LOADS = (-1000.0, 250.0)  # the first losses of stability are below 110
STEPS = 20000


def request_of(model, accuracy):
    return {"model": model,
            "analysis": {"type": "path", "discretization": {"accuracy": accuracy},
                         "stop": {"limit_points": 2, "load_factor": list(LOADS), "steps": STEPS},
                         "output": {"states": "none"}}}


def with_short_steps(binary, request, way):
    """The request with steps of at most a tenth of the median step of `way`; None without a path to measure."""
    probe = copy.deepcopy(request)
    probe["analysis"]["step"] = {"initial": 1e-3, "max": 1e-3}
    probe["analysis"]["stop"] = {"steps": 4}
    answer = binary.solve(probe)
    if answer.document is None or not way or not answer.way():
        return None
    unit = max(answer.way()) / 1e-3
    longest = statistics.median(way) / 10 / unit
    short = copy.deepcopy(request)
    short["analysis"]["step"] = {"initial": longest, "max": longest}
    return short


def values(low, high, count):
    return [low * (high / low) ** (i / max(1, count - 1)) for i in range(count)]


def follow_family(binary, arguments, family, tally):
    """Follows the arches of one family over all k; returns [(k, answer, answer with short steps)]."""
    half_angle, axial, reaction, accuracy = family
    rows = []
    for k in values(*arguments.range, arguments.count):
        model = structures.off_axis(structures.arch(half_angle, axial, k=k, reaction=reaction))
        request = request_of(model, accuracy)
        answer = binary.solve(request)
        short = with_short_steps(binary, request, answer.way() if answer.document else [])
        fine = binary.solve(short) if short else answer
        tally["paths"] += 1
        tally[answer.failure or "complete"] += 1
        if fine.failure:
            tally["short steps: " + fine.failure] += 1
        if not program.same(answer, fine, accuracy, accuracy):
            tally["differences"] += 1
            name = f"pair_{half_angle:g}_{axial:g}_{reaction}_{k:.6g}_{accuracy:g}"
            print(f"  differs  {name}\n    as chosen: {answer}\n    a tenth:   {fine}", flush=True)
            program.keep(arguments.keep, name, request)
        rows.append((k, answer, fine))
    return rows


def tell_changes(rows, tally):
    """Where kinds change along k, and the values that differ from two neighbours that agree."""
    groups = [(signature, list(run)) for signature, run in itertools.groupby(rows, lambda row: row[1].signature())]
    for number, (signature, run) in enumerate(groups):
        inside = 0 < number < len(groups) - 1
        lonely = inside and len(run) == 1 and groups[number - 1][0] == groups[number + 1][0]
        tally["lonely"] += lonely
        kinds = ", ".join(signature[1]) or "none"
        note = "   <- lonely" if lonely else ""
        print(f"  k {run[0][0]:.6g} to {run[-1][0]:.6g}: {signature[0]} {kinds}{note}", flush=True)


def read_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary")
    parser.add_argument("--count", type=int, default=400)
    parser.add_argument("--range", type=float, nargs=2, default=[1e4, 3e5])
    parser.add_argument("--accuracy", type=float, nargs="+", default=[1e-3, 1e-6])
    parser.add_argument("--half-angle", type=float, nargs="+", default=[10, 14, 28])
    parser.add_argument("--stiffness", type=float, nargs="+", default=[1e5, 1e6, 1e7])
    parser.add_argument("--reaction", nargs="+", default=["bilateral", "compression_only"])
    parser.add_argument("--keep", help="folder for the requests of differences")
    return parser.parse_args()


def main():
    arguments = read_arguments()
    binary = program.Program(arguments.binary)
    tally = collections.Counter()
    for family in itertools.product(arguments.half_angle, arguments.stiffness, arguments.reaction,
                                    arguments.accuracy):
        print("half angle {:g}, EA R^2/EI {:g}, {}, accuracy {:g}".format(*family), flush=True)
        tell_changes(follow_family(binary, arguments, family, tally), tally)
    counts = ", ".join(f"{name} {count}" for name, count in sorted(tally.items()) if name != "paths")
    print(f"pairs: {tally['differences']} differences in {tally['paths']} paths; {counts}")
    sys.exit(1 if tally["differences"] else 0)


if __name__ == "__main__":
    main()
