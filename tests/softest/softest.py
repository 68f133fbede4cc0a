#!/usr/bin/env python3
"""Checks the load factor of least stiffness before the critical load (`summary.softest`) in series of structures.

  softest.py BINARY [--values 50] [--series TEXT...] [--plain 20] [--jobs 1] [--seconds 60] [--keep FOLDER] [--table]
  softest.py --list

A series (series.py) goes from a perfect structure, which bifurcates, to one that only bends more and more. The load to design
by is `softest.load_factor`; where there is none it is the critical load factor (a perfect structure has a path whose stiffness
falls to zero without a minimum). Prints one line a disagreement and a line for each series; ends with status 1 if there was one.

  jump       the load to design by changes by more than 2 % between neighbours of 50 values (in proportion with fewer), and one
             fifth of the way between them has more than half of that change (a steep but continuous series has a fifth)
  linear     it lies within 15 % of the lowest buckling load where stiffness_ratio < 0.1
  warning    `nearly_unstable` if and only if stiffness_ratio < 0.1 at a softest point below the critical load
  plain      no such warning for structures that lose stability by a plain limit point
--table writes parameter, load to design by, ratio, critical load and buckling load of each structure.
"""
import argparse
import os
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import command_line  # noqa: E402
import series  # noqa: E402

JUMP = 0.02       # relative change between neighbours of 50 values
VALUES = 50
LINEAR = 0.15     # relative distance from the buckling load
SOFT = 0.1        # stiffness ratio below which a structure is nearly unstable
PARTS = 5         # of the way between neighbours, where a jump is suspected
SAME = 1e-3       # relative distance within which a softest point is the critical point itself


class Reading:
    """What a structure was answered: critical load, softest point, warnings, and its lowest buckling load."""

    def __init__(self, options, name, model):
        request = {"model": model, "analysis": {"type": "critical", "output": {"states": "none"}}}
        answer = command_line.solve(options.binary, request, options.seconds)
        command_line.keep(options.keep, name, request)
        self.failure = answer.failure()
        summary = answer.document["summary"] if answer.document else {}
        self.critical = summary.get("critical_load_factor")
        self.kind = summary.get("critical_type")
        self.supported = "softest" in summary
        softest = summary.get("softest") or {}
        self.softest = softest.get("load_factor")
        self.ratio = softest.get("stiffness_ratio")
        self.warned = "nearly_unstable" in answer.warnings()
        request = {"model": model, "analysis": {"type": "buckling", "output": {"states": "none"}}}
        buckling = command_line.solve(options.binary, request, options.seconds).document or {}
        self.linear = (buckling.get("buckling", {}).get("load_factors") or [None])[0]

    def design(self):
        return self.critical if self.softest is None else self.softest

    def is_soft(self):
        """Whether there is a softest point below the critical point, with little stiffness."""
        before = self.softest is not None and (self.critical is None or self.softest < self.critical * (1 - SAME))
        return before and self.ratio < SOFT

    def row(self):
        values = (self.design(), self.ratio, self.critical, self.linear)
        return " ".join(f"{x:12.6g}" if x is not None else f"{'-':>12}" for x in values) + f" {self.kind} {self.failure}"


def complaints_of(reading):
    found = []
    if reading.failure:
        found.append(f"failed: {reading.failure}")
    if not reading.supported:
        found.append("summary has no softest")
    if reading.is_soft() and reading.linear and abs(reading.softest / reading.linear - 1) > LINEAR:
        found.append(f"linear: softest at {reading.softest:.6g}, ratio {reading.ratio:.3g}, buckling load {reading.linear:.6g}")
    if reading.is_soft() != reading.warned:
        found.append(f"warning: nearly_unstable {'given' if reading.warned else 'missing'}, ratio {reading.ratio}, softest "
                     f"{reading.softest}, critical {reading.critical}")
    return found


def change_between(left, right):
    """Relative change of the load to design by; 0 where one of them has none."""
    if left.design() is None or right.design() is None:
        return 0.0
    return abs(right.design() / left.design() - 1)


def is_jump(options, name, ends, readings):
    """Whether more than half of the change between two parameters lies in one fifth of the way."""
    build = series.all_series()[name][1]
    inner = [ends[0] + (ends[1] - ends[0]) * i / PARTS for i in range(1, PARTS)]
    row = [readings[0], *(Reading(options, f"{name}_{value:.8g}", build(value)) for value in inner), readings[1]]
    return max(map(change_between, row, row[1:])) > change_between(*readings) / 2


def check_series(options, name):
    """(rows for the table, complaints, one line about the series)"""
    parameters, build = series.all_series()[name]
    values = parameters(options.values)
    readings = [Reading(options, f"{name}_{i}", build(value)) for i, value in enumerate(values)]
    complaints = [f"{value:.4g}: {text}" for value, r in zip(values, readings) for text in complaints_of(r)]
    allowed = JUMP * max(1.0, VALUES / options.values)
    largest = 0.0
    for (a, left), (b, right) in zip(zip(values, readings), zip(values[1:], readings[1:])):
        change = change_between(left, right)
        largest = max(largest, change)
        if change > allowed and is_jump(options, name, (a, b), (left, right)):
            complaints.append(f"jump: {left.design():.6g} at {a:.4g}, {right.design():.6g} at {b:.4g} ({100 * change:.2g} %)")
    table = [f"    {value:10.4g} {r.row()}" for value, r in zip(values, readings)]
    soft = [r for r in readings if r.is_soft()]
    off = max([abs(r.softest / r.linear - 1) for r in soft if r.linear] + [0.0])
    line = (f"  largest change {100 * largest:.2g} %; {len(soft)} of {len(values)} nearly unstable, within {100 * off:.2g} % of the "
            "buckling load")
    return table, complaints, line


def check_plain(options, name):
    reading = Reading(options, name, series.plain_limits()[name])
    complaints = [f"plain: {text}" for text in complaints_of(reading) if not text.startswith("linear")]
    if reading.warned:
        complaints.append(f"plain: nearly_unstable at {reading.softest} (ratio {reading.ratio}), limit point at {reading.critical}")
    if not str(reading.kind).startswith("limit"):
        complaints.append(f"plain: the critical point is {reading.kind}, no limit point")
    return [f"    {reading.row()}"], complaints, "  plain limit point"


def check(options, task):
    kind, name = task
    return (check_series if kind == "series" else check_plain)(options, name)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", nargs="?")
    parser.add_argument("--values", type=int, default=VALUES)
    parser.add_argument("--series", nargs="*")
    parser.add_argument("--plain", type=int, default=20)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--keep")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--list", action="store_true")
    options = parser.parse_args()
    names = [n for n in series.all_series() if options.series is None or any(text in n for text in options.series)]
    tasks = [("series", n) for n in names] + [("plain", n) for n in list(series.plain_limits())[:options.plain]]
    if options.list:
        print("\n".join(name for _, name in tasks))
        return 0
    wrong = 0
    for (_, name), (table, complaints, line) in command_line.for_each(tasks, lambda task: check(options, task), options.jobs):
        print(name + line)
        for text in [f"    {text}" for text in complaints] + (table if options.table else []):
            print(text, flush=True)
        wrong += bool(complaints)
    print(f"{len(tasks)} series and structures; {wrong} disagree")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
