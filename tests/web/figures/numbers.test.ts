import assert from "node:assert/strict";
import { test } from "node:test";
import { exactNumber, formatNumber, formatWithUnit, superscript, unitOf, withUnit } from "../../../web/src/figures/index";

test("numbers have the significant digits that are asked for, and no trailing zeros", () => {
  const cases: [number, number, string][] = [
    [29.28115, 5, "29.281"], [29.28115, 4, "29.28"], [10, 4, "10"], [0.101, 4, "0.101"], [1234.5, 4, "1235"], [-0.30812, 3, "−0.308"],
    [0.001, 4, "0.001"], [0, 4, "0"], [-0, 4, "0"], [999.96, 4, "1000"], [100, 2, "100"], [0.5, 1, "0.5"],
  ];
  for (const [value, digits, text] of cases) assert.equal(formatNumber(value, digits), text);
});

test("thousands are set apart from five digits on", () => {
  assert.equal(formatNumber(9999), "9999");
  assert.equal(formatNumber(12345, 5), "12\u202f345");
  assert.equal(formatNumber(-123456, 6), "−123\u202f456");
});

test("very small and very large numbers have powers of ten", () => {
  assert.equal(formatNumber(1e7), "10⁷");
  assert.equal(formatNumber(2.5e-4), "2.5\u202f×\u202f10⁻⁴");
  assert.equal(formatNumber(-1.8e20), "−1.8\u202f×\u202f10²⁰");
  assert.equal(formatNumber(999999.9, 4), "10⁶");
  assert.equal(superscript(-120), "⁻¹²⁰");
});

test("what is not finite is a dash, and empty where programs read", () => {
  assert.equal(formatNumber(Number.NaN), "–");
  assert.equal(formatNumber(Infinity), "–");
  assert.equal(exactNumber(Number.NaN), "");
  assert.equal(Number(exactNumber(0.1 + 0.2)), 0.1 + 0.2);
});

test("units come from the labels of length and force, or not at all", () => {
  const units = { length: "m", force: "kN" };
  assert.equal(unitOf(units, "line_load"), "kN/m");
  assert.equal(unitOf(units, "moment"), "kN\u202fm");
  assert.equal(unitOf({ ...units, moment: "kNm" }, "moment"), "kNm");
  assert.equal(unitOf(units, "rotation"), "rad");
  assert.equal(unitOf({ length: "m" }, "line_load"), "");
  assert.equal(unitOf(undefined, "length"), "");
  assert.equal(formatWithUnit(3, "kN"), "3\u00a0kN");
  assert.equal(formatWithUnit(3, ""), "3");
  assert.equal(withUnit("s", "m"), "s (m)");
});
