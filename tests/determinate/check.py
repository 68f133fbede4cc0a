#!/usr/bin/env python3
"""Checks statically determinate structures that are strained and settled: no forces, displacements by kinematics.

  check.py BINARY [--count 500] [--seed 1] [--jobs 2] [--keep FOLDER]

Draws random structures (draw.py): trees of 2 to 12 members, straight and arcs, clamped, simply supported, on rollers at any
angle, three-hinged and with hinged parts; EA l^2/EI from 1e2 to 1e10; uniform axial strains and curvatures, settlements and
rotations of supports, proportional and constant; large and small displacements. Of each it checks, in every state that a
static analysis returns,

  - forces: below 1e-9 of the softest EI over the square of the size times what is imposed, which is less than 1e-9 of EA times
    that; moments below that times the size;
  - displacements: exact kinematics (kinematics.py) within 1e-10 of the size, and of a radian;
  - continuity: with an extra load at a node, 1e-15 to 1e-3 of EA times what is imposed (no more than 1e-3 of the softest EI
    over the square of the size, beyond which displacements are not in proportion to it), the change of displacements
    is in proportion to the load;
  - buckling: no load factor makes a structure without forces buckle.

Prints a line a failure and a last line with the worst figures: force/(EA e), force/(EI e/l^2), displacement and jump (that of
displacements from proportion to an extra load) over the size. Ends with status 1 if a structure failed. A line has the seed of
its structure: --seed S --count 1 draws it again.
"""
import argparse
import concurrent.futures
import json
import math
import pathlib
import random
import subprocess
import sys

from draw import Case

SECONDS = 300  # of one analysis, which takes some milliseconds
FORCE = 1e-9
DISPLACEMENT = 1e-10
LOADS = 7  # sizes of the extra load
LEAST_LOAD, LARGEST_LOAD = 1e-15, 1e-3  # of EA times what is imposed
SPREAD = 1e-6  # the least extra load over the largest, at most
LARGEST_PROPORTIONAL = 1e-3  # of the softest EI over the square of the size
# Displacement that is not in proportion to a load, over the square of the one that is, both over the size: the second order of
# chains of twelve members
SECOND_ORDER = 1e3


def solve(binary, request):
    """(result, None) or (None, what went wrong)."""
    done = subprocess.run([binary, "solve", "-"], input=json.dumps(request), capture_output=True, text=True,
                          timeout=SECONDS)
    if done.returncode != 0:
        text = done.stderr.strip().splitlines()
        try:
            text = [json.loads(done.stdout)["failure"]["detail"]]
        except (ValueError, KeyError, TypeError):
            pass
        return None, f"exit status {done.returncode}: {text[-1] if text else ''}"
    result = json.loads(done.stdout)
    if result.get("failure"):
        return None, str(result["failure"])
    return result, None


class Figures:
    """Worst figures of checks."""

    def __init__(self):
        self.worst = {}

    def note(self, name, value):
        self.worst[name] = max(self.worst.get(name, 0.0), value)
        return value

    def merge(self, other):
        for name, value in other.worst.items():
            self.note(name, value)

    def text(self):
        return ", ".join(f"{name} {value:.1e}" for name, value in sorted(self.worst.items()))


def forces(state, size):
    """Largest force, and moment over the size, of members and supports."""
    out = 0.0
    for member in state["members"].values():
        for name, unit in (("axial_force", 1.0), ("shear_force", 1.0), ("bending_moment", size)):
            out = max(out, max(map(abs, member[name])) / unit)
    for support in state["supports"].values():
        out = max([out, abs(support["fx"]), abs(support["fy"]), abs(support["moment"]) / size])
    return out


def displacements(state, size):
    """Of each member and point (u over the size, v over the size, rotation), in one list."""
    out = []
    for name in sorted(state["members"]):
        member = state["members"][name]
        for u, v, rotation in zip(member["u"], member["v"], member["rotation"]):
            out += [u / size, v / size, rotation]
    return out


def exact(case, factor):
    size = case.structure.size
    return [value for name in sorted(case.exact[factor]) for u, v, rotation in case.exact[factor][name]
            for value in (u / size, v / size, rotation)]


def largest_difference(a, b):
    return max(abs(x - y) for x, y in zip(a, b))


def check_state(case, state, figures, findings):
    size = case.structure.size
    force = forces(state, size)
    figures.note("force/(EA e)", force / case.axial_scale())
    if figures.note("force/(EI e/l^2)", force / case.bending_scale()) > FORCE:
        findings.append(f"force {force:.3g} is {force / case.axial_scale():.1e} of EA e, "
                        f"{force / case.bending_scale():.1e} of EI e/l^2")
    missed = largest_difference(displacements(state, size), exact(case, state["load_factor"]))
    figures.note("displacement", missed)
    if missed > DISPLACEMENT:
        findings.append(f"displacement off by {missed:.2e} of the size at load factor {state['load_factor']:g}")


def check_continuity(binary, case, draw, figures, findings):
    """The extra load acts at load factor 1, at a node in a direction."""
    size = case.structure.size
    node = draw.choice(sorted(case.structure.places))
    angle = draw.uniform(-math.pi, math.pi)
    largest = min(LARGEST_LOAD * case.axial_scale(), LARGEST_PROPORTIONAL * case.softest())
    least = min(LEAST_LOAD * case.axial_scale(), SPREAD * largest)
    pattern = draw.choice(["proportional", "constant"])
    base = exact(case, 1.0)
    rates = []
    for k in range(LOADS):
        load = largest * (least / largest) ** (k / (LOADS - 1))
        force = load * math.cos(angle), load * math.sin(angle)
        result, failure = solve(binary, case.request((node, force, pattern)))
        if failure:
            findings.append(f"{told(case, load, node)}: {failure}")
            continue
        state = next(one for one in result["states"] if one["load_factor"] == 1.0)
        change = [a - b for a, b in zip(displacements(state, size), base)]
        rates.append((load, [value / load for value in change]))
    if len(rates) < 2:
        return
    # the rate of the largest load has the least rounding
    top, rate = rates[0]
    moved = max(map(abs, rate)) * top
    for load, other in rates[1:]:
        # the rate of the largest load is off by its second order
        jump = max(0.0, largest_difference(rate, other) * load - SECOND_ORDER * moved * moved * load / top)
        if figures.note("jump", jump) > 2 * DISPLACEMENT:
            findings.append(f"{told(case, load, node)}: displacements jump by {jump:.1e} of the size")


def told(case, load, node):
    return f"extra load {load / case.axial_scale():.1e} of EA e at {node}"


def check_buckling(binary, case, findings):
    request = case.request()
    if not case.has_proportional():
        return
    request["analysis"] = {"type": "buckling"}
    result, failure = solve(binary, request)
    if failure or result["summary"]["termination"] != "no_buckling":
        findings.append(f"buckling: {failure or result['summary']['message']}")


def check(binary, seed, keep):
    draw = random.Random(seed)
    case = Case(seed, draw)
    figures, findings = Figures(), []
    result, failure = solve(binary, case.request())
    if failure:
        findings.append(failure)
    else:
        if sorted(state["load_factor"] for state in result["states"]) != sorted(case.factors):
            findings.append("states are missing")
        if any(count != 0 for count in result["static"]["negative_eigenvalues"]):
            findings.append("negative eigenvalues without forces")
        for state in result["states"]:
            check_state(case, state, figures, findings)
    check_continuity(binary, case, draw, figures, findings)
    check_buckling(binary, case, findings)
    if findings and keep:
        keep.mkdir(parents=True, exist_ok=True)
        (keep / f"determinate_{seed}.json").write_text(json.dumps(case.request(), indent=1))
    return seed, findings, figures


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary")
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--keep", type=pathlib.Path)
    arguments = parser.parse_args()
    seeds = range(arguments.seed, arguments.seed + arguments.count)
    total = Figures()
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for seed, findings, figures in pool.map(lambda one: check(arguments.binary, one, arguments.keep), seeds):
            total.merge(figures)
            failed += bool(findings)
            for finding in findings:
                print(f"seed {seed}: {finding}", flush=True)
    print(f"{arguments.count} structures, {failed} failed; worst: {total.text()}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
