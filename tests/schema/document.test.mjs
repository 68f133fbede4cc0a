// The document itself: linted, closed, described, with units; and every schema compiles.
import assert from 'node:assert/strict';
import {test} from 'node:test';

import {lint, loadConfig} from '@redocly/openapi-core';

import {document, documentPath, walkAll} from './support/document.mjs';
import {validatorOf} from './support/validator.mjs';

const configPath = new URL('redocly.yaml', import.meta.url).pathname;

test('the linter has nothing to say', async () => {
  const problems = await lint({ref: documentPath, config: await loadConfig({configPath})});
  assert.deepEqual(problems.map((p) => `${p.severity} ${p.ruleId} ${p.location[0].pointer}: ${p.message}`), []);
});

test('the linter does look', async () => {
  const {lintFromString} = await import('@redocly/openapi-core');
  const spoilt = structuredClone(document);
  delete spoilt.paths['/v1/jobs'].get.operationId;
  spoilt.components.schemas.Node.type = 'thing';
  spoilt.components.schemas.Unused = {type: 'string'};
  const problems = await lintFromString({source: JSON.stringify(spoilt), config: await loadConfig({configPath})});
  // examples of requests have nodes, whose type is spoilt
  assert.deepEqual(new Set(problems.map((p) => p.ruleId)),
                   new Set(['operation-operationId', 'struct', 'no-unused-components', 'no-invalid-media-type-examples']));
});

test('no schema is an open object', () => {
  const open = [];
  let objects = 0;
  walkAll((schema, where, role) => {
    // `items: false` ends a tuple; `contains` and `not` only restrict; the parts of an exclusive pair of requirements add to a
    // closed object.
    if (['contains', 'not'].includes(role) || where.includes('/contains/')) return;
    if (role === 'items' && schema === false) return;
    if (role === 'additionalProperties' && schema === false) return;
    // What else Hops sends is passed over. A type for it would be that of the fields that are named, too.
    if (where === '/components/schemas/HopsCall/additionalProperties' && schema === true) return;
    const named = ['$ref', 'type', 'const', 'enum', 'oneOf', 'anyOf'].some((key) => key in schema);
    if (schema === true || !named) return open.push(where);
    if (schema.type !== 'object' && !schema.properties) return;
    const onlyRequires = !schema.properties && schema.required;
    objects += 1;
    if (schema.additionalProperties === undefined && !onlyRequires) open.push(where);
  });
  assert.deepEqual(open, []);
  assert.ok(objects > 80, `${objects} objects`);
});

test('every field, parameter, header and response is described', () => {
  const bare = [];
  let fields = 0;
  walkAll((schema, where, role) => {
    if (!['properties', 'component', 'prefixItems'].includes(role)) return;
    fields += 1;
    if (!(schema.description?.trim().length > 2) && !schema.$ref) bare.push(where);
    if (role === 'properties' && !schema.description) bare.push(where);
  });
  const inside = (part, where) => {
    if (part === null || typeof part !== 'object') return;
    for (const [key, value] of Object.entries(part)) {
      if (['responses', 'headers'].includes(key)) {
        for (const [name, one] of Object.entries(value)) if (!one.description && !one.$ref) bare.push(`${where}/${key}/${name}`);
      }
      if (key === 'parameters') {
        for (const one of Object.values(value)) if (!one.description && !one.$ref) bare.push(`${where}/${key}/${one.name}`);
      }
      if (['get', 'post', 'delete'].includes(key) && !value.summary) bare.push(`${where}/${key}`);
      if (!['schema', 'example'].includes(key)) inside(value, `${where}/${key}`);
    }
  };
  inside(document.paths, '/paths');
  inside(document.components.responses, '/components/responses');
  inside({parameters: document.components.parameters}, '/components');
  assert.deepEqual(bare, []);
  assert.ok(fields > 400, `${fields} fields`);
});

test('every number of the request and the result has a unit', () => {
  const without = [];
  let numbers = 0;
  walkAll((schema, where) => {
    const types = [schema.type].flat();
    if (!where.startsWith('/components/schemas/') || where.includes('JsonValue') || where.endsWith('/not')) return;
    if (!types.includes('number') && !types.includes('integer')) return;
    numbers += 1;
    if (!schema['x-unit']) without.push(where);
  });
  assert.deepEqual(without, []);
  assert.ok(numbers > 200, `${numbers} numbers`);
});

test('defaults obey their schemas', () => {
  let defaults = 0;
  walkAll((schema, where) => {
    const value = schema['x-default'] ?? schema.default;
    if (value === undefined) return;
    defaults += 1;
    assert.ok(validatorOf(schema, where)(value), where);
  });
  assert.ok(defaults > 30, `${defaults} defaults`);
});

test('every schema compiles in strict mode', () => {
  walkAll((schema, where, role) => {
    if (role === 'component' || role === 'schema') validatorOf(schema, where);
  });
});
