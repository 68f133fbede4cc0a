"""SVG figures in the style of `snapthrough plot`: its style sheet, and shapes that are named by its classes.

Lengths are pixels; y points down. A label may hold `r L^3/EI`, `10^{5}` or `P_{cr}`: what follows ^ or _ is raised or lowered.
"""
import dataclasses
import html
import math
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
LOOKS = ROOT / "api" / "plot" / "looks.cpp"
NARROW, WIDE = "ilI.,:;'|! ()-", "mwMW@%–−=×"  # as in api/plot/labels.cpp
RAISED = re.compile(r"([_^])(\{[^}]*\}|\w(?!\w))")
SMALL = 0.75  # size of raised and lowered letters

# Rules for what `snapthrough plot` does not draw. `solid` holds curves whose dashes say something else than which series they are.
OWN_RULES = """
.guide { stroke: $muted; stroke-width: 1.4; stroke-dasharray: 1.5 4; }
.axis-line { stroke: $muted; stroke-width: 1.8; stroke-dasharray: 6 4; }
.deformed { stroke: $ink; stroke-width: 2.6; }
.cut { stroke: $contact; stroke-width: 1.2; stroke-dasharray: 2 3; }
.tangent { stroke: $accent; stroke-width: 1.8; stroke-dasharray: 6 4; }
.thin { stroke: $accent; stroke-width: .8; opacity: .5; }
.arrow { fill: none; stroke-width: 1.8; }
.arrow.ink { stroke: $ink; } .arrow.accent { stroke: $accent; } .arrow.contact { stroke: $contact; }
.arrow.muted { stroke: $muted; }
.fill { stroke: none; }
.fill.ink { fill: $ink; } .fill.accent { fill: $accent; } .fill.contact { fill: $contact; } .fill.muted { fill: $muted; }
.body { fill: $neutralsoft; stroke: $ink; stroke-width: 1.2; }
.undeformed { stroke-dasharray: 6 4; }
.section-line.moment { stroke: $accent; }
.accent-text { fill: $accent; }
.known { fill: $paper; stroke: $ink; stroke-width: 1.4; }
.again .series-line { stroke-dasharray: 12 4 2 4 2 4; }
.solid .series-line { stroke-dasharray: none; }
.solid .series-line.unstable { stroke-dasharray: 5 5; stroke-width: 1.8; }
.solid .series-line.long { stroke-dasharray: 8 3; } .solid .series-line.short { stroke-dasharray: 1.5 4; }
.solid .series-line.touching { stroke-width: 5; stroke-linecap: butt; }
"""


def colours():
    """{name: colour on light paper} of the style sheet."""
    return dict(re.findall(r'\{"(\w+)", "(#\w+)", "#\w+"\}', LOOKS.read_text(encoding="utf-8")))


def style_sheet(body):
    """The rules of `snapthrough plot` on light paper, and those of OWN_RULES, of which a class stands in a figure's body."""
    sheet = re.search(r'kLooks = R"\((.*?)\)";', LOOKS.read_text(encoding="utf-8"), re.DOTALL)[1]
    common, _, halo = sheet.partition("@supports (paint-order: stroke) {")
    used = {"figure"} | {name for names in re.findall(r'class="([^"]*)"', body) for name in names.split()}
    known = colours()

    def scoped(rules):
        for selectors, block in re.findall(r"([^{}]+)(\{[^}]*\})", rules):
            kept = [one.strip() for one in selectors.split(",") if set(re.findall(r"\.([a-z][\w-]*)", one)) <= used]
            names = ["figure.light".join(one.split("figure", 1)) if one.startswith(".figure") else f".figure.light {one}" for one in kept]
            if names:
                yield ", ".join(names) + " " + re.sub(r"\$(\w+)", lambda name: known[name[1]], block)

    return "\n".join([*scoped(common + OWN_RULES), "@supports (paint-order: stroke) {", *scoped(halo.rpartition("}")[0]), "}"])


def text_width(text, size=12, bold=False):
    """Estimated width of a label."""
    em = sum(0.34 if c in NARROW else 0.9 if c in WIDE else 0.7 if c.isupper() else 0.585 for c in plain(text))
    return em * size * (1.06 if bold else 1)


def plain(text):
    """A label without the marks of raised and lowered letters."""
    return RAISED.sub(lambda part: part[2].strip("{}"), text)


def marked(text, size):
    """A label as SVG."""
    parts, end = [], 0
    for part in RAISED.finditer(text):
        shift = 0.28 * size if part[1] == "_" else -0.36 * size
        parts.append(html.escape(text[end:part.start()], quote=False))
        small = html.escape(part[2].strip("{}"), quote=False)
        # The space without width carries the base line back, also at the end of a label.
        parts.append(f'<tspan dy="{shift:.1f}" font-size="{SMALL * size:g}">{small}</tspan><tspan dy="{-shift:.1f}">&#8203;</tspan>')
        end = part.end()
    return "".join(parts) + html.escape(text[end:], quote=False)


def number(value):
    """A coordinate with two decimals at most."""
    return f"{value:.2f}".rstrip("0").rstrip(".") if abs(value) >= 0.005 else "0"


def points_text(points):
    return " ".join(f"{number(x)},{number(y)}" for x, y in points)


def path(classes, pieces):
    """A line through each of some lists of points."""
    data = "".join("M" + "L".join(f"{number(x)} {number(y)}" for x, y in piece) for piece in pieces if piece)
    return f'<path class="{classes}" d="{data}"/>'


def line(classes, start, end):
    return f'<line class="{classes}" x1="{number(start[0])}" y1="{number(start[1])}" x2="{number(end[0])}" y2="{number(end[1])}"/>'


def circle(classes, at, radius):
    return f'<circle class="{classes}" cx="{number(at[0])}" cy="{number(at[1])}" r="{number(radius)}"/>'


def polygon(classes, points):
    return f'<polygon class="{classes}" points="{points_text(points)}"/>'


def rectangle(classes, x, y, width, height):
    return f'<rect class="{classes}" x="{number(x)}" y="{number(y)}" width="{number(width)}" height="{number(height)}"/>'


def label(classes, at, text, anchor="start", size=12, upright=False):
    """A text; `upright` turns it so that it reads from below."""
    turn = f' transform="rotate(-90 {number(at[0])} {number(at[1])})"' if upright else ""
    return f'<text class="{classes}" x="{number(at[0])}" y="{number(at[1])}" text-anchor="{anchor}"{turn}>{marked(text, size)}</text>'


def arrow(colour, start, end, head=9):
    """A line with a filled head, in ink, accent, contact or muted."""
    length = math.hypot(end[0] - start[0], end[1] - start[1])
    tx, ty = (end[0] - start[0]) / length, (end[1] - start[1]) / length
    neck = (end[0] - 0.8 * head * tx, end[1] - 0.8 * head * ty)
    return line(f"arrow {colour}", start, neck) + arrow_head(colour, end, (tx, ty), head)


def arrow_head(colour, tip, along, head=9):
    """The head of an arrow, from its tip and its unit direction."""
    tx, ty = along
    back = (tip[0] - head * tx, tip[1] - head * ty)
    half = 0.45 * head
    return polygon(f"fill {colour}", [tip, (back[0] + half * ty, back[1] - half * tx), (back[0] - half * ty, back[1] + half * tx)])


def group(classes, shapes):
    return f'<g class="{classes}">' + "".join(shapes) + "</g>"


@dataclasses.dataclass
class Size:
    width: float = 720
    height: float = 480


def document(title, description, size, shapes):
    """A complete SVG file; `title` and `description` are spoken by screen readers."""
    body = rectangle("paper", 0, 0, size.width, size.height) + "\n" + "\n".join(shapes)
    return ('<?xml version="1.0" encoding="UTF-8"?>\n'
            f'<svg xmlns="http://www.w3.org/2000/svg" class="figure light" viewBox="0 0 {number(size.width)} {number(size.height)}" '
            f'width="{number(size.width)}" height="{number(size.height)}" role="img">'
            f"<title>{html.escape(plain(title), quote=False)}</title><desc>{html.escape(plain(description), quote=False)}</desc>\n"
            f"<style>{html.escape(style_sheet(body), quote=False)}</style>\n{body}\n</svg>\n")
