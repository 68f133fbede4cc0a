#!/usr/bin/env python3
"""Checks that static analyses say where stability is lost.

  stable_rows.py BINARY [--count 20] [--seed 1] [--jobs 1] [--seconds 60] [--keep FOLDER]
  stable_rows.py BINARY --show SEED     the request of one frame and what is expected, nothing solved

Draws random frames with slender members (frames.py), computes axial forces and the lowest buckling load by exact stiffnesses
(buckling.py), and asks for equilibrium at several load factors, of which the last is below or above that load. Prints one line a
disagreement, then counts; ends with status 1 if there was one. Expected, with B the lowest buckling load:

  below        factors up to 0.9 B are all answered, with no negative eigenvalue, and the message says that every row is stable
  beyond       with a factor above 1.15 B the analysis fails with `beyond_critical_point` or `beyond_limit_point`; the detail and
               critical_points[] have the load factor; rows are those below it, `not_reached` the others
  rod          where a single rod with hinges buckles first, at Euler's load: within 1 % of it, and `member` names the rod
  straight     where no member bends or turns before, within 1 % of B
  follow       with analysis.unstable = "follow" all rows are answered, but for those beyond a limit point; rows above B have negative
               eigenvalues where a rod has buckled; warning `unstable`

A frame whose members bend under the load need not lose stability at B: its rows may stay stable while it yields more than its
linear solution does. It counts as `bent` if its largest displacement is over 1.3 times the linear one.
"""
import collections
import json
import pathlib
import random
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import buckling  # noqa: E402
import command_line  # noqa: E402
import frames  # noqa: E402

LOST = ("beyond_critical_point", "beyond_limit_point")
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
EULER = 0.01  # allowed relative distance of a told load factor from Euler's load of a rod
BENT = 1.3    # displacement over the linear one from which a frame counts as bent


class Case:
    """A frame with its loads scaled so that B is about 1, its load factors, and the rods that reach Euler's load at B."""

    def __init__(self, seed):
        rng = random.Random(seed)
        while True:
            self.kind, self.model = frames.draw(rng)
            try:
                load = buckling.Frame(self.model).first_load()
            except ValueError:
                continue
            if load < 1e9 and self.strain(load) < 2e-3:
                break
        size = load / 10 ** rng.uniform(-0.5, 0.5)
        for load in self.model["loads"]:
            load["force"] = [size * x for x in load["force"]]
        self.frame = buckling.Frame(self.model)
        self.load = self.frame.first_load()
        self.beyond = rng.random() < 0.65
        last = rng.uniform(1.2, 4) if self.beyond else rng.uniform(0.5, 0.9)
        self.factors = sorted(self.load * x for x in [0.01, last, *(rng.uniform(0.02, last) for _ in range(rng.randint(0, 3)))])
        self.rods = [m.name for m in self.frame.members if self.frame.euler(m) <= self.load * (1 + EULER)]

    def strain(self, factor):
        """Largest axial strain and slope at a load factor, by linear theory."""
        frame = buckling.Frame(self.model)
        return factor * max(max(abs(m.force) / m.ea for m in frame.members), max(m.turn for m in frame.members) / 10)

    def single_rod(self):
        """Whether one rod alone buckles first: no other motion loses its stiffness within 3 % above B."""
        return len(self.rods) == 1 and self.frame.losses(1.03 * self.load) == 1

    def request(self, follow=False):
        analysis = {"type": "static", "load_factors": self.factors, "output": {"states": "all", "points_per_member": 2}}
        if follow:
            analysis["unstable"] = "follow"
        return {"model": self.model, "analysis": analysis}

    def linear_displacement(self, factor):
        return factor * max(abs(x) for (_, c), x in zip(self.frame.index, self.frame.displacement) if c != "rotation")


def largest_displacement(state):
    return max(max(abs(x) for x in m["u"] + m["v"]) for m in state["members"].values())


def judge_low_row(case, document):
    """Axial forces of the first row against linear theory."""
    state = document["states"][0] if document["states"] else None
    if state is None:
        return ["gives no state"]
    factor = state["load_factor"]
    largest = max(abs(m.force) for m in case.frame.members) * factor
    for member in case.frame.members:
        given = state["members"][member.name]["axial_force"][0]
        if abs(given - factor * member.force) > 0.01 * largest:
            return [f"member {member.name}: N = {given:.4g} at factor {factor:.4g}, linear theory {factor * member.force:.4g}"]
    return []


def judge_rows(case, answer, told):
    """Rows are those asked for below the told load (all, if none is told), each stable; `not_reached` has the others."""
    static = answer.document.get("static", {})
    rows = static.get("load_factor", [])
    wanted = [f for f in case.factors if told is None or f < told * (1 - 1e-9)]
    found = []
    if len(rows) != len(wanted) or any(abs(a - b) > 1e-6 * b for a, b in zip(rows, wanted)):
        found.append(f"rows {rows}, wanted {wanted}")
    missing = [f for f in case.factors if f not in wanted]
    if len(answer.document.get("not_reached", [])) != len(missing):
        found.append(f"not_reached {answer.document.get('not_reached')}, wanted {missing}")
    if any(n != 0 for n in static.get("negative_eigenvalues", [])):
        found.append(f"negative eigenvalues {static['negative_eigenvalues']} in rows that are no warning")
    return found


def told_load(answer):
    """(load factor where stability was lost, member) of the last critical point; (None, None) without one."""
    points = answer.document.get("critical_points", [])
    if not points:
        return None, None
    return points[-1]["load_factor"], points[-1].get("member")


def judge_lost(case, answer):
    told, member = told_load(answer)
    if told is None:
        return ["no critical point is listed"]
    found = judge_rows(case, answer, told)
    numbers = [float(x) for x in re.findall(NUMBER, answer.detail())]
    if not any(abs(x - told) <= 0.01 * told for x in numbers):
        found.append(f"the detail does not have the load factor {told:.6g}")
    if case.frame.is_straight() and abs(told / case.load - 1) > EULER:
        found.append(f"stability lost at {told:.6g}, lowest buckling load {case.load:.6g}, no member bends or turns before")
    if told < 0.9 * case.load:
        found.append(f"stability lost at {told:.6g}, lowest buckling load {case.load:.6g}")
    if case.rods and abs(told / case.load - 1) > EULER:
        found.append(f"stability lost at {told:.6g}, Euler's load of {case.rods} at {case.load:.6g}")
    if case.single_rod() and member not in case.rods:
        found.append(f"names member {member}, {case.rods[0]} buckles")
    if member is not None and case.rods and member not in case.rods:
        found.append(f"names member {member}, {case.rods} buckle")
    return found


def judge(case, answer):
    """(outcome, complaints)"""
    code = answer.failure()
    if code in ("document", "timeout") or answer.document is None:
        return code, [f"{code} {answer.detail()[:150]}"]
    complaints = judge_low_row(case, answer.document)
    if code in LOST:
        return code, complaints + judge_lost(case, answer)
    if code:
        return code, complaints + [f"failed: {code}"]
    complaints += judge_rows(case, answer, None)
    if "stable" not in answer.document["summary"]["message"]:
        complaints.append("the message does not say that rows are stable")
    last = answer.document["states"][-1]
    if last["load_factor"] < 1.15 * case.load:
        return "answered", complaints
    grown = largest_displacement(last) / case.linear_displacement(last["load_factor"])
    if case.rods or grown < BENT:
        complaints.append(f"all rows are answered up to {last['load_factor']:.6g}, lowest buckling load {case.load:.6g}"
                          + (f" (Euler's load of {case.rods})" if case.rods else f"; displacement over linear {grown:.3g}"))
        return "answered", complaints
    return "bent", complaints


def judge_follow(case, answer):
    code = answer.failure()
    if code == "beyond_limit_point" and told_load(answer)[0] is not None:
        return []
    if code or answer.document is None:
        return [f"follow: {code} {answer.detail()[:100]}"]
    static = answer.document["static"]
    if len(static["load_factor"]) != len(case.factors):
        return [f"follow: {len(static['load_factor'])} rows of {len(case.factors)}"]
    counts = [n for f, n in zip(static["load_factor"], static["negative_eigenvalues"]) if f > 1.05 * case.load]
    if case.rods and not all(counts):
        return [f"follow: counts of negative eigenvalues above {case.load:.6g}: {counts}"]
    if any(static["negative_eigenvalues"]) and "unstable" not in answer.warnings():
        return ["follow: no warning `unstable`"]
    return []


def check(options, seed):
    """(case, outcome, complaints) of one frame."""
    case = Case(seed)
    answer = command_line.solve(options.binary, case.request(), options.seconds)
    outcome, complaints = judge(case, answer)
    if outcome in LOST:
        complaints = complaints + judge_follow(case, command_line.solve(options.binary, case.request(True), options.seconds))
    if complaints:
        command_line.keep(options.keep, str(seed), case.request())
    return case, outcome, complaints


def expectation(case):
    if not case.beyond:
        return "below"
    return "rod" if case.rods else "beyond"


def report(results):
    counts, wrong = collections.Counter(), 0
    for seed, (case, outcome, complaints) in results:
        counts[case.kind, expectation(case), outcome or "answered", "disagrees" if complaints else "agrees"] += 1
        wrong += bool(complaints)
        for complaint in complaints:
            print(f"seed {seed} {case.kind}, B = {case.load:.6g}, factors up to {case.factors[-1]:.4g}: {complaint}", flush=True)
    for key in sorted(counts):
        print(f"  {key[0]:11} {key[1]:7} {key[2]:22} {key[3]:10} {counts[key]}")
    print(f"{sum(counts.values())} frames; {wrong} disagree")
    return wrong


def main():
    parser = command_line.seeded_parser(__doc__, count=20, seconds=60.0)
    parser.add_argument("--keep")
    parser.add_argument("--show", type=int)
    options = parser.parse_args()
    if options.show is not None:
        case = Case(options.show)
        print(json.dumps(case.request(), indent=1))
        print(f"{case.kind}: B = {case.load:.8g}, rods at Euler's load {case.rods}, alone: {case.single_rod()}", file=sys.stderr)
        return 0
    seeds = range(options.seed, options.seed + options.count)
    return 1 if report(command_line.for_each(seeds, lambda n: check(options, n), options.jobs)) else 0


if __name__ == "__main__":
    sys.exit(main())
