// Compiles clients/js/src into modules with their types.
//   node tools/client.mjs            writes clients/js/dist
//   node tools/client.mjs FOLDER     writes FOLDER instead
import { rm } from 'node:fs/promises';
import { resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import ts from 'typescript';

const root = fileURLToPath(new URL('../../clients/js', import.meta.url));
const folder = process.argv[2] ? resolve(process.argv[2]) : `${root}/dist`;
const read = ts.getParsedCommandLineOfConfigFile(`${root}/tsconfig.json`, { outDir: folder }, {
  ...ts.sys, onUnRecoverableConfigFileDiagnostic: (one) => { throw new Error(ts.flattenDiagnosticMessageText(one.messageText, '\n')); },
});
await rm(folder, { recursive: true, force: true });
const program = ts.createProgram(read.fileNames, read.options);
const emitted = program.emit();
const found = [...read.errors, ...ts.getPreEmitDiagnostics(program), ...emitted.diagnostics];
if (found.length > 0) {
  console.error(ts.formatDiagnostics(found, { getCanonicalFileName: (name) => name, getCurrentDirectory: () => root, getNewLine: () => '\n' }));
  process.exit(1);
}
