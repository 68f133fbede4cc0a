// The equilibrium path: stable solid, unstable dashed, critical points and contact events as marks, other runs as shadows.

import { Occupancy, placeLabel } from "../labels";
import { intervalOf } from "../geometry";
import { formatNumber, type Units } from "../numbers";
import { coordinate, figure, group, label, pathData, shape, type LinePoint, type Pixel, type Shape, type Size } from "../shape";
import { frameShapes, makeScale, place, plotArea, widened, type Frame } from "./axes";
import {
  branchesOf, computedRows, contactMarks, criticalMarks, curveOf, placeBetween, quantityLabel, valueAlong, type CriticalMark,
  type Monitor, type PathCurve, type PathPoint, type PathQuantity, type PathResult, type Stability, type Vertex,
} from "./curves";
import { legendHeight, legendShape, markEntries, type LegendEntry } from "./legend";
import { kMarkNames, mark, type MarkKind } from "./marks";
import {
  hasStiffness, isUpward, kScaleRoom, softestPoint, stiffnessCurve, stiffnessLine, stiffnessScale, type SoftestPoint, type StiffnessCurve,
} from "./stiffness";
import { thinned } from "./thin";

/** A run that is shown for comparison. */
export interface PathShadow {
  label: string;
  result: PathResult;
  kind: "earlier" | "pinned";
}

/** A row of a path; with `arc` the place at that arc length, which need not be a row. */
export type ChosenPoint = PathPoint & { arc?: number };

/**
 * What is drawn: a result's branches, one quantity against another. Load factors have no unit; monitors are in the model's
 * length, or radians.
 */
export interface PathInput {
  result: PathResult;
  x: PathQuantity;
  y: PathQuantity;
  monitors?: readonly Monitor[] | undefined;
  units?: Units | undefined;
  /** The point that the drawing shows: a row, or between rows the place at an arc length. */
  chosen?: ChosenPoint | null | undefined;
  shadows?: readonly PathShadow[] | undefined;
  /** Whether the stiffness ratio is drawn as a second curve; when left out, where the path has a softest point before its critical one. */
  stiffness?: boolean | undefined;
  /** Whether each row at which an equilibrium was solved has a dot; those of a static analysis always do. */
  points?: boolean | undefined;
  /** Ranges of both axes; what holds everything when left out. */
  domain?: { x: readonly [number, number]; y: readonly [number, number] } | null | undefined;
}

/** The chart with its places in pixels: what hovering and walking need. */
export interface PathChart {
  frame: Frame;
  curves: PathCurve[];
  shadows: { shadow: PathShadow; curves: PathCurve[] }[];
  marks: CriticalMark[];
  softest: SoftestMark | null;
  stiffness: StiffnessCurve | null;
  size: Size;
}

/** The softest point on the chart. */
export interface SoftestMark {
  point: SoftestPoint;
  x: number;
  y: number;
}

function softestMark(input: PathInput): SoftestMark | null {
  const point = softestPoint(input.result);
  const branch = branchesOf(input.result)[0];
  if (!point || !branch) return null;
  const mark = { point, x: valueAlong(branch, input.x, point.arc), y: valueAlong(branch, input.y, point.arc) };
  return Number.isFinite(mark.x) && Number.isFinite(mark.y) ? mark : null;
}

/** Whether the stiffness ratio is drawn. */
function showsStiffness(input: PathInput): boolean {
  return hasStiffness(input.result) && (input.stiffness ?? softestPoint(input.result) !== null);
}

function curvesOf(result: PathResult, input: PathInput): PathCurve[] {
  return branchesOf(result).flatMap((branch, index) => curveOf(result, branch, index, input.x, input.y) ?? []);
}

function rangeOf(values: Iterable<number>): [number, number] {
  let low = Infinity;
  let high = -Infinity;
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return widened(low, high);
}

/** Lays a path out. */
export function pathChart(input: PathInput, size: Size): PathChart {
  const curves = curvesOf(input.result, input);
  const shadows = (input.shadows ?? []).map((shadow) => ({ shadow, curves: curvesOf(shadow.result, input) }));
  const marks = criticalMarks(input.result, input.x, input.y);
  const all = [...curves, ...shadows.flatMap((item) => item.curves)].flatMap((curve) => curve.vertices);
  // The path of a static analysis ends before its critical point; others hold theirs.
  const beyond = input.result.branches.length === 0 ? marks : [];
  const every = curves.length === 0 ? [...all, ...marks, { x: 0, y: 0 }] : [...all, ...beyond];
  const second = showsStiffness(input);
  const above = second && !isUpward(input.y) ? kScaleRoom.above : 0;
  const right = second && isUpward(input.y) ? kScaleRoom.right : 0;
  const [x0, x1] = input.domain?.x ?? rangeOf(every.map((vertex) => vertex.x));
  const [y0, y1] = input.domain?.y ?? rangeOf(every.map((vertex) => vertex.y));
  const frame = {
    x: makeScale(x0, x1, 62, Math.max(90, size.width - 14 - right)),
    y: makeScale(y0, y1, Math.max(60, size.height - 44), 14 + above + legendHeight(legendEntries(input, curves), size.width)),
    xLabel: quantityLabel(input.x, input.monitors, input.units),
    yLabel: quantityLabel(input.y, input.monitors, input.units),
  };
  const stiffness = second ? stiffnessCurve(input.result, input.x, input.y, frame) : null;
  return { frame, curves, shadows, marks, softest: softestMark(input), stiffness, size };
}

function pixelOf(frame: Frame, point: { x: number; y: number }): Pixel {
  return { x: place(frame.x, point.x), y: place(frame.y, point.y) };
}

const kFlat = 0.05;  // pixels that the cubic between two vertices may be off the straight line that takes its place

/**
 * The inner points of the cubic from one vertex to the next one as a Bezier curve; null where a straight line is drawn. A cubic is
 * off its chord by at most three quarters of what an inner point is off its place on the chord.
 */
function innerPoints(from: Vertex, to: Vertex, frame: Frame): [Pixel, Pixel] | null {
  const third = (to.arc - from.arc) / 3;
  const inner = ({ x, y, rate }: Vertex, step: number): Pixel => pixelOf(frame, { x: x + step * rate.x, y: y + step * rate.y });
  const onChord = (fraction: number): Pixel =>
    pixelOf(frame, { x: from.x + fraction * (to.x - from.x), y: from.y + fraction * (to.y - from.y) });
  const [first, second] = [inner(from, third), inner(to, -third)];
  const off = (point: Pixel, chord: Pixel): number => Math.hypot(point.x - chord.x, point.y - chord.y);
  return 0.75 * Math.max(off(first, onChord(1 / 3)), off(second, onChord(2 / 3))) > kFlat ? [first, second] : null;
}

/** A line through vertices: cubics, and between them straight lines without the points that nobody sees. */
function linePoints(vertices: readonly Vertex[], frame: Frame): LinePoint[] {
  const runs: LinePoint[][] = [[]];  // each but the first begins with the end of a cubic, and goes on straight
  vertices.forEach((vertex, i) => {
    const before = vertices[i - 1];
    const inner = before && innerPoints(before, vertex, frame);
    const point = pixelOf(frame, vertex);
    if (inner) runs.push([{ ...point, inner }]);
    else runs[runs.length - 1]?.push(point);
  });
  return runs.flatMap((run) => thinned(run).flatMap((k) => run[k] ?? []));
}

/** Pieces of a curve of one stability as lines of pixels; neighbours share their end. */
function pieces(curve: PathCurve, frame: Frame): { stable: Stability; points: LinePoint[] }[] {
  const found: { stable: Stability; points: LinePoint[] }[] = [];
  let begin = 0;
  for (let i = 1; i <= curve.stable.length; ++i) {
    if (i < curve.stable.length && curve.stable[i] === curve.stable[begin]) continue;
    found.push({ stable: curve.stable[begin] ?? null, points: linePoints(curve.vertices.slice(begin, i + 1), frame) });
    begin = i;
  }
  return found;
}

function stabilityClass(stable: Stability): string {
  return stable === null ? "untold" : stable ? "stable" : "unstable";
}

function curveShapes(curves: readonly PathCurve[], frame: Frame, className: string, taken: Occupancy,
                     weight: number): Shape[] {
  return curves.flatMap((curve) => {
    const kind = curve.branch === 0 ? className : `${className} branch`;
    return pieces(curve, frame).map(({ stable, points }) => {
      taken.addLine(points.flatMap((point) => [...(point.inner ?? []), point]), weight);
      return shape("path", { class: `${kind} ${stabilityClass(stable)}`, d: pathData(points) });
    });
  });
}

/** A part of a figure that shows nothing outside the plot: an inner SVG clips without an id. */
function clipped(frame: Frame, className: string, ...children: (Shape | null)[]): Shape {
  const { x, y } = frame;
  const left = coordinate(x.start);
  const top = coordinate(y.end);
  const width = coordinate(x.end - x.start);
  const height = coordinate(y.start - y.end);
  return shape("svg", { class: className, x: left, y: top, width, height, viewBox: `${left} ${top} ${width} ${height}`,
                        overflow: "hidden" }, ...children);
}

function inside(frame: Frame, pixel: Pixel): boolean {
  return pixel.x >= frame.x.start - 1 && pixel.x <= frame.x.end + 1 && pixel.y >= frame.y.end - 1 &&
    pixel.y <= frame.y.start + 1;
}

const kLabelled = 8;

/** Keeps labels away from a mark, and off it. */
function takeMark(pixel: Pixel, taken: Occupancy): void {
  taken.addBox({ left: pixel.x - 11, right: pixel.x + 11, top: pixel.y - 11, bottom: pixel.y + 11 }, 14);
  taken.addBox({ left: pixel.x - 4, right: pixel.x + 4, top: pixel.y - 5, bottom: pixel.y + 4 }, 60);
}

/** The softest point with its load factor and its ratio. */
function softestShapes(chart: PathChart, taken: Occupancy): { marks: Shape; labels: () => Shape } {
  const { softest } = chart;
  const pixel = softest && pixelOf(chart.frame, softest);
  if (!softest || !pixel || !inside(chart.frame, pixel)) return { marks: group("softest-mark"), labels: () => group("mark-labels") };
  takeMark(pixel, taken);
  const labels = () => group("mark-labels", placeLabel({
    at: pixel, className: "mark-label", leader: true, distance: 14, tolerance: 400, prefer: 1,
    runs: [{ text: formatNumber(softest.point.loadFactor, 5), bold: true },
           { text: `\u00a0softest, ratio ${formatNumber(softest.point.ratio, 3)}`, className: "muted" }],
  }, taken));
  return { marks: group("softest-mark", mark("softest", pixel)), labels };
}

/** First yield with its load factor. */
function yieldShapes(input: PathInput, frame: Frame, taken: Occupancy): { marks: Shape; labels: () => Shape } {
  const found = input.result.first_yield;
  const branch = branchesOf(input.result)[0];
  const along = (quantity: PathQuantity): number =>
    !found || !branch ? Number.NaN : quantity.kind === "load_factor" ? found.load_factor : valueAlong(branch, quantity, found.arc_length);
  const at = { x: along(input.x), y: along(input.y) };
  const pixel = pixelOf(frame, at);
  if (!found || !Number.isFinite(at.x) || !Number.isFinite(at.y) || !inside(frame, pixel))
    return { marks: group("yield-mark"), labels: () => group("mark-labels") };
  takeMark(pixel, taken);
  const labels = () => group("mark-labels", placeLabel({
    at: pixel, className: "mark-label", leader: true, distance: 14, tolerance: 110, prefer: 7,
    runs: [{ text: formatNumber(found.load_factor, 5), bold: true }, { text: `\u00a0${kMarkNames.first_yield}`, className: "muted" }],
  }, taken));
  return { marks: group("yield-mark", mark("first_yield", pixel)), labels };
}

function criticalShapes(chart: PathChart, taken: Occupancy): { marks: Shape; labels: () => Shape } {
  const shown = chart.marks.map((item) => ({ item, pixel: pixelOf(chart.frame, item) }))
    .filter(({ pixel }) => inside(chart.frame, pixel));
  for (const { pixel } of shown) takeMark(pixel, taken);
  const labels = () => group("mark-labels", ...shown.slice(0, kLabelled).map(({ item, pixel }, i) => placeLabel({
    at: pixel, className: "mark-label", leader: true, distance: 14, tolerance: i === 0 ? 400 : 110,
    prefer: item.point.type === "limit_min" ? 1 : 7,
    runs: [{ text: formatNumber(item.point.load_factor, 5), bold: true },
           { text: `\u00a0${kMarkNames[item.point.type]}${item.point.confirmed ? "" : ", not confirmed"}`, className: "muted" }],
  }, taken)));
  return { marks: group("marks", ...shown.map(({ item, pixel }) => mark(item.point.type, pixel))), labels };
}

function contactShapes(input: PathInput, frame: Frame): Shape {
  const marks = contactMarks(input.result, input.x, input.y).map((item) => ({ item, pixel: pixelOf(frame, item) }));
  return group("events", ...marks.filter(({ pixel }) => inside(frame, pixel))
    .map(({ item, pixel }) => mark(item.event.type, pixel)));
}

/** Where along its path a label is tried, and what it may cover there: first where it covers no line. */
const kShadowTries: readonly (readonly [number, number])[] =
  [[0.7, 14], [0.85, 14], [0.5, 14], [1, 14], [0.3, 14], [0.7, 30], [0.85, 30], [0.5, 30], [1, 30], [0.3, 30], [0.7, 110]];

function shadowLabels(input: PathInput, chart: PathChart, taken: Occupancy): Shape[] {
  return chart.shadows.flatMap(({ shadow, curves }) => {
    const curve = curves[0];
    if (!curve || isOnly(input, shadow.kind)) return [];
    const seen = curve.vertices.map((vertex) => pixelOf(chart.frame, vertex)).filter((p) => inside(chart.frame, p));
    for (const [share, tolerance] of kShadowTries) {
      const spot = seen[Math.round(share * (seen.length - 1))];
      const text = spot && placeLabel({ at: spot, className: `shadow-label ${shadow.kind}`, distance: 8, leader: true,
                                        runs: [{ text: shadow.label }], tolerance }, taken);
      if (text) return [text];
    }
    return [];
  });
}

/** Whether a kind of shadow has one run only: then the legend names it, else each has its label beside it. */
function isOnly(input: PathInput, kind: PathShadow["kind"]): boolean {
  return (input.shadows ?? []).filter((shadow) => shadow.kind === kind).length === 1;
}

function legendEntries(input: PathInput, curves: readonly PathCurve[]): LegendEntry[] {
  const entries: LegendEntry[] = [];
  const marks = new Set<MarkKind>([...input.result.critical_points.map((point) => point.type),
                                   ...input.result.contact_events.map((event) => event.type)]);
  if (softestPoint(input.result)) marks.add("softest");
  if (input.result.first_yield) marks.add("first_yield");
  const stable = new Set(curves.flatMap((curve) => [...new Set(curve.stable)]));
  if (stable.has(true)) entries.push({ text: "stable", line: "path stable" });
  if (stable.has(false)) entries.push({ text: "unstable", line: "path unstable" });
  if (stable.has(null)) entries.push({ text: "stability not counted", line: "path untold" });
  if (curves.some((curve) => curve.branch !== 0)) entries.push({ text: "branch", line: "path branch stable" });
  const runs = (input.shadows ?? []).filter(({ kind }) => isOnly(input, kind))
    .map(({ label: text, kind }) => ({ text, line: `shadow ${kind}` }));
  const ratio = { text: `stiffness ratio (0 to 1 ${isUpward(input.y) ? "upward" : "across"})`, line: "ratio-line" };
  return [...entries, ...(showsStiffness(input) ? [ratio] : []), ...markEntries(marks), ...runs];
}

/** The place of a curve at an arc length. */
function placeAlong({ vertices }: PathCurve, arc: number): { x: number; y: number } | undefined {
  const i = intervalOf(vertices.map((vertex) => vertex.arc), arc);
  const before = vertices[i];
  const after = vertices[i + 1] ?? before;
  if (!after || !before) return undefined;
  const length = after.arc - before.arc;
  return placeBetween(before, after, length > 0 ? Math.min(1, Math.max(0, (arc - before.arc) / length)) : 1);
}

/** The ring around the chosen point; drawn alone where only the choice changes. */
export function chosenShape(chart: PathChart, chosen: ChosenPoint | null | undefined): Shape {
  const curve = chosen && chart.curves.find((item) => item.branch === chosen.branch);
  const vertex = curve && chosen &&
    (chosen.arc === undefined ? curve.vertices.find((item) => item.row === chosen.index) : placeAlong(curve, chosen.arc));
  const pixel = vertex && pixelOf(chart.frame, vertex);
  if (!pixel || !inside(chart.frame, pixel)) return group("chosen");
  return group("chosen", shape("circle", { class: "chosen-ring", cx: coordinate(pixel.x), cy: coordinate(pixel.y), r: 6.5 }));
}

/** The rows of a static analysis of few steps as dots, and a row that is alone on its branch; on request the computed ones of every branch. */
function rowDots({ frame, curves }: PathChart, { result, points }: PathInput): Shape | null {
  const branches = branchesOf(result);
  const all = result.branches.length > 0 ? points : curves.every(({ vertices }) => vertices.length <= 200);
  const dots = curves.filter(({ vertices }) => all || vertices.length === 1).flatMap(({ branch, vertices }) => {
    const rows = branches[branch];
    const computed = new Set(rows && computedRows(rows));
    const pixels = vertices.filter(({ row }) => row !== null && computed.has(row)).map((vertex) => pixelOf(frame, vertex));
    return pixels.filter((pixel) => inside(frame, pixel)).map(({ x, y }) =>
      shape("circle", { class: branch === 0 ? "row" : "row branch", cx: coordinate(x), cy: coordinate(y), r: 2.5 }));
  });
  return dots.length > 0 ? group("rows", ...dots) : null;
}

/**
 * The equilibrium path of a result: load factors without unit, monitors in the model's length or radians, as docs/results.md gives
 * them (a reversed quantity shows minus its value, and its label says the sense). A piece is solid where no eigenvalue of the
 * tangent stiffness is negative, else dashed; it changes at the critical point between the rows.
 */
export function pathFigure(input: PathInput, size: Size, chart: PathChart = pathChart(input, size)): Shape {
  const { frame } = chart;
  const taken = new Occupancy(size);
  taken.addBox({ left: 0, top: 0, right: size.width, bottom: frame.y.end - 4 });
  taken.addBox({ left: 0, top: 0, right: frame.x.start - 4, bottom: size.height });
  taken.addBox({ left: 0, top: frame.y.start + 4, right: size.width, bottom: size.height });
  if (chart.stiffness?.upward) taken.addBox({ left: frame.x.end + 2, top: 0, right: size.width, bottom: size.height });
  const shadows = chart.shadows.flatMap(({ shadow, curves }) =>
    curveShapes(curves, frame, `shadow ${shadow.kind}`, taken, 4));
  const lines = curveShapes(chart.curves, frame, "path", taken, 7);
  if (chart.stiffness) taken.addLine(chart.stiffness.points, 4);
  const softest = softestShapes(chart, taken);
  const critical = criticalShapes(chart, taken);
  const firstYield = yieldShapes(input, frame, taken);
  const empty = chart.curves.length === 0
    ? label("muted", { x: (frame.x.start + frame.x.end) / 2, y: (frame.y.start + frame.y.end) / 2 }, "middle",
            input.result.static ? "none of the load factors was reached"
                                : "no path: an analysis of type path gives one")
    : null;
  const title = `${frame.yLabel} against ${frame.xLabel}`;
  return figure("chart path-chart", size, title, plotArea(frame), frameShapes(frame, size),
                clipped(frame, "plot-lines", ...shadows, chart.stiffness && stiffnessLine(chart.stiffness), ...lines),
                chart.stiffness && stiffnessScale(chart.stiffness, frame), rowDots(chart, input), contactShapes(input, frame),
                softest.marks, firstYield.marks, critical.marks, critical.labels(), softest.labels(), firstYield.labels(),
                group("shadow-labels", ...shadowLabels(input, chart, taken)),
                chosenShape(chart, input.chosen), empty, legendShape(legendEntries(input, chart.curves), size.width));
}

/** The row of a path that is nearest to a pixel, and how far away it is; null when there is none. */
export function nearestOnPath(chart: PathChart, to: Pixel): (PathPoint & { pixel: Pixel; distance: number }) | null {
  let best: (PathPoint & { pixel: Pixel; distance: number }) | null = null;
  for (const curve of chart.curves) {
    for (const vertex of curve.vertices) {
      if (vertex.row === null) continue;
      const pixel = pixelOf(chart.frame, vertex);
      const distance = Math.hypot(pixel.x - to.x, pixel.y - to.y);
      if (best === null || distance < best.distance) {
        best = { branch: curve.branch, index: vertex.row, pixel, distance };
      }
    }
  }
  return best;
}

/** Whether the softest point is within reach of a pixel. */
export function softestNear(chart: PathChart, to: Pixel, reach = 10): boolean {
  const pixel = chart.softest && pixelOf(chart.frame, chart.softest);
  return pixel !== null && Math.hypot(pixel.x - to.x, pixel.y - to.y) <= reach;
}

/** The critical point within reach of a pixel; null when there is none. */
export function criticalNear(chart: PathChart, to: Pixel, reach = 10): CriticalMark | null {
  let best: CriticalMark | null = null;
  let least = reach;
  for (const item of chart.marks) {
    const pixel = pixelOf(chart.frame, item);
    const distance = Math.hypot(pixel.x - to.x, pixel.y - to.y);
    if (distance <= least) {
      least = distance;
      best = item;
    }
  }
  return best;
}
