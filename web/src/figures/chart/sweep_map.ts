// A sweep over two parameters: a map of an output in bands between round values, contour lines on their borders, failed
// points crossed out. The bands grow darker with the value (lighter on a dark page), so that they are read in grey as well.

import { at } from "../geometry";
import { Occupancy, placeLabel, textWidth } from "../labels";
import { formatNumber } from "../numbers";
import { coordinate, figure, group, label, pathData, shape, type Pixel, type Shape, type Size } from "../shape";
import { fewRound, frameShapes, leftRoom, makeScale, place, plotArea, roundStep, widened, type Frame, type Scale } from "./axes";
import { contours } from "./contours";
import { evenCells, evenValues, joinedCells, mapBreaks, mapBreakShapes, piecesAlong, type MapBreak, type Spot } from "./map_curves";
import { columnLabel, columnOf, errorsOf, extentOf, failureText, type Column, type RowError, type SweepAxis, type Table } from "./sweep";

export interface SweepMapInput {
  table: Table;
  x: SweepAxis;
  y: SweepAxis;
  value: SweepAxis;
  /** Index of a row. */
  chosen?: number | null | undefined;
}

export const kBands = 12;  // classes band-0 ... band-11 of figures.css

export interface SweepMapChart {
  frame: Frame;
  /** Distinct values of both parameters, increasing; `ys` are even values where the curves of a refined sweep go along y. */
  xs: number[];
  ys: number[];
  /** Borders of cells in pixels, one more than values. */
  xEdges: number[];
  yEdges: number[];
  /** Spot of each cell, row after row; null where no point is done. Empty when the points are no grid. */
  cells: (Spot | null)[];
  spots: Spot[];
  /** How many rows failed with which code; "" when none did. */
  failures: string;
  /** Where the curves of a refined sweep break, and which of their cells contour lines pass between; null for other sweeps. */
  curves: { breaks: MapBreak[]; isJoined: (i: number, j: number) => boolean } | null;
  /** Borders between bands, increasing. */
  levels: number[];
  size: Size;
}

function distinct(values: readonly number[]): number[] {
  return [...new Set(values.filter((value) => Number.isFinite(value)))].sort((a, b) => a - b);
}

/** Round values between which a range falls into at most so many bands. */
export function bandLevels(low: number, high: number, log = false): number[] {
  if (!(high > low)) return Number.isFinite(low) ? [low] : [];
  if (log && low > 0) {
    const decades = Math.log10(high / low);
    const shares = decades <= 3 ? [1, 2, 5] : decades <= 5 ? [1, 3] : [1];
    const levels: number[] = [];
    for (let p = Math.floor(Math.log10(low)); p <= Math.log10(high); ++p) levels.push(...shares.map((share) => Number(`${share}e${p}`)));
    return levels.filter((level) => level > low && level < high).slice(0, kBands - 1);
  }
  const step = roundStep(high - low, 8);
  const levels: number[] = [];
  for (let k = Math.floor(low / step) + 1; k * step < high; ++k) levels.push(Number((k * step).toPrecision(12)));
  return levels.slice(0, kBands - 1);
}

/** Band of a value: 0 below the first level. */
function bandOf(levels: readonly number[], value: number): number {
  let band = 0;
  while (band < levels.length && value >= at(levels, band)) ++band;
  return band;
}

/** The class of a band, spread over the whole scale of colours. */
function bandClass(band: number, levels: readonly number[]): string {
  const count = levels.length;
  return `band-${count === 0 ? 5 : Math.round((band / count) * (kBands - 1))}`;
}

/** Cells reach half way to their neighbours, on the scale's own measure. */
function edges(scale: Scale, values: readonly number[]): number[] {
  const pixels = values.map((value) => place(scale, value));
  const inner = pixels.slice(1).map((pixel, i) => (pixel + at(pixels, i)) / 2);
  return [scale.start, ...inner, scale.end];
}

/** A scale on which the first and the last cell are as wide as their neighbours. */
function cellScale(column: Column, values: readonly number[], log: boolean, start: number, end: number): Scale {
  if (column.names) return makeScale(-0.5, column.names.length - 0.5, start, end);
  const n = values.length;
  const first = at(values, 0);
  const final = at(values, n - 1);
  if (n < 2) {
    const [from, to] = widened(first, first);
    return makeScale(from, to, start, end);
  }
  if (log && first > 0) {
    return makeScale(first / Math.sqrt(at(values, 1) / first), final * Math.sqrt(final / at(values, n - 2)), start, end, true);
  }
  return makeScale(first - (at(values, 1) - first) / 2, final + (final - at(values, n - 2)) / 2, start, end);
}

/** Whether points fill a grid: at least half of the places are taken. */
function gridCells(spots: readonly Spot[], xs: readonly number[], ys: readonly number[]): (Spot | null)[] {
  if (xs.length * ys.length > 2 * spots.length) return [];
  const column = new Map(xs.map((value, i) => [value, i]));
  const row = new Map(ys.map((value, j) => [value, j]));
  const cells = new Array<Spot | null>(xs.length * ys.length).fill(null);
  for (const spot of spots) cells[(row.get(spot.y) ?? 0) * xs.length + (column.get(spot.x) ?? 0)] = spot;
  return cells;
}

/** Width of the scale of colours: its numbers and its name beside it. */
function barWidth(levels: readonly number[]): number {
  return 62 + levels.reduce((most, level) => Math.max(most, textWidth(formatNumber(level))), 0);
}

/** The rows that have a place on the map. */
function spotsOf(input: SweepMapInput, x: Column, y: Column, value: Column): Spot[] {
  const errors = errorsOf(input.table);
  return x.values.flatMap((where, row) => {
    const spot = { row, x: where, y: at(y.values, row), value: at(value.values, row), error: errors[row] ?? null };
    return Number.isFinite(spot.x + spot.y) ? [spot] : [];
  });
}

/** Lays the map out. */
export function sweepMapChart(input: SweepMapInput, size: Size): SweepMapChart {
  const x = columnOf(input.table, input.x.column);
  const y = columnOf(input.table, input.y.column);
  const value = columnOf(input.table, input.value.column);
  const spots = spotsOf(input, x, y, value);
  const [xLog, yLog] = [input.x.log ?? false, input.y.log ?? false];
  const xs = distinct(x.values);
  const rowValues = distinct(y.values);
  const pieces = y.names || rowValues.length < 2 ? null : piecesAlong(input.table, input.y.column);
  const ys = pieces ? evenValues(rowValues, yLog, size) : rowValues;
  const failures = failureText(errorsOf(input.table));
  const top = failures === "" && spots.every((spot) => Number.isFinite(spot.value)) ? 12 : 28;
  const [low, high] = extentOf(value.values, input.value.log);
  const levels = bandLevels(low, high, input.value.log);
  const upright = {
    y: cellScale(y, ys, yLog, Math.max(60, size.height - 44), top), yNames: y.names ?? undefined, yValues: fewRound(ys),
  };
  const left = Math.max(66, leftRoom(upright));
  const frame = {
    ...upright, x: cellScale(x, xs, xLog, left, Math.max(left + 24, size.width - barWidth(levels))),
    xLabel: columnLabel(input.x), yLabel: columnLabel(input.y), xNames: x.names ?? undefined, xValues: fewRound(xs),
  };
  const cells = pieces ? evenCells(spots, xs, ys, yLog, pieces) : gridCells(spots, xs, ys);
  return {
    frame, xs, ys, xEdges: edges(frame.x, xs), yEdges: edges(frame.y, ys), cells, spots, failures, levels, size,
    curves: pieces && { breaks: mapBreaks(spots, xs, pieces), isJoined: joinedCells(cells, xs.length, pieces) },
  };
}

/** Rectangles of neighbouring cells of one band in one row, all of a band in one path. */
function bandShapes(chart: SweepMapChart): Shape[] {
  const data = new Map<string, string>();
  const columns = chart.xs.length;
  const names = [...chart.levels, 0].map((_, band) => bandClass(band, chart.levels));
  const classOf = (i: number, j: number): string => {
    const spot = chart.cells[j * columns + i];
    if (!spot) return "";
    return Number.isFinite(spot.value) ? names[bandOf(chart.levels, spot.value)] ?? "" : "no-value";
  };
  for (let j = 0; j < chart.ys.length; ++j) {
    let begin = 0;
    let name = classOf(0, j);
    for (let i = 1; i <= columns; ++i) {
      const next = i < columns ? classOf(i, j) : null;
      if (next === name) continue;
      if (name !== "") data.set(name, (data.get(name) ?? "") + rectangle(chart, begin, i, j));
      begin = i;
      name = next ?? "";
    }
  }
  return [...data].map(([name, d]) => shape("path", { class: `band ${name}`, d }));
}

function rectangle(chart: SweepMapChart, from: number, to: number, j: number): string {
  const left = coordinate(at(chart.xEdges, from));
  const right = coordinate(at(chart.xEdges, to));
  const low = coordinate(at(chart.yEdges, j));
  const high = coordinate(at(chart.yEdges, j + 1));
  return `M${left} ${low}H${right}V${high}H${left}Z`;
}

/** Points that are no grid, as dots. */
function dotShapes(chart: SweepMapChart): Shape[] {
  return chart.spots.filter((spot) => Number.isFinite(spot.value)).map((spot) => shape("circle", {
    class: `dot ${bandClass(bandOf(chart.levels, spot.value), chart.levels)}`,
    cx: coordinate(place(chart.frame.x, spot.x)), cy: coordinate(place(chart.frame.y, spot.y)), r: 4.5,
  }));
}

/** Whether the bands on both sides of a level are dark. */
function onDark(level: number, levels: readonly number[]): boolean {
  return (level / levels.length) * (kBands - 1) > 5.5;
}

function contourShapes(chart: SweepMapChart, taken: Occupancy): Shape {
  if (chart.cells.length === 0 || chart.xs.length < 3 || chart.ys.length < 3) return group("contours");
  const grid = {
    x: chart.xs.map((value) => place(chart.frame.x, value)),
    y: chart.ys.map((value) => place(chart.frame.y, value)),
    values: chart.cells.map((spot) => spot?.value ?? Number.NaN),
    isJoined: chart.curves?.isJoined,
  };
  const lines: Shape[] = [];
  const texts: (Shape | null)[] = [];
  const all = contours(grid, chart.levels);
  for (const [number, level] of chart.levels.entries()) {
    const pieces = all[number] ?? [];
    if (pieces.length === 0) continue;
    lines.push(shape("path", { class: "contour", d: pieces.map((piece) => pathData(piece)).join("") }));
    const middle = pieces[Math.floor(pieces.length / 2)]?.[0];
    if (middle && pieces.length > 4) {
      texts.push(placeLabel({
        at: middle, className: onDark(number, chart.levels) ? "contour-text on-dark" : "contour-text", distance: 2,
        runs: [{ text: formatNumber(level) }],
      }, taken));
    }
  }
  return group("contours", ...lines, ...texts);
}

function crossData(at: Pixel, half: number): string {
  return pathData([{ x: at.x - half, y: at.y - half }, { x: at.x + half, y: at.y + half }]) +
    pathData([{ x: at.x - half, y: at.y + half }, { x: at.x + half, y: at.y - half }]);
}

function failedShapes(chart: SweepMapChart): Shape {
  const failed = chart.spots.filter((spot) => spot.error !== null);
  const narrowest = (list: readonly number[]) =>
    list.reduce((least, edge, i) => (i === 0 ? least : Math.min(least, Math.abs(edge - at(list, i - 1)))), Infinity);
  const cell = Math.min(narrowest(chart.xEdges), chart.curves ? Infinity : narrowest(chart.yEdges));
  const half = Math.min(4, Math.max(1, 0.3 * cell));
  const d = failed.map((spot) => crossData({ x: place(chart.frame.x, spot.x), y: place(chart.frame.y, spot.y) }, half)).join("");
  return shape("path", { class: "mark failed", d });
}

/** The scale of colours with the values of its borders. */
function barShape(chart: SweepMapChart, name: string): Shape {
  const x = chart.frame.x.end + 16;
  const bottom = chart.frame.y.start;
  const count = chart.levels.length + 1;
  const step = Math.min(22, (bottom - chart.frame.y.end - 4) / count);
  const shapes: Shape[] = [];
  for (let band = 0; band < count; ++band) {
    const y = coordinate(bottom - (band + 1) * step);
    shapes.push(shape("rect", { class: `band ${bandClass(band, chart.levels)}`, x, y, width: 14, height: coordinate(step) }));
  }
  chart.levels.forEach((level, i) => {
    shapes.push(label("tick", { x: x + 20, y: bottom - (i + 1) * step + 4 }, "start", formatNumber(level)));
  });
  const upright = label("axis-label", { x: chart.size.width - 6, y: (bottom + chart.frame.y.end) / 2 }, "middle", name);
  upright.attributes["transform"] = `rotate(-90 ${chart.size.width - 6} ${coordinate((bottom + chart.frame.y.end) / 2)})`;
  return group("bar", ...shapes, upright);
}

/** What the marks above the map mean: points that failed, and analyses without this output. */
function keyShapes(chart: SweepMapChart): Shape[] {
  const { failures } = chart;
  const left = chart.frame.x.start;
  const shapes = failures === "" ? [] : [
    shape("path", { class: "mark failed", d: crossData({ x: left + 4, y: 10 }, 4) }), label("muted", { x: left + 14, y: 14 }, "start", failures),
  ];
  const empty = chart.spots.filter((spot) => !Number.isFinite(spot.value) && spot.error === null).length;
  if (empty === 0) return shapes;
  const x = left + (failures === "" ? 0 : 34 + textWidth(failures));
  return [...shapes, shape("rect", { class: "band no-value", x: coordinate(x), y: 5, width: 10, height: 10 }),
          label("muted", { x: x + 15, y: 14 }, "start", `${empty} without a value`)];
}

/**
 * A map of an output over two parameters, as the table has them (docs/sweeps.md): cells of a grid that reach half way to their
 * neighbours, or dots where the points are no grid. The curves of a refined sweep are cut into even cells, with strokes where
 * they break. Contour lines are linear between the centres of cells.
 */
export function sweepMap(input: SweepMapInput, size: Size, chart: SweepMapChart = sweepMapChart(input, size)): Shape {
  const taken = new Occupancy(size);
  taken.addBox({ left: 0, top: 0, right: chart.frame.x.start, bottom: size.height });
  taken.addBox({ left: chart.frame.x.end, top: 0, right: size.width, bottom: size.height });
  taken.addBox({ left: 0, top: chart.frame.y.start, right: size.width, bottom: size.height });
  const name = columnLabel(input.value);
  const chosen = chart.spots.find((spot) => spot.row === input.chosen);
  return figure("chart sweep-map", size, `${name} over ${chart.frame.xLabel} and ${chart.frame.yLabel}`,
                frameShapes(chart.frame, size), ...(chart.cells.length > 0 ? bandShapes(chart) : dotShapes(chart)),
                contourShapes(chart, taken), ...mapBreakShapes(chart.curves?.breaks ?? [], chart.xEdges, chart.frame.y, taken),
                failedShapes(chart), plotArea(chart.frame), barShape(chart, name),
                chosen ? shape("circle", { class: "chosen-ring open", cx: coordinate(place(chart.frame.x, chosen.x)),
                                           cy: coordinate(place(chart.frame.y, chosen.y)), r: 6.5 }) : null,
                ...keyShapes(chart));
}

/** The row at a pixel: of its cell, or of the nearest dot within 12 pixels; null when there is none. */
export function sweepMapLocate(chart: SweepMapChart, pixel: Pixel): { row: number; value: number; error: RowError | null } | null {
  if (chart.cells.length > 0) {
    const i = chart.xEdges.findIndex((edge, k) => k > 0 && pixel.x <= edge && pixel.x >= at(chart.xEdges, k - 1)) - 1;
    const j = chart.yEdges.findIndex((edge, k) => k > 0 && pixel.y >= edge && pixel.y <= at(chart.yEdges, k - 1)) - 1;
    const spot = i >= 0 && j >= 0 ? chart.cells[j * chart.xs.length + i] : null;
    return spot ? { row: spot.row, value: spot.value, error: spot.error } : null;
  }
  let best: SweepMapChart["spots"][number] | null = null;
  let least = 12;
  for (const spot of chart.spots) {
    const distance = Math.hypot(place(chart.frame.x, spot.x) - pixel.x, place(chart.frame.y, spot.y) - pixel.y);
    if (distance <= least) {
      least = distance;
      best = spot;
    }
  }
  return best ? { row: best.row, value: best.value, error: best.error } : null;
}
