// Writes clients/js/src/types.ts from the OpenAPI document; with --check only compares, so that a renamed field breaks the build.
import { readFile, writeFile } from 'node:fs/promises';
import openapiTS, { astToString } from 'openapi-typescript';

const source = new URL('../../api/openapi/openapi.json', import.meta.url);
const target = new URL('../../clients/js/src/types.ts', import.meta.url);
const head = '// Made by web/tools/types.mjs from api/openapi/openapi.json. Do not edit.\n';
const text = head + astToString(await openapiTS(source, { defaultNonNullable: false }));

if (!process.argv.includes('--check')) {
  await writeFile(target, text);
} else if ((await readFile(target, 'utf8').catch(() => '')) !== text) {
  console.error('clients/js/src/types.ts is not what api/openapi/openapi.json gives; run scripts/web.sh --types');
  process.exit(1);
}
