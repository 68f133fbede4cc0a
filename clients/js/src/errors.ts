// What a call may throw. An AbortError (DOMException) comes from the signal of whoever called.

import type { Finding, Problem, Result } from "./documents.js";

function messageOf(problem: Problem): string {
  const findings = (problem.errors ?? []).map(({ pointer, detail }) => `\n${pointer === "" ? "the document" : pointer}: ${detail}`);
  return problem.detail + (problem.code === undefined ? "" : ` (${problem.code})`) + findings.join("");
}

/**
 * The service refused, or an analysis could not be completed: a problem document (docs/service.md, Errors). Its message has every
 * mistake with its JSON Pointer.
 */
export class Refused extends Error {
  override readonly name: string = "Refused";

  /** @param location address of the job, where there is one */
  constructor(readonly problem: Problem, readonly location: string | null) {
    super(messageOf(problem));
  }
  /** Such as `invalid-request`, `analysis-failed`, `unauthorized`. */
  get kind(): string {
    return this.problem.type.replace("urn:snapthrough:problem:", "");
  }
  /** Every mistake of a document: `pointer`, `code`, `detail`. */
  get findings(): Finding[] {
    return this.problem.errors ?? [];
  }
  /** The result of a failed analysis as far as it got. */
  get reached(): Result | null {
    return this.problem.reached ?? null;
  }
  /** Id of the job whose analysis failed; empty where there is none. */
  get job(): string {
    return idOf(this.location ?? "");
  }
}

/** No answer came, or it broke off. */
export class Unreachable extends Error {
  override readonly name: string = "Unreachable";
}

export function isAbort(error: unknown): boolean {
  return error instanceof DOMException && error.name === "AbortError";
}

/** The id in /v1/jobs/ID or /v1/sweeps/ID, of a path or a whole address. */
export function idOf(location: string): string {
  return /\/v1\/(?:jobs|sweeps)\/([^/?]*)/.exec(location)?.[1] ?? "";
}
