// The built executable as a service with a temporary store on a free port.
import {spawn, spawnSync} from 'node:child_process';
import {existsSync, mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {createInterface} from 'node:readline';

import {root} from './document.mjs';

export const executable = process.env.SERVICE_EXECUTABLE ?? new URL('build/release/snapthrough', root).pathname;

/** Exit status and standard output of a command of the executable. */
export function command(args, input) {
  const done = spawnSync(executable, args, {encoding: 'utf8', input, maxBuffer: 1 << 30});
  return {status: done.status, text: done.stdout, errors: done.stderr};
}

/** A running service: `address`, and stop(), which ends it and removes its store. */
export async function startService(...settings) {
  if (!existsSync(executable)) throw new Error(`${executable} is not built (SERVICE_EXECUTABLE names another)`);
  const folder = mkdtempSync(join(tmpdir(), 'snapthrough-schema-'));
  const child = spawn(executable, ['serve', '--listen', '127.0.0.1:0', '--store', join(folder, 'store.db'), ...settings],
                      {stdio: ['ignore', 'ignore', 'pipe']});
  const ended = new Promise((resolve) => child.once('exit', resolve));
  const address = await new Promise((resolve, reject) => {
    const lines = createInterface({input: child.stderr});
    lines.on('line', (line) => {
      const entry = JSON.parse(line);
      if (entry.event === 'listening') resolve(`http://${entry.host}:${entry.port}`);
    });
    ended.then((status) => reject(new Error(`the service ended with ${status}`)));
  });
  return {
    address,
    async stop() {
      child.kill('SIGTERM');
      await ended;
      rmSync(folder, {recursive: true});
    },
  };
}
