// Reaction curves of the laws of docs/requests.md, written from their formulas there: what the page draws without asking the service.

import { at, interpolate } from "./geometry";

/** Reaction p of a law at one place of its member. */
export interface ReactionCurve {
  /** p at the displacement w >= 0 into the medium, beyond the gap. */
  reaction: (w: number) => number;
  /** Ends of the parts of p, w > 0, ascending. */
  ends: number[];
  /** Displacement at which p is 90 % of the capacity or more; 0 where the support does not react. */
  reach: number;
}

const kNone: ReactionCurve = { reaction: () => 0, ends: [], reach: 0 };

/** A table of w and p with the slopes dp/dw of its cubic. */
interface Cubic {
  w: number[];
  p: number[];
  slopes: number[];
}

/**
 * Weighted harmonic means of the neighbouring chords (Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304); no
 * curvature at the first and the last point.
 */
function slopesOf(w: readonly number[], p: readonly number[]): number[] {
  const last = w.length - 1;
  const widths = w.slice(1).map((end, i) => end - at(w, i));
  const chords = widths.map((width, i) => (at(p, i + 1) - at(p, i)) / width);
  if (last === 1) return [at(chords, 0), at(chords, 0)];
  const inner = w.slice(1, last).map((_, i) => {
    const [before, after] = [at(chords, i), at(chords, i + 1)];
    const hasOneSense = (before > 0 && after > 0) || (before < 0 && after < 0);
    if (!hasOneSense) return 0;
    const [a, b] = [at(widths, i + 1) + 2 * at(widths, i), 2 * at(widths, i + 1) + at(widths, i)];
    return (a + b) / (b / before + a / after);
  });
  const end = (chord: number, next: number): number => (3 * chord - next) / 2;
  return [end(at(chords, 0), at(inner, 0)), ...inner, end(at(chords, last - 1), at(inner, last - 2))];
}

function cubicAt({ w, p, slopes }: Cubic, where: number): number {
  const next = w.findIndex((value) => value > where);
  if (next < 0) return at(p, p.length - 1);
  const i = next - 1;
  const width = at(w, next) - at(w, i);
  const t = (where - at(w, i)) / width;
  return at(p, i) * (1 + 2 * t) * (1 - t) ** 2 + at(p, next) * t * t * (3 - 2 * t) +
    width * t * (1 - t) * (at(slopes, i) * (1 - t) - at(slopes, next) * t);
}

function isPair(value: unknown): value is [number, number] {
  return Array.isArray(value) && value.length === 2 && value.every((item) => typeof item === "number" && Number.isFinite(item));
}

/** Whether the first numbers of the pairs ascend, and there is a pair. */
function ascend(pairs: readonly (readonly [number, number])[]): boolean {
  return pairs.length > 0 && pairs.every(([value], i) => i === 0 || value > (pairs[i - 1]?.[0] ?? Infinity));
}

function alongOf(value: unknown): [number, number][] | null {
  if (typeof value !== "object" || value === null || !("along" in value) || !Array.isArray(value.along)) return null;
  return value.along.every(isPair) && ascend(value.along) ? value.along : null;
}

/** A number of a law at a fraction of its member's length; NaN where the document has none. */
function numberAt(value: unknown, fraction: number): number {
  if (typeof value === "number") return value;
  const along = alongOf(value);
  return along ? interpolate(along.map(([f]) => f), along.map(([, number]) => number), fraction) : Number.NaN;
}

function tableCurve(points: unknown, factor: number, between: unknown): ReactionCurve | null {
  if (!Array.isArray(points) || !points.every(isPair)) return null;
  const given = points[0]?.[0] === 0 ? points : [[0, 0] as [number, number], ...points];
  if (given.length < 2 || !ascend(given)) return null;
  const w = given.map(([displacement]) => displacement);
  const p = given.map(([, force]) => force);
  const ends = { ends: w.slice(1), reach: at(w, w.length - 1) };
  if (between === "linear") return { reaction: (where) => factor * interpolate(w, p, where), ...ends };
  const cubic = { w, p, slopes: slopesOf(w, p) };
  return { reaction: (where) => factor * cubicAt(cubic, where), ...ends };
}

/** p = min(k w, P (w/w0)^n, P). The line meets the power before it meets the capacity where k w0 > P. */
function powerCurve(k: number, capacity: number, reference: number, exponent: number): ReactionCurve | null {
  if (!(reference > 0 && exponent > 0 && exponent < 1)) return null;
  const reaction = (w: number): number => Math.min(k * w, capacity * (w / reference) ** exponent, capacity);
  if (k * reference <= capacity) return { reaction, ends: [capacity / k], reach: capacity / k };
  const meeting = reference * (capacity / (k * reference)) ** (1 / (1 - exponent));
  return { reaction, ends: [meeting, reference], reach: reference };
}

/** The curve of `law` of a request at a fraction of the member's length; null where the law is wrong or not known here. */
export function reactionCurve(law: unknown, fraction: number): ReactionCurve | null {
  if (typeof law !== "object" || law === null) return null;
  const fields = law as Record<string, unknown>;
  if (fields["type"] === "table") {
    const factor = numberAt(fields["factor"] ?? 1, fraction);
    return factor === 0 ? kNone : factor > 0 ? tableCurve(fields["points"], factor, fields["interpolation"]) : null;
  }
  const k = numberAt(fields["stiffness"], fraction);
  const capacity = numberAt(fields["capacity"], fraction);
  if (!(k >= 0 && capacity >= 0)) return null;
  if (k === 0 || capacity === 0) return kNone;
  const yielding = capacity / k;
  switch (fields["type"]) {
    case "tanh": return { reaction: (w) => capacity * Math.tanh(w / yielding), ends: [], reach: 1.5 * yielding };
    case "hyperbolic": return { reaction: (w) => w / (1 / k + w / capacity), ends: [], reach: 9 * yielding };
    case "power": return powerCurve(k, capacity, Number(fields["reference"]), Number(fields["exponent"]));
    default: return null;
  }
}

/** Whether a number of the law varies along the member. */
export function variesAlong(law: unknown): boolean {
  return typeof law === "object" && law !== null && Object.values(law).some((value) => alongOf(value) !== null);
}
