// The problems of the gallery: their requests, sliders, documents and pictures are there and belong together.

import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import type { RequestDocument } from "../../../web/src/api/documents";
import { kGallery } from "../../../web/src/model/gallery";
import { kPractice } from "../../../web/src/model/practice";
import { valueAt } from "../../../web/src/model/pointer";
import { kProblems } from "../../../web/src/model/problems";
import { fits, valueOf, withSlider } from "../../../web/src/model/sliders";

declare const ROOT: string;

const text = (name: string): string => readFileSync(join(ROOT, name), "utf8");
const requestOf = (example: string): RequestDocument => JSON.parse(text(`examples/${example}.json`)) as RequestDocument;

test("each slider has its place in the request, and the request's value is on its way", () => {
  for (const { example, sliders } of kProblems) {
    const request = requestOf(example);
    assert.ok(sliders.length > 0, example);
    for (const slider of sliders) {
      const name = `${example}: ${slider.name}`;
      assert.ok(fits(slider, request), name);
      const value = valueOf(slider, request);
      assert.ok(value !== null && value >= slider.min && value <= slider.max, `${name}: ${value}`);
    }
  }
});

test("a slider that is set to the request's value changes nothing", () => {
  for (const { example, sliders } of kProblems) {
    const request = requestOf(example);
    for (const slider of sliders) {
      const same = withSlider(slider, request, valueOf(slider, request) ?? NaN);
      for (const { pointer } of slider.targets) {
        const [found, wanted] = [valueAt(same, pointer), valueAt(request, pointer)] as [number, number];
        assert.ok(found === wanted || Math.abs(found - wanted) <= 1e-6 * Math.abs(wanted), `${example}: ${slider.name}: ${pointer}: ${found}, not ${wanted}`);
      }
    }
  }
});

test("the documents of the gallery describe these problems and no others", () => {
  const sections = [...text("docs/gallery.md").matchAll(/^## (.*)$/gm)].map(([, heading]) => heading);
  for (const { heading } of kGallery) assert.ok(sections.includes(heading), heading);
  const pages = [...text("docs/gallery/README.md").matchAll(/^\| <img.*\]\((\w+)\.md\)/gm)].map(([, name]) => `gallery/${name ?? ""}`);
  assert.deepEqual(kPractice.map((problem) => problem.document?.name), pages);
  for (const { document: own, heading } of kPractice) {
    assert.match(text(`docs/${own?.name ?? ""}.md`), new RegExp(`^# ${heading}\n`));
    assert.ok(existsSync(join(ROOT, "docs", own?.picture ?? "none")), heading);
  }
});

test("the picture of a problem of practice is that of the request that it opens", () => {
  for (const { document: own, example } of kPractice) {
    const title = requestOf(example).model.title ?? "none";
    assert.ok(text(`docs/${own?.picture ?? "none"}`).includes(`<title>${title}: `), `${example}: ${own?.picture ?? ""}`);
  }
});
