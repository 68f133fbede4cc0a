// What the schema of requests has at a pointer: names of fields and words that a value may be.

import type { Description } from "../api/documents";

type Node = Record<string, unknown>;

export interface Suggestion {
  text: string;
  detail: string;
}

function isNode(value: unknown): value is Node {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/** The schema with its references resolved, and all of its alternatives. */
function alternatives(node: unknown, schemas: Node): Node[] {
  if (!isNode(node)) return [];
  const reference = node["$ref"];
  if (typeof reference === "string") return alternatives(schemas[reference.replace("#/components/schemas/", "")], schemas);
  const inner = ["oneOf", "anyOf", "allOf"].flatMap((word) => (Array.isArray(node[word]) ? (node[word] as unknown[]) : []));
  return [node, ...inner.flatMap((one) => alternatives(one, schemas))];
}

function below(node: Node, part: string): unknown[] {
  const properties = node["properties"];
  const found: unknown[] = [];
  if (isNode(properties) && properties[part] !== undefined) found.push(properties[part]);
  if (/^\d+$/.test(part)) {
    const items = node["prefixItems"];
    if (Array.isArray(items)) found.push((items as unknown[])[Number(part)]);
    found.push(node["items"]);
  }
  return found;
}

function nodesAt(description: Description, path: readonly string[]): Node[] {
  const components = description.components;
  const schemas = isNode(components) && isNode(components["schemas"]) ? components["schemas"] : {};
  return path.reduce<Node[]>((nodes, part) => nodes.flatMap((node) => below(node, part).flatMap((one) => alternatives(one, schemas))),
                             alternatives(schemas["Request"], schemas));
}

/** Fields that an object at the path may have. */
export function fieldsAt(description: Description, path: readonly string[]): Suggestion[] {
  const found = new Map<string, string>();
  for (const node of nodesAt(description, path)) {
    if (!isNode(node["properties"])) continue;
    for (const [name, field] of Object.entries(node["properties"])) {
      const text = isNode(field) && typeof field["description"] === "string" ? field["description"] : "";
      if (!found.has(name)) found.set(name, text);
    }
  }
  return [...found].map(([text, detail]) => ({ text, detail }));
}

/** Words that the value at the path may be. */
export function wordsAt(description: Description, path: readonly string[]): Suggestion[] {
  const words = new Set<string>();
  for (const node of nodesAt(description, path)) {
    const listed = ["enum", "x-names"].flatMap((key) => (Array.isArray(node[key]) ? (node[key] as unknown[]) : []));
    for (const word of [...listed, node["const"]]) if (typeof word === "string") words.add(word);
  }
  return [...words].map((text) => ({ text, detail: "" }));
}
