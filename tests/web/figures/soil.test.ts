// Foundations that name a soil are drawn as the sum of the laws that results list.
import assert from "node:assert/strict";
import { test } from "node:test";

import { drawingFigure } from "../../../web/src/figures";
import { withSoil } from "../../../web/src/figures/soil";
import { sectionLines } from "../../../web/src/figures/chart/sections";

type Arguments = Parameters<typeof withSoil>;
type Model = Arguments[0];
type State = NonNullable<Arguments[1]>;

const model: Model = {
  nodes: [{ id: "tip", x: 0, y: -8 }, { id: "head", x: 0, y: 2 }],
  sections: [{ id: "s", EA: 1, EI: 1 }],
  members: [{ id: "pile", start: "tip", end: "head", section: "s" }],
  soils: [{ id: "site", loading: "static", layers: [] }],
  foundations: [{ id: "own", member: "pile", stiffness: 3 }, { id: "soil", member: "pile", soil: "site" }],
};

function curve(s: number[], reaction: number[]): State["foundations"][string] {
  return {
    s, reaction, displacement: s.map(() => 0.01), contact: [[s[0] ?? 0, s.at(-1) ?? 0]],
    resultant: { fx: 1, fy: 2, moment: 3 },
    extremes: { min: { value: 0, s: 0 }, max: { value: 0, s: 0 } },
  };
}

const state = {
  load_factor: 1,
  members: { pile: { s: [0, 4, 8, 10] } },
  foundations: {
    "own": curve([0, 10], [1, 1]),
    "soil layer 2 curve 1": curve([0, 2, 4], [6, 3, 0]),
    "soil layer 2 curve 2": curve([0, 2, 4], [0, 1, 2]),
    "soil layer 1": curve([4, 8], [5, 0]),
    "soil layer 1 axial curve 1": curve([4, 8], [7, 7]),
    "soil layer 1 extra": curve([0, 10], [99, 99]),
  },
} as unknown as State;

test("the curves of a layer are added, and layers follow one another", () => {
  const drawn = withSoil(model, state);
  assert.deepEqual(drawn.model.foundations?.map(({ id }) => id), ["own", "soil", "soil axial"]);
  const found = drawn.state.foundations["soil"];
  assert.deepEqual(found?.s, [0, 2, 4, 4, 8]);
  assert.deepEqual(found?.reaction, [6, 4, 2, 5, 0]);
  assert.deepEqual(found?.contact, [[0, 4], [4, 8]]);
  assert.deepEqual(found?.extremes, { min: { value: 0, s: 8 }, max: { value: 6, s: 0 } });
  assert.deepEqual(found?.resultant, { fx: 3, fy: 6, moment: 9 });
  assert.deepEqual(drawn.state.foundations["soil axial"]?.reaction, [7, 7]);
  assert.deepEqual(drawn.state.foundations["own"], state.foundations["own"]);
});

test("the chart of reactions has one line for each foundation and kind of curve", () => {
  const lines = sectionLines({ model, state }, "pile", "reaction");
  assert.deepEqual(lines.map(({ values }) => values), [[1, 1], [6, 4, 2, 5, 0], [7, 7]]);
});

test("without a state the ground lies along the buried part", () => {
  const [, soil] = withSoil(model, null).model.foundations ?? [];
  assert.deepEqual(soil, { id: "soil", member: "pile", stiffness: 0, range: [0, 0.8] });
  const raised: Model = { ...model, foundations: [{ id: "soil", member: "pile", soil: "site", ground_level: 5 }] };
  assert.deepEqual(withSoil(raised, null).model.foundations?.[0]?.range, [0, 1]);
  const lowered: Model = { ...model, foundations: [{ id: "soil", member: "pile", soil: "site", ground_level: -8 }] };
  assert.deepEqual(withSoil(lowered, null).model.foundations, []);
});

test("a model without soil is not copied", () => {
  const plain: Model = { ...model, foundations: [{ id: "own", member: "pile", stiffness: 3 }] };
  assert.equal(withSoil(plain, state).model, plain);
  assert.equal(withSoil(plain, state).state, state);
});

test("a model in soil is drawn with ground", () => {
  const text = JSON.stringify(drawingFigure({ model }, { width: 300, height: 300 }));
  assert.ok(text.includes("ground-surface"));
});
