#!/usr/bin/env python3
"""Checks that a list of loads or frequencies has each value as often as it occurs.

  multiplicity.py BINARY [--count 40] [--seed 1] [--jobs 1] [--seconds 60] [--keep FOLDER] [--only USE...] [--parts TEXT...] [--verbose]
  multiplicity.py BINARY --show SEED      the request of one structure, nothing solved

Draws structures of 2 to 12 copies of a part (copies.py) and asks for 1 to 20 values. The values of the whole are those of the part,
found alone, divided by the factor of the copy's loads or masses, and each as often as there are copies. Structure n of a run has the
seed `--seed` + n. The uses:

  buckling, reversed   `buckling.load_factors`, and those of the opposite actions
  vibration            `vibrations[].frequencies`
  static, path         `frequencies` at load factors and at path points
  mode                 a `mode` imperfection of number n: displacements under a small load are those of the n-th buckling load
  critical             the first critical load and its multiplicity

Values agree within the accuracies of both analyses, or on equal meshes within 1e-6 (a thousand times what a search for
frequencies on a given mesh promises). Prints one line a disagreement, then counts; ends with status 1 if there was one. A list that
has the right count of each value, with errors up to 1e-4, is "imprecise"; a part alone is compared with closed forms (oracle.py).
"""
import argparse
import collections
import copy
import json
import os
import pathlib
import random
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import command_line  # noqa: E402
import copies  # noqa: E402

MESH = {"elements": 8, "order": 3}
SAME_MESH = 1e-6
IMPRECISE = 1e-4
AMPLITUDE = 1e-5   # of a mode imperfection over the size of the part
SOUTHWELL = 0.02   # error of the amplification by 1 / (1 - load / buckling load), from axial strains and the size of displacements
MODE_OF_PART = 3   # highest mode of an imperfection: the meshes of static analyses resolve three half waves
STATES = {"states": "none"}


class Case:
    """A structure, a use, and how it is computed."""

    def __init__(self, seed, options):
        rng = random.Random(seed)
        drawn = rng.choice(copies.PARTS)(rng)
        while options.parts and not any(text in drawn.kind for text in options.parts):
            drawn = rng.choice(copies.PARTS)(rng)
        self.seed = seed
        self.whole = copies.draw(rng, drawn)
        self.part = drawn
        self.use = rng.choice(self.uses())
        self.modes = rng.randint(1, 20)
        if self.use == "mode":
            self.modes = rng.randint(1, MODE_OF_PART * sum(count for count, _, _ in self.whole.groups))
        self.accuracy = None if rng.random() < 0.5 or self.use in ("static", "path") else rng.choice([1e-3, 1e-4, 1e-6])
        self.at_load = rng.random() < 0.5
        self.share = rng.uniform(0.1, 0.6)
        self.complaints = []

    def complain(self, whose, difference):
        if difference:
            self.complaints.append(f"{whose}: {difference}")

    def uses(self):
        """Braced columns sway under lateral forces alone: only their buckling follows from the parts."""
        return [use for use in self.part.uses if self.whole.join != "braced" or use in ("buckling", "critical")]

    def discretization(self):
        return {"accuracy": self.accuracy} if self.accuracy else MESH

    def tolerance(self):
        return 2 * self.accuracy + SAME_MESH if self.accuracy else SAME_MESH

    def request(self, model, analysis, accuracy=True):
        mesh = self.discretization() if accuracy else MESH
        return {"model": model, "analysis": {**analysis, "discretization": mesh, "output": {**STATES, **analysis.get("output", {})}}}

    def name(self):
        mesh = f"accuracy {self.accuracy:g}" if self.accuracy else "given mesh"
        return f"{self.use}, {self.modes} of {self.whole.describe()}, {mesh}"


class Refused(Exception):
    """An analysis of the whole, or of the part alone, that was not completed."""


class Solver:
    """Solves requests of one case; remembers the last request of the whole."""

    def __init__(self, binary, seconds):
        self.binary = binary
        self.seconds = seconds
        self.last = None

    def whole(self, request, allowed=()):
        self.last = request
        return self.solved(request, "", allowed)

    def part(self, request, allowed=()):
        return self.solved(request, "part alone ", allowed)

    def solved(self, request, whose, allowed):
        answer = command_line.solve(self.binary, request, self.seconds)
        code = answer.failure()
        if (code and code not in allowed) or not answer.document:
            raise Refused(f"{whose}{code}", " ".join((answer.detail() or "").split()))
        return answer


def loads_of(answer):
    return answer.document["buckling"]["load_factors"]


def buckling_of_part(case, solver, modes, reverse=False):
    """Loads of the part alone, which are all that it has where `fewer_modes` ends the list."""
    analysis = {"type": "buckling", "modes": modes, **({"reversed": True} if reverse else {})}
    alone = loads_of(solver.part(case.request(case.part.model, analysis), ("fewer_modes",)))
    if case.accuracy and case.part.exact_loads:
        exact = case.part.exact_loads(len(alone))
        strains = 2 * alone[-1] / case.part.model["sections"][0]["EA"]
        case.complain("part alone", lists_differ(alone, exact, len(alone), case.accuracy + strains))
    return alone


def expected_loads(case, solver, reverse=False):
    alone = buckling_of_part(case, solver, case.modes, reverse)
    return [sorted((load / loads for load in alone if sign * load > 0 for count, loads, _ in case.whole.groups for _ in range(count)), key=abs)
            for sign in ((1, -1) if reverse else (1,))]


def lists_differ(found, expected, asked, tolerance):
    """"" where the list has as many of the expected values as were asked for, each within the relative tolerance."""
    expected = expected[:asked]
    if len(found) != len(expected):
        return f"{len(found)} values for {len(expected)}: {shown(found)} for {shown(expected)}"
    errors = [abs(one - other) / abs(other) for one, other in zip(found, expected)]
    worst = max(errors, default=0.0)
    if worst <= tolerance:
        return ""
    if worst <= IMPRECISE:
        return f"imprecise: error {worst:.2g} in {shown(expected)}"
    return f"value {errors.index(worst) + 1}: {shown(found)} for {shown(expected)}"


def shown(values):
    """A list with equal neighbours counted."""
    groups = []
    for value in values:
        if groups and abs(value - groups[-1][0]) <= 1e-5 * abs(value):
            groups[-1][1] += 1
        else:
            groups.append([value, 1])
    return "[" + ", ".join(f"{value:.7g}" + (f" x {count}" if count > 1 else "") for value, count in groups) + "]"


def check_buckling(case, solver, reverse=False):
    expected = expected_loads(case, solver, reverse)
    analysis = {"type": "buckling", "modes": case.modes, **({"reversed": True} if reverse else {})}
    found = loads_of(solver.whole(case.request(case.whole.model, analysis), allowed(case, *expected)))
    signs = (1, -1) if reverse else (1,)
    parts = [[load for load in found if load * sign > 0] for sign in signs]
    return "; ".join(filter(None, (lists_differ(one, other, case.modes, case.tolerance()) for one, other in zip(parts, expected))))


def allowed(case, *expected):
    """A list may end with `fewer_modes` where there are fewer."""
    return ("fewer_modes",) if any(len(values) < case.modes for values in expected) else ()


def check_reversed(case, solver):
    return check_buckling(case, solver, reverse=True)


def first_load(case, solver):
    """The first buckling load of the whole; a load of 1 where it has none."""
    part = solver.part({"model": case.part.model, "analysis": {"type": "buckling", "discretization": MESH, "output": STATES}}, ("no_buckling",))
    return min((load / loads for load in loads_of(part) for _, loads, _ in case.whole.groups), default=1.0)


def squares(rows):
    return [None if row is None else row["omega_squared"] for row in rows]


def frequencies_of_part(case, solver, load_factors):
    """For each load factor of the whole the squares of all groups, sorted; the part is loaded by the factor of each group."""
    found = [[] for _ in load_factors]
    for count, loads, masses in case.whole.groups:
        factors = [loads * factor for factor in load_factors]
        request = case.request(case.part.model, {"type": "vibration", "modes": case.modes, "load_factors": factors})
        rows = solver.part(request, ("fewer_modes",)).document["vibrations"]
        if case.accuracy and case.part.exact_squares and factors[0] == 0.0:
            first = rows[0]["frequencies"]["omega_squared"]
            case.complain("part alone", lists_differ(first, case.part.exact_squares(len(first)), len(first), case.accuracy))
        if len(rows) != len(factors):
            raise Refused("part alone fewer rows", "")
        for values, row in zip(found, rows):
            values += [square / masses for square in row["frequencies"]["omega_squared"] for _ in range(count)]
    return [sorted(values) for values in found]


def rows_differ(case, load_factors, found, expected):
    for factor, one, other in zip(load_factors, found, expected):
        difference = "null" if one is None else lists_differ(one, other, case.modes, case.tolerance())
        if difference:
            return f"at load factor {factor:.6g}: {difference}"
    return "" if len(found) == len(expected) else f"{len(found)} rows for {len(expected)}"


def check_vibration(case, solver):
    factors = [0.0, case.share * first_load(case, solver)] if case.at_load else [0.0]
    expected = frequencies_of_part(case, solver, factors)
    request = case.request(case.whole.model, {"type": "vibration", "modes": case.modes, "load_factors": factors})
    rows = solver.whole(request, allowed(case, *expected)).document["vibrations"]
    return rows_differ(case, factors, squares(row["frequencies"] for row in rows), expected)


def check_static(case, solver):
    factors = [0.0, case.share * first_load(case, solver)]
    request = case.request(case.whole.model, {"type": "static", "load_factors": factors, "output": {"frequencies": case.modes}})
    found = solver.whole(request).document["static"]["frequencies"]
    return rows_differ(case, factors, squares(found), frequencies_of_part(case, solver, factors))


def check_path(case, solver):
    stop = {"load_factor": [-1.0, case.share * first_load(case, solver)]}
    request = case.request(case.whole.model, {"type": "path", "stop": stop, "output": {"frequencies": case.modes}})
    branch = solver.whole(request).document["branches"][0]
    rows = sorted({0, len(branch["load_factor"]) // 2, len(branch["load_factor"]) - 1})
    factors = [branch["load_factor"][row] for row in rows]
    return rows_differ(case, factors, [squares(branch["frequencies"])[row] for row in rows], frequencies_of_part(case, solver, factors))


def displacements(answer):
    """[[(u, v) of every place]] of each row, by member."""
    states = [answer.document["states"][number] for number in answer.document["static"]["state"]]
    return [[(u, v) for name in sorted(state["members"]) for u, v in zip(state["members"][name]["u"], state["members"][name]["v"])]
            for state in states]


def largest(fields, weights):
    """Largest length of the weighted sum of fields of displacements."""
    sums = ([sum(w * point[axis] for w, point in zip(weights, points)) for axis in (0, 1)] for points in zip(*fields))
    return max((x * x + y * y) ** 0.5 for x, y in sums)


def check_mode(case, solver):
    """Displacements w(f) = a f / (load - f) mode, with a the amplitude: their size at two load factors, and that both are one shape."""
    expected = expected_loads(case, solver)[0]
    if len(expected) < case.modes:
        return ""
    load, size = expected[case.modes - 1], AMPLITUDE * case.part.extent()
    factors = [0.3 * expected[0], 0.8 * expected[0]]
    analysis = {"type": "static", "load_factors": factors, "output": {"states": "all"}}
    imperfect = copy.deepcopy(case.whole.model)
    imperfect["imperfections"] = [{"type": "mode", "number": case.modes, "amplitude": size}]
    bent = displacements(solver.whole(case.request(imperfect, analysis)))
    straight = displacements(solver.solved(case.request(case.whole.model, analysis), "without imperfection ", ()))
    fields = [[(x - a, y - b) for (x, y), (a, b) in zip(one, other)] for one, other in zip(bent, straight)]
    right = [size * factor / (load - factor) for factor in factors]
    found = [largest([field], [1.0]) for field in fields]
    if any(abs(one - other) > SOUTHWELL * other for one, other in zip(found, right)):
        return f"displacements {found[0]:.5g}, {found[1]:.5g} for {right[0]:.5g}, {right[1]:.5g} of the load {load:.7g} in {shown(expected)}"
    if largest(fields, [1.0 / right[0], -1.0 / right[1]]) > SOUTHWELL:
        return "the imperfection has parts of modes of other loads"
    return ""


def check_critical(case, solver):
    """The first critical load. Copies with the smallest one count in its multiplicity, those close to it may."""
    analysis = {"type": "critical"}
    alone = solver.part(case.request(case.part.model, analysis)).document
    largest_load = max(loads for _, loads, _ in case.whole.groups)
    expected = alone["summary"]["critical_load_factor"] / largest_load
    document = solver.whole(case.request(case.whole.model, analysis)).document
    found = document["summary"]["critical_load_factor"]
    if found is None or abs(found - expected) > case.tolerance() * expected:
        return f"critical load factor {found} for {expected:.7g}"
    each = alone["critical_points"][0]["multiplicity"]
    least, most = (each * sum(count for count, loads, _ in case.whole.groups if loads >= largest_load * (1 - share))
                   for share in (0.0, 10 * case.tolerance()))
    multiplicity = document["critical_points"][0]["multiplicity"]
    return "" if least <= multiplicity <= most else f"multiplicity {multiplicity} for {least} to {most}"


def check(binary, seed, options):
    """(case, outcome for the counts, "" or what is wrong); None for a use that is left out"""
    case = Case(seed, options)
    if options.only and case.use not in options.only:
        return None
    solver = Solver(binary, options.seconds)
    try:
        complaint = globals()[f"check_{case.use}"](case, solver)
        complaint = "; ".join(filter(None, [*case.complaints, complaint]))
        outcome = "right" if not complaint else "imprecise" if "imprecise" in complaint else "wrong"
    except Refused as refused:
        outcome, complaint = f"refused: {refused.args[0]}", f"{refused.args[0]}: {refused.args[1][:160]}"
    if complaint and solver.last:
        command_line.keep(options.keep, f"multiplicity_{seed}_{case.use}", solver.last)
    return case, outcome, complaint


def report(results, verbose):
    """Prints disagreements and counts; the number of disagreements."""
    counts = collections.Counter()
    for seed, found in results:
        if found is None:
            continue
        case, outcome, complaint = found
        counts[case.use, outcome] += 1
        if complaint or verbose:
            print(f"seed {seed}: {case.name()}: {complaint or 'right'}", flush=True)
    for key in sorted(counts):
        print(f"  {key[0]:9} {key[1]:40} {counts[key]}")
    total, right = sum(counts.values()), sum(n for key, n in counts.items() if key[1] == "right")
    print(f"{total} structures, {total - right} disagree")
    return total - right if total else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary")
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--keep")
    parser.add_argument("--only", nargs="*")
    parser.add_argument("--parts", nargs="*")
    parser.add_argument("--verbose", action="store_true")
    parser.add_argument("--show", type=int)
    options = parser.parse_args()
    if options.show is not None:
        case = Case(options.show, options)
        print(json.dumps(case.whole.model, indent=1))
        print(case.name(), file=sys.stderr)
        return 0
    seeds = range(options.seed, options.seed + options.count)
    return 1 if report(command_line.for_each(seeds, lambda seed: check(options.binary, seed, options), options.jobs), options.verbose) else 0


if __name__ == "__main__":
    sys.exit(main())
