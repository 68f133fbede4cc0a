#!/usr/bin/env python3
"""Writes docs/performance/ from the JSON that bench_performance leaves: tables, figures, and the points that these show.

  scripts/bench_report.py PERFORMANCE_JSON
  scripts/bench_report.py --figures           only draws the figures anew, from the points in docs/performance/figures.json
"""
import json
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from lib import bench_figures  # noqa: E402
from lib.bench_figures import DOCS, plotted  # noqa: E402

TITLES = {"column": "Column on a base, k = 100", "shallow_arch": "Shallow arch, no base",
          "shallow_arch_k1e7": "Shallow arch, base outside, k = 1e7",
          "shallow_arch_k1e9": "Shallow arch, base outside, k = 1e9", "deep_arch": "Deep arch, 215 degrees",
          "ring_k1200": "Ring in a medium, k = 1200", "ring_k180000": "Ring in a medium, k = 180000",
          "frame": "Lee's frame", "column_with_spring": "Column with a spring, linearised"}
SKIPS = [("path_with_all_states", "path_without_states",
          "states at all points: points corrected to rounding, states computed"),
         ("path_with_critical_states", "path_without_states",
          "states at critical points only, against none"),
         ("path_without_states", "critical_load_only",
          "arch on a base: points recorded, contact changes located, against the critical load alone"),
         ("first_limit_point_by_path", "first_limit_point_alone", "the same without a base"),
         ("base_one_sided", "base_bilateral", "no contact search where a base is bilateral"),
         ("base_of_tiny_stiffness", "base_of_stiffness_0", "no base assembly at stiffness 0, against a tiny one"),
         ("base_of_stiffness_0", "no_base", "nothing is left of a base of stiffness 0"),
         ("straight_by_path", "straight_linearised", "straight column by its path, against linearised (not taken up)")]
# parts of one correction: (with, without, what)
KERNELS = [("dense", "linearise", "interiors eliminated: all unknowns factorised as one full matrix, against linearise()"),
           ("structure_each_time", "linearise", "constant data of elements: made for each linearisation, against once"),
           ("two_factorisations_two_solves", "one_factorisation_two_solves",
            "factors reused within a correction: one for each right-hand side, against one"),
           ("linearise", "residual", "linearise() against the residual alone"),
           ("linearise", "solve", "linearise() against one solve")]


def write(name, text):
    (DOCS / name).write_text(text, encoding="utf-8")


def table(head, rows):
    return "\n".join(["| " + " | ".join(head) + " |", "|" + " --- |" * len(head)] +
                     ["| " + " | ".join(str(c) for c in row) + " |" for row in rows]) + "\n"


def ms(run):
    return f"{run['cpu_time']:.3g}"


def error(run):
    return f"{run.get('error', math.nan):.1e}"


def growth_rate(runs):
    """Slope of log time against log unknowns, between the first and the last run."""
    first, last = runs[0], runs[-1]
    return math.log(last["cpu_time"] / first["cpu_time"]) / math.log(last["unknowns"] / first["unknowns"])


def precision_pages(by_group):
    """Writes tables of error against time and unknowns, case by case. Returns what their figures show."""
    figures = {}
    text = ["# Work and precision\n", "Relative error of the first critical load against CPU milliseconds, all in one run of "
            "`scripts/bench.sh`.\nCurves *asked*: the requested accuracy, nothing else set. *Order p*: fixed "
            "meshes of that order, 4 to 128 elements.\n"]
    for case, title in TITLES.items():
        asked = by_group.get(("accuracy", case), [])
        meshes = by_group.get(("mesh", case), [])
        if not asked or not meshes:
            continue
        text += [f"## {title}\n", f"![Error against time and against unknowns]({case}.svg)\n"]
        text.append(table(["asked", "error", "estimate", "elements", "order", "unknowns", "factorisations", "ms"],
                          [(r["parts"][2], error(r), f"{r.get('estimate', math.nan):.1e}", int(r["elements"]),
                            int(r["order"]), int(r["unknowns"]), int(r["factorizations"]), ms(r)) for r in asked]))
        plots = []
        for key, label in (("cpu_time", "CPU ms"), ("unknowns", "unknowns")):
            curves = []
            for order in sorted({r["parts"][2] for r in meshes}):
                points = [(r[key], max(r["error"], 1e-14)) for r in meshes
                          if r["parts"][2] == order and math.isfinite(r.get("error", math.nan)) and r["error"] < 1]
                if points:
                    curves.append((f"order {order}", points))
            curves.append(("asked", [(r[key], max(r["error"], 1e-14)) for r in asked]))
            plots.append(plotted(title, label, "relative error", curves))
        figures[case] = plots
    write("precision.md", "\n".join(text))
    return figures


def compared(rows, a, b, what):
    return what, ms(rows[a]), ms(rows[b]), f"{rows[a]['cpu_time'] / rows[b]['cpu_time']:.2f}"


def summary_page(by_group):
    """Writes targets, growth, bases and what is skipped. Returns what the figures of growth and bases show."""
    text = ["# Measured performance\n",
            "`scripts/bench.sh` writes this page: all numbers are of one run, in CPU milliseconds.\n"
            "[performance.md](../performance.md) explains them; [work and precision](precision.md) has every case.\n"]
    rows, ratios = [], []
    for case, title in TITLES.items():
        at = {r["parts"][2]: r for r in by_group.get(("accuracy", case), [])}
        if "1e-03" in at:
            r = at["1e-03"]
            rows.append((title, error(r), int(r["factorizations"]), ms(r), r.get("target_ms", "")))
        if "1e-06" in at:
            base = at["1e-03"]["cpu_time"]
            ratios.append([title] + [f"{r['cpu_time'] / base:.2f}" for _, r in sorted(at.items(), key=lambda i: -float(i[0]))])
    text += ["## Accuracy 1e-3, nothing else set\n", table(["case", "error", "factorisations", "ms", "target, ms"], rows)]
    text += ["## Time over that at 1e-3\n", table(["case", "1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8"], ratios)]
    growth = sorted(by_group[("growth",)], key=lambda r: r["unknowns"])
    text += ["## Growth with elements (order 1, four steps)\n", "![Time against unknowns](growth.svg)\n",
             table(["elements", "unknowns", "factorisations", "ms", "microseconds by unknown and factorisation"],
                   [(int(r["elements"]), int(r["unknowns"]), int(r["factorizations"]), ms(r),
                     f"{1e3 * r['cpu_time'] / r['unknowns'] / r['factorizations']:.3f}") for r in growth])]
    text.append(f"Time grows with the unknowns to the power {growth_rate(growth):.2f}.\n")
    almost_linear = [(r["unknowns"], growth[0]["cpu_time"] * (r["unknowns"] / growth[0]["unknowns"])**1.1) for r in growth]
    figures = {"growth": [plotted("Four steps of an arch", "unknowns", "CPU ms",
                                  [("measured", [(r["unknowns"], r["cpu_time"]) for r in growth]), ("n^{1.1}", almost_linear)])]}
    bases = sorted(by_group[("bases",)], key=lambda r: int(r["parts"][1]))
    text += ["## Growth with bases\n", "![Time against bases](bases.svg)\n",
             table(["bases", "elements", "factorisations", "ms"],
                   [(r["parts"][1], int(r["elements"]), int(r["factorizations"]), ms(r)) for r in bases])]
    figures["bases"] = [plotted("Shallow arch, base outside cut into pieces", "bases", "CPU ms",
                                [("measured", [(int(r["parts"][1]), r["cpu_time"]) for r in bases])])]
    skips = {r["parts"][1]: r for r in by_group[("skip",)]}
    text += ["## What is not done\n",
             table(["skipped", "with, ms", "without, ms", "ratio"],
                   [compared(skips, *pair) for pair in SKIPS])]
    kernels = {r["parts"][1]: r for r in by_group[("kernel",)]}
    text += ["Parts of one correction, five elements of order 5 without base:\n",
             table(["what", "with, ms", "without, ms", "ratio"], [compared(kernels, *pair) for pair in KERNELS])]
    write("README.md", "\n".join(text))
    return figures


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    if sys.argv[1] == "--figures":
        return bench_figures.draw()
    DOCS.mkdir(parents=True, exist_ok=True)
    runs = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))["benchmarks"]
    by_group = {}
    for run in runs:
        run["parts"] = run["name"].split("/")
        named = run["parts"][0] in ("accuracy", "mesh")
        by_group.setdefault(tuple(run["parts"][:2 if named else 1]), []).append(run)
    bench_figures.write(precision_pages(by_group) | summary_page(by_group))
    return bench_figures.draw()


if __name__ == "__main__":
    main()
