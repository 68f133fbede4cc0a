"""The pages of numbers of docs/thesis: published, on the thesis' mesh, converged, closed form."""
from lib.thesis_data import as_printed, digits, on_thesis_mesh, percent, pick, references

HEAD = ("| case | what | published | Silveira 2013 | thesis' mesh | % | converged | error estimate | reference | % | remark |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |")
INTRODUCTION = """# Tables and limit loads

Thesis' mesh: straight elements of order 1 (3 in tables 4.2 and 4.3), springs lumped at the nodes, as many elements as
the thesis used (40 for arches, 50 for the ring). Converged: `accuracy` 1e-6 asked for, with the relative error estimate
that the result carries. Reference: a closed form for columns, P_e (n^2 + k/n^2); for arches and rings collocation with
the contact edges as unknowns. Differences in per cent: of our value on the thesis' mesh from the published one, and of
the converged value from the reference. Blank: nothing published, or nothing found on that mesh.

Loads: columns P; arches P R^2/EI; ring q R^3/EI. Base: columns K; arches and ring k = K R^4/EI.
"""
SECTIONS = {
    "4.1": "## Table 4.1: column on a bonded base, K = 10, meshes\n\n"
           "Ours is linearised: the load that the thesis' path reaches is the buckling load of its imperfect column, and\n"
           "[the columns' page](columns.md) has the paths. That straight elements of order 1 differ from the thesis' by up to 2 %\n"
           "with 4 elements is the mesh's error in either; it vanishes in the converged value.",
    "4.2": "## Table 4.2: column on a bonded base, K = 15.6, half-waves 1 to 4\n\n"
           "Thesis' mesh here and in table 4.3: 20 elements of order 3 with springs lumped at their nodes, because the linear\n"
           "analyses are read as made with ANSYS' BEAM3, whose deflection is a cubic. With elements of order 1 n = 4 is 179.13 and\n"
           "199.68, 6 to 7 % off, n = 2 and 3 are 79.98, 110.11 and 160.17, 146.12: nearer at n = 2, farther at n = 3. The published\n"
           "loads for n = 2 and 3 are 1.0 to 1.5 % above the closed form, those for n = 1 and 4 0.1 to 0.4 % below it or within 0.02\n"
           "%; no one mesh gives that.",
    "4.3": "## Table 4.3: column on a bonded base, K = 47, half-waves 1 to 4",
    "4.4": "## Table 4.4: shallow arch, base outside, k = 1e5, meshes",
    "4.5": "## Table 4.5: shallow arch, base outside",
    "4.6, 4.7": "## Tables 4.6, 4.7: shallow arch, base inside\n\n"
           "From about k = 35 500 on there is no limit point.",
    "4.4.3, 235 deg": "## Deep arch of 235 degrees, base outside (4.4.3)\n\n"
           "On the thesis' mesh minima after the first maximum may be those of springs that switch one by one, which no finer mesh\n"
           "has.",
    "4.4.3, 215 deg": "## Deep arch of 215 degrees, base outside (the literature's angle)",
    "4.5 ring": "## Ring in an elastic medium (4.5)",
}


def table_row(results, r):
    rows = results[r["file"]]
    _, coarse = pick(rows, r, True)
    _, fine = pick(rows, r, False)
    coarse_load = coarse[0] if coarse else None
    load, estimate = fine if fine else (None, None)
    cells = (f"{r['key']} = {r['value']}", r["what"], r["published"], r["s13"], digits(coarse_load, 3),
             percent(coarse_load, r["published"]), digits(load), "" if estimate is None else f"{estimate:.0e}",
             as_printed(r["converged"]), percent(load, r["converged"], 4), r["note"])
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


def converged_rows(results):
    """(reference, load, estimate) of all references that have a converged row of their own."""
    for reference in references():
        rows = results[reference["file"]]
        if all(on_thesis_mesh(row) for row in rows):
            continue  # coarse meshes only; its converged value is a row of another table
        _, value = pick(rows, reference, False)
        yield reference, *(value or (None, None))


def published_rows(results):
    """(reference, load on the thesis' mesh) of all references that have a published value."""
    for reference in references():
        if reference["published"]:
            _, value = pick(results[reference["file"]], reference, True)
            yield reference, value[0] if value else None
