// Pictures of every view of the page, taken from the running executable.
//   node tests/web/pictures.mjs               writes docs/page/: the pictures that pictures.test.mjs compares with the page
//   node tests/web/pictures.mjs --all FOLDER  every view at every size, light and dark
//   node tests/web/pictures.mjs --all FOLDER NAME...   these views only
// scripts/web_pictures.sh runs it. SERVICE_EXECUTABLE names the executable; PAGE_FOLDER a page in place of the one that is built in.
import { mkdir, stat } from 'node:fs/promises';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { startBrowser } from './support/browser.mjs';
import { kSizes, kStored, kViews, nameOf, startPlaces, take } from './support/views.mjs';

const root = fileURLToPath(new URL('../..', import.meta.url));
const kMost = 3_000_000;  // bytes of all pictures in docs/page
/** Which pictures, and in which files. */
function plan(all, names) {
  if (!all) {
    return kStored;
  }
  const views = Object.keys(kViews).filter((view) => names.length === 0 || names.includes(view));
  return views.flatMap((view) => Object.keys(kSizes).flatMap((size) => ['light', 'dark'].map((scheme) => [view, size, scheme])));
}

async function main() {
  const [flag, given, ...names] = process.argv.slice(2);
  const all = flag === '--all';
  const folder = all ? given : join(root, 'docs/page');
  await mkdir(folder, { recursive: true });
  const places = await startPlaces();
  const browser = await startBrowser();
  let bytes = 0;
  try {
    for (const picture of plan(all, names)) {
      const path = join(folder, nameOf(picture));
      await take(browser, places, picture, { path });
      bytes += (await stat(path)).size;
      console.log(nameOf(picture));
    }
  } finally {
    await browser.close();
    await places.stop();
  }
  console.log(`${bytes} bytes`);
  if (!all && bytes > kMost) {
    throw new Error(`more than ${kMost} bytes of pictures`);
  }
}

await main();
