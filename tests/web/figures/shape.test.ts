import assert from "node:assert/strict";
import { test } from "node:test";
import { fileLooks, figureFile, pathData, shape, toText } from "../../../web/src/figures/index";
import { styleSheet } from "./support";

/** Whether a text is well-formed XML, as far as elements, attributes and entities go. */
function wellFormed(text: string): boolean {
  const open: string[] = [];
  const body = text.replace(/^<\?xml[^?]*\?>\s*/, "");
  const token = /<(\/?)([A-Za-z][\w-]*)((?:\s+[\w:-]+="[^"<]*")*)\s*(\/?)>|([^<]+)/gy;
  let end = 0;
  for (const match of body.matchAll(token)) {
    const [whole, closing, name = "", attributes = "", single, words = ""] = match;
    end = match.index + whole.length;
    if (/&(?!(?:amp|lt|gt|quot|#39);)/.test(attributes + words)) return false;
    if (words !== "" || single === "/") continue;
    if (closing === "/" && open.pop() !== name) return false;
    if (closing !== "/") open.push(name);
  }
  return end === body.length && open.length === 0;
}

test("the checker of XML finds what is wrong", () => {
  assert.ok(wellFormed("<a b=\"1\"><c/>text &amp; more</a>"));
  for (const wrong of ["<a>", "<a></b>", "<a b=\"<\"/>", "<a>&x;</a>", "<a b='1'/>"]) assert.ok(!wellFormed(wrong), wrong);
});

test("texts and attributes stay texts", () => {
  const node = shape("text", { "data-x": `"<'&` }, "<script>alert(1)</script>", shape("tspan", {}, "a & b"));
  const text = toText(node);
  assert.ok(wellFormed(text), text);
  assert.ok(!text.includes("<script"));
  assert.ok(text.includes("&lt;script&gt;"));
});

test("characters that XML does not know are replaced", () => {
  const text = toText(shape("text", {}, "a\u0000b\ud800c\u{1f600}"));
  assert.equal(text, "<text>a\ufffdb\ufffdc\u{1f600}</text>");
});

test("a file is well-formed, has its looks inside, and paper under the picture", () => {
  const file = figureFile(shape("svg", { class: "figure", width: 100, height: 50 }, shape("path", { class: "member" })), styleSheet());
  assert.ok(wellFormed(file.replace(/<style>[^]*<\/style>/, "<style/>")));
  assert.ok(file.startsWith("<?xml"));
  assert.ok(file.includes("viewBox=\"-14 -14 128 78\""), "a margin around the picture");
  assert.ok(file.indexOf("<style>") < file.indexOf("class=\"paper\""));
  assert.ok(file.indexOf("class=\"paper\"") < file.indexOf("class=\"member\""));
  assert.ok(file.includes(".figure .member {"));
});

test("a file's looks are light and need no custom properties", () => {
  const looks = fileLooks(styleSheet());
  assert.ok(!/[@]|var\(|--/.test(looks), looks.match(/.*(?:[@]|var\(|--).*/)?.[0]);
  assert.match(looks, /\.figure \.member \{ stroke: #1c2430; stroke-width: 4; \}/);
  assert.match(looks, /\.figure \.paper \{ fill: #fff; \}/);
  assert.equal(fileLooks(".a { --x: 1px; width: var(--x); } @media print { .b { c: d } } .e { f: g }").replace(/\s+/g, " "),
               ".a { width: 1px; } .e { f: g }");
});

test("a path breaks where there is no number", () => {
  const points = [{ x: 0, y: 0 }, { x: 1, y: 1 }, { x: Number.NaN, y: 0 }, { x: 2, y: 2.005 }];
  assert.equal(pathData(points), "M0 0L1 1M2 2.01");
  assert.equal(pathData([], true), "");
});
