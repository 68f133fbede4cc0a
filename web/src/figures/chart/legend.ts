// A legend above a chart: samples with their names, in as many rows as they need.

import { textWidth } from "../labels";
import { group, label, line, type Pixel, type Shape } from "../shape";
import { kMarkNames, mark, type MarkKind } from "./marks";

/** A line with its classes, or a mark; `group` is the class of a group around a line that has one. */
export type LegendEntry = { text: string } & ({ line: string; group?: string } | { mark: MarkKind });

const kLeft = 62;    // where the plot begins
const kNarrow = 420;  // narrower figures use all their width
const kRow = 18;

function sampleWidth(entry: LegendEntry): number {
  return "line" in entry ? 30 : 18;
}

function layout(entries: readonly LegendEntry[], width: number): { places: Pixel[]; rows: number } {
  const places: Pixel[] = [];
  const left = width < kNarrow ? 4 : kLeft;
  let x = left;
  let row = 0;
  for (const entry of entries) {
    const wide = sampleWidth(entry) + textWidth(entry.text) + 16;
    if (x > left && x + wide > width) {
      x = left;
      ++row;
    }
    places.push({ x, y: 10 + kRow * row });
    x += wide;
  }
  return { places, rows: entries.length === 0 ? 0 : row + 1 };
}

/** Height of a legend in a figure of a width. */
export function legendHeight(entries: readonly LegendEntry[], width: number): number {
  return kRow * layout(entries, width).rows;
}

export function legendShape(entries: readonly LegendEntry[], width: number, top = 0): Shape {
  const { places } = layout(entries, width);
  return group("legend", ...entries.flatMap((entry, i) => {
    const place = places[i];
    if (!place) return [];
    const at = { x: place.x, y: place.y + top };
    const sample = "mark" in entry ? mark(entry.mark, { x: at.x + 6, y: at.y })
                                   : group(entry.group ?? "sample", line(entry.line, at, { x: at.x + 24, y: at.y }));
    return [sample, label("legend-text", { x: at.x + sampleWidth(entry), y: at.y + 4 }, "start", entry.text)];
  }));
}

/** Entries of marks that occur, in their usual order. */
export function markEntries(kinds: ReadonlySet<MarkKind>): LegendEntry[] {
  return (Object.keys(kMarkNames) as MarkKind[]).filter((kind) => kinds.has(kind))
    .map((kind) => ({ text: kMarkNames[kind], mark: kind }));
}
