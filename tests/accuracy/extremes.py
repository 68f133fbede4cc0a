#!/usr/bin/env python3
"""Compares the extremes of random states with the largest of 20 001 values along each member.

  extremes.py BINARY [--count 300] [--seed 1] [--jobs 2]

The states are those of random_static.py. A state with 25 points a member is asked for its
extremes, the same state with 20 001 points for its values. An extreme has to be as large as each value, and as close to the
largest one as the distance of the points allows: both within 1e-6 of the largest magnitude of the kind in the structure. An
extreme may exceed the values where a kink or a jump lies between two points; then it is compared with the values beside it by
half the difference of these two. Forces that are rounding beside the loads are not compared.

Ends with status 1 where an extreme is off.
"""
import pathlib
import random
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE)]
import command_line  # noqa: E402
import random_static  # noqa: E402

ALLOWED = 1e-6
POINTS = 20001
FORCES = ("axial_force", "shear_force", "bending_moment")


def request_of(seed, points):
    rng = random.Random(seed)
    model = random_static.draw(rng)
    return {"model": model, "analysis": {"type": "static", "load_factors": [1.0], "discretization": {"accuracy": 1e-3},
                                         "output": {"states": "all", "points_per_member": points}}}


def lists_of(state):
    """Kind, name, places, values and printed extremes of each list of a state."""
    for name, member in state["members"].items():
        for kind in FORCES:
            yield kind, name, member["s"], member[kind], member["extremes"][kind]
        moved = [(u * u + v * v) ** 0.5 for u, v in zip(member["u"], member["v"])]
        yield "displacement", name, member["s"], moved, member["extremes"]["displacement"]
    for name, foundation in state["foundations"].items():
        yield "reaction", name, foundation["s"], foundation["reaction"], foundation["extremes"]


def off(peak, sign, s, values):
    """How far an extreme is from the largest value, a shortfall as a negative number."""
    i = max(range(len(values)), key=lambda k: sign * values[k])
    near = min(range(len(s)), key=lambda k: abs(s[k] - peak["s"]))
    beside = [values[k] for k in (near - 1, near, near + 1) if 0 <= k < len(values)]
    allowed = 0.5 * (max(beside) - min(beside))
    excess = sign * (peak["value"] - values[i])
    return excess, allowed


def one(options, seed):
    few, many = (command_line.solve(options.binary, request_of(seed, points), options.seconds) for points in (25, POINTS))
    if not few.document or not many.document or not few.document["states"] or not many.document["states"]:
        return None
    printed = {(kind, name): extremes for kind, name, _, _, extremes in lists_of(few.document["states"][-1])}
    largest, found = {}, []
    lists = list(lists_of(many.document["states"][-1]))
    for kind, _, _, values, _ in lists:
        largest[kind] = max(largest.get(kind, 0.0), max(map(abs, values)))
    loads = many.document["states"][-1]["loads"]
    rounding = 1e-12 * max(abs(loads["fx"]), abs(loads["fy"]))
    for kind, name, s, values, _ in lists:
        if kind in FORCES and largest[kind] <= rounding:
            continue
        for end, sign in (("min", -1), ("max", 1)):
            if end in printed[kind, name] and largest[kind] > 0:
                excess, allowed = off(printed[kind, name][end], sign, s, values)
                worst = -excess if excess < 0 else max(0.0, excess - allowed)
                found.append((worst / largest[kind], f"{kind} {end} of {name}"))
    coarse = 0.0
    for kind, name, _, values, _ in lists_of(few.document["states"][-1]):
        for fine in lists:
            if fine[:2] == (kind, name) and largest[kind] > 0:
                coarse = max(coarse, (max(map(abs, fine[3])) - max(map(abs, values))) / largest[kind])
    return (*max(found), coarse)


def main():
    options = command_line.seeded_parser(__doc__, count=300, seconds=240.0).parse_args()
    compared, missed, worst, samples = 0, 0, 0.0, 0.0
    seeds = range(options.seed, options.seed + options.count)
    for seed, found in command_line.for_each(seeds, lambda n: one(options, n), options.jobs):
        if found is None:
            continue
        compared += 1
        worst, samples = max(worst, found[0]), max(samples, found[2])
        if found[0] > ALLOWED:
            missed += 1
            print(f"seed {seed}: {found[1]} is {found[0]:.3g} off", flush=True)
    print(f"{compared} states, {missed} missed, largest error {worst:.3g}; the largest of 25 values is up to {samples:.3g} too small")
    return 1 if missed or 2 * compared < options.count else 0


if __name__ == "__main__":
    sys.exit(main())
