// Labels that never collide: each is tried around its anchor, and takes the place that covers least; one that finds
// no free place is left out unless it must be there.

import { group, label, line, shape, type Anchor, type Pixel, type Shape, type Size } from "./shape";

export interface Box {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

/** Estimated width of a text in system-ui, in pixels: generous, since there is no document to measure it in. */
export function textWidth(text: string, size = 12, bold = false): number {
  let em = 0;
  for (const character of text) {
    if (/[ilI.,:;'|!\u202f\u00a0 ()\-]/.test(character)) em += 0.34;
    else if (/[mwMW@%–−=×]/.test(character)) em += 0.9;
    else if (/[A-Z]/.test(character)) em += 0.7;
    else em += 0.585;
  }
  return em * size * (bold ? 1.15 : 1);
}

const kCell = 4;
const kLabelWeight = 250;  // a cell that another label covers is never taken

/** How much is drawn where, in cells of 4 pixels. */
export class Occupancy {
  private readonly columns: number;
  private readonly rows: number;
  private readonly weight: Uint8Array;

  constructor(readonly size: Size) {
    this.columns = Math.ceil(size.width / kCell);
    this.rows = Math.ceil(size.height / kCell);
    this.weight = new Uint8Array(Math.max(0, this.columns * this.rows));
  }

  private add(column: number, row: number, weight: number): void {
    if (column < 0 || row < 0 || column >= this.columns || row >= this.rows) return;
    const index = row * this.columns + column;
    this.weight[index] = Math.min(255, Math.max(weight, this.weight[index] ?? 0));
  }

  addBox(box: Box, weight = kLabelWeight): void {
    for (let row = Math.floor(box.top / kCell); row <= Math.floor(box.bottom / kCell); ++row) {
      for (let column = Math.floor(box.left / kCell); column <= Math.floor(box.right / kCell); ++column) {
        this.add(column, row, weight);
      }
    }
  }

  addLine(points: readonly Pixel[], weight = 8): void {
    for (let i = 1; i < points.length; ++i) {
      const a = points[i - 1];
      const b = points[i];
      if (!a || !b) continue;
      const steps = Math.min(2000, Math.ceil(Math.hypot(b.x - a.x, b.y - a.y) / kCell));
      for (let k = 0; k <= steps; ++k) {
        const t = steps === 0 ? 0 : k / steps;
        this.add(Math.floor((a.x + t * (b.x - a.x)) / kCell), Math.floor((a.y + t * (b.y - a.y)) / kCell), weight);
      }
    }
  }

  /** What a box would cover; Infinity where it covers a label or leaves the figure. */
  cost(box: Box): number {
    if (box.left < 0 || box.top < 0 || box.right > this.size.width || box.bottom > this.size.height) return Infinity;
    let sum = 0;
    for (let row = Math.floor(box.top / kCell); row <= Math.floor(box.bottom / kCell); ++row) {
      for (let column = Math.floor(box.left / kCell); column <= Math.floor(box.right / kCell); ++column) {
        const weight = this.weight[row * this.columns + column] ?? 0;
        if (weight >= kLabelWeight) return Infinity;
        sum += weight;
      }
    }
    return sum;
  }
}

/** A piece of a label's text with the class of its looks. */
export interface Run {
  text: string;
  className?: string;
  bold?: boolean;
}

export interface LabelRequest {
  at: Pixel;
  runs: Run[];
  className: string;
  /** Free distance from the anchor, 6 when left out. */
  distance?: number;
  size?: number;
  /** Where it goes when everything is free: 0 right, then clockwise by eighths of a turn; 7 is above on the right. */
  prefer?: number;
  /** Whether a line leads to a label that finds its place far away. */
  leader?: boolean;
  /** How many rings around the anchor are tried, 4 when left out; 1 keeps a label beside its anchor. */
  rings?: number;
  /** Cells that it may cover; labels that cover more are left out. */
  tolerance?: number;
}

const kEighths: readonly (readonly [number, number])[] =
  [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1]];
const kDiagonal = 0.75;

interface Candidate {
  box: Box;
  text: Pixel;
  anchor: Anchor;
  cost: number;
  far: boolean;
}

/** From the anchor's free distance to the nearest point of the label's box. */
function leaderShape(request: LabelRequest, box: Box): Shape {
  const end = {
    x: Math.min(box.right, Math.max(box.left, request.at.x)),
    y: Math.min(box.bottom, Math.max(box.top, request.at.y)),
  };
  const length = Math.hypot(end.x - request.at.x, end.y - request.at.y) || 1;
  const share = Math.min(1, 7 / length);
  const begin = { x: request.at.x + share * (end.x - request.at.x), y: request.at.y + share * (end.y - request.at.y) };
  return line("leader", begin, end);
}

function candidate(request: LabelRequest, eighth: number, ring: number, width: number, taken: Occupancy): Candidate {
  const [dx, dy] = kEighths[eighth] ?? [1, 0];
  const size = request.size ?? 12;
  const reach = (request.distance ?? 6) + ring * (size + 2);
  const scale = dx !== 0 && dy !== 0 ? kDiagonal : 1;
  const x = request.at.x + dx * reach * scale;
  const middle = request.at.y + dy * (reach * scale + size * 0.5);
  const left = dx > 0 ? x : dx < 0 ? x - width : x - width / 2;
  const box = { left: left - 2, right: left + width + 2, top: middle - size * 0.62, bottom: middle + size * 0.62 };
  const turn = Math.abs(((eighth - (request.prefer ?? 7) + 12) % 8) - 4);
  return {
    box,
    text: { x, y: middle + size * 0.36 },
    anchor: dx > 0 ? "start" : dx < 0 ? "end" : "middle",
    far: ring > 0,
    cost: taken.cost(box) + turn * 1.5 + ring * 22,
  };
}

/** Writes a label where it covers least, and takes the place; null when there is none. */
export function placeLabel(request: LabelRequest, taken: Occupancy): Shape | null {
  const size = request.size ?? 12;
  const width = request.runs.reduce((sum, run) => sum + textWidth(run.text, size, run.bold), 0);
  let best: Candidate | null = null;
  for (let ring = 0; ring < (request.rings ?? 4); ++ring) {
    for (let eighth = 0; eighth < 8; ++eighth) {
      const next = candidate(request, eighth, ring, width, taken);
      if (best === null || next.cost < best.cost) best = next;
    }
  }
  if (best === null || !(best.cost <= (request.tolerance ?? 60))) return null;
  taken.addBox(best.box);
  const text = label(request.className, best.text, best.anchor, ...request.runs.map(runShape));
  return request.leader && best.far ? group("led", leaderShape(request, best.box), text) : text;
}

/** Runs as the children of a text. */
export function runShape(run: Run): Shape | string {
  const className = [run.className ?? "", run.bold ? "strong" : ""].join(" ").trim();
  return className === "" ? run.text : shape("tspan", { class: className }, run.text);
}
