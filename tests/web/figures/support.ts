// Stored requests and results of the command line, and questions about trees of shapes.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { components } from "../../../web/src/api/types";
import { textWidth } from "../../../web/src/figures/labels";
import type { Pixel, Shape } from "../../../web/src/figures/index";

declare const CASES: string;  // folders, written in by run.mjs
declare const FIGURES: string;

type Schemas = components["schemas"];
export type Request = Schemas["Request"];
export type Result = Schemas["Result"];

export interface Case {
  name: string;
  request: Request;
  result: Result;
}

function stored(name: string): Record<string, unknown> {
  return JSON.parse(readFileSync(join(CASES, `${name}.json`), "utf8")) as Record<string, unknown>;
}

export function readCase(name: string): Case {
  const { request, result } = stored(name);
  return { name, request: request as Request, result: result as Result };
}

/** A branch as earlier versions have it: its computed rows, without rates. */
export function plainBranch(branch: Schemas["Branch"]): Schemas["Branch"] {
  const { computed = branch.load_factor.map((_, i) => i), rates: _, ...rest } = branch;
  const pick = <T>(list: readonly T[]): T[] => list.filter((_, i) => computed.includes(i));
  const pickEach = (lists: Record<string, number[]>) => Object.fromEntries(Object.entries(lists).map(([id, list]) => [id, pick(list)]));
  return {
    ...rest, load_factor: pick(rest.load_factor), arc_length: pick(rest.arc_length), monitors: pickEach(rest.monitors),
    negative_eigenvalues: pick(rest.negative_eigenvalues), stiffness_ratio: pick(rest.stiffness_ratio),
    contact_fraction: pickEach(rest.contact_fraction), ...(rest.frequencies ? { frequencies: pick(rest.frequencies) } : {}),
  };
}

export function readTable(name: string): Schemas["Table"] {
  return stored(name)["table"] as Schemas["Table"];
}

/** Members of a table that no program has computed. */
export const kUnmade = { kind: "table", program: null, request_sha256: null, links: { request: "", job: "" } } as const;

type Cells = Schemas["Table"]["rows"][number];

export function tableOf(columns: string[], rows: Cells[]): Schemas["Table"] {
  return { ...kUnmade, columns, rows, points: rows.map((_, i) => i) };
}

/**
 * Curves of a refined sweep over `t` at values of `k`. The load of each rises as 10 k + t, is by 5 k lower from t = 3 k on, has another
 * kind from t = 6 on, and none between 8 and 9. The rows of the curves are at different values of t.
 */
export function refinedTable(ks: readonly number[]): Schemas["Table"] {
  const load = (k: number, t: number) => (t > 8 && t < 9 ? null : 10 * k + t - (t > 3 * k ? 5 * k : 0));
  const rows = ks.flatMap((k) => [0, 1 + k / 4, 3 * k - 0.01, 3 * k + 0.01, 5.99, 6.01, 8, 8.02, 8.98, 9, 10].map((t, i): Cells => {
    const change = { 3: "jump", 5: "type: limit_max to bifurcation", 7: "no value", 9: "value begins" }[i] ?? null;
    const piece = [3, 5, 7, 9].filter((begin) => begin <= i).length;
    return [k, t, load(k, t), t > 6 ? "bifurcation" : "limit_max", piece, change, null];
  }));
  return tableOf(["k", "t", "/summary/critical_load_factor", "/summary/critical_type", "piece", "change", "error"], rows);
}

/** The table without some of its columns. */
export function without(table: Schemas["Table"], ...names: string[]): Schemas["Table"] {
  const keep = <T>(cells: readonly T[]): T[] => cells.filter((_, i) => !names.includes(table.columns[i] ?? ""));
  return { ...table, columns: keep(table.columns), rows: table.rows.map((row) => keep(row)) };
}

export function styleSheet(): string {
  return readFileSync(join(FIGURES, "figures.css"), "utf8");
}

export const kCases = ["arch_branches", "arch_outside", "bays", "beck", "curves", "pile", "pipe", "portal", "ring", "springs"] as const;

/** A value that must be there. */
export function must<T>(value: T | null | undefined, what = "value"): T {
  if (value === null || value === undefined) throw new Error(`no ${what}`);
  return value;
}

/** All shapes of a tree, the outer one first. */
export function* shapesOf(node: Shape): Generator<Shape> {
  yield node;
  for (const child of node.children) if (typeof child !== "string") yield* shapesOf(child);
}

export function classesOf(node: Shape): string[] {
  return String(node.attributes["class"] ?? "").split(" ").filter((name) => name !== "");
}

/** Shapes with all of some classes. */
export function withClass(root: Shape, classes: string): Shape[] {
  const wanted = classes.split(" ");
  return [...shapesOf(root)].filter((node) => wanted.every((name) => classesOf(node).includes(name)));
}

/** All text inside a shape. */
export function textOf(node: Shape): string {
  return node.children.map((child) => (typeof child === "string" ? child : textOf(child))).join("");
}

export function textsOf(root: Shape): string[] {
  return [...shapesOf(root)].filter((node) => node.name === "text").map(textOf);
}

/** Points of a Bezier cubic without its first one; numbers are x and y of its inner points and of its end. */
function bezierPoints(from: Pixel, numbers: readonly number[]): Pixel[] {
  const along = (start: number, k: number, t: number): number => {
    const [first, second, end] = [must(numbers[k]), must(numbers[k + 2]), must(numbers[k + 4])];
    return (1 - t) ** 3 * start + 3 * (1 - t) ** 2 * t * first + 3 * (1 - t) * t ** 2 * second + t ** 3 * end;
  };
  return Array.from({ length: 32 }, (_, i) => (i + 1) / 32).map((t) => ({ x: along(from.x, 0, t), y: along(from.y, 1, t) }));
}

/** The corners of a path and points of its cubics, piece by piece. */
export function piecesOf(node: Shape): Pixel[][] {
  const pieces: Pixel[][] = [];
  for (const [, command, text = ""] of String(node.attributes["d"]).matchAll(/([MLHVC])([-\d.e ]+)/g)) {
    if (command === "M") pieces.push([]);
    const piece = must(pieces[pieces.length - 1]);
    const before = piece[piece.length - 1] ?? { x: 0, y: 0 };
    const numbers = text.split(" ").map(Number);
    const [first = Number.NaN, second = Number.NaN] = numbers;
    if (command === "H") piece.push({ x: first, y: before.y });
    else if (command === "V") piece.push({ x: before.x, y: first });
    else if (command === "C") piece.push(...bezierPoints(before, numbers));
    else piece.push({ x: first, y: second });
  }
  return pieces;
}

export function pointsOf(node: Shape): Pixel[] {
  return piecesOf(node).flat();
}

/** Where a text is, from its anchor and its estimated width; y is that of its base line. */
export function boxOf(node: Shape): { left: number; right: number; y: number } {
  const wide = textWidth(textOf(node), 12);
  const x = Number(node.attributes["x"]);
  const anchor = node.attributes["text-anchor"];
  const left = anchor === "start" ? x : anchor === "end" ? x - wide : x - wide / 2;
  return { left, right: left + wide, y: Number(node.attributes["y"]) };
}

/** Distance of a point from a line through points. */
export function distanceTo(points: readonly Pixel[], to: Pixel): number {
  let least = Infinity;
  for (let i = 0; i < points.length; ++i) {
    const a = must(points[Math.max(0, i - 1)]);
    const b = must(points[i]);
    const square = (b.x - a.x) ** 2 + (b.y - a.y) ** 2;
    const t = square > 0 ? Math.min(1, Math.max(0, ((to.x - a.x) * (b.x - a.x) + (to.y - a.y) * (b.y - a.y)) / square)) : 0;
    least = Math.min(least, Math.hypot(to.x - a.x - t * (b.x - a.x), to.y - a.y - t * (b.y - a.y)));
  }
  return least;
}
