// The table twin of each figure, and its CSV: exact values in cells; `tableText` rounds them for reading.

import { at } from "./geometry";
import { exactNumber, formatNumber, unitOf, withUnit, type Units } from "./numbers";
import type { PathInput } from "./chart/path";
import { branchesOf, type Monitor } from "./chart/curves";
import { motionsOf, type FrequencySource } from "./chart/frequencies";
import { drawnLaw, lawLabels, type LawInput } from "./chart/law";
import { kSections, sectionLines, type SectionQuantity, type SectionsInput } from "./chart/sections";
import { columnLabel, type Table } from "./chart/sweep";
import { withSoil } from "./soil";

export type Cell = string | number | null;

export interface FigureTable {
  columns: string[];
  rows: Cell[][];
}

/** Cells as text for reading: numbers with so many significant digits, an empty text where there is nothing. */
export function tableText(table: FigureTable, digits = 6): string[][] {
  return table.rows.map((row) => row.map((cell) => {
    if (cell === null) return "";
    return typeof cell === "number" ? formatNumber(cell, digits) : cell;
  }));
}

/** A cell that a spreadsheet would take for a formula is told to be a text. */
function csvCell(cell: Cell): string {
  if (cell === null) return "";
  if (typeof cell === "number") return exactNumber(cell);
  const text = /^[=+\-@\t\r]/.test(cell) ? `'${cell}` : cell;
  return /[",\n\r]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
}

/** RFC 4180: a header, lines that end with CR LF, decimal points. */
export function tableCsv(table: FigureTable): string {
  return [table.columns, ...table.rows].map((row) => `${row.map(csvCell).join(",")}\r\n`).join("");
}

function monitorColumn(id: string, monitors: readonly Monitor[], units: Units | undefined): string {
  const monitor = monitors.find((item) => item.id === id);
  if (!monitor) return id;
  return withUnit(`${id} ${monitor.component}`, unitOf(units, monitor.component === "rotation" ? "rotation" : "length"));
}

/** One row a motion at each load factor with frequencies: exact squares of circular frequencies, and what the motion does. */
export function frequencyTable(result: FrequencySource): FigureTable {
  const columns = ["branch", "load factor", "motion", "omega squared", "imaginary part", "error estimate", "kind"];
  const vibrations = (result.vibrations ?? []).map((one) =>
    ({ branch: null, load: one.load_factor, frequencies: one.frequencies, errors: one.error_estimates }));
  const tables = result.branches.length > 0 ? result.branches : result.static ? [result.static] : [];
  const rows = tables.flatMap((table, branch) => (table.frequencies ?? []).map((frequencies, i) =>
    ({ branch, load: at(table.load_factor, i), frequencies, errors: [] as (number | null)[] })));
  return {
    columns,
    rows: [...vibrations, ...rows].flatMap(({ branch, load, frequencies, errors }) =>
      (frequencies ? motionsOf(frequencies) : []).map(({ square, imaginary, kind }, i): Cell[] =>
        [branch, load, i + 1, square, imaginary, errors[i] ?? null, kind])),
  };
}

/** One row a point of every branch: branch, load factor, monitors as in the result, stability, stiffness ratio, contact. */
export function pathTable(input: Pick<PathInput, "result" | "monitors" | "units">): FigureTable {
  const branches = branchesOf(input.result);
  const ids = [...new Set(branches.flatMap((branch) => Object.keys(branch.monitors)))];
  const bases = [...new Set(branches.flatMap((branch) => Object.keys(branch.contact_fraction)))];
  const columns = ["branch", "load factor", "arc length", ...ids.map((id) => monitorColumn(id, input.monitors ?? [], input.units)),
                   "negative eigenvalues", "stiffness ratio", ...bases.map((id) => `contact fraction ${id}`)];
  const value = (list: readonly (number | null)[] | undefined, i: number): Cell => list?.[i] ?? null;
  const counted = (count: number | undefined): Cell => (count === undefined || Number.isNaN(count) ? null : count);
  const rows = branches.flatMap((branch) => branch.load_factor.map((load, i): Cell[] => [
    branch.id, load, at(branch.arc_length, i), ...ids.map((id) => value(branch.monitors[id], i)),
    counted(branch.negative_eigenvalues[i]), value(branch.stiffness_ratio, i), ...bases.map((id) => value(branch.contact_fraction[id], i)),
  ]));
  return { columns, rows };
}

const kColumns: readonly { list: "x" | "y" | "u" | "v"; name: string }[] = [
  { list: "x", name: "x" }, { list: "y", name: "y" }, { list: "u", name: "displacement x" }, { list: "v", name: "displacement y" },
];
const kForces: readonly SectionQuantity[] = ["rotation", "N", "Q", "M"];

/** One row a point of every member: place, displacements, internal forces, and the reactions of the bases along it. */
export function sectionTable(given: SectionsInput): FigureTable {
  const input = { ...given, ...withSoil(given.model, given.state) };
  const length = unitOf(input.model.units, "length");
  const bases = (input.model.foundations ?? []).filter((item) => input.state.foundations[item.id]);
  const columns = ["member", withUnit("s", length), ...kColumns.map(({ name }) => withUnit(name, length)),
                   ...kForces.map((quantity) => withUnit(kSections[quantity].name, unitOf(input.model.units, kSections[quantity].unit))),
                   ...bases.map((base) => withUnit(`reaction ${base.id}`, unitOf(input.model.units, "line_load")))];
  const ids = input.members ?? input.model.members.map((member) => member.id);
  const rows = ids.flatMap((id) => {
    const state = input.state.members[id];
    if (!state) return [];
    const forces = kForces.map((quantity) => sectionLines(input, id, quantity)[0]?.values ?? []);
    return state.s.map((s, i): Cell[] => [
      id, s, ...kColumns.map(({ list }) => at(state[list], i)), ...forces.map((values) => at(values, i)),
      ...bases.map((base) => (base.member === id ? reactionAt(input, base.id, s) : null)),
    ]);
  });
  return { columns, rows };
}

/** The reaction at a place where the foundation has a value; null elsewhere. */
function reactionAt(input: SectionsInput, id: string, s: number): Cell {
  const state = input.state.foundations[id];
  if (!state) return null;
  const i = state.s.findIndex((value) => Math.abs(value - s) <= 1e-9 * Math.max(1, Math.abs(s)));
  return i < 0 ? null : state.reaction[i] ?? null;
}

const kLawRows = 20;  // equal steps of displacement, beside the ends of the curves' parts

/** One row a displacement: the reaction of each curve that the chart of a law has. Empty where it has none. */
export function lawTable(input: LawInput): FigureTable {
  const labels = lawLabels(input);
  const law = drawnLaw(input);
  if (!law) return { columns: [labels.w, labels.p], rows: [] };
  const { curves, gap, reach, senses } = law;
  const steps = Array.from({ length: kLawRows + 1 }, (_, i) => (i * reach) / kLawRows);
  const ends = curves.flatMap(({ curve }) => curve.ends.filter((w) => w <= reach));
  const beyond = [...new Set([...steps, ...ends])].sort((a, b) => a - b);
  const rows = senses.flatMap((sense) => {
    const half = beyond.map((w): Cell[] => [sense * (gap + w), ...curves.map(({ curve }) => sense * curve.reaction(w))]);
    return sense === 1 ? half : half.reverse();
  });
  const columns = [labels.w, ...curves.map(({ name }) => (curves.length > 1 ? `${labels.p} at ${name}` : labels.p))];
  return { columns, rows: rows.filter((row, i) => i === 0 || row[0] !== rows[i - 1]?.[0]) };
}

/** The rows of a sweep as they are, with the number of each point; errors as "code: detail". */
export function sweepTable(table: Table, labels: Readonly<Record<string, string>> = {}): FigureTable {
  const columns = ["point", ...table.columns.map((column) => columnLabel({ column, label: labels[column] }))];
  const rows = table.rows.map((row, i) => [table.points[i] ?? i, ...row.map(cellOf)]);
  return { columns, rows };
}

function cellOf(value: unknown): Cell {
  if (value === null || value === undefined) return null;
  if (typeof value === "number" || typeof value === "string") return value;
  if (typeof value === "object" && "code" in value && "detail" in value) return `${String(value.code)}: ${String(value.detail)}`;
  return JSON.stringify(value);
}
