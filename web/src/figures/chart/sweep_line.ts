// A sweep over one parameter: an output against it, one line for each value of a second parameter; failed points as crosses
// on the axis, with why.

import { at } from "../geometry";
import { formatNumber } from "../numbers";
import { coordinate, figure, group, label, pathData, shape, type Pixel, type Shape, type Size } from "../shape";
import { frameShapes, makeScale, place, plotArea, widened, type Frame, type Scale } from "./axes";
import { legendHeight, legendShape, type LegendEntry } from "./legend";
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
  /** How many rows failed with which code; "" when none did. */
  failures: string;
  size: Size;
}

const kNamed = 16;  // more lines than these are crowded: not named, without dots
const kTolerance = 0.25;  // px that a thinned line may be off
const kCrowdedTolerance = 0.75;
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
  const named = series !== null && groups.size <= kNamed;
  return [...groups].map(([key, spots]) => ({
    name: named ? `${input.series} = ${series.names?.[key] ?? formatNumber(key)}` : "",
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
  const errors = errorsOf(input.table);
  const lines = linesOf(input, x.values, y.values);
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

function seriesShapes(chart: SweepLineChart): Shape {
  const crowded = chart.lines.length > kNamed;
  return group("all-series", ...chart.lines.map((item, i) => {
    const points = item.spots.map((spot) => pixelOf(chart.frame, spot));
    const seen = crowded ? [] : points.filter((p) => Number.isFinite(p.x + p.y));
    const dots = seen.length > 80 ? [] : seen.map((p) =>
      shape("circle", { class: "series-dot", cx: coordinate(p.x), cy: coordinate(p.y), r: 2.4 }));
    const d = lineData(points, crowded ? kCrowdedTolerance : kTolerance);
    return group(`series series-${i % kSeries}`, shape("path", { class: "series-line", d }), ...dots);
  }));
}

/** Names of the lines, where there are several and not too many. */
function legendEntries(lines: SweepLineChart["lines"]): LegendEntry[] {
  if (lines.length < 2 || lines.length > kNamed) return [];
  return lines.map(({ name }, i) => ({ text: name, line: "series-line", group: `series series-${i % kSeries}` }));
}

/**
 * An output of a sweep against a parameter, both as the table has them (docs/sweeps.md): no unit is known. Rows are put in the
 * order of the parameter; a row without a number breaks the line; one with an error is a cross on the axis.
 */
export function sweepLine(input: SweepLineInput, size: Size, chart: SweepLineChart = sweepLineChart(input, size)): Shape {
  const { failures } = chart;
  const chosen = chart.lines.flatMap((item) => item.spots).find((spot) => spot.row === input.chosen);
  const ring = chosen && pixelOf(chart.frame, chosen);
  const title = `${chart.frame.yLabel} against ${chart.frame.xLabel}`;
  return figure("chart sweep-line", size, title, plotArea(chart.frame), frameShapes(chart.frame, size), seriesShapes(chart),
                failedShapes(chart),
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
