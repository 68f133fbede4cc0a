// A worker with a module of its own, in Node and in browsers. Messages: {id, start} once, then {id, call, given, watched}.
import { Module } from './module.js';

const inNode = typeof process !== 'undefined' && process.versions?.node !== undefined;
const port = inNode ? (await import('node:worker_threads')).parentPort : globalThis;
const listen = (take) => (inNode ? port.on('message', take) : port.addEventListener('message', ({ data }) => take(data)));

let started = null;

listen(async ({ id, start, call, given, watched }) => {
  try {
    if (start) started = Module.start(start);
    const module = await started;
    if (!call) {
      port.postMessage({ id, answer: module.version });
      return;
    }
    const onProgress = (now) => {
      port.postMessage({ id, progress: now });
    };
    port.postMessage({ id, answer: module[call](...given, ...(watched ? [onProgress] : [])) });
  } catch (error) {
    port.postMessage({ id, error: String(error?.message ?? error) });
  }
});
