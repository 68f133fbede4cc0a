#!/usr/bin/env python3
"""Runs the sweeps of examples/thesis through the command line and compares them with the published values.

  scripts/report.py SNAPTHROUGH              writes docs/thesis/ (needs gnuplot)
  scripts/report.py SNAPTHROUGH --check      only compares; exit status 1 when a value is off or lacking

Everything written is the same from run to run but the run times: docs/thesis/times.md and the column "ms" of tables.md.
"""
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from lib.thesis_data import DOCS, EXAMPLES, ROOT, SPRINGS, order_of, read_csv, references, run_sweep, value_of  # noqa: E402
from lib.thesis_tables import converged_rows, errata_page, table_page  # noqa: E402

CONVERGED_TOLERANCE = 1e-4  # the accuracy asked of converged values; the references have 10 digits
ACCURACY_ASKED = 1e-6  # in the documents
SPRING_TOLERANCE = 1e-6  # closed forms with 12 digits
MINIMUM_COMPARED = 408  # so that a renamed column cannot empty the comparison


def compare(results):
    """Mistakes against the converged references and the closed forms; numbers compared."""
    wrong, compared = [], 0
    for reference, ours, estimate in converged_rows(results):
        compared += 1
        name = f"{reference['table']} {reference['value']} {reference['what']}"
        if ours is None or abs(ours / float(reference["converged"]) - 1) > CONVERGED_TOLERANCE:
            wrong.append(f"{name}: {ours}")
        if estimate is None or estimate > ACCURACY_ASKED:
            wrong.append(f"{name}: error estimate {estimate}")
    for row in read_csv(ROOT / "tests/verification/data/column_discrete_spring_gamma.csv"):
        for ours in results[SPRINGS[row["bc"]]]:
            if ours["k_x"] == float(row["kx"]) and abs(1 - ours["fraction"] - float(row["c_b"])) < 1e-9:
                compared += 1
                if abs(ours["/buckling/load_factors/0"] / float(row["Gamma"]) - 1) > SPRING_TOLERANCE:
                    wrong.append(f"{row['bc']} {row['c_b']} {row['kx']}: {ours['/buckling/load_factors/0']}")
    return wrong, compared


def check_sensitivity(rows):
    """Koiter: at a symmetric unstable bifurcation the load lost grows as the amplitude to the power 2/3."""
    load = {row["amplitude"]: row["/critical_points/0/load_factor"] for row in rows}
    wrong = [f"sensitivity: {a} and {-a} differ" for a in load if abs(load[a] - load[-a]) > 1e-9 * load[0]]
    ratio = (load[0] - load[1e-3]) / (load[0] - load[1e-4])
    if abs(ratio / 10 ** (2 / 3) - 1) > 0.02:  # higher terms are of the relative size of the load lost, 0.014
        wrong.append(f"sensitivity: ratio {ratio} is not 10^(2/3)")
    return wrong


def gnuplot(name, title, xlabel, ylabel, log_x, curves):
    """curves: (label, style, points)."""
    script = ["set encoding utf8", "set terminal svg size 800,500 font 'DejaVu Sans,13' background 'white'", f"set output '{DOCS / name}'",
              f"set title '{title}'", f"set xlabel '{xlabel}'", f"set ylabel '{ylabel}'", "set grid",
              "set key outside right"] + (["set logscale x", "set format x '10^{%T}'"] if log_x else [])
    for i, (_, _, points) in enumerate(curves):
        script += [f"$c{i} << E"] + [f"{x!r} {y!r}" for x, y in points] + ["E"]
    script.append("plot " + ", ".join(f"$c{i} with {style} title '{label}'"
                                      for i, (label, style, _) in enumerate(curves)))
    subprocess.run(["gnuplot"], input="\n".join(script), text=True, check=True)


def plot_all(results):
    for number, (bc, file) in enumerate(SPRINGS.items(), 6):
        stiffnesses = sorted({row["k_x"] for row in results[file]})
        gnuplot(f"figure_4_{number}.svg", "Column with one spring: " + file.split("spring_")[1].replace("_", "-"),
                "c_b = c/L from the top", "Γ = P_{cr}/P_e", False,
                [(f"k_x = {k:g}", "linespoints pt 7 ps 0.4",
                  [(1 - row["fraction"], row["/buckling/load_factors/0"]) for row in results[file] if row["k_x"] == k])
                 for k in stiffnesses])
    gnuplot("sensitivity.svg", "Shallow arch, k = 0: antisymmetric imperfection", "amplitude / R, per cent",
            "Λ = P R^2/EI at the first loss of stability", False,
            [("imperfect: limit", "linespoints pt 7 ps 0.5",
              [(row["amplitude"], row["/critical_points/0/load_factor"])
               for row in results["imperfection_sensitivity_arch"]])])
    published_values = references()
    for file, name, title, group in (
            ("figure_4_31_deep_arch_235", "deep_arch.svg", "Deep arch, 235 degrees", "P R^2/EI"),
            ("figure_4_35_ring", "ring.svg", "Ring in an elastic medium", "q R^3/EI")):
        curves = [(label, "linespoints pt 7 ps 0.5",
                   [(row["k"], value_of(row, "limit_max")[0]) for row in results[file]
                    if row["k"] > 0 and (order_of(row) == 1) == coarse])
                  for label, coarse in (("thesis mesh", True), ("converged", False))]
        published = [(float(r["value"]), float(r["published"])) for r in published_values
                     if r["file"] == file and r["published"]]
        gnuplot(name, title + ": first limit load", "k = K R^4/EI", "Λ = " + group, True,
                curves + [("published", "points pt 6 ps 1.2", published)])


def main():
    check_only = "--check" in sys.argv
    arguments = [a for a in sys.argv[1:] if a != "--check"]
    if len(arguments) != 1:
        raise SystemExit(__doc__)
    results, times = {}, []
    for path in sorted(EXAMPLES.glob("*.json")):
        results[path.stem], seconds = run_sweep(arguments[0], path)
        times.append(f"| {path.name} | {len(results[path.stem])} | {seconds:.2f} |")
    wrong, compared = compare(results)
    wrong += check_sensitivity(results["imperfection_sensitivity_arch"])
    if compared < MINIMUM_COMPARED:
        wrong.append(f"only {compared} values were compared, {MINIMUM_COMPARED} were expected")
    print(f"{compared} values compared, {len(wrong)} off")
    if not check_only:
        DOCS.mkdir(parents=True, exist_ok=True)
        (DOCS / "tables.md").write_text(table_page(results), encoding="utf-8")
        (DOCS / "times.md").write_text("\n".join(["# Run times", "", "The only page that changes from run to run.", "",
                                                  "| sweep | points | s |", "| --- | --- | --- |"] + times) + "\n",
                                       encoding="utf-8")
        (DOCS / "errata.md").write_text(errata_page(results), encoding="utf-8")
        plot_all(results)
    if wrong:
        raise SystemExit("\n".join(wrong))


if __name__ == "__main__":
    main()
