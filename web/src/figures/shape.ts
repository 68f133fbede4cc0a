// A tree of SVG shapes: what every figure returns. The page turns it into its own nodes, `toText` into SVG text,
// so that each picture is drawn once. Nothing here knows a document object model.

export interface Shape {
  name: string;
  attributes: Record<string, string | number>;
  children: (Shape | string)[];
}

/** Width and height in CSS pixels; one unit of a figure's view box is one pixel. */
export interface Size {
  width: number;
  height: number;
}

/** A place in a figure, in pixels from its top left corner, y down. */
export interface Pixel {
  x: number;
  y: number;
}

export type Child = Shape | string | null | undefined | false;

/** A shape; children that are null, undefined or false are left out. */
export function shape(name: string, attributes: Record<string, string | number> = {}, ...children: Child[]): Shape {
  return { name, attributes, children: children.filter(isPresent) };
}

function isPresent(child: Child): child is Shape | string {
  return child !== null && child !== undefined && child !== false;
}

export function group(className: string, ...children: Child[]): Shape {
  return shape("g", { class: className }, ...children);
}

/** A coordinate as it is written: a hundredth of a pixel. */
export function coordinate(value: number): number {
  return Math.round(value * 100) / 100;
}

export function line(className: string, from: Pixel, to: Pixel): Shape {
  return shape("line", {
    class: className,
    x1: coordinate(from.x), y1: coordinate(from.y), x2: coordinate(to.x), y2: coordinate(to.y),
  });
}

/** A point of a line; with `inner` a Bezier cubic with these inner points leads to it, else a straight line. */
export interface LinePoint extends Pixel {
  inner?: readonly [Pixel, Pixel];
}

function pair({ x, y }: Pixel): string {
  return `${coordinate(x)} ${coordinate(y)}`;
}

/** The `d` of a path through points; what is not finite breaks the line. */
export function pathData(points: readonly LinePoint[], closed = false): string {
  let text = "";
  let pen = false;
  for (const point of points) {
    if (!Number.isFinite(point.x) || !Number.isFinite(point.y)) {
      pen = false;
      continue;
    }
    text += pen && point.inner ? `C${point.inner.map(pair).join(" ")} ${pair(point)}` : `${pen ? "L" : "M"}${pair(point)}`;
    pen = true;
  }
  return closed && text !== "" ? `${text}Z` : text;
}

export function path(className: string, points: readonly Pixel[], closed = false): Shape {
  return shape("path", { class: className, d: pathData(points, closed) });
}

export type Anchor = "start" | "middle" | "end";

export function label(className: string, at: Pixel, anchor: Anchor, ...children: Child[]): Shape {
  return shape("text", { class: className, x: coordinate(at.x), y: coordinate(at.y), "text-anchor": anchor },
               ...children);
}

/** The outer shape of a figure. `title` is what a screen reader says of it. */
export function figure(className: string, size: Size, title: string, ...children: Child[]): Shape {
  return shape("svg", {
    xmlns: "http://www.w3.org/2000/svg",
    class: `figure ${className}`,
    viewBox: `0 0 ${coordinate(size.width)} ${coordinate(size.height)}`,
    width: coordinate(size.width),
    height: coordinate(size.height),
    role: "img",
    "aria-label": title,
  }, ...children);
}

const kEscapes: Record<string, string> = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;", "'": "&#39;" };

/** XML allows tab, line feed and carriage return of the control characters, and no half of a surrogate pair. */
function escaped(text: string): string {
  return text
    .replace(/[\u0000-\u0008\u000b\u000c\u000e-\u001f\ufffe\uffff]/g, "\ufffd")
    .replace(/[\ud800-\udbff](?![\udc00-\udfff])|(?<![\ud800-\udbff])[\udc00-\udfff]/g, "\ufffd")
    .replace(/[&<>"']/g, (character) => kEscapes[character] ?? character);
}

/** The shape as SVG text, escaped. */
export function toText(node: Shape): string {
  const attributes = Object.entries(node.attributes)
    .map(([name, value]) => ` ${name}="${escaped(String(value))}"`)
    .join("");
  if (node.children.length === 0) return `<${node.name}${attributes}/>`;
  const inside = node.children.map((child) => (typeof child === "string" ? escaped(child) : toText(child))).join("");
  return `<${node.name}${attributes}>${inside}</${node.name}>`;
}

/** A style sheet without its @ blocks. */
function withoutBlocks(css: string): string {
  const at = css.indexOf("@");
  if (at < 0) return css;
  let depth = 0;
  for (let i = css.indexOf("{", at); i >= 0 && i < css.length; ++i) {
    if (css[i] === "{") ++depth;
    else if (css[i] === "}" && --depth === 0) return css.slice(0, at) + withoutBlocks(css.slice(i + 1));
  }
  return css.slice(0, at);
}

/** The looks of a file: light, with the values of custom properties written in, since few programs but browsers know those. */
export function fileLooks(css: string): string {
  const plain = withoutBlocks(css.replace(/\/\*[^]*?\*\//g, ""));
  const values = new Map([...plain.matchAll(/(--[\w-]+):\s*([^;}]+)/g)].map(([, name = "", value = ""]) => [name, value.trim()]));
  return plain
    .replace(/--[\w-]+:[^;}]+;?\s*/g, "")
    .replace(/var\((--[\w-]+)\)/g, (whole, name: string) => values.get(name) ?? whole);
}

const kFileMargin = 14;

/** A file of its own: the figure on white paper, with the looks of `css` (the text of figures.css) inside. */
export function figureFile(node: Shape, css: string): string {
  const width = Number(node.attributes["width"] ?? 0) + 2 * kFileMargin;
  const height = Number(node.attributes["height"] ?? 0) + 2 * kFileMargin;
  const paper = shape("rect", { class: "paper", x: -kFileMargin, y: -kFileMargin, width, height });
  const looks = shape("style", {}, fileLooks(css));
  const attributes = { ...node.attributes, width, height, viewBox: `${-kFileMargin} ${-kFileMargin} ${width} ${height}` };
  const file = { ...node, attributes, children: [looks, paper, ...node.children] };
  return `<?xml version="1.0" encoding="UTF-8"?>\n${toText(file)}\n`;
}
