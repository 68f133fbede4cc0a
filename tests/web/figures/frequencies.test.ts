import assert from "node:assert/strict";
import { test } from "node:test";
import {
  frequencyChart, frequencyFigure, frequencyTable, hasFrequencies, motionsOf, nearestMotion, pathFigure, type FrequencyInput,
} from "../../../web/src/figures/index";
import { place } from "../../../web/src/figures/chart/axes";
import { classesOf, must, plainBranch, readCase, textsOf, withClass } from "./support";

const size = { width: 560, height: 420 };
const { result } = readCase("beck");

test("a square below zero diverges, a pair with imaginary parts flutters, and rounding does neither", () => {
  const [free, up, down] = motionsOf({ omega_squared: [-1e-12, 4, -9] });
  assert.deepEqual([free?.kind, up?.kind, down?.kind], ["vibrates", "vibrates", "diverges"]);
  assert.deepEqual([up?.omega, down?.omega], [2, -3]);
  const pair = motionsOf({ omega_squared: [3, 3], imaginary: [-4, 4] });
  assert.deepEqual(pair.map(({ kind, omega }) => [kind, omega]), [["flutters", 2], ["flutters", 2]]);  // sqrt(3 + 4i) = 2 + i
});

test("two frequencies meet at the flutter load, where the mark is, and are dashed beyond it", () => {
  const picture = frequencyFigure({ result }, size);
  const load = must(result.summary.critical_load_factor);
  const [mark] = withClass(must(withClass(picture, "marks")[0]), "flutter");
  const { frame } = frequencyChart({ result }, size);
  const x = must(/^M([\d.]+)/.exec(String(must(mark).attributes["d"]))?.[1]);
  assert.ok(Math.abs(Number(x) + 6 - place(frame.x, load)) < 0.11);
  const lines = withClass(must(withClass(picture, "plot-lines")[0]), "path");
  const looks = lines.map((line) => (classesOf(line).includes("unstable") ? "unstable" : "stable"));
  assert.deepEqual(looks, ["stable", "unstable", "stable", "unstable"]);
  assert.ok(textsOf(picture).includes("pair that flutters"));
});

test("the path is dashed beyond flutter, which negative eigenvalues do not show", () => {
  assert.ok(must(result.branches[0]).negative_eigenvalues.every((count) => count === 0));
  const picture = pathFigure({ result, x: { kind: "arc_length" }, y: { kind: "load_factor" } }, size);
  const pieces = withClass(must(withClass(picture, "plot-lines")[0]), "path").map((line) => classesOf(line).includes("unstable"));
  assert.deepEqual(pieces, [false, true]);
  assert.ok(textsOf(picture).includes("flutter"));
});

test("rows without frequencies are gaps, and pointing finds the nearest motion", () => {
  const branch = plainBranch(must(result.branches[0]));
  const frequencies = must(branch.frequencies).map((one, i) => (i === 2 ? null : one));
  const input: FrequencyInput = { result: { ...result, branches: [{ ...branch, frequencies }] } };
  const lines = withClass(must(withClass(frequencyFigure(input, size), "plot-lines")[0]), "path");
  assert.equal(lines.length, 6);
  const chart = frequencyChart(input, size);
  const second = must(motionsOf(must(frequencies[1]))[1]);
  const at = { x: place(chart.frame.x, must(branch.load_factor[1])), y: place(chart.frame.y, second.omega) };
  assert.deepEqual(nearestMotion(chart, at), { branch: 0, row: 1, motion: 1 });
});

test("the table has every motion of every computed row with its exact square", () => {
  const { columns, rows } = frequencyTable(result);
  const branch = must(result.branches[0]);
  assert.equal(rows.length, 2 * plainBranch(branch).load_factor.length);
  assert.equal(must(rows[1])[columns.indexOf("omega squared")], must(must(branch.frequencies)[0]).omega_squared[1]);
  assert.equal(must(rows[rows.length - 1])[columns.indexOf("kind")], "flutters");
  assert.ok(!hasFrequencies(readCase("portal").result));
});
