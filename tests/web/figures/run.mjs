// Bundles the tests of the figures with esbuild (from web/node_modules, see scripts/web.sh) and runs them:
//   node tests/web/figures/run.mjs [name of a test file without .test.ts ...]
import { spawnSync } from "node:child_process";
import { mkdtempSync, readdirSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const web = join(here, "../../../web");
const { buildSync } = createRequire(join(web, "package.json"))("esbuild");
const wanted = process.argv.slice(2);
const tests = readdirSync(here).filter((name) => name.endsWith(".test.ts"))
  .filter((name) => wanted.length === 0 || wanted.includes(name.replace(".test.ts", "")));
if (tests.length === 0) {
  console.error(`no test file is called ${wanted.join(", ")}`);
  process.exit(1);
}
const folder = mkdtempSync(join(tmpdir(), "figures-"));
try {
  buildSync({
    entryPoints: tests.map((name) => join(here, name)), outdir: folder, outExtension: { ".js": ".mjs" },
    bundle: true, platform: "node", format: "esm", target: "node18", sourcemap: "inline", logLevel: "warning",
    define: { CASES: JSON.stringify(join(here, "cases")), FIGURES: JSON.stringify(join(web, "src/figures")),
      ROOT: JSON.stringify(join(web, "..")) },
  });
  const files = tests.map((name) => join(folder, name.replace(/\.ts$/, ".mjs")));
  const { status } = spawnSync(process.execPath, ["--enable-source-maps", "--test", ...files], { stdio: "inherit" });
  process.exitCode = status ?? 1;
} finally {
  rmSync(folder, { recursive: true });
}
