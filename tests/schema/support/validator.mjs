// ajv with the document's vocabulary.
import Ajv2020 from 'ajv/dist/2020.js';

import {document} from './document.mjs';

const ajv = new Ajv2020({
  strict: true,
  strictRequired: false,  // dependentRequired and the two forms of a sweep's parameter name fields of the object around them
  strictTypes: false,     // the same
  allowUnionTypes: true,
  allErrors: true,
  formats: {'date-time': /^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(\.\d+)?Z$/},
});
// discriminator: which of oneOf it is; oneOf says the same, and that of ajv takes no mapping
for (const keyword of ['x-unit', 'x-ids', 'x-analysis', 'x-column', 'x-default', 'x-names', 'discriminator']) ajv.addKeyword({keyword});
ajv.addKeyword({keyword: 'components'});
ajv.addSchema({$id: 'snapthrough', components: document.components});

const compiled = new Map();

/** A function that tells whether a value is valid; its `errors` say why not. */
export function validatorOf(schema, where = JSON.stringify(schema)) {
  if (!compiled.has(where)) {
    const absolute = JSON.parse(JSON.stringify(schema, (key, value) => (key === '$ref' ? `snapthrough${value}` : value)));
    compiled.set(where, ajv.compile(absolute));
  }
  return compiled.get(where);
}

export const validatorNamed = (name) => validatorOf({$ref: `#/components/schemas/${name}`}, name);

/** What is wrong with a value, as lines. */
export function faults(validate, value) {
  if (validate(value)) return [];
  return validate.errors.map((e) => `${e.instancePath} ${e.message} ${JSON.stringify(e.params)}`);
}
