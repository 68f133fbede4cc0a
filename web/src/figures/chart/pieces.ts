// Pieces of the curves of a refined sweep. A curve is the rows along the last parameter for one choice of the others; it breaks
// where a line between two neighbouring rows would join what does not belong together, such as both sides of a jump.

import { kMarkNames, type MarkKind } from "./marks";
import { errorsOf, type Table } from "./sweep";

/** What the columns `piece` and `change` of a refined sweep have in each row. */
export interface Pieces {
  /** Number of the row's piece, counted from 0 along its curve; NaN for a row that failed. */
  numbers: number[];
  /** What differs from the row before, at the first row of each piece but the first; else "". */
  changes: string[];
  /** Code of the failure of each row; "" where it did not fail. */
  failures: string[];
}

/** Two neighbouring rows of a curve that no line joins, and what changes between them; "" where the table does not say it. */
export interface Break<Spot> {
  before: Spot;
  after: Spot;
  change: string;
}

const kLast = ["piece", "change", "error"];

/** Columns of parameters; those of outputs are JSON Pointers and stand behind them. */
function parameterCount(table: Table): number {
  return Math.max(0, table.columns.findIndex((column) => column.startsWith("/")));
}

/**
 * The pieces of a table; null where the sweep was not refined. The two columns stand between the outputs and `error`, so that a
 * parameter that is called `piece` or `change` is not taken for them.
 */
export function piecesOf(table: Table): Pieces | null {
  const { columns, rows } = table;
  const index = columns.length - kLast.length;
  if (index < 1 || !columns[index - 1]?.startsWith("/") || kLast.some((name, i) => columns[index + i] !== name)) return null;
  return {
    numbers: rows.map((row) => (typeof row[index] === "number" ? row[index] : Number.NaN)),
    changes: rows.map((row) => (typeof row[index + 1] === "string" ? row[index + 1] as string : "")),
    failures: errorsOf(table).map((error) => error?.code ?? ""),
  };
}

/** The last parameter of a refined sweep, and the others, whose values tell its curves apart; null for other sweeps. */
export function curveAxes(table: Table): { x: string; series: string[] } | null {
  const names = table.columns.slice(0, parameterCount(table));
  const x = names[names.length - 1];
  return x !== undefined && piecesOf(table) ? { x, series: names.slice(0, -1) } : null;
}

/** Whether a line may join two rows: they are of one piece, or both failed and so have nothing to draw. */
function areJoined({ numbers, failures }: Pieces, a: number, b: number): boolean {
  return numbers[a] === numbers[b] || (failures[a] !== "" && failures[b] !== "");
}

/** What changes at a row from the row before. A row that failed has no text of its own. */
function changeAt({ changes, failures }: Pieces, row: number): string {
  const failure = failures[row] ?? "";
  return failure === "" ? changeText(changes[row] ?? "") : `no value, failure: ${failure.replace(/_/g, " ")}`;
}

/** The breaks between neighbours of a list of rows. The text of a change is in the later of two rows of the table. */
export function breaksOf<Spot extends { row: number }>(spots: readonly Spot[], pieces: Pieces | null): Break<Spot>[] {
  if (!pieces) return [];
  return spots.slice(1).flatMap((after, i) => {
    const before = spots[i] ?? after;
    if (areJoined(pieces, before.row, after.row)) return [];
    return [{ before, after, change: changeAt(pieces, Math.max(before.row, after.row)) }];
  });
}

/** A change in words: "jump, type: limit_max to bifurcation" is "jump, limit point to bifurcation". */
export function changeText(change: string): string {
  return change
    .replace(/type: (?=\w+ to )(?!none )(?!\w+ to none)/, "")
    .replace(/failure: \w+ to \w+/, (codes) => codes.replace(/_/g, " "))
    .replace(/[a-z]+_[a-z]+/g, (word) => kMarkNames[word as MarkKind] ?? word);
}

/** The rows of a table at which something changes: the values of their parameters, and what changes there. */
export function changesOf(table: Table): { row: number; where: { name: string; value: unknown }[]; change: string }[] {
  const pieces = piecesOf(table);
  if (!pieces) return [];
  const names = table.columns.slice(0, parameterCount(table));
  return pieces.changes.flatMap((change, row) => (change === "" ? [] : [{
    row, where: names.map((name, i) => ({ name, value: table.rows[row]?.[i] })), change: changeText(change),
  }]));
}
