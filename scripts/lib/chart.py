"""Charts in the style of `snapthrough plot`: curves over two axes, linear or logarithmic, with a legend above them."""
import dataclasses
import math

from lib.svg_figure import Size, circle, document, group, label, line, path, plain, polygon, text_width

MARGIN, HEADING, ROW = 14, 26, 18
SERIES = 6  # colours of the style sheet; further series repeat them with other dashes
MARKS = {"maximum": [(0, -6.5), (6, 4.5), (-6, 4.5)], "minimum": [(0, 6.5), (6, -4.5), (-6, -4.5)],
         "bifurcation": [(0, -7), (6, 0), (0, 7), (-6, 0)]}
MARK_CLASSES = {"maximum": "mark limit", "minimum": "mark limit", "bifurcation": "mark bifurcation"}
SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
THIN = "\u202f"


@dataclasses.dataclass
class Curve:
    """Pieces of points in one style.

    A curve with the label None is not in the legend; one with pieces None is only there.
    """
    label: str | None
    pieces: list | None
    series: int | None = 0  # number of the colour; None: a guide in grey
    looks: str = ""  # classes of the line besides: unstable, long, short, touching
    mark: str | None = None  # dot, known (a ring), or a name of MARKS
    joined: bool = True  # whether a line joins the points
    dashed: bool = False  # whether the series has the dashes of its number


@dataclasses.dataclass
class Axes:
    """Title, labels, ranges (None: from the data) and scales."""
    title: str
    x: str
    y: str
    x_range: tuple = (None, None)
    y_range: tuple = (None, None)
    logarithmic: str = ""  # "x", "y", "xy"
    equal: bool = False  # one unit is as long on both axes
    percent: bool = False  # the ordinate is a share
    x_ticks: tuple = ()  # in place of round numbers


@dataclasses.dataclass
class Scale:
    """An axis: pixels `start` to `end` stand for the values `low` to `high`."""
    low: float
    high: float
    start: float
    end: float
    log: bool

    def __call__(self, value):
        if self.log:
            share = math.log10(value / self.low) / math.log10(self.high / self.low)
        else:
            share = (value - self.low) / (self.high - self.low)
        return self.start + share * (self.end - self.start)


def line_of(label_, points, series=0, **more):
    return Curve(label_, [points], series, **more)


def marks(label_, points, mark="dot", series=0):
    return Curve(label_, [points], series, mark=mark, joined=False)


def guide(label_, points):
    return Curve(label_, [points], None)


def values(curves, index):
    return [point[index] for curve in curves for piece in curve.pieces or [] for point in piece]


def linear_range(found, asked):
    """A range with room around the data, from zero where they begin near it."""
    low, high = (given if given is not None else pick(found) for given, pick in zip(asked, (min, max)))
    if high == low:
        half = 0.5 * abs(low) or 1
        return low - half, high + half
    room = 0.06 * (high - low)
    if asked[0] is None:
        low = 0 if 0 <= low < 0.25 * high else low - room
    if asked[1] is None:
        high = high if high == 0 else high + room
    return low, high


def log_range(found):
    low, high = math.log10(min(found)), math.log10(max(found))
    room = 0.04 * (high - low) or 0.5
    return 10 ** (low - room), 10 ** (high + room)


def linear_ticks(scale, spacing):
    rough = (scale.high - scale.low) / max(1, abs(scale.end - scale.start) / spacing)
    power = 10 ** math.floor(math.log10(rough))
    step = power * next(share for share, most in ((1, 1.5), (2, 3.5), (5, 7.5), (10, math.inf)) if rough / power < most)
    first, last = math.ceil(scale.low / step - 1e-9), math.floor(scale.high / step + 1e-9)
    for i in range(first, last + 1):
        yield i * step, number_text(i * step)


def number_text(value):
    """A number as on the axes of `snapthrough plot`: 0.05, −1000, 20 000, 3 × 10⁶."""
    sign = "−" if value < 0 else ""
    mantissa, _, exponent = f"{abs(value):.9e}".partition("e")
    if value == 0 or -3 <= int(exponent) < 6:
        text = f"{abs(value):.10f}".rstrip("0").rstrip(".")
        return sign + (f"{int(text):,}".replace(",", THIN) if text.isdigit() and len(text) > 4 else text)
    mantissa, ten = mantissa.rstrip("0").rstrip("."), "10" + str(int(exponent)).translate(SUPERSCRIPTS)
    return sign + (ten if mantissa == "1" else f"{mantissa}{THIN}×{THIN}{ten}")


def log_ticks(scale, spacing):
    """Powers of ten, every second or third one where they are many, and 2 and 5 times them where they are few."""
    decades = math.log10(scale.high / scale.low)
    count = max(1, abs(scale.end - scale.start) / spacing)
    every = max(1, round(decades / count))
    shares = (1,) if decades > 0.7 * count else (1, 3) if decades > 0.35 * count else (1, 2, 5)
    for power in range(math.floor(math.log10(scale.low)), math.ceil(math.log10(scale.high)) + 1):
        for share in shares if power % every == 0 else ():
            value = share * 10.0 ** power
            if scale.low * (1 - 1e-9) <= value <= scale.high * (1 + 1e-9):
                yield value, number_text(value)


def ticks(scale, spacing):
    return list((log_ticks if scale.log else linear_ticks)(scale, spacing))


def clipped(piece, x, y):
    """Parts of a line of values inside a frame, in pixels."""
    left, right, bottom, top = x.start, x.end, y.start, y.end
    parts, last = [], None
    pixels = [(x(a), y(b)) for a, b in piece]
    for start, end in zip(pixels, pixels[1:]):
        begin, stop = 0.0, 1.0
        for here, there, low, high in ((start[0], end[0], left, right), (start[1], end[1], top, bottom)):
            if here == there:
                begin = begin if low <= here <= high else 2.0
                continue
            one, other = sorted(((low - here) / (there - here), (high - here) / (there - here)))
            begin, stop = max(begin, one), min(stop, other)
        if begin > stop:
            continue
        ends = [(start[0] + t * (end[0] - start[0]), start[1] + t * (end[1] - start[1])) for t in (begin, stop)]
        if last is None or begin > 0 or last != start:
            parts.append([ends[0]])
        parts[-1].append(ends[1])
        last = end if stop == 1.0 else None
    return parts


def mark_shape(curve, at):
    if curve.mark in MARKS:
        return polygon(MARK_CLASSES[curve.mark], [(at[0] + dx, at[1] + dy) for dx, dy in MARKS[curve.mark]])
    return circle("known", at, 3.6) if curve.mark == "known" else circle("series-dot", at, 2.4)


def in_series(curve, shapes):
    """Shapes in the colour of a curve."""
    if curve.series is None:
        return group("guides", shapes)
    series = f"series series-{curve.series % SERIES}"
    return group("again" if curve.series >= SERIES else "dashes" if curve.dashed else "solid", [group(series, shapes)])


def line_classes(curve):
    return "guide" if curve.series is None else f"series-line {curve.looks}".strip()


def curve_shape(curve, x, y):
    shapes = []
    if curve.joined:
        shapes.append(path(line_classes(curve), [part for piece in curve.pieces for part in clipped(piece, x, y)]))
    for a, b in (point for piece in curve.pieces for point in piece if curve.mark):
        at = (x(a), y(b))
        if x.start - 0.5 <= at[0] <= x.end + 0.5 and y.end - 0.5 <= at[1] <= y.start + 0.5:
            shapes.append(mark_shape(curve, at))
    return in_series(curve, shapes)


def legend_places(curves, left, width):
    """[(curve, place of its sample)], and the number of rows."""
    places, x, row = [], left, 0
    for curve in curves:
        room = sample_width(curve) + text_width(curve.label) + 18
        if x > left and x + room - 18 > width:
            x, row = left, row + 1
        places.append((curve, (x, 10 + ROW * row)))
        x += room
    return places, row + 1 if places else 0


def sample_width(curve):
    return 30 if curve.joined else 18 if curve.mark else 0


def legend_shape(places, top):
    shapes = []
    for curve, (x, y) in places:
        y += top
        sample = [line(line_classes(curve), (x, y), (x + 24, y))] if curve.joined else []
        if curve.mark:
            sample.append(mark_shape(curve, (x + (12 if curve.joined else 6), y)))
        shapes += [in_series(curve, sample), label("legend-text", (x + sample_width(curve), y + 4), curve.label)]
    return group("legend", shapes)


def frame_shape(axes, x, y, size):
    shapes = []
    free = -math.inf
    for value, text in [(value, number_text(value)) for value in axes.x_ticks] or ticks(x, 80):
        at = x(value)
        shapes.append(line("grid zero" if value == 0 and not x.log else "grid", (at, y.start), (at, y.end)))
        half = text_width(text) / 2
        if at - half >= free:
            shapes.append(label("tick", (at, y.start + 16), text, "middle"))
            free = at + half + 10
    for value, text in ticks(y, 50):
        at = y(value)
        shapes.append(line("grid zero" if value == 0 and not y.log else "grid", (x.start, at), (x.end, at)))
        shapes.append(label("tick", (x.start - 8, at + 4), f"{100 * value:.0f} %" if axes.percent else text, "end"))
    shapes.append(label("axis-label", ((x.start + x.end) / 2, size.height - MARGIN - 4), axes.x, "middle"))
    shapes.append(label("axis-label", (MARGIN + 12, (y.start + y.end) / 2), axes.y, "middle", upright=True))
    return group("frame", shapes)


def equalised(x, y):
    """Ranges widened about their middles so that a unit is as long on both axes."""
    unit_x, unit_y = ((scale.high - scale.low) / abs(scale.end - scale.start) for scale in (x, y))
    unit = max(unit_x, unit_y)
    for scale in (x, y):
        middle, half = (scale.low + scale.high) / 2, unit * abs(scale.end - scale.start) / 2
        scale.low, scale.high = middle - half, middle + half


def scales(axes, curves, size, legend_rows):
    """The two axes in pixels."""
    bottom, top = size.height - MARGIN - 44, MARGIN + HEADING + ROW * legend_rows + 12
    ranges = [log_range(values(curves, i)) if name in axes.logarithmic else linear_range(values(curves, i), asked)
              for i, (name, asked) in enumerate((("x", axes.x_range), ("y", axes.y_range)))]
    y = Scale(*ranges[1], bottom, top, "y" in axes.logarithmic)
    widest = max(text_width("100 %" if axes.percent else text) for _, text in ticks(y, 50))
    x = Scale(*ranges[0], MARGIN + max(62, widest + 34), size.width - MARGIN - 28, "x" in axes.logarithmic)
    if axes.equal:
        equalised(x, y)
    return x, y


def chart_shapes(axes, curves, size, left=0):
    """The shapes of a chart whose left edge is at `left`."""
    drawn = [curve for curve in curves if curve.pieces is None or any(curve.pieces)]
    named = [curve for curve in drawn if curve.label]
    places, rows = legend_places(named if len(named) > 1 else [], MARGIN + 62, size.width - MARGIN)
    x, y = scales(axes, drawn, size, rows)
    shapes = [label("heading", (MARGIN, MARGIN + 11), axes.title, size=13), frame_shape(axes, x, y, size)]
    shapes += [curve_shape(curve, x, y) for curve in drawn if curve.pieces is not None]
    shapes.append(legend_shape(places, MARGIN + HEADING))
    return f'<g transform="translate({left} 0)">' + "\n".join(shapes) + "</g>" if left else "\n".join(shapes)


def description(axes, curves):
    names = [plain(curve.label) for curve in curves if curve.label and curve.pieces]
    return f"{axes.y} over {axes.x}" + (": " + ", ".join(names) if len(names) > 1 else "") + "."


def chart(axes, curves, size=Size()):
    """An SVG file of one chart."""
    return document(axes.title, description(axes, curves), size, [chart_shapes(axes, curves, size)])


def charts_beside(charts, size=Size()):
    """An SVG file of charts from left to right, [(axes, curves)]."""
    shapes = [chart_shapes(axes, curves, size, i * size.width) for i, (axes, curves) in enumerate(charts)]
    words = " ".join(description(axes, curves) for axes, curves in charts)
    return document(charts[0][0].title, words, Size(size.width * len(charts), size.height), shapes)
