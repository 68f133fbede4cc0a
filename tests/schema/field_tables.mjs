// Writes the tables of fields in docs/ from the document:  node field_tables.mjs --write
// Without an option it tells which pages are out of date (exit status 1).
import {readFileSync, writeFileSync} from 'node:fs';
import {fileURLToPath} from 'node:url';

import {dereferenced, fieldsOf, root} from './support/document.mjs';

const kPages = [['docs/requests.md', 'Request'], ['docs/results.md', 'Result']];

/** What of a schema fits on a line: its type and range, or its names. */
function values(schema) {
  const at = dereferenced(schema);
  if ('const' in at) return `\`${JSON.stringify(at.const)}\``;
  if (at.enum) return at.enum.length > 8 ? 'a code' : at.enum.map((one) => `\`${JSON.stringify(one)}\``).join(', ');
  const forms = at.oneOf ?? at.anyOf;
  if (forms) return [...new Set(forms.map(values))].join(' or ');
  if (at.prefixItems) return `[${at.prefixItems.map(values).join(', ')}]`;
  if (at.type === 'array') return `list${count(at, 'minItems', 'maxItems')} of ${values(at.items)}`;
  if (at.type === 'object') return at.properties ? 'object' : `object by id of ${values(at.additionalProperties)}`;
  return [at.type].flat().map((type) => (type === 'null' ? 'null' : type + range(at))).join(' or ');
}

function count(at, least, most) {
  if (at[least] === undefined && at[most] === undefined) return '';
  return ` (${at[least] ?? 0}${at[most] === undefined ? ' or more' : ` to ${at[most]}`})`;
}

function range(at) {
  if (at.type === 'string') return '';
  const wide = (value) => value === undefined || Math.abs(value) >= 1e150;
  const lower = at.exclusiveMinimum !== undefined ? `> ${at.exclusiveMinimum}` : wide(at.minimum) ? '' : `>= ${at.minimum}`;
  const upper = at.exclusiveMaximum !== undefined ? `< ${at.exclusiveMaximum}` : wide(at.maximum) ? '' : `<= ${at.maximum}`;
  return ` ${[lower, upper].filter(Boolean).join(', ')}`.trimEnd();
}

/** Units of a field, of its items and of its alternatives. */
function units(schema, found = new Set()) {
  const at = dereferenced(schema);
  const unit = schema['x-unit'] ?? at['x-unit'];
  if (unit) found.add(unit);
  for (const one of [...(at.oneOf ?? []), ...(at.anyOf ?? []), ...(at.prefixItems ?? [])]) if (!one.properties) units(one, found);
  if (at.items) units(at.items, found);
  if (at.additionalProperties && !at.properties) units(at.additionalProperties, found);
  return found;
}

const unique = (list) => [...new Set(list)];

function row({path, forms, required}) {
  const texts = unique(forms.map((form) => form.description));
  const kinds = unique(forms.map(values));
  const measures = unique(forms.flatMap((form) => [...(dereferenced(form).properties ? [] : units(form))]));
  const preset = forms.map((form) => form.default ?? dereferenced(form).default).find((one) => one !== undefined);
  const about = kinds.join(' or ') + (preset === undefined ? '' : `; default \`${JSON.stringify(preset)}\``);
  return `| \`${path}\`${required ? '' : ' ?'} | ${about} | ${measures.join('; ')} | ${texts.join(' / ')} |`.replaceAll('\n', ' ');
}

const table = (name) => ['| field | values | unit | what |', '| --- | --- | --- | --- |', ...fieldsOf(name).map(row)].join('\n');

/** Pages as they are and as they should be. */
export function pages() {
  return kPages.map(([name, schema]) => {
    const path = fileURLToPath(new URL(name, root));
    const text = readFileSync(path, 'utf8');
    const marks = new RegExp(`(<!-- fields of ${schema} -->\n)[^]*?(<!-- end of fields -->)`);
    if (!marks.test(text)) throw new Error(`${name} has no place for the fields of ${schema}`);
    return {name, path, text, wanted: text.replace(marks, (all, begin, end) => `${begin}\n${table(schema)}\n\n${end}`)};
  });
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const stale = pages().filter(({text, wanted}) => text !== wanted);
  for (const {name, path, wanted} of stale) {
    if (process.argv.includes('--write')) writeFileSync(path, wanted);
    console.log(`${name}: ${process.argv.includes('--write') ? 'written' : 'out of date'}`);
  }
  process.exitCode = stale.length > 0 && !process.argv.includes('--write') ? 1 : 0;
}
