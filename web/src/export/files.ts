// Files that people take away: pictures, tables, requests, results, and commands that do the same.

import { render } from "preact";
import type { RequestDocument } from "../api/documents";
import { shapeNode } from "../app/shape_view";
import { figureFile, toText, type Shape } from "../figures";
import looks from "../figures/figures.css?text";

const kScale = 2;  // pixels of a PNG for one of the figure

function save(name: string, content: Blob): void {
  const address = URL.createObjectURL(content);
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}

export function saveText(name: string, text: string, type = "text/plain"): void {
  save(name, new Blob([text], { type: `${type};charset=utf-8` }));
}

export function saveJson(name: string, value: unknown): void {
  saveText(name, `${JSON.stringify(value, null, 2)}\n`, "application/json");
}

export function saveSvg(name: string, figure: Shape): void {
  saveText(name, figureFile(figure, looks), "image/svg+xml");
}

/** What a style sheet says of a shape and can be said by attributes. */
const kLooks = [
  "display", "fill", "fill-opacity", "stroke", "stroke-width", "stroke-opacity", "stroke-dasharray", "stroke-linecap", "stroke-linejoin",
  "opacity", "paint-order", "font-family", "font-size", "font-weight", "font-style", "text-anchor", "dominant-baseline",
];

/** The shape with the looks of the page as attributes: an image from a blob may not have a style sheet of its own here. */
function withLooks(shape: Shape, element: Element): Shape {
  const style = getComputedStyle(element);
  const looks = Object.fromEntries(kLooks.map((name) => [name, style.getPropertyValue(name)]).filter(([, value]) => value !== ""));
  let next = 0;
  const children = shape.children.map((child) => {
    const below = typeof child === "string" ? undefined : element.children[next++];
    return typeof child === "string" || !below ? child : withLooks(child, below);
  });
  return { name: shape.name, attributes: { ...shape.attributes, ...looks }, children };
}

function standalone(figure: Shape): Shape {
  const paper: Shape = { name: "rect", attributes: { class: "paper", width: "100%", height: "100%" }, children: [] };
  const whole = { ...figure, children: [paper, ...figure.children] };
  const place = document.createElement("div");
  place.className = "unseen";
  document.body.append(place);
  render(shapeNode(whole), place);
  const root = place.firstElementChild;
  const result = root ? withLooks(whole, root) : whole;
  render(null, place);
  place.remove();
  return result;
}

export async function savePng(name: string, figure: Shape): Promise<void> {
  const address = URL.createObjectURL(new Blob([toText(standalone(figure))], { type: "image/svg+xml" }));
  try {
    const image = new Image();
    image.src = address;
    await image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = kScale * image.naturalWidth;
    canvas.height = kScale * image.naturalHeight;
    canvas.getContext("2d")?.drawImage(image, 0, 0, canvas.width, canvas.height);
    const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, "image/png"));
    if (blob) save(name, blob);
  } finally {
    URL.revokeObjectURL(address);
  }
}

/** A name for a file, from a title. */
export function fileName(title: string, ending: string): string {
  const words = title.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "").slice(0, 40);
  return `${words === "" ? "snapthrough" : words}${ending}`;
}

/** A shell command that has the request solved. */
export function curlCommand(request: RequestDocument, origin: string, withKey: boolean): string {
  const text = JSON.stringify(request, null, 1).replace(/'/g, "'\\''");
  const key = withKey ? ' \\\n  -H "Authorization: Bearer $SNAPTHROUGH_KEY"' : "";
  return `curl -sS ${origin}/v1/jobs \\\n  -H 'Content-Type: application/json' \\\n  ` +
    `-H 'Prefer: wait=60, return=representation'${key} \\\n  --data-binary '${text}'\n`;
}

/** The same in Python, with its standard library. */
export function pythonProgram(request: RequestDocument, origin: string, withKey: boolean): string {
  const document = JSON.stringify(JSON.stringify(request));
  const key = withKey ? '\n    "Authorization": "Bearer " + os.environ["SNAPTHROUGH_KEY"],' : "";
  return `import json${withKey ? "\nimport os" : ""}
import urllib.request

request = json.loads(${document})
call = urllib.request.Request("${origin}/v1/jobs", json.dumps(request).encode(), {
    "Content-Type": "application/json",
    "Prefer": "wait=60, return=representation",${key}
})
with urllib.request.urlopen(call) as answer:
    result = json.load(answer)
print(result["summary"])
`;
}
