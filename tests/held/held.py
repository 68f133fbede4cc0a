#!/usr/bin/env python3
"""Checks that loads which one-sided supports can't carry are refused, and no others.

  held.py BINARY [--count 60] [--seed 1] [--jobs 1] [--seconds 60] [--keep FOLDER] [--only KIND...] [--verbose]
  held.py BINARY --show SEED         the request of one structure and what is expected, nothing solved
  held.py --file REQUEST.json...     the decision for requests (lines and arcs only), nothing solved

Draws random structures on one-sided supports (drawings.py), decides by Fichera's condition whether they are held (fichera.py)
and asks the program for a linear and a nonlinear static analysis, a path of five steps, the critical load and the buckling load.
Structure n of a run has the seed `--seed` + n. Prints one line a disagreement, then counts; ends with status 1 if there was one.

Expected, with constant loads C and proportional loads P:
  static at factor f   fails with `not_held` if and only if C + f P is not held
  path, critical       the same for C + a small share of P
  buckling             the same; its load is at most the largest factor up to which C + f P is held, or a warning says so, or the
                       analysis is refused with that factor
A nonlinear static analysis may also be refused where C + f P is held, but not C + a small share of P, with which its path begins.
A buckling analysis linearises about C + P: where that is not held it may fail, too, or say `mechanism` where a motion stays free
both ways, which only the loads may stiffen. A refusal names a motion of the cone K on which the loads do work. On a held structure
`no_start`, `loose_part` and `mechanism` are disagreements; other failures are counted. Structures within 1e-6 of the limit are left
out.
"""
import argparse
import collections
import copy
import json
import math
import os
import pathlib
import random
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import command_line  # noqa: E402
import drawings  # noqa: E402
import fichera  # noqa: E402
import small_program as lp  # noqa: E402

LIMIT = 1e-6          # relative distance to the limit within which a structure may be called either
SMALL = (1e-4, 1e-6)  # shares of P that stand for "a little load"; both must decide alike
UNFIT = ("no_start", "loose_part", "mechanism")  # codes that say of a held structure that it is not held
COARSE = 0.02         # relative rounding of a named motion from which it says nothing
NO_START = "no equilibrium was found for the first small load"  # the same of constant actions
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
POINT = rf"\(\s*({NUMBER})\s*,\s*({NUMBER})\s*\)"


class Case:
    """A structure, the factor of its static analyses, and the decisions: margins at that factor and under a little load."""

    def __init__(self, model, factor):
        self.model = model
        self.factor = factor
        self.condition = fichera.Condition(model)
        self.at_factor = self.condition.margin(factor)
        margins = [self.condition.margin(share) for share in SMALL]
        same = None not in margins and (margins[0] > 0) == (margins[1] > 0)
        self.at_start = margins[1] if same else None

    def near_limit(self):
        return any(m is not None and abs(m) < LIMIT for m in (self.at_factor, self.at_start)) or self.at_start is None

    def mechanism(self):
        return self.at_factor is None

    def no_reference_state(self, code):
        """Whether C + P, about which a buckling analysis linearises, is not held, or leaves a motion that only loads can stiffen."""
        reference = self.condition.margin(1.0)
        return reference is None or reference < LIMIT or (code == "mechanism" and self.condition.neutral() > 0)

    def names_largest_factor(self, answer):
        """Whether a refusal names the largest factor up to which C + f P is held."""
        bound = self.condition.largest_factor() if self.condition.constant else math.inf
        return any(abs(float(x) - bound) <= 1e-5 * bound for x in re.findall(NUMBER, answer.detail()) if bound < math.inf)

    def requests(self):
        """(kind, request, margin that decides, load factor of the decision)"""
        discretization = {"accuracy": 1e-2}
        output = {"states": "none"}
        static = {"type": "static", "load_factors": [self.factor]}
        kinds = [("linear", {**static, "geometry": "linear"}, self.at_factor, self.factor),
                 ("static", static, self.at_factor, self.factor),
                 ("path", {"type": "path", "stop": {"steps": 5}}, self.at_start, SMALL[1]),
                 ("critical", {"type": "critical"}, self.at_start, SMALL[1]),
                 ("buckling", {"type": "buckling"}, self.at_start, SMALL[1])]
        for kind, analysis, margin, factor in kinds:
            analysis = {**analysis, "discretization": discretization, "output": output}
            yield kind, {"model": self.model, "analysis": analysis}, margin, factor


def with_loads(model, constant, proportional):
    model = copy.deepcopy(model)
    model["loads"] = [{**load, "pattern": "constant"} for load in constant] + copy.deepcopy(proportional)
    return model


def scaled(loads, share):
    loads = copy.deepcopy(loads)
    for load in loads:
        for field in ("force", "moment", "value"):
            if field in load:
                load[field] = [share * x for x in load[field]] if field == "force" else share * load[field]
    return loads


def draw_loads(s, parts):
    return [load for prefix, soft in parts for load in drawings.draw_loads(s, prefix, soft)]


def wanted_loads(s, parts, held):
    """Loads that are held, or not, with their margin; None if 300 draws give none."""
    condition = fichera.Condition(s.model)
    for _ in range(300):
        loads = draw_loads(s, parts)
        condition.set_loads(loads)
        margin = condition.margin(1.0)
        if margin is not None and abs(margin) > LIMIT and (margin > 0) == held:
            return loads
    return None


def near_the_limit(model, held, not_held, rng):
    """A mixture of two sets of loads whose distance to the limit is 1e-5 to 1e-2 of its share, on either side."""
    low, high = 0.0, 1.0
    condition = fichera.Condition(model)
    for _ in range(50):
        t = (low + high) / 2
        condition.set_loads(scaled(held, 1 - t) + scaled(not_held, t))
        margin = condition.margin(1.0)
        low, high = (t, high) if margin is not None and margin > 0 else (low, t)
    t = low + rng.choice([-1, -1, 1]) * 10 ** rng.uniform(-5, -2)
    return scaled(held, 1 - t) + scaled(not_held, t)


def draw(seed):
    """A case; draws structures until loads of the wanted kind are found."""
    rng = random.Random(seed)
    while True:
        s, parts = drawings.sketch(rng)
        held = wanted_loads(s, parts, True)
        other = wanted_loads(s, parts, False) if rng.random() < 0.8 or held is None else None
        if held is None and (other is None or rng.random() < 0.5):
            continue
        constant, factor = [], 1.0
        loads = other if held is None or (other and rng.random() < 0.55) else held
        if held and other and rng.random() < 0.4:
            loads = near_the_limit(s.model, held, other, rng)
        if held and rng.random() < 0.4:
            constant = held
            loads = draw_loads(s, parts) if rng.random() < 0.7 else loads
            factor = 10 ** rng.uniform(-1, 1)
            if rng.random() < 0.3 and other:
                constant = other
        case = Case(drawings.finish(with_loads(s.model, constant, loads), rng), factor)
        if not case.mechanism():
            return case


def named_motions(detail, condition):
    """[(motion, rounding)]: motions that a message names, in local coordinates and of size 1, with what rounding of their figures
    may change: "about node "ID"", "about (x, y)", "direction (dx, dy)". The one place to adapt to other words.
    """
    drawing = condition.drawing
    names = re.findall(r'about (?:the )?node "([^"]+)"', detail)
    centres = [(drawing.nodes[name], 0.0) for name in names if name in drawing.nodes]
    for found in re.finditer(rf"(\w+) {POINT}", detail):
        pair = (float(found.group(2)), float(found.group(3)))
        rounding = math.hypot(*(half_unit(found.group(i)) for i in (2, 3)))
        if found.group(1) in ("direction", "along", "by", "towards"):
            size = math.hypot(*pair)
            yield [pair[0] / size, pair[1] / size, 0.0], rounding / size
        else:
            centres.append((pair, rounding / drawing.size))
    for centre, rounding in centres:
        x, y = drawing.local(centre)
        motion = [y, -x, 1.0]
        yield [value / lp.norm(motion) for value in motion], rounding / lp.norm(motion)


def half_unit(figure):
    """Half a unit of the third significant digit of a number, or of its last digit if it has more."""
    value = abs(float(figure))
    digits = max(3, len(re.sub(r"[eE].*|[-+.]", "", figure).lstrip("0")))
    return 0.5 * 10 ** (math.floor(math.log10(value)) + 1 - digits) if value else 0.0


def judge_refusal(case, answer, factor):
    """"" if the message names a motion that escapes, else what is wrong with it."""
    motions = list(named_motions(answer.detail(), case.condition))
    if not motions:
        return "names no motion"
    loads = case.condition.total(factor)
    for motion, rounding in motions:
        if rounding < COARSE and case.condition.explains(loads, motion, 1e-3 + 2 * rounding):
            return ""
    if all(rounding >= COARSE for _, rounding in motions):
        return "names a motion whose figures are too coarse to tell where it is"
    return "names a motion that is blocked or that the loads do not drive"


def judge(case, kind, answer, margin, factor):
    """(outcome for the counts, "" or what disagrees)"""
    code = answer.failure()
    if code == "document":
        return code, "the document was refused"
    if margin < 0:
        if code != "not_held":
            return "accepted" if not code else code, f"not held, answered {code or 'success'}"
        return "refused", judge_refusal(case, answer, factor)
    if kind == "buckling" and code in UNFIT + ("not_held",) and case.no_reference_state(code):
        return code, ""
    if code == "not_held" and kind == "buckling" and case.names_largest_factor(answer):
        return "limit told", ""
    if code == "not_held" and kind == "static" and case.at_start < 0:
        return "start not held", ""
    if code == "not_held" or code in UNFIT or (code == "constant_actions" and NO_START in answer.detail()):
        return code, f"held, answered {code}"
    if kind == "buckling" and not code:
        loads = answer.document["buckling"]["load_factors"]
        bound = case.condition.largest_factor() if case.condition.constant else math.inf
        if loads and loads[0] > bound * (1 + 1e-6):
            warned = any(str(w["code"]).startswith(("contact", "not_held", "linear")) for w in answer.document["warnings"])
            return "above", "" if warned else f"buckling load {loads[0]:.6g} above the largest load that is held, {bound:.6g}"
    return code or "answered", ""


def check(binary, seed, options):
    """[(kind, expected, outcome, complaint, detail)] of one structure; None near the limit."""
    case = draw(seed)
    if case.near_limit():
        return None
    found = []
    for kind, request, margin, factor in case.requests():
        if options.only and kind not in options.only:
            continue
        answer = command_line.solve(binary, request, options.seconds)
        outcome, complaint = judge(case, kind, answer, margin, factor)
        if complaint or outcome == "timeout":
            command_line.keep(options.keep, f"{seed}_{kind}", request)
        detail = answer.detail() or ""
        found.append((kind, margin, outcome, complaint, detail))
    return found


def report(results, verbose):
    """Prints disagreements (verbose: other failures on held structures, too) and counts; the number of structures with a disagreement."""
    counts, near, wrong = collections.Counter(), 0, 0
    structures = not_held = 0
    for seed, found in results:
        if found is None:
            near += 1
            continue
        structures += 1
        not_held += found[0][1] < 0
        wrong += any(complaint for _, _, _, complaint, _ in found)
        for kind, margin, outcome, complaint, detail in found:
            counts["held" if margin > 0 else "not held", kind, outcome] += 1
            if complaint or (verbose and margin > 0 and outcome not in ("answered", "above")):
                complaint = complaint or f"held, answered {outcome}"
                print(f"seed {seed} {kind}: margin {margin:.3g}: {complaint}: {' '.join(detail.split())[:200]}", flush=True)
    for key in sorted(counts):
        print(f"  {key[0]:9} {key[1]:9} {key[2]:22} {counts[key]}")
    print(f"{structures} structures, {not_held} of them not held at their factor, {near} near the limit; {wrong} disagree")
    return wrong


def decide(files):
    for name in files:
        request = json.loads(pathlib.Path(name).read_text(encoding="utf-8"))
        condition = fichera.Condition(request["model"])
        for factor in request["analysis"].get("load_factors", [1.0]):
            print(f"{name}: factor {factor}: {len(condition.basis)} free motions, margin {condition.margin(factor)}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("binary", nargs="?")
    parser.add_argument("--count", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--keep")
    parser.add_argument("--only", nargs="*")
    parser.add_argument("--verbose", action="store_true")
    parser.add_argument("--show", type=int)
    parser.add_argument("--file", nargs="*")
    options = parser.parse_args()
    if options.file:
        decide(options.file)
        return 0
    if options.show is not None:
        case = draw(options.show)
        print(json.dumps(next(case.requests())[1], indent=1))
        print(f"factor {case.factor:g}: margin {case.at_factor}; little load: margin {case.at_start}; "
              f"largest factor {case.condition.largest_factor():g}", file=sys.stderr)
        return 0
    seeds = range(options.seed, options.seed + options.count)
    return 1 if report(command_line.for_each(seeds, lambda n: check(options.binary, n, options), options.jobs), options.verbose) else 0


if __name__ == "__main__":
    sys.exit(main())
