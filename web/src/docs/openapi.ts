// The interface's document (OpenAPI 3.1) as far as the page shows it.

export interface Schema {
  $ref?: string;
  type?: string | string[];
  description?: string;
  properties?: Record<string, Schema>;
  required?: string[];
  items?: Schema | false;
  prefixItems?: Schema[];
  additionalProperties?: Schema | boolean;
  oneOf?: Schema[];
  anyOf?: Schema[];
  const?: unknown;
  enum?: unknown[];
  default?: unknown;
  [keyword: string]: unknown;
}

export interface Parameter {
  $ref?: string;
  name: string;
  in: string;
  required?: boolean;
  description?: string;
  schema: Schema;
}

type Content = Record<string, { schema?: Schema; example?: unknown }>;

export interface Answer {
  $ref?: string;
  description: string;
  headers?: Record<string, { description?: string; schema: Schema }>;
  content?: Content;
}

export interface Operation {
  operationId: string;
  tags: string[];
  summary: string;
  description?: string;
  security?: unknown[];
  parameters?: Parameter[];
  requestBody?: { content: Content };
  responses: Record<string, Answer>;
}

export type PathItem = { parameters?: Parameter[] } & Record<string, Operation>;

export interface OpenApi {
  info: { title: string; version: string; description: string };
  tags: { name: string; description: string }[];
  paths: Record<string, PathItem>;
  webhooks: Record<string, PathItem>;
  components: { schemas: Record<string, Schema>; parameters: Record<string, Parameter>; responses: Record<string, Answer> };
}

export interface Call {
  method: string;
  path: string;
  operation: Operation;
  parameters: Parameter[];
}

const kMethods = ["get", "post", "delete"];

/** "#/components/schemas/Job": "Job". */
export function nameOf(reference: string): string {
  return reference.slice(reference.lastIndexOf("/") + 1);
}

/** Every operation of paths or webhooks, with the parameters of its path. */
export function callsOf(api: OpenApi, paths: Record<string, PathItem>): Call[] {
  const parameter = (one: Parameter): Parameter => (one.$ref ? api.components.parameters[nameOf(one.$ref)] ?? one : one);
  return Object.entries(paths).flatMap(([path, item]) => kMethods.flatMap((method) => {
    const operation = item[method];
    if (!operation) return [];
    return [{ method: method.toUpperCase(), path, operation,
              parameters: [...(item.parameters ?? []), ...(operation.parameters ?? [])].map(parameter) }];
  }));
}

/** Names of the schemas that a value refers to, directly or by others. */
export function reachable(api: OpenApi, value: unknown, found = new Set<string>()): Set<string> {
  if (typeof value !== "object" || value === null) return found;
  for (const [key, part] of Object.entries(value)) {
    if (key === "$ref" && typeof part === "string") {
      const name = nameOf(part);
      if (!found.has(name)) {
        found.add(name);
        reachable(api, api.components.schemas[name], found);
      }
    } else {
      reachable(api, part, found);
    }
  }
  return found;
}

function interval(schema: Schema): string[] {
  const said = (key: string, words: string): string[] => (schema[key] === undefined ? [] : [`${words} ${String(schema[key])}`]);
  return [...said("minimum", "at least"), ...said("exclusiveMinimum", "more than"), ...said("maximum", "at most"),
          ...said("exclusiveMaximum", "less than")];
}

function counted(schema: Schema, least: string, most: string, what: string): string[] {
  const [from, to] = [schema[least], schema[most]];
  if (from === undefined && to === undefined) return [];
  if (to === undefined) return [`${what}: at least ${String(from)}`];
  return [from === to ? `${what}: ${String(to)}` : `${what}: ${String(from ?? 0)} to ${String(to)}`];
}

/** Bounds and unit of a value in words. */
export function boundsOf(schema: Schema): string[] {
  const words = [...interval(schema), ...counted(schema, "minLength", "maxLength", "characters"),
                 ...counted(schema, "minItems", "maxItems", "entries"),
                 ...counted(schema, "minProperties", "maxProperties", "names")];
  if (schema.pattern !== undefined) words.push(`matches ${String(schema.pattern)}`);
  if (schema.format !== undefined) words.push(String(schema.format));
  if (schema.uniqueItems) words.push("each once");
  if (schema["x-unit"] !== undefined) words.push(`unit: ${String(schema["x-unit"])}`);
  if (schema.default !== undefined) words.push(`default ${JSON.stringify(schema.default)}`);
  return words;
}

/** A command for an operation: what its document says, and nothing that it does not. */
export function curlOf({ method, path, operation, parameters }: Call, origin: string): string {
  const query = parameters.filter((one) => one.in === "query" && one.required).map(({ name }) => `${name}=...`).join("&");
  const parts = ["curl", ...(method === "GET" ? [] : [`-X ${method}`])];
  if (operation.security === undefined) parts.push("-H 'Authorization: Bearer KEY'");
  const [type, content] = Object.entries(operation.requestBody?.content ?? {})[0] ?? [];
  if (type) parts.push(`-H 'Content-Type: ${type}'`, content?.example === undefined ? "--data-binary @body.json" : "--data-binary @example.json");
  return [...parts, `'${origin}${path}${query ? `?${query}` : ""}'`].join(" ");
}
