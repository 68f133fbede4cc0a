// The documents that come with the service, in the order in which they are read.

export interface Entry {
  name: string;  // of docs/NAME.md
  heading: string;
  text: string;
}

export const kContents: readonly Entry[] = [
  { name: "tutorial", heading: "From a sketch to a design chart", text: "One problem by command line, HTTP, Python and this page." },
  { name: "gallery", heading: "The problems of the gallery", text: "What each is a model of, what moves it, and how exact its numbers are." },
  { name: "requests", heading: "Requests", text: "How a structure, its ground, its loads and an analysis are written, with every field." },
  { name: "results", heading: "Results", text: "What comes back, how to read the path, and what kinds of points it has." },
  { name: "sweeps", heading: "Sweeps", text: "One request at many values: grids, tables, and loads that are followed from point to point." },
  { name: "theory", heading: "Theory", text: "What is computed, its assumptions, and where they end." },
  { name: "verification", heading: "Verification", text: "Which results have been compared with which sources." },
  { name: "performance", heading: "Time and accuracy", text: "What an accuracy costs, and the sizes that have been tried." },
  { name: "stress", heading: "Stress tests", text: "Random models and pairs of models that must agree, with what was found." },
  { name: "gallery/README", heading: "Real problems", text: "Liners, piles, pipelines, tunnels and frames, each with a design chart and published values." },
  { name: "thesis/README", heading: "The examples of the thesis", text: "Figures and tables of the 2016 thesis, computed again." },
  { name: "interface", heading: "The interface", text: "Every address and every field, from the service's OpenAPI document." },
  { name: "service", heading: "The service", text: "Addresses, waiting, errors, callbacks, settings, limits and metrics." },
];

/** Where a document or a section of it is in the page. */
export function documentAddress(name: string, section = ""): string {
  return `#/docs/${name}${section ? `?at=${encodeURIComponent(section)}` : ""}`;
}

/** The name of a heading in addresses, as in the rendered documents of the repository. */
export function sectionName(heading: string): string {
  return heading.toLowerCase().replace(/[^\p{L}\p{N}\s_-]/gu, "").trim().replace(/\s/g, "-");
}

/** `..` and `.` of a link in docs/FROM.md resolved: "thesis/ring.md". Null when it leads out of the documents. */
function resolved(from: string, path: string): string | null {
  const parts = from.split("/").slice(0, -1);
  for (const part of path.split("/")) {
    if (part === "..") {
      if (parts.pop() === undefined) return null;
    } else if (part !== ".") {
      parts.push(part);
    }
  }
  return parts.join("/");
}

const kServed = /^([a-z0-9_]+|(thesis|performance|gallery)\/[A-Za-z0-9_]+)\.(md|svg)$/;

/** Where a link of docs/FROM.md leads in the page; null for files of the repository that the service does not have. */
export function linkTarget(from: string, href: string): string | null {
  if (/^https?:/.test(href)) return href;
  const [path = "", section = ""] = href.split("#");
  if (path === "") return documentAddress(from, section);
  if (path.endsWith("openapi.json")) return documentAddress("interface");
  const example = /(?:^|\/)examples\/((?:gallery\/)?[a-z0-9_]+)\.json$/.exec(path);
  if (example?.[1]) return `#/studio?example=${example[1]}`;
  const file = resolved(from, path);
  if (file === null || !kServed.test(file)) return null;
  return file.endsWith(".md") ? documentAddress(file.slice(0, -3), section) : `docs/${file}`;
}
