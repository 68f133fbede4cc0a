// The figures that both drawing libraries share: tests/figures/cases.json says what each must show, tests/api/plot/cases_test.cpp reads
// the same list. A fact is read from the picture as a person does, by the numbers at its axes.

import assert from "node:assert/strict";
import { test } from "node:test";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import {
  defaultQuantities, drawingFigure, frequencyFigure, isReversed, lawChart, lawFigure, pathFigure, sectionsFigure, sweepLine,
  type PathQuantity, type Pixel, type Shape, type Table,
} from "../../../web/src/figures/index";
import { classesOf, distanceTo, must, piecesOf, textOf, type Request, type Result } from "./support";

declare const ROOT: string;  // folder of the project, written in by run.mjs

type Point = [number, number];

interface Fact {
  fact: string;
  /** The library that does not meet the fact yet. */
  not_yet?: "page" | "plot";
  [key: string]: unknown;
}

interface Case {
  name: string;
  document?: unknown;
  request?: unknown;
  figure: string;
  choices: Record<string, unknown>;
  facts: Fact[];
}

interface Cases {
  least_cases: number;
  /** Pixels that a mark, and a point of a line, may be off. */
  tolerance: { mark: number; line: number };
  cases: Case[];
}

function read(name: string): unknown {
  return JSON.parse(readFileSync(join(ROOT, "tests/figures", name), "utf8"));
}

/** A document of a case: inside of it, or the name of a file beside the list. */
function documentOf(given: unknown): unknown {
  return typeof given === "string" ? read(given) : given;
}

const cases = read("cases.json") as Cases;
const size = { width: 692, height: 452 };

// --- Figures -------------------------------------------------------------------------------------------------------------------

/** Takes the choices of a case; one that nobody took is a mistake of the list. */
class Choices {
  private readonly left: Map<string, unknown>;

  constructor(choices: Record<string, unknown>) {
    this.left = new Map(Object.entries(choices));
  }

  take<T>(name: string): T | undefined {
    const value = this.left.get(name);
    this.left.delete(name);
    return value as T | undefined;
  }

  done(): void {
    assert.deepEqual([...this.left.keys()], [], "choices that the page's figure does not have");
  }
}

const kLoad: PathQuantity = { kind: "load_factor" };

function drawPath({ document, request }: Case, choices: Choices): Shape {
  const result = documentOf(document) as Result;
  const { monitors, units } = (documentOf(request) as Request | undefined)?.model ?? {};
  const id = choices.take<string>("monitor");
  const x: PathQuantity = choices.take("over_arc_length") ? { kind: "arc_length" }
    : id !== undefined ? { kind: "monitor", id, reversed: isReversed(result, id) } : defaultQuantities(result).x;
  return pathFigure({ result, x, y: kLoad, monitors, units, points: choices.take<boolean>("points") }, size);
}

/** The page draws the stiffness ratio as the second curve of a path, over the load factor when that goes across. */
function drawStiffness({ document }: Case): Shape {
  const result = documentOf(document) as Result;
  return pathFigure({ result, x: kLoad, y: defaultQuantities(result).x, stiffness: true }, size);
}

function drawLaw({ document }: Case, choices: Choices): Shape {
  const { model } = documentOf(document) as Pick<Request, "model">;
  const id = choices.take<string>("law");
  const found = (["springs", "foundations"] as const).flatMap((list) =>
    (model[list] ?? []).filter((one) => one.id === id).map((support) => ({ list, support: { ...support }, units: model.units })))[0];
  const input = must(found, "support of that id");
  return lawFigure(input, size, must(lawChart(input, size)));
}

function drawSweep({ document }: Case, choices: Choices): Shape {
  const by = choices.take<string>("by");
  const x = { column: must(choices.take<string>("x")), log: choices.take<boolean>("log") };
  const y = { column: must(choices.take<string>("output")) };
  return sweepLine({ table: documentOf(document) as Table, x, y, series: by }, size);
}

function drawStructure({ document, request, figure }: Case, choices: Choices): Shape {
  const { model } = documentOf(request) as Request;
  const result = documentOf(document) as Result;
  if (figure === "mode") {
    const number = choices.take<number>("mode") ?? 0;
    const buckling = must(result.buckling);
    return drawingFigure({ model, mode: buckling.modes[number], loadFactor: buckling.load_factors[number] }, size);
  }
  const state = must(result.states[choices.take<number>("state") ?? 0]);
  return figure === "sections" ? sectionsFigure({ model, state, quantities: ["N", "Q", "M"] }, { width: 692, height: 572 })
    : drawingFigure({ model, state, factor: choices.take<number>("magnify") }, size);
}

const kFigures: Record<string, (one: Case, choices: Choices) => Shape> = {
  path: drawPath, stiffness: drawStiffness, law: drawLaw, sweep: drawSweep, shape: drawStructure, mode: drawStructure,
  sections: drawStructure,
  frequencies: ({ document }) => frequencyFigure({ result: documentOf(document) as Result }, size),
};

// --- Reading -------------------------------------------------------------------------------------------------------------------

/** A shape with the classes of the shapes around it. */
interface Drawn {
  node: Shape;
  around: string[];
}

function* drawnIn(node: Shape, around: string[] = []): Generator<Drawn> {
  yield { node, around };
  const inner = [...around, ...classesOf(node)];
  for (const child of node.children) if (typeof child !== "string") yield* drawnIn(child, inner);
}

function plainSpaces(text: string): string {
  return text.replace(/[\u00a0\u202f]/g, " ");
}

function writtenNumber(text: string): number {
  return Number(text.replace(/\u202f×\u202f10/, "e").replace(/\u202f/g, "").replace("−", "-"));
}

type Along = (value: number) => number;

/** The map from values to pixels that two places of an axis give. */
function axisThrough(places: Point[], log = false): Along {
  const [first, last] = [must(places[0], "tick"), must(places[places.length - 1])];
  const level = (value: number): number => (log ? Math.log(value) : value);
  return (value) => first[1] + (level(value) - level(first[0])) / (level(last[0]) - level(first[0])) * (last[1] - first[1]);
}

const kMarks: Record<string, { looks: string; corner: Point }> = {  // where the first corner stands from the mark's middle
  limit_max: { looks: "limit", corner: [0, -6.5] }, limit_min: { looks: "limit", corner: [0, 6.5] },
  bifurcation: { looks: "bifurcation", corner: [0, -7] }, broken_bifurcation: { looks: "broken", corner: [0, -7] },
  flutter: { looks: "flutter", corner: [-6, -6.5] }, capacity: { looks: "limit", corner: [-6, -5] }, first_yield: { looks: "yield", corner: [-4.5, -6] },
  softest: { looks: "softest", corner: [-5, -5] },
};

/** The picture of a case with its axes. */
class Picture {
  readonly one: Case;
  readonly drawn: Drawn[];
  readonly x: Along;
  readonly y: Along;

  constructor(one: Case, root: Shape) {
    this.one = one;
    this.drawn = [...drawnIn(root)].filter(({ around }) => !around.includes("mirror-image"));
    const undeformed = this.with("undeformed").flatMap(({ node }) => piecesOf(node)).flat();
    if (undeformed.length > 0) [this.x, this.y] = this.structureAxes(undeformed);
    else if (one.figure === "sections") [this.x, this.y] = [Number, Number];
    else [this.x, this.y] = this.chartAxes();
  }

  with(...looks: string[]): Drawn[] {
    return this.drawn.filter(({ node }) => looks.every((name) => classesOf(node).includes(name)));
  }

  /** Axes by the numbers at their ticks; the stiffness ratio has its own at the right. */
  private chartAxes(): [Along, Along] {
    const ratio = this.one.figure === "stiffness";
    const places = (frame: string, anchor: string, key: "x" | "y", off: number): Point[] =>
      this.with("tick").filter(({ node, around }) => around.includes(frame) && node.attributes["text-anchor"] === anchor)
        .map(({ node }) => [writtenNumber(textOf(node)), Number(node.attributes[key]) - off]);
    const across = places("frame", "middle", "x", 0);
    const up = ratio ? places("ratio-scale", "start", "y", 4) : places("frame", "end", "y", 4);
    return [axisThrough(across, this.one.choices["log"] === true), axisThrough(up)];
  }

  /** Axes by the box of the undeformed members, which is that of the model's nodes. */
  private structureAxes(pixels: Pixel[]): [Along, Along] {
    const { nodes } = (documentOf(this.one.request) as Request).model;
    const ends = (values: number[]): Point => [Math.min(...values), Math.max(...values)];
    const [left, right] = ends(pixels.map((p) => p.x));
    const [top, bottom] = ends(pixels.map((p) => p.y));
    const [x0, x1] = ends(nodes.map((node) => node.x));
    const [y0, y1] = ends(nodes.map((node) => node.y));
    return [axisThrough([[x0, left], [x1, right]]), axisThrough([[y0, bottom], [y1, top]])];
  }

  place([x, y]: Point): Pixel {
    return { x: this.x(x), y: this.y(y) };
  }

  /** Pieces of the lines of a name, in pixels. */
  pieces(name: string): Pixel[][] {
    const [kind = "", second = ""] = name.split(" ");
    const isLine = ({ node, around }: Drawn): boolean => node.name === "path" && !around.includes("legend");
    const lines = (looks: string[], hidden: string[] = []) => this.with(...looks).filter((one) =>
      isLine(one) && !hidden.some((other) => classesOf(one.node).includes(other)));
    const found = kind === "series" ? lines(["series-line"]).filter(({ around }) => around.includes(`series-${second}`))
      : kind === "branch" ? lines(["path", "branch", second])
      : kind === "ratio" ? lines(["ratio-line"])
      : kind === "member" ? lines(["member"], ["slack"])
      : ["slack", "mode", "undeformed", "contact"].includes(kind) ? lines([kind])
      : ["stable", "unstable", "untold"].includes(kind) ? lines(["path", kind], ["branch"])
      : assert.fail(`no line is called ${name}`);
    return found.flatMap(({ node }) => piecesOf(node));
  }

  /** Marks outside of the legend with their middles. */
  marks(): { kind: string; at: Pixel }[] {
    return this.with("mark").filter(({ node, around }) => !around.includes("legend") && !classesOf(node).includes("failed"))
      .map(({ node }) => {
        if (classesOf(node).includes("event")) return { kind: classesOf(node).includes("open") ? "opened" : "closed", at: centreOf(node) };
        const corners = piecesOf(node).flat();
        const [first, second] = [must(corners[0]), must(corners[1])];
        const limit = corners.length === 4 ? "capacity" : first.y < second.y ? "limit_max" : "limit_min";
        const kind = classesOf(node).includes("limit") ? limit
          : must(Object.keys(kMarks).find((name) => classesOf(node).includes(must(kMarks[name]).looks)), "kind of mark");
        const [dx, dy] = must(kMarks[kind]).corner;
        return { kind, at: { x: first.x - dx, y: first.y - dy } };
      });
  }

  /** Places of the circles of a look; those at the same place are one. */
  circles(looks: string): Pixel[] {
    const all = this.with(looks).filter(({ node, around }) => node.name === "circle" && !around.includes("legend"))
      .map(({ node }) => centreOf(node));
    return all.filter((one, i) => all.findIndex((other) => apart(one, other) === 0) === i);
  }

  texts(within?: string): string[] {
    return this.drawn.filter(({ node, around }) => node.name === "text" && (within === undefined || around.includes(within)))
      .map(({ node }) => plainSpaces(textOf(node)));
  }
}

function centreOf(node: Shape): Pixel {
  return { x: Number(node.attributes["cx"]), y: Number(node.attributes["cy"]) };
}

function apart(a: Pixel, b: Pixel): number {
  return Math.hypot(a.x - b.x, a.y - b.y);
}

// --- Facts ---------------------------------------------------------------------------------------------------------------------

/** Pairs each wanted place with one of the drawn ones; both lists have the same length. */
function needSame<T>(wanted: readonly T[], drawn: readonly T[], off: (a: T, b: T) => number, most: number): void {
  assert.equal(drawn.length, wanted.length, "how many are drawn");
  const left = [...drawn];
  for (const one of wanted) {
    const nearest = left.reduce((best, other, i) => (off(one, other) < off(one, must(left[best])) ? i : best), 0);
    const [found] = left.splice(nearest, 1);
    assert.ok(off(one, must(found)) <= most, `${JSON.stringify(one)} is off by ${off(one, must(found))} px`);
  }
}

function needMark(picture: Picture, { kind, x, y }: Fact): void {
  const found = picture.marks().filter((mark) => mark.kind === kind).map(({ at }) =>
    Math.max(Math.abs(at.x - picture.x(x as number)), y === null ? 0 : Math.abs(at.y - picture.y(y as number))));
  assert.ok(Math.min(...found) <= cases.tolerance.mark, `marks are off by ${found.join(", ")} px`);
}

function needMarkCounts(picture: Picture, { counts }: Fact): void {
  const found: Record<string, number> = {};
  for (const { kind } of picture.marks()) found[kind] = (found[kind] ?? 0) + 1;
  assert.deepEqual(Object.entries(found).sort(), Object.entries(counts as object).sort());
}

function needLineThrough(picture: Picture, { line, points }: Fact): void {
  const pieces = picture.pieces(line as string);
  for (const point of points as Point[]) {
    const off = Math.min(...pieces.map((piece) => distanceTo(piece, picture.place(point))));
    assert.ok(off <= cases.tolerance.line, `${point.join(", ")} is ${off} px off the line`);
  }
}

function needPieces(picture: Picture, { line, ends }: Fact): void {
  const drawn = picture.pieces(line as string).map((piece) => [must(piece[0]), must(piece[piece.length - 1])]);
  const wanted = (ends as Point[][]).map((pair) => pair.map((point) => picture.place(point)));
  needSame(wanted, drawn, (a, b) => Math.max(...a.map((pixel, i) => apart(pixel, must(b[i])))), cases.tolerance.mark);
}

/** Points of the lines, and the middles between them, are on a circle in values of the axes. */
function needCircle(picture: Picture, { lines, centre, radius, within }: Fact): void {
  const middle = picture.place(centre as Point);
  const [cx, cy] = centre as Point;
  const r = radius as number;
  const [across, up] = [(picture.x(cx + r) - middle.x) / r, (picture.y(cy + r) - middle.y) / r];
  const off = (p: Pixel): number => Math.abs(Math.hypot((p.x - middle.x) / across, (p.y - middle.y) / up) - r);
  const pieces = (lines as string[]).flatMap((name) => picture.pieces(name));
  const all = pieces.flatMap((piece) => piece.flatMap((p, i) => {
    const before = piece[i - 1];
    return before ? [p, { x: (p.x + before.x) / 2, y: (p.y + before.y) / 2 }] : [p];
  }));
  assert.ok(all.length > 8, "a line is drawn");
  const most = Math.max(...all.map(off));
  assert.ok(most <= (within as number), `off the circle by ${most}`);
}

function needDots(picture: Picture, { looks, at }: Fact): void {
  needSame((at as Point[]).map((point) => picture.place(point)), picture.circles(looks as string), apart, cases.tolerance.mark);
}

/** Crosses stand at whole pixels. */
function needFailed(picture: Picture, { x }: Fact): void {
  const own = picture.with("failed").filter(({ around }) => around.includes("failed-points")).flatMap(({ node }) => piecesOf(node))
    .map((stroke) => (must(stroke[0]).x + must(stroke[1]).x) / 2).filter((_, i) => i % 2 === 0);
  needSame((x as number[]).map((value) => picture.x(value)), own, (a, b) => Math.abs(a - b), 0.51);
}

/** The marked values of a quantity: place along the members one after another, number, and height in proportion. */
function needExtremes(picture: Picture, { quantity, at }: Fact): void {
  const inPanel = ({ around }: Drawn): boolean => around.includes(`section-${String(quantity)}`);
  const axis = must(picture.with("axis").find((one) => inPanel(one) && one.node.attributes["y1"] === one.node.attributes["y2"])).node;
  const [left, right, zero] = ["x1", "x2", "y1"].map((key) => Number(axis.attributes[key])) as [number, number, number];
  const dots = picture.with("section-dot").filter(inPanel).map(({ node }) => centreOf(node));
  const values = picture.with("section-value").filter(inPanel).map(({ node }) => writtenNumber(textOf(node)));
  const wanted = at as { member: string; s: number; value: number }[];
  const { members } = must((documentOf(picture.one.document) as Result).states[0]);
  const lengths = (documentOf(picture.one.request) as Request).model.members.map(({ id }) => ({ id, length: must(members[id]?.s.at(-1)) }));
  const total = lengths.reduce((sum, { length }) => sum + length, 0);
  const before = (member: string): number =>
    lengths.slice(0, lengths.findIndex(({ id }) => id === member)).reduce((sum, { length }) => sum + length, 0);
  assert.equal(dots.length, wanted.length, "how many extremes are marked");
  wanted.forEach(({ member, s, value }, i) => {
    const dot = must(dots[i]);
    const x = left + (before(member) + s) / total * (right - left);
    assert.ok(Math.abs(dot.x - x) <= cases.tolerance.mark, `${quantity} ${value} stands at ${dot.x}, not at ${x}`);
    assert.ok(Math.abs(must(values[i]) - value) <= 5e-4 * Math.abs(value), `${must(values[i])} is written, not ${value}`);
    const height = (zero - must(dots[0]).y) * value / must(wanted[0]).value;
    assert.ok(Math.abs(zero - dot.y - height) <= 2 * cases.tolerance.mark, `${quantity} ${value} is ${zero - dot.y} high, not ${height}`);
  });
}

function needAll(wanted: readonly string[], found: readonly string[]): void {
  for (const text of wanted) assert.ok(found.includes(text), `"${text}" is not among ${found.join(" | ")}`);
}

/** How many shapes of a look are drawn, the legend among them. */
function needCount(picture: Picture, { looks, count }: Fact): void {
  assert.equal(picture.with(looks as string).length, count);
}

/** What the description says of the breaks of curves. */
function needBreaks(picture: Picture, { count }: Fact): void {
  const told = String(must(picture.drawn[0]).node.attributes["aria-label"]);
  assert.equal(Number(/broken at (\d+) places?$/.exec(told)?.[1] ?? 0), count, told);
}

const kFacts: Record<string, (picture: Picture, fact: Fact) => void> = {
  mark: needMark, marks: needMarkCounts, through: needLineThrough, pieces: needPieces, circle: needCircle, dots: needDots,
  failed: needFailed, extremes: needExtremes, count: needCount, breaks: needBreaks,
  texts: (picture, { texts }) => needAll(texts as string[], picture.texts()),
  legend: (picture, { entries }) => needAll(entries as string[], picture.texts("legend")),
};

function check(picture: Picture, fact: Fact): void {
  const need = must(kFacts[fact.fact], `kind of fact ${fact.fact}`);
  assert.ok(fact.not_yet === undefined || ["page", "plot"].includes(fact.not_yet), "a library");
  const told = JSON.stringify(fact).slice(0, 160);
  if (fact.not_yet === "page") assert.throws(() => need(picture, fact), assert.AssertionError, `is met now: ${told}`);
  else assert.doesNotThrow(() => need(picture, fact), told);
}

test("the list has as many cases as it says", () => {
  assert.ok(cases.cases.length >= cases.least_cases);
  assert.equal(new Set(cases.cases.map(({ name }) => name)).size, cases.cases.length, "each has a name of its own");
});

for (const one of cases.cases) {
  test(`shared case ${one.name}`, () => {
    const choices = new Choices(one.choices);
    const picture = new Picture(one, must(kFigures[one.figure], `kind of figure ${one.figure}`)(one, choices));
    choices.done();
    assert.ok(one.facts.length > 0);
    for (const fact of one.facts) check(picture, fact);
  });
}
