// The WebAssembly module and its calls, in the thread that uses it. The same code runs in Node, in a page and in a worker.

const SUCCESS = 0;
const NOT_SUPPORTED = 58;

/** What the C library of the module asks of its host (wasi_snapshot_preview1). It gets no files, no arguments and no
 * environment. */
function system(memory, tell) {
  const view = () => new DataView(memory().buffer);
  return {
    clock_time_get: (_clock, _precision, out) => {
      view().setBigUint64(out, BigInt(Math.round(performance.now() * 1e6)), true);
      return SUCCESS;
    },
    environ_sizes_get: (count, size) => {
      view().setUint32(count, 0, true);
      view().setUint32(size, 0, true);
      return SUCCESS;
    },
    environ_get: () => SUCCESS,
    fd_write: (_file, pieces, count, out) => {
      let written = 0;
      for (let i = 0; i < count; ++i) {
        const at = view().getUint32(pieces + 8 * i, true);
        const length = view().getUint32(pieces + 8 * i + 4, true);
        tell(new TextDecoder().decode(new Uint8Array(memory().buffer, at, length)));
        written += length;
      }
      view().setUint32(out, written, true);
      return SUCCESS;
    },
    proc_exit: (status) => {
      throw new Error(`The module ended with the status ${status}.`);
    },
  };
}

export const Status = Object.freeze({
  DONE: 0, WRONG_USE: 1, WRONG_REQUEST: 2, NOT_COMPLETED: 3, CANCELLED: 4, OUT_OF_MEMORY: 5, INTERNAL_ERROR: 6,
});

export class Module {
  #functions;
  #onProgress = null;

  /** Starts a compiled module. `tell` takes what its C library writes, which is nothing while all is well. */
  static async start(compiled, { tell = (text) => console.error(text) } = {}) {
    const module = new Module();
    const provided = system(() => module.#functions.memory, tell);
    const refuse = () => NOT_SUPPORTED;
    const imports = {
      wasi_snapshot_preview1: {},
      snapthrough: {
        progress: (done, total, loadFactor, branch, negativeEigenvalues, arcLength, at, count) => {
          const monitors = Array.from(new Float64Array(module.#functions.memory.buffer, at, count));
          const now = { done, total, loadFactor, branch, negativeEigenvalues, arcLength, monitors };
          return module.#onProgress?.(now) === true ? 1 : 0;
        },
      },
    };
    for (const { module: from, name } of WebAssembly.Module.imports(compiled)) {
      if (from === 'wasi_snapshot_preview1') imports[from][name] = provided[name] ?? refuse;
    }
    const instance = await WebAssembly.instantiate(compiled, imports);
    module.#functions = instance.exports;
    module.#functions._initialize();
    return module;
  }

  get version() {
    const bytes = new Uint8Array(this.#functions.memory.buffer, this.#functions.version());
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  }

  /** Each call takes JSON texts and gives `{status, text}`. A progress callback stops the call by returning true. */
  solve(request, onProgress = null) {
    return this.#call('solve', [request], onProgress);
  }
  check(document) {
    return this.#call('check', [document]);
  }
  sweep(document, first, count, onProgress = null) {
    return this.#call('sweep', [document], onProgress, first, count);
  }
  /** The request of a point of a valid sweep. */
  point(document, number) {
    return this.#call('point', [document], null, number);
  }
  plot(document, choices = '') {
    return this.#call('plot', [document, choices]);
  }

  #call(name, texts, onProgress, ...numbers) {
    const given = texts.map((text) => this.#put(text));
    this.#onProgress = onProgress;
    const watched = name === 'solve' || name === 'sweep' ? [onProgress ? 1 : 0] : [];
    try {
      return this.#answer(this.#functions[name](...given.flat(), ...numbers, ...watched));
    } finally {
      this.#onProgress = null;
      for (const [at] of given) this.#functions.free(at);
    }
  }

  #put(text) {
    const bytes = new TextEncoder().encode(text);
    const at = this.#functions.malloc(bytes.length || 1);
    if (at === 0) throw new RangeError('There is not enough memory for the document.');
    new Uint8Array(this.#functions.memory.buffer, at, bytes.length).set(bytes);
    return [at, bytes.length];
  }

  #answer(document) {
    if (document === 0) return { status: Status.OUT_OF_MEMORY, text: '' };
    const view = new DataView(this.#functions.memory.buffer);
    const [at, length] = [view.getUint32(document, true), view.getUint32(document + 4, true)];
    const status = view.getInt32(document + 8, true);
    const text = new TextDecoder().decode(new Uint8Array(this.#functions.memory.buffer, at, length));
    this.#functions.release(document);
    return { status, text };
  }
}
