// Contour lines on a grid by marching squares; a cell with a missing corner has none.

import { at } from "../geometry";
import type { Pixel } from "../shape";

/** Values row after row: value(i, j) = values[j * x.length + i] at (x[i], y[j]), in pixels. */
export interface Grid {
  x: readonly number[];
  y: readonly number[];
  values: readonly number[];
  /** Whether lines may be drawn in the cell between (i, j) and (i + 1, j + 1); they may in all cells when left out. */
  isJoined?: ((i: number, j: number) => boolean) | undefined;
}

/** Where the line between two corners crosses the level; null when it does not. */
function crossing(a: Pixel, va: number, b: Pixel, vb: number, level: number): Pixel | null {
  if ((va < level) === (vb < level)) return null;
  const t = (level - va) / (vb - va);
  return { x: a.x + t * (b.x - a.x), y: a.y + t * (b.y - a.y) };
}

/** Pieces of the contour in one cell. In a saddle the mean of the corners decides which crossings belong together. */
function cellPieces(corners: readonly Pixel[], values: readonly number[], level: number): [Pixel, Pixel][] {
  const found: Pixel[] = [];
  for (let k = 0; k < 4; ++k) {
    const a = corners[k];
    const b = corners[(k + 1) % 4];
    const point = a && b ? crossing(a, at(values, k), b, at(values, (k + 1) % 4), level) : null;
    if (point) found.push(point);
  }
  const [p, q, r, s] = found;
  if (!p || !q) return [];
  if (!r || !s) return [[p, q]];
  const mean = values.reduce((sum, value) => sum + value, 0) / 4;
  return (mean < level) === (at(values, 0) < level) ? [[p, q], [r, s]] : [[q, r], [s, p]];
}

/** All pieces of the contour lines of increasing levels, one list a level. */
export function contours(grid: Grid, levels: readonly number[]): [Pixel, Pixel][][] {
  const pieces: [Pixel, Pixel][][] = levels.map(() => []);
  const columns = grid.x.length;
  for (let j = 0; j + 1 < grid.y.length; ++j) {
    for (let i = 0; i + 1 < columns; ++i) if (grid.isJoined?.(i, j) ?? true) addCell(grid, i, j, levels, pieces);
  }
  return pieces;
}

function addCell(grid: Grid, i: number, j: number, levels: readonly number[], pieces: [Pixel, Pixel][][]): void {
  const columns = grid.x.length;
  const k = j * columns + i;
  const a = at(grid.values, k);
  const b = at(grid.values, k + 1);
  const c = at(grid.values, k + columns + 1);
  const d = at(grid.values, k + columns);
  const least = Math.min(a, b, c, d);
  const most = Math.max(a, b, c, d);
  if (!Number.isFinite(least) || !Number.isFinite(most)) return;
  levels.forEach((level, number) => {
    if (least >= level || most < level) return;
    const corners = [{ x: at(grid.x, i), y: at(grid.y, j) }, { x: at(grid.x, i + 1), y: at(grid.y, j) },
                     { x: at(grid.x, i + 1), y: at(grid.y, j + 1) }, { x: at(grid.x, i), y: at(grid.y, j + 1) }];
    pieces[number]?.push(...cellPieces(corners, [a, b, c, d], level));
  });
}
