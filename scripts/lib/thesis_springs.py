"""Special values of columns with one lateral spring (thesis 4.3.1), for the errata."""
from lib.thesis_data import SPRINGS, run_sweep_at

TOLERANCE = 1e-6
# ends, c_b from the top, k_x, exact P_cr/P_e (transfer matrix, 12 digits), what it shows
EXACT = (("PP", 0.5, 100, 2.96830966429, "pinned-pinned, not 4 yet"),
         ("PP", 0.5, 150, 3.86526272967, "pinned-pinned, nor here"),
         ("PP", 0.5, 157.91367041743, 4.0, "pinned-pinned, from here on"),
         ("CF", 0.0, 100, 1.99637734246, "clamped-free"),
         ("CP", 0.359479327630061, 216.623072862487, 6.04679919465894, "clamped-pinned, from here on"),
         ("CC", 0.5, 207.744813742772, 8.18299406375318, "clamped-clamped, from here on"),
         ("CC", 0.5, 1e6, 8.18299406375318, "clamped-clamped, almost rigid"))
# clamped-pinned: k_x and the place of the largest load, known to the nearest 0.005
PLACES = ((10, 0.395), (50, 0.390), (100, 0.380))


def load_of(program, ends, c_b, k_x):
    row, = run_sweep_at(program, SPRINGS[ends], {"fraction": [1 - c_b], "k_x": [k_x]})
    return row["/buckling/load_factors/0"]


def largest_at(program, k_x):
    """The place c_b of the largest load among multiples of 0.005."""
    rows = run_sweep_at(program, SPRINGS["CP"], {"fraction": [1 - 0.005 * i for i in range(68, 84)], "k_x": [k_x]})
    return 1 - max(rows, key=lambda row: row["/buckling/load_factors/0"])["fraction"]


def special_values(program):
    """(table for the errata, mistakes, numbers compared)"""
    table = ["| column | c_b | k_x | exact | ours |", "| --- | --- | --- | --- | --- |"]
    wrong = []
    for ends, c_b, k_x, exact, text in EXACT:
        ours = load_of(program, ends, c_b, k_x)
        table.append(f"| {text} | {c_b:.5g} | {k_x:.8g} | {exact:.6f} | {ours:.6f} |")
        if abs(ours / exact - 1) > TOLERANCE:
            wrong.append(f"{text}, k_x = {k_x}: {ours}, exact {exact}")
    table += ["", "| clamped-pinned, k_x | c_b of the largest load, exact to 0.005 | ours |", "| --- | --- | --- |"]
    for k_x, exact in PLACES:
        ours = largest_at(program, k_x)
        table.append(f"| {k_x} | {exact:.3f} | {ours:.3f} |")
        if abs(ours - exact) > 1e-9:
            wrong.append(f"clamped-pinned, k_x = {k_x}: largest at {ours}, exact {exact}")
    return table, wrong, len(EXACT) + len(PLACES)
