// The curves of a refined sweep on a map. Their rows are at other values of the last parameter on each curve, so that they are no
// grid: each curve is cut into cells of even size, with the values that straight lines between its rows have there.

import { at } from "../geometry";
import type { Occupancy } from "../labels";
import { coordinate, group, shape, type Pixel, type Shape, type Size } from "../shape";
import { place, type Scale } from "./axes";
import { breakLabels, type DrawnBreak } from "./breaks";
import { breaksOf, curveAxes, piecesOf, type Break, type Pieces } from "./pieces";
import type { RowError, Table } from "./sweep";

/** A row of the table on a map; or a cell, with the number of the row that is nearest to it. */
export interface Spot {
  row: number;
  x: number;
  y: number;
  value: number;
  error: RowError | null;
}

const kCellHeight = 3;  // px
const kFewest = 24;     // cells of a curve

/** The pieces of a table whose curves go along the column `y`; null where there are none. */
export function piecesAlong(table: Table, y: string): Pieces | null {
  return curveAxes(table)?.x === y ? piecesOf(table) : null;
}

/** Values in equal steps, or in equal ratios, that cut the curves of a map of a height into cells of a few pixels. */
export function evenValues(values: readonly number[], log: boolean, size: Size): number[] {
  const [low, high] = [at(values, 0), at(values, values.length - 1)];
  const count = Math.max(kFewest, Math.round((size.height - 60) / kCellHeight));
  const step = (i: number): number =>
    log && low > 0 ? low * (high / low) ** (i / count) : low + (high - low) * (i / count);
  return Array.from({ length: count + 1 }, (_, i) => (i === count ? high : step(i)));
}

/** The rows of a map by their curves, each in rising order. */
export function curvesOf(spots: readonly Spot[]): Map<number, Spot[]> {
  const curves = new Map<number, Spot[]>();
  for (const spot of spots) {
    const curve = curves.get(spot.x) ?? [];
    curve.push(spot);
    curves.set(spot.x, curve);
  }
  for (const curve of curves.values()) curve.sort((a, b) => a.y - b.y);
  return curves;
}

/** The cell between two rows, at a share of the way from one to the other: between pieces it has the value of the nearest row. */
function cellBetween(before: Spot, after: Spot, share: number, y: number, pieces: Pieces): Spot {
  const nearest = share < 0.5 ? before : after;
  const joined = pieces.numbers[before.row] === pieces.numbers[after.row] && Number.isFinite(before.value + after.value);
  return { ...nearest, y, value: joined ? before.value + share * (after.value - before.value) : nearest.value };
}

/** Cells of a curve at rising values; null beyond the rows that it has. */
function cellsAlong(curve: readonly Spot[], ys: readonly number[], log: boolean, pieces: Pieces): (Spot | null)[] {
  const measure = (y: number): number => (log && y > 0 ? Math.log(y) : y);
  let next = 0;
  return ys.map((y) => {
    while ((curve[next]?.y ?? Infinity) < y) ++next;
    const after = curve[next];
    const before = curve[next - 1];
    if (!after || (!before && after.y > y)) return null;
    if (!before) return { ...after, y };
    const share = (measure(y) - measure(before.y)) / (measure(after.y) - measure(before.y));
    return cellBetween(before, after, share, y, pieces);
  });
}

/** Cells of all curves, row after row of the map; null where a curve has none. */
export function evenCells(spots: readonly Spot[], xs: readonly number[], ys: readonly number[], log: boolean,
                          pieces: Pieces): (Spot | null)[] {
  const curves = curvesOf(spots);
  const columns = xs.map((x) => cellsAlong(curves.get(x) ?? [], ys, log, pieces));
  return ys.flatMap((_, j) => columns.map((column) => column[j] ?? null));
}

/**
 * Whether the cells of two neighbouring rows and columns belong together, so that contour lines may pass between them. Where the
 * curves of both columns have as many pieces, pieces of one number belong together; else a break of one curve parts its cells.
 */
export function joinedCells(cells: readonly (Spot | null)[], columns: number, pieces: Pieces): (i: number, j: number) => boolean {
  const pieceOf = (i: number, j: number): number => pieces.numbers[cells[j * columns + i]?.row ?? -1] ?? Number.NaN;
  const counts = Array.from({ length: columns }, (_, i) => {
    let most = 0;
    for (let j = 0; j * columns < cells.length; ++j) most = Math.max(most, pieceOf(i, j) || 0);
    return most;
  });
  return (i, j) => {
    const [low, high, lowNext, highNext] = [pieceOf(i, j), pieceOf(i, j + 1), pieceOf(i + 1, j), pieceOf(i + 1, j + 1)];
    return low === high && lowNext === highNext && (counts[i] !== counts[i + 1] || low === lowNext);
  };
}

/** A break of the curve over a column of a map. */
export type MapBreak = Break<Spot> & { column: number };

/** The breaks of all curves. */
export function mapBreaks(spots: readonly Spot[], xs: readonly number[], pieces: Pieces): MapBreak[] {
  const curves = curvesOf(spots);
  return xs.flatMap((x, column) => breaksOf(curves.get(x) ?? [], pieces).map((one) => ({ ...one, column })));
}

/** Strokes across the columns where their curves break, all of one change in one path; and one name for each change. */
export function mapBreakShapes(breaks: readonly MapBreak[], xEdges: readonly number[], y: Scale, taken: Occupancy): Shape[] {
  if (breaks.length === 0) return [];
  const changes = new Map<string, { d: string; ends: Pixel[] }>();
  for (const { column, before, after, change } of breaks) {
    const [left, right] = [at(xEdges, column), at(xEdges, column + 1)];
    const middle = (place(y, before.y) + place(y, after.y)) / 2;
    const drawn = changes.get(change) ?? { d: "", ends: [] };
    drawn.d += `M${coordinate(left)} ${coordinate(middle)}H${coordinate(right)}`;
    drawn.ends.push({ x: (left + right) / 2, y: middle });
    changes.set(change, drawn);
  }
  const all = [...changes].map(([change, { d, ends }]) => ({ change, title: change === "" ? "break" : change, d, ends }));
  const named = all.map((one): DrawnBreak => ({ ...one, ends: one.ends.slice(0, 1 + Math.floor(one.ends.length / 2)) }));
  return [
    group("breaks", ...all.map(({ title, d }) => shape("path", { class: "break-line", d }, shape("title", {}, title)))),
    breakLabels(named, taken, true),
  ];
}
