"""SVG plots through gnuplot, and equilibrium paths with their unstable parts dashed."""
import dataclasses
import subprocess

PALETTE = ("#1f5fa8", "#c8501e", "#2e8540", "#7b3f99", "#8a6d00", "#b0246a", "#3a3a3a", "#0d8a8a")
KINDS = (("limit_max", "maximum", 9), ("limit_min", "minimum", 11), ("bifurcation", "bifurcation", 6))


@dataclasses.dataclass
class Curve:
    """Pieces of points in one style; a label None stays out of the key; pieces None only explains a style there."""
    label: str | None
    style: str
    pieces: list | None


@dataclasses.dataclass
class Axes:
    """Title, labels and what else of gnuplot's `set` a plot needs."""
    title: str
    x: str
    y: str
    settings: tuple = ()


def line(label, points, color, extra=""):
    return Curve(label, f"lines lw 1.8 lc rgb '{color}' {extra}", [points])


def marks(label, points, color, kind=7, size=0.7):
    return Curve(label, f"points pt {kind} ps {size} lw 1.5 lc rgb '{color}'", [points])


def plot(path, axes, curves):
    """Writes one SVG of 800 x 500."""
    script = ["set encoding utf8", "set terminal svg size 800,500 font 'DejaVu Sans,13' background 'white'",
              f"set output '{path}'", f"set title '{axes.title}'", f"set xlabel '{axes.x}'", f"set ylabel '{axes.y}'",
              "set grid lc rgb '#dddddd'", "set border lc rgb '#555555'", "set key outside right Left reverse", *axes.settings]
    drawn = [curve for curve in curves if curve.pieces is None or any(curve.pieces)]
    for i, curve in enumerate(drawn):
        if curve.pieces is None:
            continue
        script.append(f"$c{i} << E")
        for piece in curve.pieces:
            script += [f"{x:.8g} {y:.8g}" for x, y in piece] + [""]
        script.append("E")
    script.append("plot " + ", ".join(
        ("keyentry" if curve.pieces is None else f"$c{i}") + f" with {curve.style} " + (f"title '{curve.label}'" if curve.label else "notitle") for i, curve in enumerate(drawn)))
    subprocess.run(["gnuplot"], input="\n".join(script) + "\n", text=True, check=True)


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


def equilibrium_paths(paths, x, colors=PALETTE):
    """Curves of [(label, result)]: stable parts solid, unstable ones dashed, critical points marked by kind.

    @param x  abscissa of a {monitor: displacement}; the ordinate is the load factor
    """
    curves = []
    for (label, result), color in zip(paths, colors):
        stable, unstable = path_pieces(result, x)
        curves.append(Curve(label, f"lines lw 1.8 lc rgb '{color}'", stable or [[]]))
        curves.append(Curve(None if stable else label, f"lines lw 1.4 dt (6,4) lc rgb '{color}'", unstable))
    for kind, name, symbol in KINDS:  # black, so that they stand out on every colour
        points = [(x(p["monitors"]), p["load_factor"]) for _, result in paths for p in result["critical_points"] if p["type"] == kind]
        curves.append(marks(name, points, "#000000", symbol, 0.9))
    curves.append(Curve("stable", "lines lw 1.8 lc rgb '#777777'", None))
    curves.append(Curve("unstable", "lines lw 1.4 dt (6,4) lc rgb '#777777'", None))
    return curves
