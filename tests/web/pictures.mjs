// Pictures of the page for the docs. scripts/web_pictures.sh runs it.
import { mkdir } from 'node:fs/promises';
import { join } from 'node:path';
import { openPage, settled, slide, startBrowser } from './support/browser.mjs';
import { startService } from './support/service.mjs';

const folder = process.argv[2];
const service = await startService();
const browser = await startBrowser();
await mkdir(folder, { recursive: true });

const kDesk = { width: 1440, height: 900 };
const kSmall = { width: 1024, height: 768 };
const kPhone = { width: 390, height: 844 };

async function picture(name, hash, { size = kDesk, scheme = 'light', whole = false, prepare = async () => {} } = {}) {
  const page = await openPage(browser, `${service.url}/${hash}`, { viewport: size, colorScheme: scheme });
  await prepare(page);
  await page.waitForTimeout(1500);  // states along the path have come
  await page.screenshot({ path: join(folder, `${name}.png`), fullPage: whole });
  await page.context().close();
}

/** The soil is made stiffer, with the run before pinned. */
async function compare(page) {
  await settled(page);
  await page.getByRole('button', { name: 'Pin this run' }).click();
  await slide(page, 'Soil stiffness', 350);
  await settled(page);
  await page.waitForTimeout(600);
  await slide(page, 'Soil stiffness', 800);
  await settled(page);
}

async function startSweep(page) {
  await settled(page);
  await page.getByRole('tab', { name: 'Sweep' }).click();
  await page.getByRole('button', { name: 'Add a second parameter' }).click();
  await page.getByRole('button', { name: 'Start the sweep' }).click();
  await page.locator('.badge', { hasText: 'successful' }).waitFor({ timeout: 60_000 });
  await page.locator('.sweep-chart svg').waitFor();
}

await picture('studio', '#/studio', { prepare: compare });
await picture('studio-dark', '#/studio?problem=tunnel_arch', { scheme: 'dark', prepare: settled });
await picture('studio-1024', '#/studio?problem=column_between_walls', { size: kSmall, prepare: settled });
await picture('studio-phone', '#/studio?problem=film_on_substrate', { size: kPhone, whole: true, prepare: settled });
await picture('gallery', '#/studio', { prepare: async (page) => {
  await settled(page);
  await page.getByRole('button', { name: 'Gallery' }).click();
} });
await picture('json', '#/model', { prepare: (page) => page.locator('.cm-content').waitFor() });
await picture('sweep', '#/studio', { prepare: startSweep });
await picture('jobs', '#/jobs', { prepare: (page) => page.locator('tbody tr').first().waitFor() });

await browser.close();
await service.stop();
