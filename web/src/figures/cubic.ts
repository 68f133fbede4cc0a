// The cubic between two rows of a path: the one with the values of both and their rates by arc length (docs/results.md, branches).

/** A value at a row, and its rate by arc length; the rate is NaN where it is not known. */
export interface Knot {
  value: number;
  rate: number;
}

/** The value at a fraction of the arc length between two rows; a straight line joins rows of which a rate is not known. */
export function valueBetween(from: Knot, to: Knot, length: number, fraction: number): number {
  const rise = to.value - from.value;
  const bend = (1 - fraction) * (length * from.rate - rise) - fraction * (length * to.rate - rise);
  return from.value + fraction * (rise + (Number.isNaN(bend) ? 0 : (1 - fraction) * bend));
}

/** A fraction at which the cubic has a value that is between those of its ends, by bisection. */
export function fractionAt(from: Knot, to: Knot, length: number, value: number): number {
  const sense = Math.sign(to.value - from.value);
  let low = 0;
  let high = 1;
  while (high - low > 1e-15) {
    const middle = 0.5 * (low + high);
    if (sense * (valueBetween(from, to, length, middle) - value) < 0) low = middle;
    else high = middle;
  }
  return high;
}
