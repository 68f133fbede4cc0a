// Natural frequencies against the load factor: of the rows of a path or of a static analysis, or of a vibration analysis.

import type { components } from "../../api/types";
import { coordinate, figure, group, label, line, path, shape, type Pixel, type Shape, type Size } from "../shape";
import { frameShapes, makeScale, place, plotArea, widened, type Frame } from "./axes";
import { computedRows, type Branch, type PathResult, type Result } from "./curves";
import { legendHeight, legendShape, markEntries, type LegendEntry } from "./legend";
import { mark, type MarkKind } from "./marks";

type Frequencies = components["schemas"]["Frequencies"];
type Mode = components["schemas"]["Mode"];
type Vibration = components["schemas"]["Vibration"];

/** What a natural motion does: it vibrates, it is one of a pair whose vibrations grow, or it grows without vibrating. */
export type MotionKind = "vibrates" | "flutters" | "diverges";

export interface Motion {
  kind: MotionKind;
  /** Circular frequency in radians per time; of a motion that diverges minus the square root of -omega squared. */
  omega: number;
  square: number;
  /** Imaginary part of omega squared; not zero for a pair that flutters. */
  imaginary: number;
}

const kRounding = 1e-9;  // of the largest omega squared: smaller negative ones are those of motions that nothing resists

/** The motions of one state, in the order of the result. */
export function motionsOf(frequencies: Frequencies): Motion[] {
  const { omega_squared: squares, imaginary: parts } = frequencies;
  const largest = squares.reduce((most, square) => Math.max(most, Math.abs(square)), 0);
  return squares.map((square, i): Motion => {
    const imaginary = parts?.[i] ?? 0;
    if (imaginary !== 0) {
      return { kind: "flutters", omega: Math.sqrt(Math.max(0, 0.5 * (Math.hypot(square, imaginary) + square))), square, imaginary };
    }
    const kind = square < -kRounding * largest ? "diverges" : "vibrates";
    return { kind, omega: Math.sign(square) * Math.sqrt(Math.abs(square)), square, imaginary };
  });
}

function opposite(mode: Mode): Mode {
  const negative = (values: readonly number[]): number[] => values.map((value) => -value);
  return {
    members: Object.fromEntries(Object.entries(mode.members).map(([id, { s, u, v, rotation }]) =>
      [id, { s, u: negative(u), v: negative(v), rotation: negative(rotation) }])),
  };
}

/**
 * The shape of a motion a quarter of a period after that of its mode; null where the whole motion then passes the equilibrium.
 *
 * A pair that flutters has omega squared a - ib and a + ib, b > 0, and lists the parts R and I of the motion R + iI of the second.
 * The vibration that grows is that of the first, R - iI with omega = c - id, c and d > 0: Re((R - iI) exp(ict)) is
 * R cos ct + I sin ct. A motion that starts at I continues with -R.
 */
export function quadratureOf({ frequencies, modes }: Vibration, motion: number): Mode | null {
  const imaginary = frequencies.imaginary?.[motion] ?? 0;
  if (imaginary < 0) return modes[motion + 1] ?? null;
  const real = imaginary > 0 ? modes[motion - 1] : undefined;
  return real ? opposite(real) : null;
}

/** The parts of a result that frequencies are drawn from. */
export type FrequencySource = Pick<PathResult, "branches" | "critical_points" | "static"> & Pick<Result, "vibrations">;

/** A motion of a vibration analysis: index of its load factor in `vibrations`, and of the motion there. */
export interface ChosenMotion {
  row: number;
  motion: number;
}

export interface FrequencyInput {
  result: FrequencySource;
  /** The motion of a vibration analysis that is shown. */
  chosen?: ChosenMotion | null | undefined;
  /** The load factor of the point of the path that is shown. */
  load?: number | null | undefined;
}

/** A row with frequencies; `motions` is empty where there are none. */
interface Row {
  /** Index in the list that it comes from. */
  row: number;
  load: number;
  motions: Motion[];
}

interface Series {
  /** Index of the branch; 0 for the rows of other analyses. */
  branch: number;
  rows: Row[];
}

/** The computed rows of a branch or of a static analysis: others have no frequencies, and are no gaps. */
function rowsOf(table: Pick<Branch, "load_factor" | "frequencies" | "computed">): Row[] {
  const { load_factor: loads, frequencies = [] } = table;
  return computedRows(table).filter((row) => row < frequencies.length).map((row) => {
    const one = frequencies[row];
    return { row, load: loads[row] ?? Number.NaN, motions: one ? motionsOf(one) : [] };
  });
}

function seriesOf(result: FrequencySource): Series[] {
  const vibrations = (result.vibrations ?? []).map((one, row): Row =>
    ({ row, load: one.load_factor, motions: motionsOf(one.frequencies) }));
  if (vibrations.length > 0) return [{ branch: 0, rows: vibrations.sort((a, b) => a.load - b.load) }];
  const tables = result.branches.length > 0 ? result.branches : result.static ? [result.static] : [];
  return tables.map((table, branch) => ({ branch, rows: rowsOf(table) }));
}

/** Whether a result has natural frequencies. */
export function hasFrequencies(result: FrequencySource): boolean {
  return seriesOf(result).some(({ rows }) => rows.some(({ motions }) => motions.length > 0));
}

export interface FrequencyChart {
  frame: Frame;
  series: Series[];
  size: Size;
}

/** Lines and marks that a legend explains; a chart where nothing flutters needs none. */
function legendEntries(input: FrequencyInput, series: readonly Series[]): LegendEntry[] {
  const kinds = new Set(series.flatMap(({ rows }) => rows.flatMap(({ motions }) => motions.map(({ kind }) => kind))));
  const entries: LegendEntry[] = [];
  if (kinds.has("flutters")) entries.push({ text: "pair that flutters", line: "path unstable" });
  if (series.some(({ branch, rows }) => branch !== 0 && rows.some(({ motions }) => motions.length > 0))) {
    entries.push({ text: "branch", line: "path branch stable" });
  }
  return [...entries, ...markEntries(new Set(criticalMarks(input.result, series).map(({ kind }) => kind)))];
}

/** Lays the frequencies of a result out: load factor across, circular frequency upward. */
export function frequencyChart(input: FrequencyInput, size: Size): FrequencyChart {
  const series = seriesOf(input.result);
  const rows = series.flatMap((one) => one.rows).filter(({ motions }) => motions.length > 0);
  const diverges = rows.some(({ motions }) => motions.some(({ kind }) => kind === "diverges"));
  const least = (values: readonly number[]): number => values.reduce((low, value) => Math.min(low, value), Infinity);
  const most = (values: readonly number[]): number => values.reduce((high, value) => Math.max(high, value), -Infinity);
  const loads = rows.map(({ load }) => load);
  const omegas = rows.flatMap(({ motions }) => motions.map(({ omega }) => omega));
  const [x0, x1] = widened(least(loads), most(loads));
  const [y0, y1] = widened(Math.min(0, least(omegas)), most(omegas));
  const top = 14 + legendHeight(legendEntries(input, series), size.width);
  const frame = {
    x: makeScale(x0, x1, 62, Math.max(90, size.width - 14)), y: makeScale(y0, y1, Math.max(60, size.height - 44), top),
    xLabel: "load factor", yLabel: `circular frequency${diverges ? ", below 0: diverging" : ""}`,
  };
  return { frame, series, size };
}

function pixelOf(frame: Frame, row: Row, motion: Motion): Pixel {
  return { x: place(frame.x, row.load), y: place(frame.y, motion.omega) };
}

/** The lines of one motion, from row to row; dashed where both ends flutter, with a gap at rows without frequencies. */
function motionLines(frame: Frame, rows: readonly Row[], number: number, className: string): Shape[] {
  const runs: { looks: string; points: Pixel[] }[] = [];
  rows.forEach((row, i) => {
    const before = rows[i - 1];
    const from = before?.motions[number];
    const to = row.motions[number];
    if (!before || !from || !to) return;
    const looks = from.kind === "flutters" && to.kind === "flutters" ? "unstable" : "stable";
    const start = pixelOf(frame, before, from);
    const run = runs[runs.length - 1];
    const end = run?.points[run.points.length - 1];
    if (run && run.looks === looks && end?.x === start.x && end.y === start.y) run.points.push(pixelOf(frame, row, to));
    else runs.push({ looks, points: [start, pixelOf(frame, row, to)] });
  });
  return runs.map(({ looks, points }) => path(`${className} ${looks}`, points));
}

/**
 * Critical points on the path at the rows of their load factors: flutter at the first motion that flutters there or, since the
 * critical load is rounded, in the row beyond; others at the motion of the lowest frequency.
 */
function criticalMarks(result: FrequencySource, series: readonly Series[]): { kind: MarkKind; row: Row; motion: Motion }[] {
  return result.critical_points.filter(({ type }) => type !== "broken_bifurcation" && type !== "capacity").flatMap((point) => {
    const rows = series.find(({ branch }) => branch === point.branch)?.rows ?? [];
    const at = rows.findIndex(({ load }) => Math.abs(load - point.load_factor) <= 1e-9 * Math.abs(point.load_factor));
    const row = rows[at];
    const beyond = [row, rows[at + 1]].map((one) => one?.motions.findIndex(({ kind }) => kind === "flutters") ?? -1);
    const lowest = (row?.motions ?? []).reduce<Motion | undefined>((low, one) =>
      (low && Math.abs(low.omega) <= Math.abs(one.omega) ? low : one), undefined);
    const motion = point.type === "flutter" ? row?.motions[beyond.find((number) => number >= 0) ?? -1] : lowest;
    return row && motion ? [{ kind: point.type, row, motion }] : [];
  });
}

/** The rows of an analysis of few load factors as dots, the chosen motion with a ring. */
function dots(chart: FrequencyChart, input: FrequencyInput): Shape {
  const vibrations = input.result.branches.length === 0 ? chart.series.flatMap(({ rows }) => rows) : [];
  return group("rows", ...vibrations.flatMap((row) => row.motions.map((motion, i) => {
    const { x, y } = pixelOf(chart.frame, row, motion);
    const chosen = input.chosen?.row === row.row && input.chosen.motion === i;
    return shape("circle", { class: chosen ? "chosen-ring" : "row", cx: coordinate(x), cy: coordinate(y), r: chosen ? 6.5 : 3.5 });
  })));
}

/** The load factor of the shown point of the path as a line from bottom to top. */
function loadLine({ frame }: FrequencyChart, load: number | null | undefined): Shape | null {
  if (load == null || load < Math.min(frame.x.from, frame.x.to) || load > Math.max(frame.x.from, frame.x.to)) return null;
  const x = place(frame.x, load);
  return line("leader", { x, y: frame.y.start }, { x, y: frame.y.end });
}

/**
 * Circular frequencies against the load factor, each motion a line. A motion that diverges is below zero; the two lines of a pair
 * that flutters lie on one another, at the frequency of its growing vibration.
 */
export function frequencyFigure(input: FrequencyInput, size: Size, chart: FrequencyChart = frequencyChart(input, size)): Shape {
  const { frame, series } = chart;
  const lines = series.flatMap(({ branch, rows }) => {
    const count = rows.reduce((most, { motions }) => Math.max(most, motions.length), 0);
    const className = branch === 0 ? "path" : "path branch";
    return Array.from({ length: count }, (_, number) => motionLines(frame, rows, number, className)).flat();
  });
  const marks = criticalMarks(input.result, series).map(({ kind, row, motion }) => mark(kind, pixelOf(frame, row, motion)));
  const empty = lines.length > 0 || hasFrequencies(input.result) ? null
    : label("muted", { x: (frame.x.start + frame.x.end) / 2, y: (frame.y.start + frame.y.end) / 2 }, "middle", "no frequencies");
  return figure("chart frequency-chart", size, "Circular frequency against load factor", plotArea(frame), frameShapes(frame, size),
                loadLine(chart, input.load), group("plot-lines", ...lines), dots(chart, input), group("marks", ...marks), empty,
                legendShape(legendEntries(input, series), size.width));
}

/** The motion whose place is nearest to a pixel, with its branch; null without motions. */
export function nearestMotion(chart: FrequencyChart, to: Pixel): (ChosenMotion & { branch: number }) | null {
  let best: (ChosenMotion & { branch: number }) | null = null;
  let least = Infinity;
  for (const { branch, rows } of chart.series) {
    for (const row of rows) {
      row.motions.forEach((motion, i) => {
        const at = pixelOf(chart.frame, row, motion);
        const distance = Math.hypot(at.x - to.x, at.y - to.y);
        if (distance >= least) return;
        least = distance;
        best = { branch, row: row.row, motion: i };
      });
    }
  }
  return best;
}
