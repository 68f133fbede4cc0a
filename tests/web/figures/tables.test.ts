import assert from "node:assert/strict";
import { test } from "node:test";
import { pathTable, sectionTable, sweepTable, tableCsv, tableText } from "../../../web/src/figures/index";
import { must, readCase, readTable, refinedTable } from "./support";

test("a path's table has every row of every branch, exactly", () => {
  const { request, result } = readCase("arch_branches");
  const table = pathTable({ result, monitors: request.model.monitors, units: { length: "m" } });
  assert.deepEqual(table.columns.slice(0, 5), ["branch", "load factor", "arc length", "crown y (m)", "negative eigenvalues"]);
  assert.equal(table.rows.length, result.branches.reduce((sum, branch) => sum + branch.load_factor.length, 0));
  const first = must(result.branches[0]).load_factor.length;
  assert.deepEqual(must(table.rows[first]).slice(0, 2), [must(result.branches[1]).id, must(result.branches[1]).load_factor[0]]);
  assert.equal(table.rows[3]?.[3], result.branches[0]?.monitors["crown"]?.[3]);
});

test("the stiffness ratio is a column, empty where it is not known and for static analyses", () => {
  const { result } = readCase("bays");
  const branch = must(result.branches[0]);
  const ratios = branch.stiffness_ratio.map((ratio, i) => (i === 2 ? null : ratio));
  const table = pathTable({ result: { ...result, branches: [{ ...branch, stiffness_ratio: ratios }] } });
  const column = table.columns.indexOf("stiffness ratio");
  assert.equal(column, table.columns.indexOf("negative eigenvalues") + 1);
  assert.deepEqual(table.rows.map((row) => row[column]), ratios);
  assert.equal(tableCsv(table).split("\r\n")[3]?.split(",")[column], "");
  const rows = pathTable({ result: readCase("springs").result });
  assert.ok(rows.rows.every((row) => row[rows.columns.indexOf("stiffness ratio")] === null));
});

test("contact fractions of bases are columns", () => {
  const { request, result } = readCase("arch_outside");
  const table = pathTable({ result, monitors: request.model.monitors, units: request.model.units });
  assert.equal(table.columns.at(-1), "contact fraction soil");
  assert.equal(table.rows[9]?.at(-1), result.branches[0]?.contact_fraction["soil"]?.[9]);
});

test("a section table has the state's lists with their units", () => {
  const { request, result } = readCase("arch_outside");
  const state = must(result.states[3]);
  const table = sectionTable({ model: request.model, state });
  assert.equal(table.rows.length, 15);
  const column = (name: string) => table.columns.indexOf(name);
  assert.equal(table.rows[4]?.[column("axial force N (MN)")], state.members["arch"]?.axial_force[4]);
  assert.equal(table.rows[4]?.[column("bending moment M (MN\u202fm)")], state.members["arch"]?.bending_moment[4]);
  assert.equal(table.rows[4]?.[column("reaction soil (MN/m)")], state.foundations["soil"]?.reaction[4]);
});

test("a base along a part of a member has no reactions elsewhere", () => {
  const { request, result } = readCase("curves");
  const table = sectionTable({ model: request.model, state: must(result.states[0]) });
  const reaction = table.columns.indexOf("reaction below (kN/m)");
  const own = table.rows.filter((row) => row[0] === "line0").map((row) => row[reaction]);
  assert.equal(own[0], null);
  assert.ok(own.some((value) => typeof value === "number"));
  assert.ok(table.rows.filter((row) => row[0] === "arc1").every((row) => row[reaction] === null));
});

test("a sweep's table has the number of each point and why it failed", () => {
  const table = sweepTable(readTable("map"), { k: "soil stiffness" });
  assert.deepEqual(table.columns, ["point", "soil stiffness", "EI", "critical load factor", "kind of critical point", "error"]);
  assert.match(String(table.rows[0]?.at(-1)), /^wrong_request: \/model\/sections\/0\/EI/);
  assert.deepEqual(must(table.rows[6]).slice(0, 3), [6, readTable("map").rows[6]?.[0], 1]);
});

test("the table of a refined sweep has the piece of each row and what changes there", () => {
  const table = sweepTable(refinedTable([1]));
  assert.deepEqual(table.columns.slice(-3), ["piece", "change", "error"]);
  assert.deepEqual(must(table.rows[3]).slice(-3), [1, "jump", null]);
  assert.deepEqual(must(table.rows[4]).slice(-3), [1, null, null]);
});

test("CSV is exact, quoted where it must be, and no text is a formula", () => {
  const csv = tableCsv({ columns: ["a, b", "c"], rows: [[1 / 3, "say \"x\""], [-2, "=1+1"], [null, "-5 kN"], [Number.NaN, "line\nbreak"]] });
  assert.equal(csv, "\"a, b\",c\r\n0.3333333333333333,\"say \"\"x\"\"\"\r\n-2,'=1+1\r\n,'-5 kN\r\n,\"line\nbreak\"\r\n");
});

test("the table for reading rounds", () => {
  assert.deepEqual(tableText({ columns: ["a"], rows: [[1 / 3], [null], ["x"], [1234567]] }),
                   [["0.333333"], [""], ["x"], ["1.23457\u202f×\u202f10⁶"]]);
  assert.deepEqual(tableText({ columns: ["a"], rows: [[2 / 3]] }, 2), [["0.67"]]);
});
