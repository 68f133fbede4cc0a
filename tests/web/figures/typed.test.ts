import assert from "node:assert/strict";
import { test } from "node:test";
import { readNumber } from "../../../web/src/model/typed_number";

test("numbers are read as people write them", () => {
  const cases: [string, number][] = [
    ["50000", 50000], ["1e4", 1e4], ["10\u202f000", 10000], ["10'000", 10000], ["0,5", 0.5], ["0,500", 0.5], ["12,75", 12.75],
    ["50.000", 50], ["1,234,567", 1234567], ["1,234.5", 1234.5], ["1.234,5", 1234.5], ["1.234.567", 1234567], ["−3", -3], ["-.5", -0.5],
    ["2.5\u202f×\u202f10⁻⁴", 2.5e-4], ["10⁷", 1e7], ["1,5e3", 1500], ["+7", 7], ["1234,567", 1234.567],
  ];
  for (const [text, value] of cases) assert.deepEqual(readNumber(text), { value }, text);
});

test("what may mean two numbers is refused, and both are said", () => {
  assert.deepEqual(readNumber("50,000"), { trouble: "50,000 may be 50000 or 50.000: write one of these." });
  assert.ok("trouble" in readNumber("-1,234"));
});

test("what is no number is refused in words", () => {
  assert.deepEqual(readNumber("soft"), { trouble: "soft is no number." });
  assert.deepEqual(readNumber(" "), { trouble: "A number is missing." });
  for (const text of ["0x10", "Infinity", "1e999", "1,2,3", "1.2.3", "--1", "12,34,567"]) assert.ok("trouble" in readNumber(text), text);
});
