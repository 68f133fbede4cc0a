// A sweep over one parameter: an output against it, one line for each value of other parameters; failed points as crosses on the
// axis, with why; the breaks of refined curves as rings, with what changes there.

import { at } from "../geometry";
import { Occupancy } from "../labels";
import { formatNumber } from "../numbers";
import { coordinate, figure, group, label, pathData, shape, type Pixel, type Shape, type Size } from "../shape";
import { frameShapes, makeScale, place, plotArea, widened, type Frame, type Scale } from "./axes";
import { breakLabels, breakMarks, type DrawnBreak } from "./breaks";
import { legendHeight, legendShape, type LegendEntry } from "./legend";
import { breaksOf, piecesOf, type Break, type Pieces } from "./pieces";
import { columnLabel, columnOf, errorsOf, extentOf, failureText, type RowError, type SweepAxis, type Table } from "./sweep";
import { thinned } from "./thin";

export interface SweepLineInput {
  table: Table;
  x: SweepAxis;
  y: SweepAxis;
  /** Columns of further parameters; a line for each combination of their values. */
  series?: string | readonly string[] | undefined;
  /** Index of a row. */
  chosen?: number | null | undefined;
}

/** A row's place: index in the table's rows. */
interface Spot {
  row: number;
  x: number;
  y: number;
}

export interface SweepLineChart {
  frame: Frame;
  /** Each with the places at which it breaks though both rows may have values. */
  lines: { name: string; spots: Spot[]; breaks: Break<Spot>[] }[];
  failed: { row: number; x: number; error: RowError }[];
  /** How many rows failed with which code; "" when none did. */
  failures: string;
  size: Size;
}

const kNamed = 16;  // more lines than these are crowded: not named, without dots
const kTolerance = 0.25;  // px that a thinned line may be off
const kCrowdedTolerance = 0.75;
const kRingWeight = 40;  // of the cells of a ring that a name would cover
const kSeries = 6;  // colours; further lines begin again

/** What tells the line of a row from other lines: its values of the further parameters, and the name that they give the line. */
function seriesOf(input: SweepLineInput): ((row: number) => { key: string; name: string }) | null {
  const names = typeof input.series === "string" ? [input.series] : input.series ?? [];
  const columns = names.map((name) => ({ name, ...columnOf(input.table, name) }));
  return columns.length === 0 ? null : (row) => ({
    key: columns.map(({ values }) => at(values, row)).join(" "),
    name: columns.map((one) => `${one.name} = ${one.names?.[at(one.values, row)] ?? formatNumber(at(one.values, row))}`).join(", "),
  });
}

function linesOf(input: SweepLineInput, xs: readonly number[], ys: readonly number[], pieces: Pieces | null): SweepLineChart["lines"] {
  const series = seriesOf(input);
  const groups = new Map<string, { name: string; spots: Spot[] }>();
  for (let row = 0; row < xs.length; ++row) {
    const { key, name } = series?.(row) ?? { key: "", name: "" };
    const line = groups.get(key) ?? { name, spots: [] };
    line.spots.push({ row, x: at(xs, row), y: at(ys, row) });
    groups.set(key, line);
  }
  const named = groups.size <= kNamed;
  return [...groups.values()].map(({ name, spots: all }) => {
    const spots = all.filter((spot) => Number.isFinite(spot.x)).sort((a, b) => a.x - b.x);
    return { name: named ? name : "", spots, breaks: breaksOf(spots, pieces) };
  });
}

function scaleOf(values: readonly number[], names: readonly string[] | null, log: boolean, start: number, end: number,
                 tight: boolean): Scale {
  if (names) return makeScale(-0.5, Math.max(0.5, names.length - 0.5), start, end);
  const [low, high] = extentOf(values, log);
  if (log && low < high) return tight ? makeScale(low, high, start, end, true)
                                      : makeScale(low / 1.1, high * 1.1, start, end, true);
  const [from, to] = tight && low < high ? [low, high] : widened(low, high);
  return makeScale(from, to, start, end);
}

/** Lays the chart out. */
export function sweepLineChart(input: SweepLineInput, size: Size): SweepLineChart {
  const x = columnOf(input.table, input.x.column);
  const y = columnOf(input.table, input.y.column);
  const errors = errorsOf(input.table);
  const lines = linesOf(input, x.values, y.values, piecesOf(input.table));
  const failures = failureText(errors);
  const top = 12 + (failures === "" ? 0 : 18) + legendHeight(legendEntries(lines), size.width);
  const frame = {
    x: scaleOf(x.values, x.names, input.x.log ?? false, 66, Math.max(90, size.width - 28), true),
    y: scaleOf(y.values, y.names, input.y.log ?? false, Math.max(60, size.height - 44), top, false),
    xLabel: columnLabel(input.x),
    yLabel: columnLabel(input.y),
    xNames: x.names ?? undefined,
    yNames: y.names ?? undefined,
  };
  const failed = errors.flatMap((error, row) => {
    const where = at(x.values, row);
    return error && Number.isFinite(where) ? [{ row, x: where, error }] : [];
  });
  return { frame, lines, failed, failures, size };
}

function pixelOf(frame: Frame, spot: { x: number; y: number }): Pixel {
  return { x: place(frame.x, spot.x), y: place(frame.y, spot.y) };
}

/** A line with its gaps, thinned between them. */
function lineData(points: readonly Pixel[], tolerance: number): string {
  let text = "";
  let part: Pixel[] = [];
  const finish = () => {
    text += pathData(thinned(part, tolerance).flatMap((i) => part[i] ?? []));
    part = [];
  };
  for (const point of points) {
    if (Number.isFinite(point.x + point.y)) part.push(point);
    else finish();
  }
  finish();
  return text;
}

function cross(className: string, at: Pixel, title: string): Shape {
  const d = pathData([{ x: at.x - 4, y: at.y - 4 }, { x: at.x + 4, y: at.y + 4 }]) +
    pathData([{ x: at.x - 4, y: at.y + 4 }, { x: at.x + 4, y: at.y - 4 }]);
  return shape("path", { class: className, d }, shape("title", {}, title));
}

/** Crosses on the axis, one for all that fall on the same pixel. */
function failedShapes(chart: SweepLineChart): Shape {
  const seen = new Set<number>();
  const crosses = chart.failed.flatMap(({ x, error }) => {
    const pixel = Math.round(place(chart.frame.x, x));
    if (seen.has(pixel)) return [];
    seen.add(pixel);
    return [cross("mark failed", { x: pixel, y: chart.frame.y.start - 7 }, `${error.code}: ${error.detail}`)];
  });
  return group("failed-points", ...crosses);
}

function isCrowded(chart: SweepLineChart): boolean {
  return chart.lines.length > kNamed;
}

const kGap: Pixel = { x: Number.NaN, y: Number.NaN };

/** A line in pixels, with a gap where it breaks. */
function linePixels({ frame }: SweepLineChart, { spots, breaks }: SweepLineChart["lines"][number]): Pixel[] {
  const begins = new Set(breaks.map(({ after }) => after.row));
  return spots.flatMap((spot) => (begins.has(spot.row) ? [kGap, pixelOf(frame, spot)] : [pixelOf(frame, spot)]));
}

function isSeen(pixel: Pixel): boolean {
  return Number.isFinite(pixel.x + pixel.y);
}

function seriesShapes(chart: SweepLineChart, lines: readonly Pixel[][]): Shape {
  const crowded = isCrowded(chart);
  return group("all-series", ...lines.map((points, i) => {
    const seen = crowded ? [] : points.filter(isSeen);
    const dots = seen.length > 80 ? [] : seen.map((p) =>
      shape("circle", { class: "series-dot", cx: coordinate(p.x), cy: coordinate(p.y), r: 2.4 }));
    const d = lineData(points, crowded ? kCrowdedTolerance : kTolerance);
    return group(`series series-${i % kSeries}`, shape("path", { class: "series-line", d }), ...dots);
  }));
}

function drawnBreaks(chart: SweepLineChart): DrawnBreak[] {
  const { frame } = chart;
  const valueOf = (x: number): string => frame.xNames?.[x] ?? formatNumber(x);
  return chart.lines.flatMap(({ name, breaks }) => breaks.map(({ before, after, change }) => ({
    ends: [pixelOf(frame, before), pixelOf(frame, after)].filter(isSeen), change,
    title: `${name === "" ? "" : `${name}, `}${frame.xLabel} = ${valueOf(after.x)}: ${change === "" ? "break" : change}`,
  })));
}

/** Rings where lines break, and the names of the first changes beside the lines. */
function breakShapes(chart: SweepLineChart, lines: readonly Pixel[][], breaks: readonly DrawnBreak[]): Shape[] {
  if (breaks.length === 0) return [];
  const { frame, size } = chart;
  const taken = new Occupancy(size);
  taken.addBox({ left: 0, top: 0, right: frame.x.start, bottom: size.height });
  taken.addBox({ left: frame.x.end + 8, top: 0, right: size.width, bottom: size.height });
  taken.addBox({ left: 0, top: 0, right: size.width, bottom: frame.y.end - 4 });
  taken.addBox({ left: 0, top: frame.y.start - 12, right: size.width, bottom: size.height });
  for (const points of lines) taken.addLine(points);  // gaps are left out
  for (const end of breaks.flatMap(({ ends }) => ends)) {
    taken.addBox({ left: end.x - 3, top: end.y - 3, right: end.x + 3, bottom: end.y + 3 }, kRingWeight);
  }
  return [breakMarks(breaks, isCrowded(chart) ? 2 : 3), breakLabels(breaks, taken)];
}

/** Names of the lines, where there are several and not too many; a line without a value says so. */
function legendEntries(lines: SweepLineChart["lines"]): LegendEntry[] {
  if (lines.length < 2 || lines.length > kNamed) return [];
  return lines.map(({ name, spots }, i) => ({
    text: spots.some(({ y }) => Number.isFinite(y)) ? name : `${name} (no value)`, line: "series-line", group: `series series-${i % kSeries}`,
  }));
}

/**
 * An output of a sweep against a parameter, both as the table has them (docs/sweeps.md): no unit is known. Rows are put in the
 * order of the parameter; a row without a number breaks the line, and so does the end of a piece of a refined curve; a row with an
 * error is a cross on the axis.
 */
export function sweepLine(input: SweepLineInput, size: Size, chart: SweepLineChart = sweepLineChart(input, size)): Shape {
  const { failures } = chart;
  const chosen = chart.lines.flatMap((item) => item.spots).find((spot) => spot.row === input.chosen);
  const ring = chosen && pixelOf(chart.frame, chosen);
  const lines = chart.lines.map((item) => linePixels(chart, item));
  const breaks = drawnBreaks(chart);
  const broken = breaks.length === 0 ? "" : `, broken at ${breaks.length} ${breaks.length === 1 ? "place" : "places"}`;
  const title = `${chart.frame.yLabel} against ${chart.frame.xLabel}${broken}`;
  return figure("chart sweep-line", size, title, plotArea(chart.frame), frameShapes(chart.frame, size), seriesShapes(chart, lines),
                failedShapes(chart), ...breakShapes(chart, lines, breaks),
                ring && Number.isFinite(ring.x + ring.y)
                  ? shape("circle", { class: "chosen-ring", cx: coordinate(ring.x), cy: coordinate(ring.y), r: 6.5 }) : null,
                legendShape(legendEntries(chart.lines), size.width, failures === "" ? 0 : 18),
                failures === "" ? null : cross("mark failed", { x: 70, y: 10 }, failures),
                failures === "" ? null : label("muted", { x: 80, y: 14 }, "start", failures));
}

/** The row nearest to a pixel, failed ones among them; null when there is none. */
export function nearestInSweep(chart: SweepLineChart, to: Pixel): { row: number; pixel: Pixel; distance: number } | null {
  let best: { row: number; pixel: Pixel; distance: number } | null = null;
  const offer = (row: number, pixel: Pixel) => {
    const distance = Math.hypot(pixel.x - to.x, pixel.y - to.y);
    if (distance < (best?.distance ?? Infinity)) best = { row, pixel, distance };
  };
  for (const item of chart.lines) for (const spot of item.spots) offer(spot.row, pixelOf(chart.frame, spot));
  for (const item of chart.failed) offer(item.row, { x: place(chart.frame.x, item.x), y: chart.frame.y.start - 7 });
  return best;
}
