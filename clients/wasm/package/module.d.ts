import type { Progress } from './index.js';

export const Status: Readonly<{
  DONE: 0;
  WRONG_USE: 1;
  WRONG_REQUEST: 2;
  NOT_COMPLETED: 3;
  CANCELLED: 4;
  OUT_OF_MEMORY: 5;
  INTERNAL_ERROR: 6;
}>;

export interface Answer {
  status: number;
  text: string;
}

/** The module in the thread that calls it: a call blocks. A progress callback stops the call by returning true. */
export class Module {
  static start(compiled: WebAssembly.Module, options?: { tell?: (text: string) => void }): Promise<Module>;
  readonly version: string;
  solve(request: string, onProgress?: ((now: Progress) => boolean | void) | null): Answer;
  check(document: string): Answer;
  sweep(document: string, first: number, count: number, onProgress?: ((now: Progress) => boolean | void) | null): Answer;
  point(document: string, number: number): Answer;
  plot(document: string, choices?: string): Answer;
}
