"""Equilibrium paths as curves of a chart: stable parts solid, unstable ones dashed, critical points marked by kind."""
from lib.chart import Curve, marks

KINDS = (("limit_max", "maximum"), ("limit_min", "minimum"), ("bifurcation", "bifurcation"))
COLOURS = (0, 1, 2, 3, 5, 4)  # of paths; grey is the last, as it stands for all paths in the legend of up to five


def path_nodes(result, number, x):
    """[(arc length, (x, load), negative eigenvalues from here on)] of a branch, its critical points between the steps."""
    branch = result["branches"][number]
    nodes = [(s, (x({name: values[i] for name, values in branch["monitors"].items()}), load), negative)
             for i, (s, load, negative) in enumerate(zip(branch["arc_length"], branch["load_factor"], branch["negative_eigenvalues"]))]
    nodes += [(point["arc_length"], (x(point["monitors"]), point["load_factor"]), point["negative_after"])
              for point in result["critical_points"] if point["branch"] == number]
    return sorted(nodes, key=lambda node: node[0])


def path_pieces(result, x):
    """(stable, unstable): pieces of all branches, cut where stability changes."""
    parts = ([], [])
    for number in range(len(result["branches"])):
        nodes = path_nodes(result, number, x)
        previous = None
        for (_, start, negative), (_, end, _) in zip(nodes, nodes[1:]):
            unstable = negative > 0
            if unstable != previous:
                parts[unstable].append([start])
            parts[unstable][-1].append(end)
            previous = unstable
    return parts


def equilibrium_paths(paths, x):
    """Curves of [(label, result)], a colour for each.

    @param x  abscissa of a {monitor: displacement}; the ordinate is the load factor
    """
    curves, both = [], ([], [])
    for (label, result), series in zip(paths, COLOURS):
        stable, unstable = path_pieces(result, x)
        name = label if len(paths) > 1 else None
        curves.append(Curve(name, stable or [[]], series))
        curves.append(Curve(None if stable else name, unstable, series, "unstable"))
        for all_, some in zip(both, (stable, unstable)):
            all_.extend(some)
    if len(paths) > 5:
        curves.append(Curve("solid stable, dashed unstable" if all(both) else None, None, joined=False))
    elif both[1]:
        series = COLOURS[5] if len(paths) > 1 else 0
        curves += [Curve(name, None, series, looks) for name, looks in (("stable", ""), ("unstable", "unstable"))]
    for kind, name in KINDS:
        points = [(x(p["monitors"]), p["load_factor"]) for _, result in paths for p in result["critical_points"] if p["type"] == kind]
        curves.append(marks(name, points, name))
    return curves
