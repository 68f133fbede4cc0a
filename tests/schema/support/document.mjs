// The published document and walks through its schemas.
import {readFileSync} from 'node:fs';

export const root = new URL('../../../', import.meta.url);
export const documentPath = new URL('api/openapi/openapi.json', root).pathname;
export const document = JSON.parse(readFileSync(documentPath, 'utf8'));
export const schemas = document.components.schemas;

export function resolve(reference) {
  return reference.slice(2).split('/').reduce(
      (at, token) => at[token.replaceAll('~1', '/').replaceAll('~0', '~')], document);
}

/** A part of the document, or what it refers to. */
export const dereferenced = (part) => (part?.$ref ? resolve(part.$ref) : part);

/** Keywords whose values are schemas: one, a list, or a map. */
const kOne = ['items', 'additionalProperties', 'propertyNames', 'contains', 'not', 'contentSchema'];
const kLists = ['oneOf', 'anyOf', 'allOf', 'prefixItems'];

/**
 * Calls visit(schema, where, role) for a schema and all that is inside it, not through references. `role` is the keyword that
 * the schema stands at.
 */
export function walk(schema, where, visit, role = 'schema') {
  visit(schema, where, role);
  for (const key of kOne) {
    if (schema[key] !== undefined) walk(schema[key], `${where}/${key}`, visit, key);
  }
  for (const key of kLists) {
    (schema[key] ?? []).forEach((one, i) => walk(one, `${where}/${key}/${i}`, visit, key));
  }
  for (const [name, one] of Object.entries(schema.properties ?? {})) {
    walk(one, `${where}/properties/${name}`, visit, 'properties');
  }
}

/** Every schema of the document: components, parameters, headers, bodies and responses. */
export function walkAll(visit) {
  for (const [name, schema] of Object.entries(schemas)) walk(schema, `/components/schemas/${name}`, visit, 'component');
  const inside = (part, where) => {
    if (part === null || typeof part !== 'object') return;
    for (const [key, value] of Object.entries(part)) {
      if (key === 'schema') walk(value, `${where}/schema`, visit);
      else inside(value, `${where}/${key}`);
    }
  };
  inside(document.paths, '/paths');
  inside(document.components.parameters, '/components/parameters');
  inside(document.components.responses, '/components/responses');
}

/**
 * The fields of a schema as {path, forms, required}, references followed: `a.b`, `a[].b` for items of lists, `a.ID.b` for maps by id. A
 * path that several alternatives have comes once, with the schema of each in `forms`.
 */
export function fieldsOf(name) {
  const found = new Map();
  const inside = (schema, path) => {
    if (schema.$ref?.endsWith('/JsonValue')) return;
    const at = dereferenced(schema);
    for (const alternative of [...(at.oneOf ?? []), ...(at.anyOf ?? []), ...(at.prefixItems ?? [])]) inside(alternative, path);
    for (const [key, one] of Object.entries(at.properties ?? {})) {
      const field = path ? `${path}.${key}` : key;
      if (!found.has(field)) found.set(field, {path: field, forms: [], required: at.required?.includes(key) ?? false});
      found.get(field).forms.push(one);
      inside(one, field);
    }
    if (at.items) inside(at.items, `${path}[]`);
    if (at.additionalProperties) {
      const node = ['supports', 'nodes'].includes(at['x-ids']);
      inside(at.additionalProperties, `${path}.${node ? 'NODE' : 'ID'}`);
    }
  };
  inside(schemas[name], '');
  return [...found.values()];
}
