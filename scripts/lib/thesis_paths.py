"""Numbers of the path requests: the tables of the beam and of the columns, and what is checked of them."""
from lib.thesis_data import ROOT, read_csv, references
from lib.thesis_figures import BEAM_SUPPORTS, NONLINEAR_BEAM, STIFFNESS, beam_point, beam_runs

LINEAR_BEAM = ROOT / "tests/verification/data/beam_winkler_uniform_linear_4_2.csv"
LINEAR = {"type": "static", "geometry": "linear", "load_factors": [1], "discretization": {"elements": 16, "order": 5},
          "output": {"states": "all", "points_per_member": 201}}
BEAM_TOLERANCE = 1e-5  # the nonlinear reference has ten decimals and an inextensible axis; here EA L^2/EI is 1e9
BASE_FORCE_TOLERANCE = 1e-4  # trapezoids over 200 intervals
PLATEAU = 39.494012  # P (1 - P/EA) = pi^2 EI/L^2 with L = 5, EI = 100, EA = 1e5
PATH_TOLERANCE = 1e-4  # the paths ask for 1e-5
DRAWN = {"table_4_5_arch_outside_base": ("arch_outside_base", 1.4e-8, (0, 1e5, 1e7, 1e9)),
         "table_4_7_arch_inside_base": ("arch_inside_base", 1.4e-8, (0, 1e4, 2.5e4)),
         "figure_4_31_deep_arch_235": ("deep_arch_235", 1e-6, (0, 1e2, 1e3, 1e4, 1e5)),
         "figure_4_35_ring": ("ring", 3, (1200, 1e4, 5e4, 1.8e5))}
MESHES = {4: 71.93, 6: 67.76, 8: 66.38, 10: 65.76, 20: 64.95}  # table 4.1 as printed


def nonlinear_beam(runs):
    """(K, load, w/L, its reference, r L^3/EI in the middle, its reference) of the sliding beam."""
    results = beam_runs(runs)
    for row in read_csv(NONLINEAR_BEAM):
        result = results.get((int(row["K"]), "sliding"))
        states = [] if result is None else result["states"]
        for state in states:
            if abs(state["load_factor"] / float(row["Lam"]) - 1) < 1e-9:
                _, w, reaction, _ = beam_point(state)
                yield row["K"], row["Lam"], w, float(row["wmid_over_L"]), reaction, float(row["k_wmid"])


def linear_beam(runs):
    """(K, w/(L Lambda), its closed form, R_B/Lambda, its closed form), small displacements."""
    for row in read_csv(LINEAR_BEAM):
        if float(row["K"]) in (1, 9, 30, 50):
            result = runs("beam_on_soil", ("/analysis", LINEAR), (STIFFNESS, float(row["K"])))
            _, w, _, force = beam_point(result["states"][0])
            # per unit of q; at load factor 1 q is 0.1, and L^2/EI is 1
            yield row["K"], w, float(row["wmid_over_L_per_Lambda"]), force, 0.1 * float(row["F_found_per_q"])


def column_meshes(runs):
    """(elements, published, limit load of the imperfect path) with straight elements and lumped springs."""
    for elements, published in MESHES.items():
        result = runs("column_bonded_base", ("/analysis/discretization", {"elements": elements, "order": 1, "foundation": "lumped"}))
        yield elements, published, next(p["load_factor"] for p in result["critical_points"] if p["type"] == "limit_max")


def known_limits(runs):
    """(name, load, reference) of the critical points of arches and ring whose paths are drawn."""
    for r in references():
        name, scale, stiffnesses = DRAWN.get(r["file"], (None, 0, ()))
        k = float(r["value"])
        if k not in stiffnesses or "limit_max 2" in r["what"]:
            continue  # the paths drawn end before a second maximum
        found = [p["load_factor"] for p in runs(name, (STIFFNESS, k * scale))["critical_points"] if p["type"] == r["what"]]
        yield f"{name} k = {r['value']} {r['what']}", found[0] if found else float("nan"), float(r["converged"])


def plateau_points(result):
    """Loads of the path while the column has left its base and is hardly bent."""
    branch = result["branches"][0]
    return [load for load, w in zip(branch["load_factor"], branch["monitors"]["mid"]) if 1e-3 < abs(w) < 0.015]


def check_paths(runs):
    """(mistakes, numbers compared)"""
    wrong, compared = [], 0

    def compare(name, ours, reference, tolerance):
        nonlocal compared
        compared += 1
        if not abs(ours / reference - 1) <= tolerance:  # not a number is wrong too
            wrong.append(f"{name}: {ours}, reference {reference}")

    for K, load, w, exact, reaction, exact_reaction in nonlinear_beam(runs):
        # half a unit of the reference's last digit besides
        compare(f"beam K = {K}, load {load}", w, exact, BEAM_TOLERANCE + 0.5e-11 / exact)
        compare(f"beam K = {K}, load {load}, base", reaction, exact_reaction, BEAM_TOLERANCE + 0.5e-10 / exact_reaction)
    for K, w, exact, force, exact_force in linear_beam(runs):
        compare(f"linear beam K = {K}", w, exact, 1e-6)
        compare(f"linear beam K = {K}, base", force, exact_force, BASE_FORCE_TOLERANCE)
    for K in (10, 50, 75, 500, 1000):
        result = runs("column_one_sided_base", (STIFFNESS, K))
        loads = plateau_points(result)
        # the straight column's bifurcation is beside the path
        met = [p for p in result["critical_points"] if p["type"] != "broken_bifurcation"]
        wrong += [] if len(loads) > 1 and not met else [f"column on one side, K = {K}: no plateau"]
        # how many points a path has there is the steps' business: the farthest stands for all
        farthest = max(loads, key=lambda load: abs(load / PLATEAU - 1), default=float("nan"))
        compare(f"column on one side, K = {K}", farthest, PLATEAU, 2e-5)  # Koiter: the load rises by (w pi/L)^2/8
    for elements, published, ours in column_meshes(runs):
        compare(f"table 4.1, {elements} elements", ours, published, 0.02)
    for name, ours, reference in known_limits(runs):
        compare(name, ours, reference, PATH_TOLERANCE)
    return wrong, compared


def beam_table(runs):
    yield from ("| K | load | w/L | reference | % | R_B | reference | % |", "| --- | --- | --- | --- | --- | --- | --- | --- |")
    for K, load, w, exact, reaction, exact_reaction in nonlinear_beam(runs):
        yield (f"| {K} | {load} | {w:.8f} | {exact:.8f} | {100 * (w / exact - 1):+.4f} | {reaction:.7f} | {exact_reaction:.7f} | "
               f"{100 * (reaction / exact_reaction - 1):+.4f} |")


def linear_beam_table(runs):
    yield from ("| K | w/(L Λ) | closed form | % | resultant R L^2/(EI Λ) | closed form | % |", "| --- | --- | --- | --- | --- | --- | --- |")
    for K, w, exact, force, exact_force in linear_beam(runs):
        yield (f"| {K} | {w:.10f} | {exact:.10f} | {100 * (w / exact - 1):+.5f} | {force:.7f} | {exact_force:.7f} | "
               f"{100 * (force / exact_force - 1):+.4f} |")


def fixed_beam_table(runs):
    labels = [label for label, _, _ in BEAM_SUPPORTS]
    yield "| K | " + " | ".join(f"w/L, {label}" for label in labels) + " |"
    yield "| --- | --- | --- | --- |"
    results = beam_runs(runs)
    for K in (1, 9, 30, 50):
        last = [beam_point(results[K, label]["states"][-1])[1] for label in labels]
        yield f"| {K} | " + " | ".join(f"{w:.6f}" for w in last) + " |"


def column_table(runs):
    yield from ("| elements | published | ours, path | % |", "| --- | --- | --- | --- |")
    for elements, published, ours in column_meshes(runs):
        yield f"| {elements} | {published} | {ours:.3f} | {100 * (ours / published - 1):+.2f} |"
    result = runs("column_bonded_base")
    point = result["critical_points"][0]
    yield f"| converged | | {point['load_factor']:.6f} (error estimate {point['error_estimate']:.0e}) | |"


def one_sided_table(runs):
    yield from ("| K | lowest and highest load on the plateau | critical points on the path |", "| --- | --- | --- |")
    for K in (10, 50, 75, 500, 1000):
        result = runs("column_one_sided_base", (STIFFNESS, K))
        loads = plateau_points(result)
        yield f"| {K} | {min(loads):.5f}, {max(loads):.5f} | {sum(p['type'] != 'broken_bifurcation' for p in result['critical_points'])} |"


TABLES = {"{linear_beam}": linear_beam_table, "{beam}": beam_table, "{fixed_beam}": fixed_beam_table, "{columns}": column_table,
          "{one_sided}": one_sided_table}


def filled(text, runs):
    """A page with its tables where their names stand."""
    for name, table in TABLES.items():
        if name in text:
            text = text.replace(name, "\n".join(table(runs)))
    return text
