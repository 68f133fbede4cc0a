// Scales, round ticks, grid and axis labels that all charts share.

import { textWidth } from "../labels";
import { formatNumber } from "../numbers";
import { coordinate, group, label, line, shape, type Shape, type Size } from "../shape";

/** A scale from values to pixels; `log` maps the logarithm. */
export interface Scale {
  from: number;
  to: number;
  start: number;
  end: number;
  log: boolean;
}

export function makeScale(from: number, to: number, start: number, end: number, log = false): Scale {
  return { from, to, start, end, log };
}

function position(scale: Scale, value: number): number {
  return scale.log ? Math.log10(value / scale.from) / Math.log10(scale.to / scale.from)
                   : (value - scale.from) / (scale.to - scale.from);
}

/** The pixel of a value. */
export function place(scale: Scale, value: number): number {
  return scale.start + position(scale, value) * (scale.end - scale.start);
}

/** The value at a pixel. */
export function valueAt(scale: Scale, pixel: number): number {
  const t = (pixel - scale.start) / (scale.end - scale.start);
  return scale.log ? scale.from * (scale.to / scale.from) ** t : scale.from + t * (scale.to - scale.from);
}

/** The step of 1, 2 or 5 times a power of ten that cuts a length into about so many parts. */
export function roundStep(length: number, parts: number): number {
  const rough = length / Math.max(1, parts);
  const power = 10 ** Math.floor(Math.log10(rough));
  const share = rough / power;
  return power * (share < 1.5 ? 1 : share < 3.5 ? 2 : share < 7.5 ? 5 : 10);
}

/** Round values of a scale, about one every `spacing` pixels. */
export function ticks(scale: Scale, spacing: number): number[] {
  const count = Math.max(1, Math.abs(scale.end - scale.start) / spacing);
  const low = Math.min(scale.from, scale.to);
  const high = Math.max(scale.from, scale.to);
  if (!(high > low) || !Number.isFinite(high - low)) return [low];
  if (scale.log) return logTicks(low, high, count);
  const step = roundStep(high - low, count);
  const first = Math.ceil(low / step - 1e-9);
  const values: number[] = [];
  for (let i = first; i * step <= high + 1e-9 * step; ++i) values.push(i === 0 ? 0 : Number((i * step).toPrecision(12)));
  return values;
}

function logTicks(low: number, high: number, count: number): number[] {
  const decades = Math.log10(high / low);
  const every = Math.max(1, Math.round(decades / count));
  const shares = decades > 0.7 * count ? [1] : decades > 0.35 * count ? [1, 3] : [1, 2, 5];
  const values: number[] = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); ++power) {
    if (power % every !== 0) continue;
    for (const share of shares) {
      const value = Number(`${share}e${power}`);
      if (value >= low * (1 - 1e-9) && value <= high * (1 + 1e-9)) values.push(value);
    }
  }
  return values;
}

/** A range with room at both ends, that is never empty and holds zero where it is near. */
export function widened(low: number, high: number, share = 0.06): [number, number] {
  if (!Number.isFinite(low) || !Number.isFinite(high)) return [0, 1];
  if (high - low < 1e-12 * Math.max(Math.abs(low), Math.abs(high), 1e-300)) {
    const half = low === 0 ? 1 : 0.5 * Math.abs(low);
    return [low - half, high + half];
  }
  const room = share * (high - low);
  const from = low === 0 ? 0 : low > 0 && low < 0.25 * high ? 0 : low - room;
  const to = high === 0 ? 0 : high < 0 && high > 0.25 * low ? 0 : high + room;
  return [from, to];
}

/** The frame of a chart: grid lines, numbers, axis labels. */
export interface Frame {
  x: Scale;
  y: Scale;
  xLabel: string;
  yLabel: string;
  /** Names at values, where an axis has names and not numbers. */
  xNames?: readonly string[] | undefined;
  yNames?: readonly string[] | undefined;
  /** Values to write at, where there are few that mean something. */
  xValues?: readonly number[] | undefined;
  yValues?: readonly number[] | undefined;
}

/** Ticks of an axis with their texts: numbers, or names at 0, 1, 2, ... as many as find room. */
function written(scale: Scale, names: readonly string[] | undefined, values: readonly number[] | undefined,
                 spacing: number): { value: number; text: string }[] {
  if (!names) return (values ?? ticks(scale, spacing)).map((value) => ({ value, text: formatNumber(value) }));
  const room = Math.max(1, Math.floor(Math.abs(scale.end - scale.start) / Math.min(spacing, 60)));
  const every = Math.max(1, Math.ceil(names.length / room));
  return names.flatMap((text, value) => (value % every === 0 ? [{ value, text }] : []));
}

export const kBetweenTexts = 6;  // pixels between texts below an axis
const kLineHeight = 14;

/** Room at the left of a plot for the texts of its upright axis and its name. */
export function leftRoom({ y, yNames, yValues }: Pick<Frame, "y" | "yNames" | "yValues">): number {
  return 30 + written(y, yNames, yValues, 50).reduce((most, { text }) => Math.max(most, textWidth(text)), 0);
}

/** Values of a sweep's parameter that can be written at an axis: few, and exact in three digits. */
export function fewRound(values: readonly number[]): readonly number[] | undefined {
  return values.length <= 10 && values.every((value) => Number(value.toPrecision(3)) === value) ? values : undefined;
}

/** Grid, zero lines and numbers. A number that would cover the one before is left out. */
export function frameShapes(frame: Frame, size: Size): Shape {
  const { x, y } = frame;
  const shapes: Shape[] = [];
  let free = -Infinity;
  for (const { value, text } of written(x, frame.xNames, frame.xValues, 80)) {
    const px = place(x, value);
    const half = textWidth(text) / 2;
    shapes.push(line(value === 0 && !x.log && !frame.xNames ? "grid zero" : "grid", { x: px, y: y.start }, { x: px, y: y.end }));
    if (px - half < free) continue;
    free = px + half + kBetweenTexts;
    shapes.push(label("tick", { x: px, y: y.start + 16 }, "middle", text));
  }
  free = Infinity;
  for (const { value, text } of written(y, frame.yNames, frame.yValues, 50)) {
    const py = place(y, value);
    shapes.push(line(value === 0 && !y.log && !frame.yNames ? "grid zero" : "grid", { x: x.start, y: py }, { x: x.end, y: py }));
    if (py > free) continue;
    free = py - kLineHeight;
    shapes.push(label("tick", { x: x.start - 8, y: py + 4 }, "end", text));
  }
  const middle = (y.start + y.end) / 2;
  const upright = label("axis-label", { x: 12, y: middle }, "middle", frame.yLabel);
  upright.attributes["transform"] = `rotate(-90 12 ${coordinate(middle)})`;
  shapes.push(label("axis-label", { x: (x.start + x.end) / 2, y: Math.min(size.height - 4, y.start + 36) }, "middle",
                    frame.xLabel), upright);
  return group("frame", ...shapes);
}

/** A rectangle with nothing in it: a place for the reader's pointer. */
export function plotArea(frame: Frame): Shape {
  const { x, y } = frame;
  return shape("rect", {
    class: "plot", x: coordinate(x.start), y: coordinate(y.end),
    width: coordinate(x.end - x.start), height: coordinate(y.start - y.end),
  });
}
