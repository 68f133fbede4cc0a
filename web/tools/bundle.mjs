// Bundles src/main.tsx into dist/ (index.html and assets/), and fails when the page is larger than it may be.
//   node tools/bundle.mjs             writes dist/
//   node tools/bundle.mjs FOLDER      writes FOLDER instead
//   node tools/bundle.mjs --watch     writes dist/ again whenever a source changes
import { mkdir, readFile, rm, writeFile } from 'node:fs/promises';
import { basename, join, relative, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import esbuild from 'esbuild';

const root = fileURLToPath(new URL('..', import.meta.url));
const first = 120_000;  // bytes, gzip: what a browser loads before it shows the studio
const whole = 260_000;  // with everything that is loaded when it is opened
const given = process.argv[2];
const watching = given === '--watch';
const folder = given && !watching ? resolve(given) : join(root, 'dist');

/** The outputs that an entry imports, itself included, without those that it loads later. */
function staticImports(outputs, name, found = new Set()) {
  if (!found.has(name)) {
    found.add(name);
    for (const one of outputs[name].imports) {
      if (one.kind === 'import-statement') {
        staticImports(outputs, one.path, found);
      }
    }
  }
  return found;
}

function indexDocument(template, script, style, preloads) {
  const links = preloads.map((name) => `<link rel="modulepreload" href="/assets/${basename(name)}">`);
  const head = [`<link rel="stylesheet" href="/assets/${basename(style)}">`, ...links,
                `<script type="module" src="/assets/${basename(script)}"></script>`];
  return template.replace('<!-- head -->', head.join('\n'));
}

/** @returns bytes by file, with the gzip size of the first view and of all. */
function report(files, early) {
  const sizes = { first: 0, whole: 0 };
  for (const [name, content] of files) {
    const packed = gzipSync(content, { level: 9 }).length;
    sizes.whole += packed;
    sizes.first += early.has(name) ? packed : 0;
    console.log(`${String(packed).padStart(8)}  ${early.has(name) ? 'first' : 'later'}  ${name}`);
  }
  console.log(`${String(sizes.first).padStart(8)}  of ${first} for the first view`);
  console.log(`${String(sizes.whole).padStart(8)}  of ${whole} for all`);
  return sizes.first <= first && sizes.whole <= whole;
}

async function write(result) {
  const { outputs } = result.metafile;
  const entry = Object.keys(outputs).find((name) => outputs[name].entryPoint === 'src/main.tsx');
  const style = outputs[entry].cssBundle;
  const early = new Set([...staticImports(outputs, entry), style]);
  const preloads = [...early].filter((name) => name !== entry && name !== style).sort();
  const template = await readFile(join(root, 'src/index.html'), 'utf8');
  const files = new Map([['index.html', Buffer.from(indexDocument(template, entry, style, preloads))]]);
  files.set('assets/icon.svg', await readFile(join(root, 'src/icon.svg')));
  for (const output of result.outputFiles.sort((a, b) => (a.path < b.path ? -1 : 1))) {
    files.set(`assets/${basename(output.path)}`, Buffer.from(output.contents));
  }
  await rm(folder, { recursive: true, force: true });
  await mkdir(join(folder, 'assets'), { recursive: true });
  for (const [name, content] of files) {
    await writeFile(join(folder, name), content);
  }
  const loaded = new Set(['index.html', 'assets/icon.svg', ...[...early].map((name) => `assets/${basename(name)}`)]);
  return report(files, loaded);
}

/** `import text from "x.css?text"`: the style sheet, minified, as a string. Its path is part of names: relative. */
const styleText = {
  name: 'style-text',
  setup(build) {
    build.onResolve({ filter: /\.css\?text$/ }, ({ path, resolveDir }) =>
      ({ path: relative(root, resolve(resolveDir, path.replace('?text', ''))), namespace: 'style-text' }));
    build.onLoad({ filter: /.*/, namespace: 'style-text' }, async ({ path }) => {
      const { code } = await esbuild.transform(await readFile(join(root, path), 'utf8'), { loader: 'css', minify: true });
      return { contents: code, loader: 'text' };
    });
  },
};

const options = {
  absWorkingDir: root,
  entryPoints: { app: 'src/main.tsx' },
  outdir: 'out',
  entryNames: '[name]-[hash]',
  chunkNames: '[name]-[hash]',
  assetNames: '[name]-[hash]',
  bundle: true,
  splitting: true,
  format: 'esm',
  target: ['es2021', 'chrome100', 'firefox100', 'safari15.4'],
  jsx: 'automatic',
  jsxImportSource: 'preact',
  minify: true,
  charset: 'utf8',
  legalComments: 'none',
  metafile: true,
  write: false,
  logLevel: 'warning',
  plugins: [styleText],
};

if (watching) {
  const context = await esbuild.context({
    ...options,
    plugins: [styleText, { name: 'write', setup: (build) => build.onEnd(async (result) => {
      if (result.errors.length === 0) {
        await write(result);
      }
    }) }],
  });
  await context.watch();
} else if (!(await write(await esbuild.build(options)))) {
  console.error('The page is larger than it may be.');
  process.exit(1);
}
