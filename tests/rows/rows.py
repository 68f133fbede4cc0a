#!/usr/bin/env python3
"""Checks that each row of a static analysis is an equilibrium, whatever other rows are asked for.

  rows.py BINARY [--count 60] [--seed 1] [--jobs 2] [--seconds 20] [--keep FOLDER]
  rows.py BINARY --show SEED      the request of one structure, nothing solved

Draws random structures over rigid and stiff beds and stops (drawings.py). Prints one line a disagreement, then counts; ends with
status 1 if there was one. Expected:

  balance   actions and reactions of every row sum to zero: 1e-9 of the largest (balance.py)
  alone     a row equals the row that is asked for alone: 1e-6 of the largest displacement and reaction
  answered  where every row is answered with beds of stiffness 1e3 EI / span^4, it is with rigid and stiff ones
"""
import collections
import json
import pathlib
import random
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import balance  # noqa: E402
import command_line  # noqa: E402
import drawings  # noqa: E402

BALANCE = 1e-9
ALONE = 1e-6
INSIDE = "inside the rigid foundation"  # a support and a rigid bed contradict each other
#: losses of stability are answers of their own
LOST = ("beyond_critical_point", "beyond_limit_point", "constant_actions_limit", "not_held", "loose_part")


def fixed(request, elements):
    """The request on a mesh that does not depend on the rows."""
    request["analysis"]["discretization"] = {"elements": elements, "order": 3}
    return request


def judge_balance(request, answer):
    found = []
    for state in answer.document["states"]:
        left = balance.imbalance(request["model"], state, request["analysis"].get("geometry") == "linear")
        if left > BALANCE:
            found.append(f"row {state['load_factor']:.6g} is off balance by {left:.2g}")
    return found


def difference(model, one, other):
    """Largest difference of two states: displacements over the largest, reactions over the largest."""
    moved = [(a, b) for m in one["members"] for key in ("u", "v")
             for a, b in zip(one["members"][m][key], other["members"][m][key])]
    size = max(abs(a) for a, _ in moved)
    worst = max(abs(a - b) for a, b in moved) / size if size else 0.0
    here, there = (balance.reactions(model, state) for state in (one, other))
    force = max([abs(r[c]) for r in here for c in range(2)] + [balance.dead_force(model, one["load_factor"])[1]])
    apart = max((abs(a[c] - b[c]) for a, b in zip(here, there) for c in range(2)), default=0.0)
    return max(worst, apart / force if force else 0.0)


def judge_alone(drawing, request, answer, options, rng):
    states = answer.document["states"]
    if len(request["analysis"]["load_factors"]) < 2 or not states:
        return []
    state = rng.choice(states)
    alone = command_line.solve(options.binary, fixed(drawing.request([state["load_factor"]]), options.elements), options.seconds)
    if alone.failure() or not alone.document["states"]:
        return [f"row {state['load_factor']:.6g} is answered among others, alone: {alone.failure()} {alone.detail()[:100]}"]
    apart = difference(request["model"], state, alone.document["states"][0])
    return [f"row {state['load_factor']:.6g} differs by {apart:.2g} from itself alone"] if apart > ALONE else []


def check(options, seed):
    """(kind, outcome, complaints) of one structure."""
    rng = random.Random(seed)
    drawing = drawings.Drawing(rng)
    request = fixed(drawing.request(), options.elements)
    answer = command_line.solve(options.binary, request, options.seconds)
    code = answer.failure()
    complaints = []
    if answer.document is None:
        if drawing.rigid and INSIDE in answer.detail():
            return drawing, "enters_obstacle", []
        complaints = [f"{code} {answer.detail()[:200]}"]
    else:
        complaints += judge_balance(request, answer) + judge_alone(drawing, request, answer, options, rng)
    if code and code not in LOST:
        soft = command_line.solve(options.binary, fixed(drawing.request(soft=True), options.elements), options.seconds)
        if not soft.failure():
            complaints.append(f"{code} {answer.detail()[:150]}; the softer bed is answered")
    if complaints:
        command_line.keep(options.keep, str(seed), request)
    return drawing, code, complaints


def report(results):
    counts, wrong = collections.Counter(), 0
    for seed, (drawing, code, complaints) in results:
        counts[drawing.kind, code or "answered", "disagrees" if complaints else "agrees"] += 1
        wrong += bool(complaints)
        for complaint in complaints:
            print(f"seed {seed} {drawing.kind}{' rigid' if drawing.rigid else f' {drawing.over:.1g}'} "
                  f"gap {drawing.gap / drawing.span:.1g} {drawing.moves}: {complaint}", flush=True)
    for key in sorted(counts):
        print(f"  {key[0]:11} {key[1]:22} {key[2]:10} {counts[key]}")
    print(f"{sum(counts.values())} structures; {wrong} disagree")
    return wrong


def main():
    parser = command_line.seeded_parser(__doc__, count=60, seconds=20.0)
    parser.add_argument("--elements", type=int, default=8)
    parser.add_argument("--keep")
    parser.add_argument("--show", type=int)
    options = parser.parse_args()
    if options.show is not None:
        print(json.dumps(fixed(drawings.Drawing(random.Random(options.show)).request(), options.elements), indent=1))
        return 0
    seeds = range(options.seed, options.seed + options.count)
    return 1 if report(command_line.for_each(seeds, lambda n: check(options, n), options.jobs)) else 0


if __name__ == "__main__":
    sys.exit(main())
