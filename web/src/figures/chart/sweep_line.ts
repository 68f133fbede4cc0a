// A sweep over one parameter: an output against it, one line for each value of a second parameter; failed points as crosses
// on the axis, with why.

import { at } from "../geometry";
import { Occupancy, placeLabel } from "../labels";
import { formatNumber } from "../numbers";
import { coordinate, figure, group, label, pathData, shape, type Pixel, type Shape, type Size } from "../shape";
import { frameShapes, makeScale, place, plotArea, widened, type Frame, type Scale } from "./axes";
import { columnLabel, columnOf, errorsOf, extentOf, failureText, type RowError, type SweepAxis, type Table } from "./sweep";
import { thinned } from "./thin";

export interface SweepLineInput {
  table: Table;
  x: SweepAxis;
  y: SweepAxis;
  /** Column of a second parameter; a line for each of its values. */
  series?: string | undefined;
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
  lines: { name: string; spots: Spot[] }[];
  failed: { row: number; x: number; error: RowError }[];
  size: Size;
}

const kNamed = 16;  // more lines than these are not named
const kSeries = 6;  // colours; further lines begin again

function linesOf(input: SweepLineInput, xs: readonly number[], ys: readonly number[]): SweepLineChart["lines"] {
  const series = input.series === undefined ? null : columnOf(input.table, input.series);
  const groups = new Map<number, Spot[]>();
  for (let row = 0; row < xs.length; ++row) {
    const key = series ? at(series.values, row) : 0;
    const spots = groups.get(key) ?? [];
    spots.push({ row, x: at(xs, row), y: at(ys, row) });
    groups.set(key, spots);
  }
  return [...groups].map(([key, spots]) => ({
    name: series === null ? "" : `${input.series} = ${series.names?.[key] ?? formatNumber(key)}`,
    spots: spots.filter((spot) => Number.isFinite(spot.x)).sort((a, b) => a.x - b.x),
  }));
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
  const top = failureText(errorsOf(input.table)) === "" ? 12 : 28;
  const frame = {
    x: scaleOf(x.values, x.names, input.x.log ?? false, 66, Math.max(90, size.width - 18), true),
    y: scaleOf(y.values, y.names, input.y.log ?? false, Math.max(60, size.height - 44), top, false),
    xLabel: columnLabel(input.x),
    yLabel: columnLabel(input.y),
    xNames: x.names ?? undefined,
    yNames: y.names ?? undefined,
  };
  const failed = errorsOf(input.table).flatMap((error, row) => {
    const where = at(x.values, row);
    return error && Number.isFinite(where) ? [{ row, x: where, error }] : [];
  });
  return { frame, lines: linesOf(input, x.values, y.values), failed, size };
}

function pixelOf(frame: Frame, spot: { x: number; y: number }): Pixel {
  return { x: place(frame.x, spot.x), y: place(frame.y, spot.y) };
}

/** A line with its gaps, thinned between them. */
function lineData(points: readonly Pixel[]): string {
  let text = "";
  let part: Pixel[] = [];
  const finish = () => {
    text += pathData(thinned(part).flatMap((i) => part[i] ?? []));
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

function seriesShapes(chart: SweepLineChart, taken: Occupancy): { lines: Shape; labels: () => Shape } {
  const many = chart.lines.length > 1 && chart.lines.length <= kNamed;
  const drawn = chart.lines.map((item, i) => {
    const points = item.spots.map((spot) => pixelOf(chart.frame, spot));
    const seen = points.filter((p) => Number.isFinite(p.x + p.y));
    taken.addLine(seen, 14);
    const dots = seen.length > 80 ? [] : seen.map((p) =>
      shape("circle", { class: "series-dot", cx: coordinate(p.x), cy: coordinate(p.y), r: 2.4 }));
    const line = shape("path", { class: "series-line", d: lineData(points) });
    return { shape: group(`series series-${i % kSeries}`, line, ...dots), name: item.name, end: seen[seen.length - 1] };
  });
  const labels = () => group("series-labels", ...drawn.map(({ name, end }, i) => (many && end ? placeLabel({
    at: end, className: `series-label series-${i % kSeries}`, runs: [{ text: name }], prefer: 4, tolerance: 400,
  }, taken) : null)));
  return { lines: group("all-series", ...drawn.map((item) => item.shape)), labels };
}

/** An output of a sweep against a parameter. */
export function sweepLine(input: SweepLineInput, size: Size, chart: SweepLineChart = sweepLineChart(input, size)): Shape {
  const taken = new Occupancy(size);
  taken.addBox({ left: 0, top: 0, right: chart.frame.x.start - 4, bottom: size.height });
  const series = seriesShapes(chart, taken);
  const failures = failureText(errorsOf(input.table));
  const chosen = chart.lines.flatMap((item) => item.spots).find((spot) => spot.row === input.chosen);
  const ring = chosen && pixelOf(chart.frame, chosen);
  const title = `${chart.frame.yLabel} against ${chart.frame.xLabel}`;
  return figure("chart sweep-line", size, title, plotArea(chart.frame), frameShapes(chart.frame, size), series.lines,
                failedShapes(chart),
                ring && Number.isFinite(ring.x + ring.y)
                  ? shape("circle", { class: "chosen-ring", cx: coordinate(ring.x), cy: coordinate(ring.y), r: 6.5 }) : null,
                series.labels(),
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
