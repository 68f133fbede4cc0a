// Types that openapi-typescript makes of the document, and programs that use every field against them.
import assert from 'node:assert/strict';
import {spawnSync} from 'node:child_process';
import {mkdirSync, readFileSync, writeFileSync} from 'node:fs';
import {test} from 'node:test';
import {fileURLToPath} from 'node:url';

import {dereferenced, documentPath, fieldsOf} from './support/document.mjs';

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const program = here('client/every_field.ts');

function run(tool, ...options) {
  const done = spawnSync(process.execPath, [here(`node_modules/${tool}`), ...options], {encoding: 'utf8'});
  return {status: done.status, text: done.stdout + done.stderr};
}

function makeTypes() {
  mkdirSync(here('client/generated'), {recursive: true});
  // As a user calls it: with its own options a field with a default would be required.
  const made = run('openapi-typescript/bin/cli.js', documentPath, '-o', here('client/generated/snapthrough.d.ts'));
  assert.equal(made.status, 0, made.text);
}

/** The type in TypeScript of the values that a schema allows; `object` for objects and lists. */
function typeOf(schema) {
  const at = dereferenced(schema);
  if ('const' in at) return JSON.stringify(at.const);
  if (at.enum) return at.enum.map((one) => JSON.stringify(one)).join(' | ');
  if (at.anyOf) return at.anyOf.map(typeOf).join(' | ');
  const names = {number: 'number', integer: 'number', string: 'string', boolean: 'boolean', null: 'null'};
  return [at.type].flat().map((type) => names[type] ?? 'object').join(' | ');
}

/** The type that the generated types give the field at a path such as `branches[].monitors.ID`. */
function placeOf(path) {
  const tokens = path.replaceAll('[]', '.[]').split('.');
  return tokens.reduce((type, token) => {
    const key = {'[]': 'number', ID: 'string', NODE: 'string'}[token] ?? `'${token}'`;
    return `NonNullable<${type}>[${key}]`;
  }, 'Result');
}

/** A program that compiles only if the generated types give every field of a result the type of its schema. */
function makeReader() {
  const lines = fieldsOf('Result').map(({path, forms}, i) => {
    const types = [...new Set(forms.map(typeOf))].join(' | ');
    const check = types.includes('object') ? 'Fits' : 'Is';
    return `export const field${i}: ${check}<${placeOf(path)}, ${types}> = true; // ${path}`;
  });
  writeFileSync(here('client/generated/every_result.ts'), `import type {components} from './snapthrough.js';
type Result = components['schemas']['Result'];
type IsAny<T> = 0 extends 1 & T ? true : false;
type Fits<T, Wanted> = IsAny<T> extends true ? false : [Exclude<T, undefined>] extends [Wanted] ? true : false;
type Is<T, Wanted> = Fits<T, Wanted> extends true ? [Wanted] extends [Exclude<T, undefined>] ? true : false : false;
${lines.join('\n')}
`);
  return lines.length;
}

const compile = (project) => run('typescript/bin/tsc', '-p', here(project));

test('a client of the generated types compiles', () => {
  makeTypes();
  assert.ok(makeReader() > 120);
  const {status, text} = compile('client');
  assert.equal(status, 0, text);
});

test('the client uses every field of request and sweep', () => {
  const text = readFileSync(program, 'utf8').replace(/\/\/.*/g, '');
  const names = new Set(['Request', 'SweepDocument'].flatMap((schema) => fieldsOf(schema).map(
      ({path}) => path.split('.').at(-1))));
  const unused = [...names].filter((name) => !new RegExp(`\\b${name}\\b`).test(text));
  assert.deepEqual(unused, []);
  assert.ok(names.size > 80, `${names.size} names`);
});

test('a client that uses a field wrongly does not compile', () => {
  makeTypes();
  const bodies = ['result.critical_points[0]!.load_facto', 'result.summary.critical_load_factor.toFixed()',
                  'result.states[0]!.members["beam"].x0', 'result.buckling.modes', 'result.critical_points[0]!.load_factor'];
  const files = bodies.map((body, i) => `program_${i}.ts`);
  const project = here('client/generated/tsconfig.json');
  writeFileSync(project, JSON.stringify({extends: '../tsconfig.json', files}));
  bodies.forEach((body, i) => writeFileSync(here(`client/generated/${files[i]}`),
      `import type {components} from './snapthrough.js';
export const read = (result: components['schemas']['Result']) => ${body};\n`));
  const {text} = compile('client/generated/tsconfig.json');
  assert.deepEqual(files.filter((file) => text.includes(`${file}(`)), files.slice(0, -1), text);
});
