#!/usr/bin/env python3
"""Writes docs/performance/ from the JSON that bench_performance leaves: tables, and SVG plots by gnuplot.

  scripts/bench_report.py PERFORMANCE_JSON
"""
import json
import math
import pathlib
import subprocess
import sys

DOCS = pathlib.Path(__file__).resolve().parent.parent / "docs" / "performance"
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


WIDTH, HEIGHT = 720, 480  # px of a plot


def plot(title, xlabel, ylabel, curves):
    """An SVG document; curves: (title, points, style); both axes logarithmic."""
    commands = [f"set terminal svg size {WIDTH},{HEIGHT} font 'sans,13' background 'white'",
                f"set title \"{title}\"\nset xlabel '{xlabel}'\nset ylabel '{ylabel}'",
                "set logscale xy\nset format y '1e%L'\nset grid\nset key outside right", ""]
    commands.append("plot " + ", ".join(f"'-' with {style} title \"{label}\"" for label, _, style in curves))
    for _, points, _ in curves:
        commands += [f"{x} {y}" for x, y in points] + ["e"]
    return subprocess.run(["gnuplot"], input="\n".join(commands), text=True, check=True, stdout=subprocess.PIPE).stdout


def beside(plots):
    """One SVG document with plots from left to right."""
    parts = [text[text.index("<svg"):].rstrip().replace("<svg", f'<svg x="{i * WIDTH}"', 1) for i, text in enumerate(plots)]
    size = f'width="{len(plots) * WIDTH}" height="{HEIGHT}" viewBox="0 0 {len(plots) * WIDTH} {HEIGHT}"'
    return "\n".join(['<?xml version="1.0" encoding="utf-8"?>', f'<svg {size} xmlns="http://www.w3.org/2000/svg">', *parts, "</svg>\n"])


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
    """Tables and plots of error against time and unknowns, case by case."""
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
                    curves.append((f"order {order}", points, "linespoints"))
            curves.append(("asked", [(r[key], max(r["error"], 1e-14)) for r in asked], "points pt 7 ps 1"))
            plots.append(plot(title, label, "relative error", curves))
        write(f"{case}.svg", beside(plots))
    write("precision.md", "\n".join(text))


def compared(rows, a, b, what):
    return what, ms(rows[a]), ms(rows[b]), f"{rows[a]['cpu_time'] / rows[b]['cpu_time']:.2f}"


def summary_page(by_group):
    """Targets, growth, bases and what is skipped."""
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
    write("growth.svg", plot("Four steps of an arch", "unknowns", "CPU ms",
                             [("measured", [(r["unknowns"], r["cpu_time"]) for r in growth], "linespoints"),
                              ("n^{1.1}", almost_linear, "lines")]))
    bases = sorted(by_group[("bases",)], key=lambda r: int(r["parts"][1]))
    text += ["## Growth with bases\n", "![Time against bases](bases.svg)\n",
             table(["bases", "elements", "factorisations", "ms"],
                   [(r["parts"][1], int(r["elements"]), int(r["factorizations"]), ms(r)) for r in bases])]
    write("bases.svg", plot("Shallow arch, base outside cut into pieces", "bases", "CPU ms",
                            [("measured", [(int(r["parts"][1]), r["cpu_time"]) for r in bases], "linespoints")]))
    skips = {r["parts"][1]: r for r in by_group[("skip",)]}
    text += ["## What is not done\n",
             table(["skipped", "with, ms", "without, ms", "ratio"],
                   [compared(skips, *pair) for pair in SKIPS])]
    kernels = {r["parts"][1]: r for r in by_group[("kernel",)]}
    text += ["Parts of one correction, five elements of order 5 without base:\n",
             table(["what", "with, ms", "without, ms", "ratio"], [compared(kernels, *pair) for pair in KERNELS])]
    write("README.md", "\n".join(text))


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    DOCS.mkdir(parents=True, exist_ok=True)
    runs = json.loads(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8"))["benchmarks"]
    by_group = {}
    for run in runs:
        run["parts"] = run["name"].split("/")
        named = run["parts"][0] in ("accuracy", "mesh")
        by_group.setdefault(tuple(run["parts"][:2 if named else 1]), []).append(run)
    precision_pages(by_group)
    summary_page(by_group)


if __name__ == "__main__":
    main()
