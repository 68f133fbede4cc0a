// Every view of the page as something to look at: how to get there, and its picture.
import { createHash } from 'node:crypto';
import { rm, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { openPage, settled, slide } from './browser.mjs';
import { exampleOf, startService } from './service.mjs';

const kRest = 900;        // ms without a request after which the studio has the states to walk through
const kLongest = 60_000;  // ms
const kKey = 'the key of the pictures';
const kProblems = ['buried_pipe', 'tunnel_arch', 'column_between_walls', 'pile_in_soil', 'portal_sway', 'pipeline_upheaval',
                   'film_on_substrate', 'arch_no_base', 'frame_nearly_unstable', 'frame_portal'];
export const kSizes = { wide: { width: 1440, height: 900 }, tablet: { width: 1024, height: 768 }, phone: { width: 390, height: 844 } };

/** Waits until the page has its answers and asks for nothing more. */
async function still(page) {
  const open = new Set();
  let last = performance.now();
  const begun = (request) => open.add(request);
  const ended = (request) => {
    open.delete(request);
    last = performance.now();
  };
  page.on('request', begun).on('requestfinished', ended).on('requestfailed', ended);
  await settled(page);
  const start = performance.now();
  last = start;
  while (open.size > 0 || performance.now() - last < kRest) {
    if (performance.now() - start > kLongest) {
      throw new Error(`the page still waits for ${open.size} answers`);
    }
    await page.waitForTimeout(50);
  }
  page.off('request', begun).off('requestfinished', ended).off('requestfailed', ended);
}

async function openStudio(page, url, problem) {
  await page.goto(`${url}/#/studio?problem=${problem}`);
  await still(page);
}

/** Soil that was made stiffer, with the run before and a pinned one. */
async function changedStudio(page, url) {
  await openStudio(page, url, 'buried_pipe');
  await page.getByRole('button', { name: 'Pin this run' }).click();
  for (const place of [350, 800]) {
    await slide(page, 'Soil stiffness', place);
    await still(page);
  }
}

/** A model with three mistakes, in the editor. */
async function writeMistakes(page, url) {
  await openStudio(page, url, 'tunnel_arch');
  await page.goto(`${url}/#/model`);
  const editor = page.locator('.cm-content');
  await editor.waitFor();
  const request = await exampleOf(url, 'tunnel_arch');
  request.model.sections[0].EI = -1;
  request.model.members[0].end = 'crwn';
  request.model.supports[0].fxed = ['x'];
  await editor.click();
  await page.keyboard.press('Control+a');
  await page.keyboard.insertText(JSON.stringify(request, null, 2));
  await page.locator('.json .findings li').first().waitFor();
  await page.waitForTimeout(kRest);
}

async function post(url, path, body) {
  const answer = await fetch(url + path, {
    method: 'POST', headers: { 'Content-Type': 'application/json', Prefer: 'wait=20, return=minimal' }, body: JSON.stringify(body),
  });
  return answer.headers.get('Location').split('/').pop();
}

async function makeSweep(url, parameters, title) {
  const request = await exampleOf(url, 'tunnel_arch');
  request.model.title = title;
  const sweep = await post(url, '/v1/sweeps', {
    ...request, parameters, design: 'grid',
    outputs: ['/summary/critical_load_factor', '/summary/critical_type', '/critical_points/0/monitors/crown'],
  });
  for (;;) {
    const { status } = await (await fetch(`${url}/v1/sweeps/${sweep}`)).json();
    if (status !== 'accepted' && status !== 'running') {
      return sweep;
    }
    await new Promise((resolve) => setTimeout(resolve, 200));
  }
}

/** Jobs and sweeps to look at. */
async function fill(url) {
  const ids = {};
  for (const name of ['frame_portal', 'pile_in_soil', 'film_on_substrate', 'arch_deep_215', 'pipe_under_pressure', 'buried_pipe']) {
    ids[name] = await post(url, '/v1/jobs', { label: 'site north', request: await exampleOf(url, name) });
  }
  const failing = await exampleOf(url, 'tunnel_arch');
  failing.analysis = { type: 'static', load_factors: [10, 20, 60, 200], output: { states: 'all' } };
  ids.failed = await post(url, '/v1/jobs', failing);
  const along = (name, pointer, from, to, count) => ({ name, targets: [{ pointer }], range: { from, to, count, spacing: 'log' } });
  ids.line = await makeSweep(url, [along('ground stiffness', '/model/foundations/0/stiffness', 1e-4, 1, 61)], 'Tunnel arch, stiffer ground');
  ids.map = await makeSweep(url, [along('ground stiffness', '/model/foundations/0/stiffness', 1e-4, 1, 21),
                                  along('EA', '/model/sections/0/EA', 40, 4000, 17)], 'Tunnel arch, ground and rib');
  return ids;
}

export const kViews = {
  studio: ({ page, url }) => changedStudio(page, url),
  ...Object.fromEntries(kProblems.map((name) => [`studio-${name}`, ({ page, url }) => openStudio(page, url, name)])),
  gallery: async ({ page, url }) => {
    await openStudio(page, url, 'buried_pipe');
    await page.getByRole('button', { name: 'Gallery' }).click();
    await page.locator('.gallery .thumb svg').last().waitFor();
  },
  form: async ({ page, url }) => {
    await openStudio(page, url, 'pile_in_soil');
    await page.locator('.model-form summary', { hasText: 'Foundations' }).click();
    await page.locator('.law-figure svg.law').first().scrollIntoViewIfNeeded();
    await page.waitForTimeout(200);
  },
  'mode-of-bifurcation': async ({ page, url }) => {
    await openStudio(page, url, 'arch_no_base');
    const mark = page.locator('.path-card svg .mark.bifurcation').first();
    await mark.scrollIntoViewIfNeeded();
    const box = await mark.boundingBox();
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    await page.locator('div.note').waitFor();
  },
  'softest-point': async ({ page, url }) => {
    await openStudio(page, url, 'frame_nearly_unstable');
    await page.getByRole('button', { name: 'Show the motion' }).click();
    await page.waitForTimeout(200);
  },
  pointed: async ({ page, url }) => {
    await openStudio(page, url, 'tunnel_arch');
    const member = page.locator('.drawing-card svg path.member').first();
    await member.scrollIntoViewIfNeeded();
    const box = await member.boundingBox();
    await page.mouse.move(box.x + 0.3 * box.width, box.y + 0.3 * box.height);
    await page.waitForTimeout(200);
  },
  'table-twin': async ({ page, url }) => {
    await openStudio(page, url, 'buried_pipe');
    await page.locator('.path-card summary').click();
    await page.getByRole('button', { name: 'Show as table' }).click();
  },
  json: async ({ page, url }) => {
    await openStudio(page, url, 'tunnel_arch');
    await page.goto(`${url}/#/model`);
    await page.locator('.cm-content').waitFor();
    await page.waitForTimeout(kRest);
  },
  findings: ({ page, url }) => writeMistakes(page, url),
  'sweep-builder': async ({ page, url }) => {
    await openStudio(page, url, 'buried_pipe');
    await page.getByRole('tab', { name: 'Sweep' }).click();
    await page.getByRole('button', { name: 'Add a second parameter' }).click();
  },
  job: async ({ page, url, ids }) => {
    await page.goto(`${url}/#/jobs/${ids.film_on_substrate}`);
    await page.locator('.trust-card .headline').waitFor();
  },
  'job-buckling': async ({ page, url, ids }) => {
    await page.goto(`${url}/#/jobs/${ids.frame_portal}`);
    await page.locator('.trust-card .headline').waitFor();
  },
  jobs: async ({ page, url }) => {
    await page.goto(`${url}/#/jobs`);
    await page.locator('tbody tr').nth(5).waitFor();
    await page.waitForTimeout(kRest);
  },
  'job-failed': async ({ page, url, ids }) => {
    await page.goto(`${url}/#/jobs/${ids.failed}`);
    await page.locator('.trouble').waitFor();
  },
  'sweep-line': async ({ page, url, ids }) => {
    await page.goto(`${url}/#/sweeps/${ids.line}`);
    await page.locator('.sweep-chart svg').waitFor();
    await page.waitForTimeout(kRest);
  },
  'sweep-map': async ({ page, url, ids }) => {
    await page.goto(`${url}/#/sweeps/${ids.map}`);
    await page.locator('.sweep-chart svg').waitFor();
    await page.waitForTimeout(kRest);
    const chart = page.locator('.sweep-chart .walkable');
    await chart.scrollIntoViewIfNeeded();
    const box = await chart.boundingBox();
    await page.mouse.move(box.x + 0.6 * box.width, box.y + 0.4 * box.height);
    await page.waitForTimeout(200);
  },
  sweeps: async ({ page, url }) => {
    await page.goto(`${url}/#/sweeps`);
    await page.locator('tbody tr').nth(1).waitFor();
  },
  documents: async ({ page, url }) => {
    await page.goto(`${url}/#/docs`);
    await page.getByRole('heading', { level: 1 }).waitFor();
  },
  document: async ({ page, url }) => {
    await page.goto(`${url}/#/docs/gallery?at=pipeline-lifting-off-the-seabed`);
    await page.locator('.document h1').waitFor();
    await page.waitForTimeout(200);
  },
  nowhere: async ({ page, url }) => {
    await page.goto(`${url}/#/nowhere`);
    await page.getByRole('heading', { level: 1 }).waitFor();
  },
  key: async ({ page, locked }) => {
    await page.goto(locked);
    await page.getByRole('dialog', { name: 'This service needs a key' }).waitFor();
  },
  gone: async ({ page }) => {
    const mortal = await startService();
    await openStudio(page, mortal.url, 'pile_in_soil');
    await mortal.kill();
    await slide(page, "Clay's strength at the tip", 700);
    await page.locator('.gone-banner').waitFor();
    await rm(mortal.folder, { recursive: true, force: true });
  },
};

/** The pictures of docs/page: views in which only times differ from run to run, so that a test can compare them. */
export const kStored = [
  ['studio', 'wide', 'light'], ['studio', 'wide', 'dark'], ['studio', 'phone', 'light'], ['studio-tunnel_arch', 'tablet', 'dark'],
  ['studio-column_between_walls', 'wide', 'light'], ['studio-pile_in_soil', 'wide', 'light'], ['studio-portal_sway', 'wide', 'light'],
  ['studio-pipeline_upheaval', 'wide', 'light'], ['studio-film_on_substrate', 'wide', 'light'], ['studio-arch_no_base', 'wide', 'light'],
  ['studio-frame_nearly_unstable', 'wide', 'light'], ['studio-frame_portal', 'wide', 'light'],
  ['gallery', 'wide', 'light'], ['form', 'wide', 'light'], ['json', 'wide', 'light'],
  ['sweep-line', 'wide', 'light'], ['sweep-map', 'wide', 'dark'], ['job-failed', 'wide', 'light'], ['documents', 'wide', 'light'],
];

async function startLocked(folder) {
  const config = join(folder, 'keys.toml');
  await writeFile(config, `[[keys]]\nowner = "ann"\nsha256 = "${createHash('sha256').update(kKey).digest('hex')}"\n`);
  return startService(['--config', config]);
}

/** The services that the views are of: one with jobs and sweeps, one that wants a key. */
export async function startPlaces() {
  const service = await startService();
  const locked = await startLocked(service.folder);
  return {
    url: service.url,
    locked: locked.url,
    ids: await fill(service.url),
    stop: async () => {
      await locked.stop();
      await service.stop();
    },
  };
}

/** Takes the picture of a view. `options` are those of playwright's screenshot(). @returns what `look` says of the page then. */
export async function take(browser, places, [view, size, colorScheme], options, look = async () => null) {
  const phone = size === 'phone';
  const page = await openPage(browser, 'about:blank', { viewport: kSizes[size], colorScheme, hasTouch: phone });
  await kViews[view]({ page, ...places });
  const seen = await look(page);
  await page.screenshot({ fullPage: phone, animations: 'disabled', ...options });
  if (page.troubles.length > 0) {
    throw new Error(`${view}: ${page.troubles.join('; ')}`);
  }
  await page.context().close();
  return seen;
}

/** The file of a picture. */
export function nameOf([view, size, scheme]) {
  return `${[view, ...(size === 'wide' ? [] : [size]), ...(scheme === 'light' ? [] : [scheme])].join('-')}.png`;
}
