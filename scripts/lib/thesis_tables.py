"""The pages of numbers of docs/thesis: published, on the thesis' mesh, converged, closed form."""
from lib.thesis_data import EXAMPLES, as_printed, digits, order_of, percent, pick, references, value_of

HEAD = ("| case | what | published | Silveira 2013 | thesis' mesh | % | converged | error estimate | reference | % | remark | ms |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")
INTRODUCTION = """# Tables and limit loads

Thesis' mesh: straight elements of order 1, springs lumped at the nodes, as many elements as the thesis used (40 for arches, 50
for the ring). Converged: `accuracy` 1e-6 asked for, with the relative error estimate that the result carries. Reference: a
closed form for columns, P_e (n^2 + k/n^2); for arches and rings collocation with the contact edges as unknowns. Differences in
per cent: of our value on the thesis' mesh from the published one, and of the converged value from the reference. Blank: nothing
published, or nothing found on that mesh. ms: run time of the whole converged analysis (of the thesis' mesh where there is only
that); it changes from run to run.

Loads: columns P; arches P R^2/EI; ring q R^3/EI. Base: columns K; arches and ring k = K R^4/EI.
"""
SECTIONS = {
    "4.1": "## Table 4.1: column on a bonded base, K = 10, meshes\n\n"
           "Ours is linearised: the load that the thesis' path reaches is the buckling load of its imperfect column, and [the columns' "
           "page](columns.md) has the paths. That straight elements of order 1 differ from the thesis' by up to 2 % with 4 elements is the "
           "mesh's error in either; it vanishes in the converged value.",
    "4.2": "## Table 4.2: column on a bonded base, K = 15.6, half-waves 1 to 4",
    "4.3": "## Table 4.3: column on a bonded base, K = 47, half-waves 1 to 4",
    "4.4": "## Table 4.4: shallow arch, base outside, k = 1e5, meshes",
    "4.5": "## Table 4.5: shallow arch, base outside",
    "4.6, 4.7": "## Tables 4.6, 4.7: shallow arch, base inside\n\nFrom about k = 35 500 on there is no limit point.",
    "4.4.3, 235 deg": "## Deep arch of 235 degrees, base outside (4.4.3)\n\nOn the thesis' mesh minima after the first maximum may be "
                      "those of springs that switch one by one, which no finer mesh has.",
    "4.4.3, 215 deg": "## Deep arch of 215 degrees, base outside (the literature's angle)",
    "4.5 ring": "## Ring in an elastic medium (4.5)",
}


def table_row(results, r):
    rows = results[r["file"]]
    coarse_row, coarse = pick(rows, r, True)
    fine_row, fine = pick(rows, r, False)
    coarse_load = coarse[0] if coarse else None
    load, estimate = fine if fine else (None, None)
    seconds = (fine_row or coarse_row)["/diagnostics/wall_time_s"]
    cells = (f"{r['key']} = {r['value']}", r["what"].split("|")[0], r["published"], r["s13"], digits(coarse_load, 3),
             percent(coarse_load, r["published"]), digits(load), "" if estimate is None else f"{estimate:.0e}",
             as_printed(r["converged"]), percent(load, r["converged"], 4), r["note"], f"{1000 * seconds:.0f}")
    return "| " + " | ".join(cells) + " |"


def table_page(results):
    lines = [INTRODUCTION]
    section = None
    for r in references():
        if r["table"] != section:
            section = r["table"]
            lines += ["" if len(lines) > 1 else None, SECTIONS[section], "", *HEAD]
        lines.append(table_row(results, r))
    return "\n".join(line for line in lines if line is not None) + "\n"


def stiffer_springs(results, file, source):
    """Rows of the published loads beside those with springs as much stiffer as the published loads suggest."""
    yield from ("", "| k as printed | what | published | ours, stiffer springs | % | converged with k as printed |",
                "| --- | --- | --- | --- | --- | --- |")
    for row in results[file]:
        for r in references():
            if r["file"] == source and float(r["value"]) == row["k"] and r["published"]:
                numbers = range(1, 8) if r["what"] == "limit_min" else [1]  # springs that switch make several minima
                found = [value_of(row, f"{r['what']} {n}") for n in numbers]
                ours = min((value[0] for value in found if value), default=None)
                yield (f"| {r['value']} | {r['what']} | {r['published']} | {digits(ours, 3)} | {percent(ours, r['published'])} | "
                       f"{float(r['converged']):.3f} |")


def errata_page(results, springs):
    """The handwritten errata, with the tables of springs and of stiffer bases where {springs}, {deep_arch}, {ring} stand."""
    text = (EXAMPLES / "errata.md").read_text(encoding="utf-8")
    tables = {"{springs}": springs}
    for name, file, source in (("{deep_arch}", "errata_deep_arch_springs", "figure_4_31_deep_arch_235"),
                               ("{ring}", "errata_ring_springs", "figure_4_35_ring")):
        tables[name] = list(stiffer_springs(results, file, source))[1:]
    for name, table in tables.items():
        if text.count(name) != 1:
            raise SystemExit(f"errata.md: {name} must stand there once")
        text = text.replace(name, "\n".join(table))
    return text


def converged_rows(results):
    """(reference, load, estimate) of all references that have a converged row of their own."""
    for reference in references():
        rows = results[reference["file"]]
        if all(order_of(row) == 1 for row in rows):
            continue  # coarse meshes only; its converged value is a row of another table
        _, value = pick(rows, reference, False)
        yield reference, *(value or (None, None))
