// The law of a spring or foundation as it stands in the request: reaction p over displacement w (docs/requests.md, laws).

import { formatNumber, formatWithUnit, unitOf, withUnit, type Units } from "../numbers";
import { reactionCurve, variesAlong, type ReactionCurve } from "../reaction";
import { coordinate, figure, group, path, shape, type Pixel, type Shape, type Size } from "../shape";
import { frameShapes, makeScale, place, plotArea, widened, type Frame } from "./axes";
import { legendHeight, legendShape, type LegendEntry } from "./legend";
import { thinned } from "./thin";

/** A support with a `law`, as it is in `list` of the model. Its fields may still be wrong: people are typing. */
export interface LawInput {
  list: "springs" | "foundations";
  support: Readonly<Record<string, unknown>>;
  units?: Units | undefined;
}

/** What is drawn of a law. */
export interface DrawnLaw {
  /** Senses of w in which the support reacts: 1 into the medium, -1 away from it. */
  senses: readonly (1 | -1)[];
  /** Displacement before a one-sided support reacts. */
  gap: number;
  /** Largest displacement beyond the gap that is drawn. */
  reach: number;
  /**
   * One curve; or three, at the start, the middle and the end of the range, where numbers vary along the member. The name of each is
   * its place in lengths L of the member.
   */
  curves: { name: string; curve: ReactionCurve }[];
}

interface LawPoint {
  w: number;
  p: number;
}

export interface LawChart {
  frame: Frame;
  lines: { name: string; points: LawPoint[]; dots: LawPoint[] }[];
}

const kRoom = 1.2;     // share of the largest reach of the curves that is drawn
const kFree = 0.25;    // share of it on the side to which a one-sided support does not react
const kPieces = 60;    // of each curve, as far as its reach and beyond
const kTolerance = 0.05;  // px that a thinned line may be off: in a small chart corners of more are seen
const kMostDots = 40;  // more points of a table are crowded

const kSenses: Record<string, readonly (1 | -1)[]> = { bilateral: [-1, 1], compression_only: [1], tension_only: [-1] };

function fractionsOf(range: unknown): [number, number] {
  const [from, to] = Array.isArray(range) ? (range as unknown[]) : [];
  return [typeof from === "number" ? from : 0, typeof to === "number" ? to : 1];
}

/** The law with its curves; null where the support has none, or one that the checks of the service refuse. */
export function drawnLaw({ support }: LawInput): DrawnLaw | null {
  const [from, to] = fractionsOf(support["range"]);
  const fractions = variesAlong(support["law"]) ? [from, (from + to) / 2, to] : [from];
  const curves = fractions.flatMap((fraction) => {
    const curve = reactionCurve(support["law"], fraction);
    return curve ? [{ name: `${formatNumber(fraction, 3)}\u00a0L`, curve }] : [];
  });
  const senses = kSenses[String(support["reaction"] ?? "bilateral")];
  const given = support["gap"];  // a gap that varies along the member is left out
  const gap = senses?.length === 1 && typeof given === "number" ? given : 0;
  const reach = kRoom * Math.max(0, ...curves.map(({ curve }) => curve.reach));
  if (!senses || curves.length < fractions.length || !(gap >= 0 && reach > 0 && Number.isFinite(gap + reach))) return null;
  return { senses, gap, reach, curves };
}

/** Displacements beyond the gap at which a curve is computed: close where it bends. */
function samples(curve: ReactionCurve, reach: number): number[] {
  const shares = Array.from({ length: kPieces + 1 }, (_, i) => i / kPieces);
  const all = [...shares.map((share) => share * reach), ...shares.map((share) => share * share * curve.reach), ...curve.ends];
  return all.filter((w) => w <= reach).sort((a, b) => a - b);
}

function inSense(sense: 1 | -1, points: readonly LawPoint[]): LawPoint[] {
  return sense === 1 ? [...points] : points.map(({ w, p }) => ({ w: -w, p: -p })).reverse();
}

function lineOf(law: DrawnLaw, curve: ReactionCurve): LawPoint[] {
  const half = samples(curve, law.reach).map((w) => ({ w: law.gap + w, p: curve.reaction(w) }));
  const free = law.senses.length === 1 ? [{ w: -kFree * (law.gap + law.reach), p: 0 }] : [];
  return law.senses.flatMap((sense) => inSense(sense, [...free, ...half]));
}

function dotsOf(law: DrawnLaw, curve: ReactionCurve): LawPoint[] {
  if (curve.ends.length * law.senses.length > kMostDots) return [];
  const points = curve.ends.map((w) => ({ w: law.gap + w, p: curve.reaction(w) }));
  return law.senses.flatMap((sense) => inSense(sense, points));
}

/** What w and p are called, with their units: a foundation's p is a force or moment per length, a rotational spring's a moment. */
export function lawLabels({ list, support, units }: LawInput): { w: string; p: string; unit: string } {
  const turns = list === "springs" ? support["direction"] === "rotation" : support["component"] === "rotation";
  // a moment per length is a force
  const unit = unitOf(units, turns && list === "springs" ? "moment" : turns || list === "springs" ? "force" : "line_load");
  const beyond = typeof support["gap"] === "object" && support["gap"] !== null ? " beyond the gap" : "";
  return {
    w: withUnit((turns ? "rotation w" : "displacement w") + beyond, unitOf(units, turns ? "rotation" : "length")),
    p: withUnit(turns ? "moment p" : "reaction p", unit), unit,
  };
}

function extentOf(values: readonly number[]): [number, number] {
  return [Math.min(...values), Math.max(...values)];
}

function legendEntries(lines: LawChart["lines"]): LegendEntry[] {
  if (lines.length < 2) return [];
  return lines.map(({ name }, i) => ({ text: name, line: "series-line", group: `series series-${i}` }));
}

/** Lays the chart out; null where there is no law to draw. */
export function lawChart(input: LawInput, size: Size): LawChart | null {
  const law = drawnLaw(input);
  if (!law) return null;
  const table = (input.support["law"] as { type: string }).type === "table";
  const lines = law.curves.map(({ name, curve }) => ({
    name, points: lineOf(law, curve), dots: table ? dotsOf(law, curve) : [],
  }));
  const all = lines.flatMap(({ points }) => points);
  const w = extentOf(all.map((point) => point.w));
  const p = widened(...extentOf(all.map((point) => point.p)));
  const labels = lawLabels(input);
  const frame = {
    x: makeScale(w[0], w[1], 66, Math.max(90, size.width - 14)),
    y: makeScale(p[0], p[1], Math.max(60, size.height - 44), 10 + legendHeight(legendEntries(lines), size.width)),
    xLabel: labels.w, yLabel: labels.p,
  };
  return { frame, lines };
}

function titleOf(input: LawInput, chart: LawChart): string {
  const { id, law, reaction } = input.support;
  const most = Math.max(...chart.lines.flatMap(({ points }) => points.map(({ p }) => Math.abs(p))));
  const sense = typeof reaction === "string" ? `, ${reaction.replace("_", " ")}` : "";
  return `Law of ${String(id)}: ${(law as { type: string }).type}${sense}; ${chart.frame.yLabel} against ${chart.frame.xLabel}, ` +
    `up to ${formatWithUnit(most, lawLabels(input).unit)}`;
}

/**
 * Reaction p over displacement w, both positive into the medium, in the model's units. A bilateral support has both senses, a
 * one-sided one the free side up to its gap too. Points of a table are dots.
 */
export function lawFigure(input: LawInput, size: Size, chart: LawChart): Shape {
  const { frame } = chart;
  const pixel = ({ w, p }: LawPoint): Pixel => ({ x: place(frame.x, w), y: place(frame.y, p) });
  const curves = chart.lines.map(({ points, dots }, i) => {
    const pixels = points.map(pixel);
    return group(`series series-${i}`, path("series-line", thinned(pixels, kTolerance).flatMap((k) => pixels[k] ?? [])),
                 ...dots.map(pixel).map(({ x, y }) =>
                   shape("circle", { class: "series-dot", cx: coordinate(x), cy: coordinate(y), r: 2.4 })));
  });
  return figure("chart law", size, titleOf(input, chart), plotArea(frame), frameShapes(frame, size), ...curves,
                legendShape(legendEntries(chart.lines), size.width));
}
