// Numbers as people type them.

/** A number, or the sentence that says why the text is none. */
export type Typed = { value: number } | { trouble: string };

const kSpaces = /[\s\u202f\u00a0'’]/g;
const kRaised = "⁰¹²³⁴⁵⁶⁷⁸⁹";

/** Powers of ten as the page writes them: 2.5 × 10⁻⁴ is 2.5e-4. */
function withPlainPower(text: string): string {
  return text.replace(/(^|[×·*])10([⁺⁻]?)([⁰¹²³⁴⁵⁶⁷⁸⁹]+)$/, (_, times: string, sign: string, digits: string) =>
    `${times === "" ? "1" : ""}e${sign === "⁻" ? "-" : ""}${[...digits].map((digit) => kRaised.indexOf(digit)).join("")}`);
}

/**
 * Reads 1e4, 10 000, 0,5, 1,234,567, 1.234.567,8 and 2.5 × 10⁻⁴. A text of one comma before three digits, such as 50,000, means
 * 50 000 to some and 50.000 to others: it is refused, and the sentence has both.
 */
export function readNumber(text: string): Typed {
  const plain = withPlainPower(text.replace(kSpaces, "").replace(/−/g, "-"));
  const read = (digits: string): Typed => ({ value: Number(digits) });
  if (/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain) && Number.isFinite(Number(plain))) return read(plain);
  if (/^[+-]?\d{1,3}(,\d{3})+\.\d*$/.test(plain) || /^[+-]?\d{1,3}(,\d{3}){2,}$/.test(plain)) return read(plain.replace(/,/g, ""));
  if (/^[+-]?\d{1,3}(\.\d{3})+,\d*$/.test(plain) || /^[+-]?\d{1,3}(\.\d{3}){2,}$/.test(plain)) {
    return read(plain.replace(/\./g, "").replace(",", "."));
  }
  if (/^[+-]?[1-9]\d{0,2},\d{3}$/.test(plain)) {
    return { trouble: `${plain} may be ${plain.replace(",", "")} or ${plain.replace(",", ".")}: write one of these.` };
  }
  if (/^[+-]?\d*,\d+(e[+-]?\d+)?$/i.test(plain)) return read(plain.replace(",", "."));
  return { trouble: plain === "" ? "A number is missing." : `${text.trim()} is no number.` };
}

/** The number that a text is; null where it is none, or more than one. */
export function numberOf(text: string): number | null {
  const typed = readNumber(text);
  return "value" in typed ? typed.value : null;
}
