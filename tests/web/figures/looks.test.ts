import assert from "node:assert/strict";
import { test } from "node:test";
import {
  bucklingFigure, defaultQuantities, drawingFigure, frequencyFigure, hasFrequencies, lawChart, lawFigure, pathFigure, sectionsFigure, sweepLine, sweepMap, toText,
  type LawInput, type Shape,
} from "../../../web/src/figures/index";
import { classesOf, kCases, must, readCase, readTable, refinedTable, shapesOf, styleSheet } from "./support";

const size = { width: 560, height: 420 };

function lawFigures(): Shape[] {
  const { model } = readCase("laws").request;
  return (["springs", "foundations"] as const).flatMap((list) => (model[list] ?? []).map((support) => {
    const input: LawInput = { list, support: { ...support }, units: model.units };
    return lawFigure(input, size, must(lawChart(input, size)));
  }));
}

/** Every figure of every stored result. */
function everyFigure(): Shape[] {
  const figures: Shape[] = [];
  for (const name of kCases) {
    const { request, result } = readCase(name);
    const { model } = request;
    figures.push(drawingFigure({ model }, size));
    const mode = result.critical_points[0]?.mode ?? null;
    for (const state of result.states) {
      figures.push(drawingFigure({ model, state, mode, cursor: { member: must(model.members[0]).id, s: 0 } }, size));
      figures.push(sectionsFigure({ model, state, cursor: { member: must(model.members[0]).id, s: 0 } }, size));
    }
    const shadows = (["earlier", "pinned"] as const).map((kind) => ({ kind, label: kind, result }));
    figures.push(pathFigure({ result, ...defaultQuantities(result), shadows, chosen: { branch: 0, index: 1 } }, size));
    if (hasFrequencies(result)) figures.push(frequencyFigure({ result, load: 1, chosen: { row: 0, motion: 0 } }, size));
    if (result.buckling) figures.push(bucklingFigure({ buckling: result.buckling, chosen: 0 }, size));
  }
  figures.push(...lawFigures());
  const table = readTable("map");
  const value = { column: "/summary/critical_load_factor" };
  figures.push(sweepLine({ table, x: { column: "k", log: true }, y: value, series: "EI", chosen: 3 }, size));
  figures.push(sweepMap({ table, x: { column: "k", log: true }, y: { column: "EI" }, value, chosen: 3 }, size));
  const refined = refinedTable([1, 1.5]);
  figures.push(sweepLine({ table: refined, x: { column: "t" }, y: value, series: ["k"] }, size));
  figures.push(sweepMap({ table: refined, x: { column: "k" }, y: { column: "t" }, value }, size));
  return figures;
}

test("no figure has ids, styles, handlers or addresses, or a number that is none", () => {
  for (const figure of everyFigure()) {
    for (const node of shapesOf(figure)) {
      for (const [name, value] of Object.entries(node.attributes)) {
        assert.ok(!/^(id|style|href|xlink:href|on.*)$/.test(name), name);
        assert.ok(!/NaN|Infinity|undefined/.test(String(value)), `${node.name} ${name}="${value}"`);
      }
      assert.ok(["svg", "g", "path", "line", "circle", "rect", "text", "tspan", "title"].includes(node.name), node.name);
    }
    assert.ok(!/>[^<]*(NaN|undefined)/.test(toText(figure)));
  }
});

test("every figure says what it is", () => {
  for (const figure of everyFigure()) {
    assert.equal(figure.attributes["role"], "img");
    assert.ok(String(figure.attributes["aria-label"]).length > 10);
  }
});

/** Class names of the style sheet that a stroke or a fill is given to. */
function painted(css: string): Set<string> {
  const names = new Set<string>();
  for (const [, selectors = "", body = ""] of css.replace(/\/\*[^]*?\*\//g, "").matchAll(/([^{}]+)\{([^{}]*)\}/g)) {
    if (!/(?:^|[\s;])(?:stroke|fill):/.test(body)) continue;
    for (const [, name = ""] of selectors.matchAll(/\.([\w-]+)/g)) names.add(name);
  }
  names.delete("figure");
  return names;
}

test("everything that is drawn is seen: each line, path, circle and rectangle has a painted class", () => {
  const names = painted(styleSheet());
  for (const figure of everyFigure()) {
    for (const node of shapesOf(figure)) {
      if (!["path", "line", "circle", "rect"].includes(node.name)) continue;
      assert.ok(classesOf(node).some((name) => names.has(name)), `${node.name} of class ${node.attributes["class"]}`);
    }
  }
});

/** Custom properties of the light and of the dark part of the style sheet. */
function properties(css: string): { light: Map<string, string>; dark: Map<string, string> } {
  const read = (text: string) => new Map([...text.matchAll(/--figure-([\w-]+):\s*(#[0-9a-f]{3,6})/g)]
    .map(([, name = "", colour = ""]) => [name, colour]));
  const from = css.indexOf("@media");
  const light = read(css.slice(0, from));
  return { light, dark: new Map([...light, ...read(css.slice(from))]) };
}

/** Relative luminance (WCAG 2). */
function luminance(colour: string): number {
  const full = colour.length === 4 ? colour.replace(/[0-9a-f]/g, "$&$&") : colour;
  const [r = 0, g = 0, b = 0] = [1, 3, 5].map((i) => {
    const value = Number.parseInt(full.slice(i, i + 2), 16) / 255;
    return value <= 0.03928 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function contrast(a: string, b: string): number {
  const [low = 0, high = 0] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (high + 0.05) / (low + 0.05);
}

test("texts have a contrast of 4.5 at least and lines of 3, light and dark", () => {
  const { light, dark } = properties(styleSheet());
  for (const [mode, colours] of Object.entries({ light, dark })) {
    const paper = must(colours.get("paper"));
    for (const name of ["ink", "muted", "contact-text", "accent", "branch-text"]) {
      assert.ok(contrast(must(colours.get(name), name), paper) >= 4.5, `${mode} ${name} ${contrast(must(colours.get(name)), paper)}`);
    }
    for (const name of ["contact", "branch", "moment"]) {
      assert.ok(contrast(must(colours.get(name), name), paper) >= 3, `${mode} ${name} ${contrast(must(colours.get(name)), paper)}`);
    }
  }
});

test("the bands of a map grow darker step by step, so that they are read in grey", () => {
  const css = styleSheet();
  const bands = Array.from({ length: 12 }, (_, i) => must(css.match(new RegExp(`\\.band-${i} \\{ fill: (#[0-9a-f]{6})`)))[1] ?? "");
  const lightness = bands.map((colour) => 116 * Math.cbrt(luminance(colour)) - 16);
  lightness.slice(1).forEach((value, i) => assert.ok(value < must(lightness[i]) - 3, `band ${i + 1}: ${value}`));
});

test("text that a user wrote stays text in every figure", () => {
  const { request, result } = readCase("arch_outside");
  const evil = "<script>alert(1)</script>";
  const model = { ...request.model, monitors: [{ ...must(request.model.monitors?.[0]), id: evil }] };
  const renamed = result.branches.map((branch) => ({ ...branch, monitors: { [evil]: must(branch.monitors["crown"]) } }));
  const pictures = [
    drawingFigure({ model, state: must(result.states[0]) }, size),
    pathFigure({ result: { ...result, branches: renamed }, x: { kind: "monitor", id: evil }, y: { kind: "load_factor" },
                 monitors: model.monitors, shadows: [{ kind: "pinned", label: evil, result }] }, size),
  ];
  for (const picture of pictures) {
    const text = toText(picture);
    assert.ok(!text.includes("<script") && text.includes("&lt;script&gt;"));
  }
});
