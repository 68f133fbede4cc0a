// Writes clients/js/src/types.ts from the OpenAPI document.
import { writeFile } from 'node:fs/promises';
import openapiTS, { astToString } from 'openapi-typescript';

const source = new URL('../../api/openapi/openapi.json', import.meta.url);
const target = new URL('../../clients/js/src/types.ts', import.meta.url);
const head = '// Made by web/tools/types.mjs from api/openapi/openapi.json. Do not edit.\n';
const text = head + astToString(await openapiTS(source, { defaultNonNullable: false }));

await writeFile(target, text);
