import assert from "node:assert/strict";
import { test } from "node:test";
import { drawingFigure, drawingView, modeMotion, quadratureOf, type DrawingInput, type Pixel, type Shape } from "../../../web/src/figures/index";
import { must, pointsOf, readCase, withClass } from "./support";

const size = { width: 560, height: 420 };
type Mode = NonNullable<DrawingInput["mode"]>;

/** Corners of all lines of a mode. */
function corners(modes: Shape): Pixel[] {
  return withClass(modes, "mode").flatMap(pointsOf);
}

function assertNear(found: readonly Pixel[], wanted: readonly Pixel[]): void {
  assert.equal(found.length, wanted.length);
  found.forEach((pixel, i) => {
    const to = must(wanted[i]);
    assert.ok(Math.hypot(pixel.x - to.x, pixel.y - to.y) < 0.02, `corner ${i}: ${JSON.stringify([pixel, to])}`);
  });
}

/** An arch at a critical point with the mode there, and the mode of the next critical point. */
function arch(): { input: DrawingInput; other: Mode } {
  const { request, result } = readCase("arch_branches");
  const [point, next] = result.critical_points;
  const state = must(result.states[must(must(point).state)]);
  return { input: { model: request.model, mode: must(must(point).mode), state }, other: must(must(next).mode) };
}

test("the motion at phase 0 is the mode of the still picture, number by number", () => {
  const { input, other } = arch();
  const view = drawingView(input, size);
  const still = must(withClass(drawingFigure(input, size, view), "modes")[0]);
  assert.ok(corners(still).length > 5);
  assert.deepEqual(modeMotion(input, view)(0), still);
  assert.deepEqual(modeMotion({ ...input, quadrature: other }, view)(0), still);
});

test("a mode swings to its opposite through the equilibrium, and comes back after a period", () => {
  const { input } = arch();
  const view = drawingView(input, size);
  const motion = modeMotion(input, view);
  const still = corners(motion(0));
  const equilibrium = corners(motion(Math.PI / 2));
  const flat = { members: Object.fromEntries(Object.entries(must(input.mode).members).map(([id, shape]) =>
    [id, { ...shape, u: shape.u.map(() => 0), v: shape.v.map(() => 0) }])) };
  assertNear(equilibrium, corners(modeMotion({ ...input, mode: flat }, view)(0)));
  assertNear(corners(motion(Math.PI)), equilibrium.map(({ x, y }, i) => ({ x: 2 * x - must(still[i]).x, y: 2 * y - must(still[i]).y })));
  assertNear(corners(motion(Math.PI / 3)), equilibrium.map(({ x, y }, i) => ({ x: (x + must(still[i]).x) / 2, y: (y + must(still[i]).y) / 2 })));
  assertNear(corners(motion(2 * Math.PI)), still);
});

test("a quarter of a period later the motion has the shape of the quadrature", () => {
  const { input, other } = arch();
  const view = drawingView(input, size);
  assertNear(corners(modeMotion({ ...input, quadrature: other }, view)(Math.PI / 2)), corners(modeMotion({ ...input, mode: other }, view)(0)));
});

/** A mode of two displacements. */
function pairMode(u: number, v: number): Mode {
  return { members: { m: { s: [1], u: [u], v: [v], rotation: [0] } } };
}

test("motions of one sign have no quadrature, and a pair that flutters has that of its growing vibration", () => {
  // x'' = -J x, J = [[a, b], [-b, a]], has the squares a -+ ib; the motion of a + ib is (1, i): R = (1, 0), I = (0, 1).
  const [a, b] = [3, 4];
  const modes = [pairMode(1, 1), pairMode(1, 0), pairMode(0, 1)];
  const vibration = { load_factor: 1, error_estimates: [null, null, null], modes,
                      frequencies: { omega_squared: [1, a, a], imaginary: [0, -b, b] } };
  assert.equal(quadratureOf(vibration, 0), null);
  assert.equal(quadratureOf({ ...vibration, frequencies: { omega_squared: [1, 2, 3] } }, 1), null);
  const displacements = (motion: number): (number | undefined)[] => {
    const shape = must(must(quadratureOf(vibration, motion)).members["m"]);
    return [shape.u[0], shape.v[0]];
  };
  // Steps in time from rest end in the vibration that grows, which turns from the mode towards its quadrature.
  let [x, y, dx, dy] = [1, 0.4, 0, 0];
  for (let i = 0, step = 1e-3; i < 20_000; ++i) {
    [dx, dy] = [dx - step * (a * x + b * y), dy - step * (a * y - b * x)];
    [x, y] = [x + step * dx, y + step * dy];
  }
  const turn = Math.sign(x * dy - y * dx);
  assert.deepEqual(displacements(1).map((value) => must(value) + 0), [0, turn]);
  assert.deepEqual(displacements(2).map((value) => must(value) + 0), [-turn, 0]);
});
