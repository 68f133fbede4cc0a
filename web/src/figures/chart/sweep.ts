// Rows of a sweep as values: parameters, outputs, and why a point failed (docs/sweeps.md).

import type { components } from "../../api/types";
import { at } from "../geometry";
import { formatNumber } from "../numbers";

export type Table = components["schemas"]["Table"];

/** What an axis of a sweep shows. */
export interface SweepAxis {
  /** Name of the column: a parameter, or the pointer of an output. */
  column: string;
  /** What to call it; made from the column's name when left out. */
  label?: string | undefined;
  log?: boolean | undefined;
}

/** Why a row has no outputs. */
export interface RowError {
  code: string;
  detail: string;
}

const kLabels: Record<string, string> = {
  "/summary/critical_load_factor": "critical load factor",
  "/summary/critical_type": "kind of critical point",
  "/summary/error_estimate": "estimated relative error",
  "/summary/softest/load_factor": "load factor of the softest point",
  "/summary/softest/stiffness_ratio": "stiffness ratio of the softest point",
};

/** A column's name as people say it: "/critical_points/0/monitors/crown" is "crown at critical point 1". */
export function columnLabel(axis: SweepAxis): string {
  if (axis.label !== undefined) return axis.label;
  const known = kLabels[axis.column];
  if (known !== undefined || !axis.column.startsWith("/")) return known ?? axis.column;
  const parts = axis.column.split("/").slice(1).map((part) => part.replace(/~1/g, "/").replace(/~0/g, "~"));
  const words = (part: string) => part.replace(/_/g, " ");
  if (parts[0] === "critical_points" && parts.length > 2) {
    return `${words(parts[parts.length - 1] ?? "")} at critical point ${Number(parts[1]) + 1}`;
  }
  if (parts[0] === "buckling" && parts[1] === "load_factors") return `buckling load ${Number(parts[2]) + 1}`;
  if (parts[0] === "vibrations" && parts[3] === "omega_squared") return `omega squared ${Number(parts[4]) + 1}`;
  return parts.filter((part) => !/^\d+$/.test(part)).slice(-2).map(words).join(", ");
}

/** A column as numbers: NaN where there is none; texts count as 0, 1, 2, ... in the order of their first rows. */
export interface Column {
  values: number[];
  /** The texts; null for numbers. */
  names: string[] | null;
}

export function columnOf(table: Table, name: string): Column {
  const index = table.columns.indexOf(name);
  const cells = table.rows.map((row) => row[index] ?? null);
  if (!cells.some((cell) => typeof cell === "string")) {
    return { values: cells.map((cell) => (typeof cell === "number" ? cell : Number.NaN)), names: null };
  }
  const places = new Map<string, number>();
  const values = cells.map((cell) => {
    if (cell === null) return Number.NaN;
    const text = typeof cell === "string" ? cell : JSON.stringify(cell);
    const known = places.get(text) ?? places.size;
    places.set(text, known);
    return known;
  });
  return { values, names: [...places.keys()] };
}

/** Why each row failed; null where it did not. */
export function errorsOf(table: Table): (RowError | null)[] {
  const index = table.columns.indexOf("error");
  return table.rows.map((row) => {
    const cell = row[index];
    if (cell === null || cell === undefined || typeof cell !== "object" || Array.isArray(cell)) return null;
    const { code, detail } = cell as { code?: unknown; detail?: unknown };
    return { code: String(code ?? "failed"), detail: String(detail ?? "") };
  });
}

/** How many rows failed with each code, most first. */
export function failureCounts(errors: readonly (RowError | null)[]): { code: string; count: number }[] {
  const counts = new Map<string, number>();
  for (const error of errors) if (error) counts.set(error.code, (counts.get(error.code) ?? 0) + 1);
  return [...counts].map(([code, count]) => ({ code, count })).sort((a, b) => b.count - a.count);
}

/** "3 failed: 2 no_start, 1 mechanism"; "" when none did. */
export function failureText(errors: readonly (RowError | null)[]): string {
  const counts = failureCounts(errors);
  if (counts.length === 0) return "";
  const all = counts.reduce((sum, item) => sum + item.count, 0);
  return `${formatNumber(all, 6)} failed: ${counts.map(({ code, count }) => `${formatNumber(count, 6)} ${code}`).join(", ")}`;
}

/** Least and greatest finite value; above zero only where a logarithm is taken. */
export function extentOf(values: readonly number[], log = false): [number, number] {
  let low = Infinity;
  let high = -Infinity;
  for (let i = 0; i < values.length; ++i) {
    const value = at(values, i);
    if (!Number.isFinite(value) || (log && value <= 0)) continue;
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return [low, high];
}
