// Buckling loads of a linearised analysis as stems, one a mode.

import type { components } from "../../api/types";
import { formatNumber } from "../numbers";
import { coordinate, figure, group, label, line, shape, type Pixel, type Shape, type Size } from "../shape";
import { frameShapes, makeScale, place, type Frame } from "./axes";

type Buckling = components["schemas"]["Buckling"];

/** Load factors have no unit; `chosen` is the index of a mode. */
export interface BucklingInput {
  buckling: Buckling;
  chosen?: number | null | undefined;
}

export function bucklingFrame(input: BucklingInput, size: Size): Frame {
  const loads = input.buckling.load_factors;
  const least = loads.reduce((min, load) => Math.min(min, load), 0);
  const most = loads.reduce((max, load) => Math.max(max, load), 0);
  const room = 0.12 * (most - least) || 1;
  return {
    x: makeScale(-0.5, Math.max(0.5, loads.length - 0.5), 66, Math.max(90, size.width - 14)),
    y: makeScale(least < 0 ? least - room : 0, most + room, Math.max(60, size.height - 44), 12),
    xLabel: "mode", yLabel: "buckling load factor", xNames: loads.map((_, i) => String(i + 1)),
  };
}

/** Buckling loads, smallest first; those of the opposite actions below zero. */
export function bucklingFigure(input: BucklingInput, size: Size): Shape {
  const frame = bucklingFrame(input, size);
  const few = input.buckling.load_factors.length <= 12;
  const stems = input.buckling.load_factors.map((load, i) => {
    const x = place(frame.x, i);
    const y = place(frame.y, load);
    return group(i === input.chosen ? "stem chosen-stem" : "stem", line("stem-line", { x, y: place(frame.y, 0) }, { x, y }),
                 shape("circle", { class: "stem-dot", cx: coordinate(x), cy: coordinate(y), r: 5 }),
                 few ? label("mark-label strong", { x, y: load < 0 ? y + 18 : y - 10 }, "middle", formatNumber(load, 5)) : null);
  });
  return figure("chart buckling", size, "Buckling load factors by mode", frameShapes(frame, size), ...stems);
}

/** The mode whose stem is nearest to a pixel; null without modes. */
export function nearestMode(input: BucklingInput, size: Size, to: Pixel): number | null {
  const frame = bucklingFrame(input, size);
  const count = input.buckling.load_factors.length;
  if (count === 0) return null;
  const step = (frame.x.end - frame.x.start) / count;
  return Math.min(count - 1, Math.max(0, Math.floor((to.x - frame.x.start) / step)));
}
