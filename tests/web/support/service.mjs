// The real executable on a store of its own.
import { spawn } from 'node:child_process';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';

const executable = process.env.SERVICE_EXECUTABLE;

// PAGE_FOLDER: a folder in place of the page that is built in, while working on it.
const page = process.env.PAGE_FOLDER ? ['--web', process.env.PAGE_FOLDER] : [];

/** Starts a service; `options` are flags of `snapthrough serve`. @returns its address, and how to stop or kill it. */
export async function startService(options = [], { port = 0, folder = null } = {}) {
  if (!executable) {
    throw new Error('SERVICE_EXECUTABLE names no snapthrough');
  }
  const own = folder ?? await mkdtemp(join(tmpdir(), 'snapthrough-page-'));
  const child = spawn(executable, ['serve', '--listen', `127.0.0.1:${port}`, '--store', join(own, 'store.db'), ...page, ...options],
                      { stdio: ['ignore', 'ignore', 'pipe'] });
  const log = createInterface({ input: child.stderr });
  const taken = await new Promise((resolve, reject) => {
    log.on('line', (line) => {
      const entry = line.startsWith('{') ? JSON.parse(line) : { event: 'trouble', detail: line };
      if (entry.event === 'listening') {
        resolve(entry.port);
      }
    });
    child.on('exit', (code) => reject(new Error(`the service ended with status ${code}`)));
  });
  const ended = new Promise((resolve) => child.on('exit', resolve));
  const end = async (signal) => {
    child.kill(signal);
    await ended;
  };
  return {
    port: taken,
    folder: own,
    url: `http://127.0.0.1:${taken}`,
    kill: () => end('SIGKILL'),
    stop: async () => {
      await end('SIGTERM');
      await rm(own, { recursive: true, force: true });
    },
  };
}

/** The request of an example that a service has, to be changed at will. */
export async function exampleOf(url, name) {
  const { examples } = await (await fetch(`${url}/v1/examples`)).json();
  return examples.find((one) => one.name === name).request;
}
