#!/usr/bin/env python3
"""Runs the sweeps of examples/thesis through the command line and compares them with the published values.

  scripts/report.py SNAPTHROUGH              writes docs/thesis/ (needs gnuplot)
  scripts/report.py SNAPTHROUGH --check      only compares; exit status 1 when a value is off or lacking

Everything written is the same from run to run but docs/thesis/times.md.
"""
import csv
import json
import pathlib
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
EXAMPLES = ROOT / "examples" / "thesis"
DOCS = ROOT / "docs" / "thesis"
CONVERGED_TOLERANCE = 1e-4  # the accuracy asked of converged values; the references have 10 digits
SPRING_TOLERANCE = 1e-6  # closed forms with 12 digits
MINIMUM_COMPARED = 371  # so that a renamed column cannot empty the comparison
SPRINGS = {"PP": "figure_4_6_column_spring_pinned_pinned", "CF": "figure_4_7_column_spring_clamped_free",
           "CP": "figure_4_8_column_spring_clamped_pinned", "CC": "figure_4_9_column_spring_clamped_clamped"}


def run_sweep(program, path):
    """Rows as dictionaries, and the seconds it took."""
    start = time.monotonic()
    done = subprocess.run([program, "sweep", str(path)], capture_output=True, text=True, check=False)
    seconds = time.monotonic() - start
    if done.returncode != 0:
        raise SystemExit(f"{path.name}: exit status {done.returncode}: {done.stderr.strip()}")
    table = json.loads(done.stdout)
    return [dict(zip(table["columns"], row)) for row in table["rows"]], seconds


def read_csv(path):
    with open(path, encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def mesh_of(row):
    """(elements, order) of a row; a sweep over `elements` alone is on straight elements of order 1."""
    mesh = row.get("mesh")
    return (mesh["elements"], mesh["order"]) if mesh else (row["elements"], 1)


def value_of(row, what):
    kind, _, number = what.partition(" ")
    if kind == "buckling":
        number = number.split("|")[-1 if mesh_of(row)[1] == 1 else 0]
        return row["/buckling/load_factors/" + number]
    for i in range(4):
        if row.get(f"/critical_points/{i}/type") == kind:
            return row[f"/critical_points/{i}/load_factor"]
    return None


def pick(rows, reference, order_1):
    """Our value beside a reference: on the thesis' own mesh, or on the finest one."""
    for row in rows:
        elements, order = mesh_of(row)
        if (order == 1) != order_1:
            continue
        if reference["key"] == "elements":
            if order_1 and elements != float(reference["value"]):
                continue
        elif abs(row[reference["key"]] - float(reference["value"])) > 1e-9 * abs(row[reference["key"]]):
            continue
        return value_of(row, reference["what"])
    return None


def percent(value, reference):
    return "" if value is None or not reference else f"{100 * (value / float(reference) - 1):+.2f}"


def digits(value, places=6):
    return "" if value is None else f"{value:.{places}f}"


def compare(results):
    """Mistakes against the converged references and the closed forms; numbers compared."""
    wrong, compared = [], 0
    for reference in read_csv(EXAMPLES / "reference.csv"):
        ours = pick(results[reference["file"]], reference, False)
        if reference["file"] == "table_4_4_arch_meshes":
            continue  # coarse meshes only; its converged value is a row of table 4.5
        compared += 1
        if ours is None or abs(ours / float(reference["converged"]) - 1) > CONVERGED_TOLERANCE:
            wrong.append(f"{reference['table']} {reference['value']} {reference['what']}: {ours}")
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


def table_page(results):
    lines = ["# Tables and limit loads", "",
             "Thesis' mesh: straight elements of order 1, springs lumped at the nodes, as many elements as the thesis used.",
             "Converged: order 5. Differences in per cent: of our value on the thesis' mesh from the published one, and of",
             "the converged value from the reference (blank where nothing was published). The sweeps run on fixed meshes,",
             "for which no error estimate is computed.", "",
             "| table | case | what | published | thesis' mesh | % | converged | reference | % | remark |",
             "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"]
    for r in read_csv(EXAMPLES / "reference.csv"):
        coarse, fine = (pick(results[r["file"]], r, order_1) for order_1 in (True, False))
        lines.append(f"| {r['table']} | {r['key']} = {r['value']} | {r['what']} | {r['published']} | {digits(coarse, 3)} | "
                     f"{percent(coarse, r['published'])} | {digits(fine)} | {float(r['converged']):.6f} | "
                     f"{percent(fine, r['converged'])} | {r['note']} |")
    return "\n".join(lines) + "\n"


def errata_page(results):
    references = read_csv(EXAMPLES / "reference.csv")

    def stiffer(file, source):
        for row in results[file]:
            for r in references:
                if r["file"] == source and float(r["value"]) == row["k"] and r["published"]:
                    ours = value_of(row, "limit_max")
                    yield (f"| {r['value']} | {r['published']} | {digits(ours, 3)} | {percent(ours, r['published'])} | "
                           f"{float(r['converged']):.3f} |")

    head = ["", "| k as printed | published | ours, stiffer springs | % | converged with k as printed |",
            "| --- | --- | --- | --- | --- |"]
    base = (EXAMPLES / "errata.md").read_text(encoding="utf-8").rstrip("\n").split("\n")
    deep = ["", "## Deep arch (4.4.3): springs ten times too stiff", "",
            "One of 40 elements is 100 (235 pi/180)/40 = 10.25 long. A spring of K L_elem multiplied by L_elem once more is",
            "10.25 times too stiff. Straight elements with such springs:"]
    ring = ["", "## Ring (4.5): springs about 2 pi times too stiff", "", "Straight elements with springs 2 pi times stiffer:"]
    return "\n".join(base + deep + head + list(stiffer("errata_deep_arch_springs", "figure_4_31_deep_arch_235"))
                     + ring + head + list(stiffer("errata_ring_springs", "figure_4_35_ring"))) + "\n"


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
    references = read_csv(EXAMPLES / "reference.csv")
    for file, name, title, group in (
            ("figure_4_31_deep_arch_235", "deep_arch.svg", "Deep arch, 235 degrees", "P R^2/EI"),
            ("figure_4_35_ring", "ring.svg", "Ring in an elastic medium", "q R^3/EI")):
        curves = [(label, "linespoints pt 7 ps 0.5",
                   [(row["k"], value_of(row, "limit_max")) for row in results[file]
                    if row["k"] > 0 and (mesh_of(row)[1] == 1) == coarse])
                  for label, coarse in (("thesis mesh", True), ("converged", False))]
        published = [(float(r["value"]), float(r["published"])) for r in references
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
