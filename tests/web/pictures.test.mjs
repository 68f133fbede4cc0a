// The pictures of docs/page against the page as it is: what looks otherwise is either a mistake, or wants new pictures
// (scripts/web_pictures.sh) that somebody has looked at.
import assert from 'node:assert/strict';
import { mkdtemp, readFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { after, before, test } from 'node:test';
import { startBrowser } from './support/browser.mjs';
import { kStored, nameOf, startPlaces, take } from './support/views.mjs';

const stored = fileURLToPath(new URL('../../docs/page', import.meta.url));
/** Where times stand. */
const kTimes = '.state, .rows dd, .cm-cursor';
const kBlock = 24;     // px: a picture is compared block by block, so that a line that is missing counts
const kLevel = 60;     // of 255: two colours that are not the same, whatever the edges of letters look like
const kShare = 0.06;   // of a block that may differ

let places;
let browser;
let folder;

before(async () => {
  places = await startPlaces();
  browser = await startBrowser();
  folder = await mkdtemp(join(tmpdir(), 'snapthrough-pictures-'));
});
after(async () => {
  await browser?.close();
  await places?.stop();
});

/** Runs in a browser's page. @returns how the second of two PNGs differs from the first outside of boxes, or "". */
async function difference({ pictures, boxes, block, level, share }) {
  const pixels = await Promise.all(pictures.map(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const canvas = new OffscreenCanvas(image.width, image.height).getContext('2d');
    canvas.drawImage(image, 0, 0);
    return canvas.getImageData(0, 0, image.width, image.height);
  }));
  const [one, other] = pixels;
  if (one.width !== other.width || one.height !== other.height) {
    return `${other.width} x ${other.height} px instead of ${one.width} x ${one.height}`;
  }
  const hidden = (x, y) => boxes.some((box) =>
    x + block > box.x && x < box.x + box.width && y + block > box.y && y < box.y + box.height);
  const differs = (at) => [0, 1, 2].some((c) => Math.abs(one.data[at + c] - other.data[at + c]) > level);
  const places = [];
  for (let y = 0; y < one.height; y += block) {
    for (let x = 0; x < one.width; x += block) {
      let count = 0;
      for (let v = y; v < Math.min(y + block, one.height); ++v) {
        for (let u = x; u < Math.min(x + block, one.width); ++u) count += differs(4 * (v * one.width + u)) ? 1 : 0;
      }
      if (count > share * block * block && !hidden(x, y)) places.push(`(${x}, ${y})`);
    }
  }
  return places.length === 0 ? '' : `${places.length} blocks differ: ${places.slice(0, 8).join(' ')}`;
}

const boxesOf = (page) => page.locator(kTimes).evaluateAll((all) => all.map((one) => {
  const { x, y, width, height } = one.getBoundingClientRect();
  return { x: x + scrollX, y: y + scrollY, width, height };
}));

for (const picture of kStored) {
  test(`${nameOf(picture)} is as it was`, async () => {
    const path = join(folder, nameOf(picture));
    const boxes = await take(browser, places, picture, { path }, boxesOf);
    const pictures = await Promise.all([join(stored, nameOf(picture)), path].map(async (file) => (await readFile(file)).toString('base64')));
    const page = await browser.newPage();
    const found = await page.evaluate(difference, { pictures, boxes, block: kBlock, level: kLevel, share: kShare });
    await page.close();
    assert.equal(found, '', `see ${path}`);
  });
}
