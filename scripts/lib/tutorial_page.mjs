// Takes docs/tutorial_page.png, the sweep of docs/tutorial.md on the page: node scripts/lib/tutorial_page.mjs SNAPTHROUGH
// It needs the packages that scripts/web_pictures.sh installs in tests/web.
import { readFile } from 'node:fs/promises';
import { resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

process.env.SERVICE_EXECUTABLE = resolve(process.argv[2]);
const { openPage, startBrowser } = await import('../../tests/web/support/browser.mjs');
const { startService } = await import('../../tests/web/support/service.mjs');

const docs = fileURLToPath(new URL('../../docs', import.meta.url));
const kRest = 900;  // ms after which the chart stands still

/** The sweep that the tutorial's last section builds: its request along the stiffness of the clay. */
async function sweepOfTutorial() {
  const text = await readFile(`${docs}/tutorial.md`, 'utf8');
  const request = JSON.parse(text.match(/^```json micropile\.json\n(.*?)^```/ms)[1]);
  const targets = [{ pointer: '/model/foundations/0/stiffness' }];
  return {
    ...request, design: 'grid', parameters: [{ name: 'clay: stiffness', targets, range: { from: 10, to: 1000, count: 41, spacing: 'log' } }],
    outputs: ['/summary/critical_load_factor', '/summary/critical_type', '/summary/error_estimate'],
  };
}

const service = await startService();
const browser = await startBrowser();
try {
  const answer = await fetch(`${service.url}/v1/sweeps`, {
    method: 'POST', headers: { 'Content-Type': 'application/json', Prefer: 'return=minimal' }, body: JSON.stringify(await sweepOfTutorial()),
  });
  const id = answer.headers.get('Location').split('/').pop();
  const { status } = await (await fetch(`${service.url}/v1/sweeps/${id}`, { headers: { Prefer: 'wait=60' } })).json();
  if (status !== 'successful') {
    throw new Error(`the sweep is ${status}`);
  }
  const page = await openPage(browser, 'about:blank', { viewport: { width: 1440, height: 820 }, colorScheme: 'light' });
  await page.goto(`${service.url}/#/sweeps/${id}`);
  await page.locator('.sweep-chart svg').waitFor();
  await page.waitForTimeout(kRest);
  await page.screenshot({ animations: 'disabled', path: `${docs}/tutorial_page.png` });
} finally {
  await browser.close();
  await service.stop();
}
