import assert from "node:assert/strict";
import { test } from "node:test";
import {
  drawingCaption, drawingFigure, drawingView, locate, modeMotion, suggestedFactor, toModel, toPixel, toText, zoomed, type DrawingInput, type Pixel,
  type Shape,
} from "../../../web/src/figures/index";
import { distanceTo, kCases, must, piecesOf, pointsOf, readCase, textsOf, withClass, type Request } from "./support";

const size = { width: 540, height: 460 };
type Model = Request["model"];

function inputOf(name: string, state = 0): DrawingInput {
  const { request, result } = readCase(name);
  return { model: request.model, state: result.states[state] ?? null };
}

/** A line of length 10 from left to right on two supports, with what a test adds. */
function beam(more: Partial<Model>): Model {
  return {
    nodes: [{ id: "a", x: 0, y: 0 }, { id: "b", x: 10, y: 0 }], sections: [{ id: "s", EA: 1, EI: 1 }],
    members: [{ id: "m", start: "a", end: "b", section: "s" }],
    supports: [{ node: "a", fixed: ["x", "y"] }, { node: "b", fixed: ["y"] }], ...more,
  };
}

function bounds(points: readonly Pixel[]): { left: number; right: number; top: number; bottom: number } {
  return {
    left: Math.min(...points.map((p) => p.x)), right: Math.max(...points.map((p) => p.x)),
    top: Math.min(...points.map((p) => p.y)), bottom: Math.max(...points.map((p) => p.y)),
  };
}

function only(root: Shape, classes: string): Shape {
  const found = withClass(root, classes);
  assert.equal(found.length, 1, `${found.length} of ${classes}`);
  return must(found[0]);
}

test("the whole structure with its ground, loads and dimensions is inside every figure", () => {
  for (const name of kCases) {
    for (const [width, height] of [[540, 460], [350, 300], [900, 300], [300, 700]] as const) {
      const picture = drawingFigure(inputOf(name), { width, height });
      const parts = ["member", "undeformed", "ground-body", "reaction-line", "load", "load-head", "dimension"];
      for (const node of parts.flatMap((part) => withClass(picture, part))) {
        const box = bounds(pointsOf(node));
        const where = `${name} ${width}x${height}: ${String(node.attributes["class"])} ${JSON.stringify(box)}`;
        const empty = box.left === Infinity;
        assert.ok(empty || (box.left >= -1 && box.right <= width + 1 && box.top >= -1 && box.bottom <= height + 1), where);
      }
    }
  }
});

test("the structure is in the middle of its room", () => {
  const view = drawingView({ model: beam({}) }, size);
  assert.ok(Math.abs(toPixel(view, { x: 5, y: 0 }).y - (42 + (size.height - 42 - 58) / 2)) < 0.01);
  assert.ok(Math.abs(toPixel(view, { x: 5, y: 0 }).x - (58 + (size.width - 58 - 40) / 2)) < 0.01);
});

test("the deformed shape has true scale, both ways the same, and a factor is said", () => {
  const input = inputOf("arch_branches", 1);
  const view = drawingView(input, size);
  const state = must(input.state?.members["arch"]);
  const drawn = pointsOf(only(drawingFigure(input, size), "member"));
  state.x.forEach((x, i) => {
    const pixel = toPixel(view, { x, y: must(state.y[i]) });
    assert.ok(Math.hypot(pixel.x - must(drawn[i]).x, pixel.y - must(drawn[i]).y) < 0.01);
  });
  assert.match(drawingCaption(input), /true scale/);
  const scaled = { ...input, factor: 5 };
  assert.match(drawingCaption(scaled), /displacements × 5/);
  const moved = pointsOf(only(drawingFigure(scaled, size, view), "member"));
  const middle = Math.floor(state.x.length / 2);
  const expected = toPixel(view, { x: 0, y: must(state.y0[middle]) + 5 * must(state.v[middle]) });
  assert.ok(Math.abs(must(moved[middle]).y - expected.y) < 0.02);
});

test("the ground lies on its documented side, beyond its gap, along its range", () => {
  const band = (foundation: object) => {
    const model = beam({ foundations: [{ id: "f", member: "m", stiffness: 1, reaction: "compression_only", ...foundation }] });
    const view = drawingView({ model }, size);
    const corners = pointsOf(only(drawingFigure({ model }, size), "ground-body"));
    const box = bounds(corners);
    const low = toModel(view, { x: box.left, y: box.bottom });
    const high = toModel(view, { x: box.right, y: box.top });
    return { left: low.x, bottom: low.y, right: high.x, top: high.y };
  };
  const near = (a: number, b: number) => Math.abs(a - b) < 0.01;
  const left = band({ gap: 0.2 });
  assert.ok(near(left.bottom, 0.2) && left.top > 1 && near(left.left, 0) && near(left.right, 10), JSON.stringify(left));
  const right = band({ side: "right", range: [0.3, 0.6] });
  assert.ok(near(right.top, 0) && right.bottom < -1 && near(right.left, 3) && near(right.right, 6), JSON.stringify(right));
  const down = band({ direction: [0, -2] });
  assert.ok(near(down.top, 0) && down.bottom < -1, JSON.stringify(down));
});

test("the hatching stays inside the ground", () => {
  const picture = drawingFigure(inputOf("arch_outside"), size);
  const body = pointsOf(only(picture, "ground-body"));
  const box = bounds(body);
  const strokes = piecesOf(only(picture, "ground-hatch"));
  assert.ok(strokes.length > 20);
  for (const point of strokes.flat()) {
    assert.ok(distanceTo([...body, must(body[0])], point) < 0.05, "a stroke ends on the edge of the ground");
    assert.ok(point.x >= box.left - 0.1 && point.x <= box.right + 0.1);
  }
});

test("contact zones are those of the state, and lie on the deformed member", () => {
  const input = inputOf("ring");
  const view = drawingView(input, size);
  const state = must(input.state);
  const zones = must(state.foundations["soil"]).contact;
  const picture = drawingFigure({ ...input, mirror: false }, size, view);
  const lines = withClass(picture, "contact");
  assert.equal(lines.length, zones.length);
  const member = pointsOf(only(picture, "member"));
  for (const line of lines) for (const point of pointsOf(line)) assert.ok(distanceTo(member, point) < 0.1);
  const ends = must(state.members["ring"]);
  const last = must(zones[zones.length - 1])[1];
  const end = must(pointsOf(must(lines[lines.length - 1])).at(-1));
  const found = must(locate({ ...input, mirror: false }, size, end, view));
  assert.ok(Math.abs(found.s - last) < 0.02 * must(ends.s.at(-1)), `${found.s} ${last}`);
});

test("bilateral bases have no contact zones but a reaction, drawn into the medium where it pushes", () => {
  const input = { ...inputOf("pile"), factor: 100 };
  const picture = drawingFigure(input, size);
  assert.equal(withClass(picture, "contact").length, 0);
  const line = pointsOf(only(picture, "reaction-line"));
  const base = pointsOf(only(picture, "member"));
  const reaction = must(input.state?.foundations["soil"]).reaction;
  const pushed = reaction.indexOf(Math.max(...reaction));
  const pulled = reaction.indexOf(Math.min(...reaction));
  assert.ok(must(line[pushed]).x < must(base[pushed]).x - 10, "the soil is on the left of a pile that runs up");
  assert.ok(must(line[pulled]).x > must(base[pulled]).x + 10);
});

/** Points of the load arrows: tail and tip of each. */
test("a mode is inside the drawing, in all phases", () => {
  let tried = 0;
  for (const name of kCases) {
    const { request: { model }, result } = readCase(name);
    const modes = [...result.critical_points.map((point) => point.mode), ...(result.buckling?.modes ?? [])];
    for (const mode of modes) {
      if (!mode) continue;
      for (const [width, height] of [[560, 420], [300, 500], [900, 200], [1200, 150]] as const) {
        const input = { model, mode };
        const motion = modeMotion(input, drawingView(input, { width, height }));
        for (const point of [0, 1, Math.PI].flatMap((phase) => withClass(motion(phase), "mode").flatMap(pointsOf))) {
          assert.ok(point.x >= 0 && point.x <= width && point.y >= 0 && point.y <= height, `${name} ${width} ${JSON.stringify(point)}`);
        }
        tried += 1;
      }
    }
  }
  assert.ok(tried > 20);
});

function arrows(model: Model, loadFactor: number | null = null): { tail: Pixel; tip: Pixel }[] {
  const picture = drawingFigure({ model, loadFactor }, size);
  const tails = piecesOf(only(picture, "load")).map((piece) => must(piece[0]));
  const tips = piecesOf(only(picture, "load-head")).map((piece) => must(piece[0]));
  return tips.map((tip, i) => ({ tail: must(tails[i]), tip }));
}

test("friction along a member has neither ground nor an area of reactions, and is told under the pointer", () => {
  const input = inputOf("laws", 3);
  const picture = drawingFigure(input, size);
  const across = ["deep", "layers"];
  assert.equal(withClass(picture, "ground-body").length, across.length);
  assert.equal(withClass(picture, "reaction").length, across.length);
  const view = drawingView(input, size);
  const told = must(locate(input, size, toPixel(view, { x: 2, y: 6 }), view));
  assert.deepEqual(must(told.state).reactions.map(({ foundation }) => foundation), ["shaft"]);
});

test("arrows point where loads push, with their heads on the structure", () => {
  const at = { member: "m", fraction: 0.5 };
  const [down] = arrows(beam({ loads: [{ type: "point", at, force: [0, -2] }] }));
  assert.ok(must(down).tip.y > must(down).tail.y + 30 && Math.abs(must(down).tip.x - must(down).tail.x) < 0.1);
  const [right] = arrows(beam({ loads: [{ type: "point", at, force: [3, 0] }] }));
  assert.ok(must(right).tip.x > must(right).tail.x + 30);
  const fromLeft = arrows(beam({ loads: [{ type: "pressure", member: "m", value: 1 }] }));
  assert.ok(fromLeft.every(({ tail, tip }) => tip.y > tail.y + 15), "the left side of a member to the right is above");
  const fromRight = arrows(beam({ loads: [{ type: "pressure", member: "m", value: 1, side: "right" }] }));
  assert.ok(fromRight.every(({ tail, tip }) => tip.y < tail.y - 15));
  const suction = arrows(beam({ loads: [{ type: "pressure", member: "m", value: -1 }] }));
  assert.ok(suction.every(({ tail, tip }) => tip.y < tail.y - 15));
});

test("a force that follows turns with its place, another one keeps its direction", () => {
  const { member, fraction } = { member: "column", fraction: 1 };
  const { request, result } = readCase("beck");
  const state = must(result.states[0]);
  const still = must(state.members[member]);
  // the column along x, turned by a right angle: it points up
  const members = { [member]: { ...still, x: still.y0, y: still.x0 } };
  for (const follows of [true, false]) {
    const loads = [{ type: "point" as const, at: { member, fraction }, force: [-1, 0] as [number, number], follows }];
    const picture = drawingFigure({ model: { ...request.model, loads }, state: { ...state, members } }, size);
    const [tail, neck] = must(piecesOf(only(picture, "load"))[0]);
    const [across, upward] = [must(neck).x - must(tail).x, must(tail).y - must(neck).y];
    assert.ok(follows ? Math.abs(across) < 0.1 && upward < -20 : across < -20 && Math.abs(upward) < 0.1, `${across} ${upward}`);
  }
});

test("a force on a fixed line stays on it, with a plate to its place", () => {
  const { member, fraction } = { member: "column", fraction: 1 };
  const { request, result } = readCase("beck");
  const state = must(result.states[0]);
  const still = must(state.members[member]);
  const raised = { ...still, y: still.y0.map((y, i) => y + 0.3 * (must(still.x0[i]) / must(still.x0.at(-1)))) };
  const loads = [{ type: "point" as const, at: { member, fraction }, force: [-1, 0] as [number, number], fixed_line: true }];
  const picture = drawingFigure({ model: { ...request.model, loads }, state: { ...state, members: { [member]: raised } } }, size);
  const [plate, shaft] = piecesOf(only(picture, "load"));
  const [place, foot] = [must(must(plate)[0]), must(must(plate)[1])];
  assert.ok(foot.y > place.y + 20 && Math.abs(foot.x - place.x) < 0.1, "the plate goes straight down to the line");
  assert.ok(must(shaft).every(({ y }) => Math.abs(y - foot.y) < 0.1), "the force is on the line");
});

test("loads are those of the load factor, unless they are constant", () => {
  const at = { member: "m", fraction: 0.5 };
  const load = { type: "point" as const, at, force: [0, -2] as [number, number] };
  const [turned] = arrows(beam({ loads: [load] }), -3);
  assert.ok(must(turned).tip.y < must(turned).tail.y);
  const texts = (pattern: "constant" | "proportional") =>
    textsOf(drawingFigure({ model: beam({ loads: [{ ...load, pattern }], units: { length: "m", force: "kN" } }), loadFactor: 3 }, size));
  assert.ok(texts("proportional").includes("6\u00a0kN"));
  assert.ok(texts("constant").includes("2\u00a0kN"));
});

test("a load per horizontal length is drawn by its share of the axis", () => {
  const steep: Partial<Model> = {
    nodes: [{ id: "a", x: 0, y: 0 }, { id: "b", x: 1, y: 10 }],
    loads: [{ type: "distributed", member: "m", force: [0, -1], per: "horizontal" }],
  };
  const lengths = arrows(beam(steep)).map(({ tail, tip }) => Math.hypot(tip.x - tail.x, tip.y - tail.y));
  assert.ok(Math.max(0, ...lengths) < 6, "hardly anything falls onto a steep member");
});

test("supports are told apart by their form", () => {
  const parts = (fixed: ("x" | "y" | "rotation")[]) => {
    const group = withClass(drawingFigure({ model: beam({ supports: [{ node: "a", fixed }] }) }, size), "supports");
    const root = must(group[0]);
    return [withClass(root, "support-bar").length, withClass(root, "support-body").filter((n) => n.name === "path").length,
            withClass(root, "support-body").filter((n) => n.name === "circle").length].join();
  };
  assert.equal(parts(["x", "y", "rotation"]), "1,0,0");
  assert.equal(parts(["x", "y"]), "0,1,0");
  assert.equal(parts(["y"]), "0,1,3");
  assert.equal(parts(["x", "rotation"]), "0,0,3");
  assert.equal(parts(["rotation"]), "0,1,0");
});

test("rollers let a support move along them: below what is held along y, beside what is held along x", () => {
  const plate = (fixed: "x" | "y", angle_degrees = 0) => {
    const model = beam({ supports: [{ node: "a", fixed: [fixed], angle_degrees }] });
    const { x1, y1, x2, y2 } = only(must(withClass(drawingFigure({ model }, size), "supports")[0]), "support").attributes;
    return Math.atan2(Number(y2) - Number(y1), Number(x2) - Number(x1));
  };
  const along = (angle: number) => Math.abs(Math.cos(angle));
  assert.ok(along(plate("y")) > 0.999 && along(plate("x")) < 0.001);
  assert.ok(Math.abs(Math.abs(Math.sin(2 * plate("y", 45))) - 1) < 0.001, "turned with its axes");
  assert.ok(Math.sin(2 * plate("y", 30)) < 0, "counter-clockwise, where pixels have y down");
});

test("a closed spring touches the structure, an open one stands off by its gap", () => {
  const input = { ...inputOf("springs", 3), factor: 10 };
  const picture = drawingFigure(input, size);
  const member = pointsOf(only(picture, "member"));
  const closed = withClass(picture, "contact-spring").map(pointsOf).flat();
  assert.ok(Math.min(...closed.map((point) => distanceTo(member, point))) < 0.1);
  const view = drawingView(input, size);
  const open = pointsOf(must(withClass(must(withClass(picture, "spring-symbol")[1]), "spring")[0]));
  const axis = toPixel(view, { x: 0, y: must(input.state?.members["m"]?.y0[10]) }).y;  // 21 points: the middle
  assert.ok(Math.abs(must(open[0]).y - axis) < 0.1 && must(open.at(-1)).y > axis + 30, "the one below stays where it was");
});

test("a support goes with its node, a spring's ground stays", () => {
  const input = inputOf("springs", 3);
  const picture = drawingFigure({ ...input, factor: 10 }, size);
  assert.equal(withClass(picture, "spring-symbol").length, 3);
  assert.ok(withClass(picture, "contact-spring").length > 0, "the spring above is closed");
  const open = drawingFigure({ model: input.model }, size);
  assert.equal(withClass(open, "contact-spring").length, 0);
});

test("hinges, monitors with their values, and texts that stay texts", () => {
  const picture = drawingFigure(inputOf("curves"), { width: 700, height: 900 });
  assert.equal(withClass(picture, "hinge").length, 1);
  assert.equal(withClass(picture, "monitor").length, 2);
  const text = toText(picture);
  assert.ok(text.includes("a &amp; &lt;b&gt; v = "), "the monitor's name and its displacement along y");
  assert.ok(!text.includes("<b>"));
});

test("a monitor's value is what the path says", () => {
  const { request, result } = readCase("arch_outside");
  const point = must(result.critical_points[0]);
  const state = must(result.states[must(point.state)]);
  const texts = textsOf(drawingFigure({ model: request.model, state }, size));
  const expected = must(point.monitors["crown"]).toPrecision(3).replace("-", "−");
  assert.ok(texts.some((text) => text === `crown v = ${expected}\u00a0m`), texts.join(" | "));
});

test("pointing at the structure gives the state there", () => {
  const input = inputOf("arch_outside", 2);
  const view = drawingView(input, size);
  const member = must(input.state?.members["arch"]);
  for (const i of [0, 3, 7, 14]) {
    const found = must(locate(input, size, toPixel(view, { x: must(member.x[i]), y: must(member.y[i]) })));
    assert.equal(found.member, "arch");
    assert.ok(found.distance < 0.01 && Math.abs(found.s - must(member.s[i])) < 1e-6 * found.length);
    const state = must(found.state);
    assert.ok(Math.abs(state.M - must(member.bending_moment[i])) < 1e-6 * Math.max(...member.bending_moment.map(Math.abs)));
    assert.ok(Math.abs(state.N - must(member.axial_force[i])) < 1e-6 * Math.abs(state.N));
    assert.ok(Math.abs(state.displacement - Math.hypot(must(member.u[i]), must(member.v[i]))) < 1e-9);
    assert.equal(must(state.reactions[0]).foundation, "soil");
  }
  const zoom = zoomed(view, 3, { x: 100, y: 100 }, { x: 5, y: -7 });
  const fixed = toPixel(zoom, toModel(view, { x: 100, y: 100 }));
  assert.ok(Math.abs(fixed.x - 105) < 1e-9 && Math.abs(fixed.y - 93) < 1e-9, "the point under the pointer stays there");
  assert.equal(must(locate({ model: input.model }, size, { x: 0, y: 0 })).state, null);
});

test("a closed half is shown with its mirror image, and says so", () => {
  const input = inputOf("ring");
  const view = drawingView(input, size);
  const picture = drawingFigure(input, size);
  assert.equal(withClass(picture, "mirror-image").length, 1);
  assert.match(drawingCaption(input), /half mirrored/);
  const axis = toPixel(view, { x: 0, y: 0 }).x;
  assert.ok(Math.abs(axis - (58 + (size.width - 98) / 2)) < 1, "the axis of symmetry is in the middle");
  assert.equal(must(withClass(picture, "mirror-image")[0]).attributes["transform"], `translate(${Math.round(200 * axis) / 100} 0) scale(-1 1)`);
  assert.equal(withClass(drawingFigure({ ...input, mirror: false }, size), "mirror-image").length, 0);
  const member = must(input.state?.members["ring"]);
  const image = toPixel(view, { x: -must(member.x[20]), y: must(member.y[20]) });
  const found = must(locate(input, size, image));
  assert.ok(Math.abs(found.s - must(member.s[20])) < 1e-6 && Math.abs(found.pixel.x - image.x) < 0.01, "the image answers as its half");
  for (const other of ["portal", "pipe", "arch_outside"]) {
    assert.equal(withClass(drawingFigure(inputOf(other), size), "mirror-image").length, 0, other);
  }
});

test("a mode is drawn over the structure without a claim about its size", () => {
  const { request, result } = readCase("portal");
  const mode = must(result.buckling?.modes[0]);
  const input = { model: request.model, mode, loadFactor: must(result.buckling?.load_factors[0]) };
  const picture = drawingFigure(input, size);
  assert.equal(withClass(picture, "mode").length, 3);
  assert.match(drawingCaption(input), /size without meaning/);
});

test("the suggested factor is round, and 1 where displacements are seen", () => {
  assert.equal(suggestedFactor(inputOf("ring")), 1);
  const factor = suggestedFactor(inputOf("pile"));
  assert.ok(factor > 1 && [1, 2, 5].includes(Number(factor.toExponential()[0])), String(factor));
  assert.equal(suggestedFactor({ model: beam({}) }), 1);
});

test("models that are not finished are drawn as far as they go", () => {
  const broken = beam({
    members: [{ id: "m", start: "a", end: "nowhere", section: "s" }, { id: "n", start: "a", end: "b", section: "s" }],
    foundations: [{ id: "f", member: "gone", stiffness: 1 }], loads: [{ type: "point", at: { node: "gone" }, force: [0, -1] }],
    monitors: [{ id: "q", at: { member: "gone", fraction: 0 }, component: "y" }],
    springs: [{ id: "k", at: { node: "gone" }, direction: [0, 1], stiffness: 1 }], supports: [{ node: "gone", fixed: ["x"] }],
  });
  assert.equal(withClass(drawingFigure({ model: broken }, size), "member").length, 1);
  const nothing = drawingFigure({ model: { nodes: [], sections: [], members: [] } }, size);
  assert.ok(!toText(nothing).includes("NaN"));
});
