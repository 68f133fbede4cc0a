// The size of what people have to read, as scripts/check_shape.py has it for C++ and Python: functions under 60 lines, files under
// 800, nesting under 5. Of the page, the JavaScript client, the page's tools, its tests and its benchmarks.
//   node tools/shape.mjs [FILE...]
import { readdirSync, readFileSync } from 'node:fs';
import { join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import ts from 'typescript';

const root = fileURLToPath(new URL('../..', import.meta.url));
const kMost = { lines: 60, file: 800, depth: 4 };
const kGenerated = 'clients/js/src/types.ts';

function sources(folder) {
  return readdirSync(join(root, folder), { withFileTypes: true }).flatMap((entry) => {
    const path = `${folder}/${entry.name}`;
    if (entry.isDirectory()) return ['node_modules', 'dist', 'generated'].includes(entry.name) ? [] : sources(path);
    return /\.(tsx?|mjs)$/.test(entry.name) && path !== kGenerated ? [path] : [];
  });
}

const kBlocks = new Set([
  ts.SyntaxKind.IfStatement, ts.SyntaxKind.ForStatement, ts.SyntaxKind.ForOfStatement, ts.SyntaxKind.ForInStatement,
  ts.SyntaxKind.WhileStatement, ts.SyntaxKind.DoStatement, ts.SyntaxKind.SwitchStatement, ts.SyntaxKind.TryStatement,
]);

/** `else if` is no deeper than its `if`. */
function opensBlock(node) {
  return kBlocks.has(node.kind) && !(ts.isIfStatement(node) && ts.isIfStatement(node.parent) && node.parent.elseStatement === node);
}

function check(name, text) {
  const file = ts.createSourceFile(name, text, ts.ScriptTarget.Latest, true);
  const line = (position) => file.getLineAndCharacterOfPosition(position).line + 1;
  const found = [];
  const count = line(file.end);
  if (count > kMost.file) found.push([1, `file of ${count} lines, at most ${kMost.file}`]);
  const visit = (node, depth) => {
    if (ts.isFunctionLike(node) && node.body) {
      const lines = line(node.end) - line(node.getStart()) + 1;
      if (lines > kMost.lines) found.push([line(node.getStart()), `function of ${lines} lines, at most ${kMost.lines}`]);
    }
    const deeper = depth + (opensBlock(node) ? 1 : 0);
    if (deeper > kMost.depth && deeper !== depth) found.push([line(node.getStart()), `nesting deeper than ${kMost.depth}`]);
    ts.forEachChild(node, (child) => visit(child, deeper));
  };
  visit(file, 0);
  return found;
}

function selfTest() {
  const long = `function f() {\n${'x();\n'.repeat(60)}}\n`;
  const deep = 'function f() { if (a) for (;;) while (b) if (c) for (const d of e) x(); }';
  const good = `function f() {\n${'x();\n'.repeat(58)}}\nfunction g() { if (a) x(); else if (b) y(); else if (c) z(); else if (d) x(); else if (e) y(); }`;
  if (check('a.ts', long).length !== 1 || check('a.ts', deep).length !== 1 || check('a.ts', good).length !== 0) {
    throw new Error('the check of shapes is wrong');
  }
}

selfTest();
const files = process.argv.length > 2 ? process.argv.slice(2).map((name) => relative(root, name))
  : ['clients/js/src', 'web/src', 'web/tools', 'tests/web', 'tests/schema', 'tests/clients', 'bench'].flatMap(sources);
let offenders = 0;
for (const name of files) {
  for (const [line, text] of check(name, readFileSync(join(root, name), 'utf8'))) {
    ++offenders;
    console.log(`${name}:${line}: ${text}`);
  }
}
console.log(`shape: ${files.length} files, ${offenders} too long or too deep`);
process.exit(offenders === 0 ? 0 : 1);
