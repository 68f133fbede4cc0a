#!/usr/bin/env python3
"""Runs the examples of the thesis and of the gallery through the command line and compares them with published values.

  scripts/report.py SNAPTHROUGH              writes docs/thesis/ and docs/gallery/
  scripts/report.py SNAPTHROUGH --check      only compares; exit status 1 when a value is off or lacking, a page of the gallery has
                                             another number than is found, or a line of a design chart is more than 1 % off
  ... --gallery [NAME]                       only the gallery, or one page of it
  scripts/report.py --self-test              checks the report itself

Everything written is the same from run to run; the run times go to standard output.
"""
import argparse
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from lib.gallery_pages import gallery, gallery_self_test  # noqa: E402
from lib.thesis_data import DOCS, EXAMPLES, ROOT, SPRINGS, read_csv, run_sweep  # noqa: E402
from lib.thesis_errata import Table44, errata_page  # noqa: E402
from lib.thesis_figures import Runs, plot_all  # noqa: E402
from lib.thesis_paths import check_paths, filled  # noqa: E402
from lib.thesis_self_test import self_test  # noqa: E402
from lib.thesis_springs import special_values  # noqa: E402
from lib.thesis_tables import converged_rows, published_rows, table_page  # noqa: E402

CONVERGED_TOLERANCE = 1e-4  # the accuracy asked of converged values; the references have 10 digits
ACCURACY_ASKED = 1e-6  # in the documents
PUBLISHED_TOLERANCE = 0.02  # asked of the thesis' own meshes
SPRING_TOLERANCE = 1e-6  # closed forms with 12 digits
MINIMUM_COMPARED = 573  # so that a renamed column cannot empty the comparison


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


def compare_published(results):
    """Mistakes against the published values, on the thesis' own meshes; numbers compared.

    A row whose `errata` is yes must be off: a mark that nothing needs any longer is a mistake too.
    """
    wrong, compared = [], 0
    for reference, ours in published_rows(results):
        compared += 1
        name = f"{reference['table']} {reference['value']} {reference['what']}, published {reference['published']}"
        near = ours is not None and abs(ours / float(reference["published"]) - 1) <= PUBLISHED_TOLERANCE
        if near == (reference["errata"] == "yes"):
            wrong.append(f"{name}: {ours}" + (" is near, but has an erratum" if near else ""))
    return wrong, compared


def check_sensitivity(rows):
    """Koiter: at a symmetric unstable bifurcation the load lost grows as the amplitude to the power 2/3."""
    load = {row["amplitude"]: row["/summary/critical_load_factor"] for row in rows}
    wrong = [f"sensitivity: {a} and {-a} differ" for a in load if abs(load[a] - load[-a]) > 1e-9 * load[0]]
    ratio = (load[0] - load[1e-3]) / (load[0] - load[1e-4])
    if abs(ratio / 10 ** (2 / 3) - 1) > 0.02:  # higher terms are of the relative size of the load lost, 0.014
        wrong.append(f"sensitivity: ratio {ratio} is not 10^(2/3)")
    return wrong


def thesis(program, check_only):
    """(mistakes, numbers compared, run times) of the examples of the thesis; writes docs/thesis/ unless it only checks."""
    results, times = {}, []
    for path in sorted(EXAMPLES.glob("*.json")):
        results[path.stem], seconds = run_sweep(program, path)
        times.append(f"{seconds:8.2f} s  {path.name}, {len(results[path.stem])} points")
    wrong, compared = compare(results)
    wrong += check_sensitivity(results["imperfection_sensitivity_arch"])
    runs = Runs(program)
    springs, *of_springs = special_values(program)
    table_4_4 = Table44(program, results)
    for more_wrong, more in (compare_published(results), check_paths(runs), of_springs, table_4_4.check()):
        wrong, compared = wrong + more_wrong, compared + more
    if compared < MINIMUM_COMPARED:
        wrong.append(f"only {compared} values were compared, {MINIMUM_COMPARED} were expected")
    if not check_only:
        DOCS.mkdir(parents=True, exist_ok=True)
        plot_all(runs, results)
        (DOCS / "tables.md").write_text(table_page(results), encoding="utf-8")
        for page in sorted(EXAMPLES.glob("pages/*.md")):  # pages with tables; docs/thesis has the others as they are written
            (DOCS / page.name).write_text(filled(page.read_text(encoding="utf-8"), runs), encoding="utf-8")
        (DOCS / "errata.md").write_text(errata_page(program, results, springs, table_4_4), encoding="utf-8")
    return wrong, compared, times + runs.times


def main():
    if sys.argv[1:] == ["--self-test"]:
        raise SystemExit("\n".join(self_test() + gallery_self_test()) or None)
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("program")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--gallery", nargs="?", const="", metavar="NAME")
    arguments = parser.parse_args()
    parts = [gallery(arguments.program, not arguments.check, arguments.gallery)]
    if arguments.gallery is None:
        parts.append(thesis(arguments.program, arguments.check))
    wrong = [mistake for part in parts for mistake in part[0]]
    print(f"{sum(part[1] for part in parts)} values compared, {len(wrong)} off")
    if not arguments.check:
        print("\n".join(["wall time, start of the command line included:"] + [time for part in parts for time in part[2]]))
    if wrong:
        raise SystemExit("\n".join(wrong))


if __name__ == "__main__":
    main()
