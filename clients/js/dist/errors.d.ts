import type { Finding, Problem, Result } from "./documents.js";
/**
 * The service refused, or an analysis could not be completed: a problem document (docs/service.md, Errors). Its message has every
 * mistake with its JSON Pointer.
 */
export declare class Refused extends Error {
    readonly problem: Problem;
    readonly location: string | null;
    readonly name: string;
    /** @param location address of the job, where there is one */
    constructor(problem: Problem, location: string | null);
    /** Such as `invalid-request`, `analysis-failed`, `unauthorized`. */
    get kind(): string;
    /** Every mistake of a document: `pointer`, `code`, `detail`. */
    get findings(): Finding[];
    /** The result of a failed analysis as far as it got. */
    get reached(): Result | null;
    /** Id of the job whose analysis failed; empty where there is none. */
    get job(): string;
}
/** No answer came, or it broke off. */
export declare class Unreachable extends Error {
    readonly name: string;
}
export declare function isAbort(error: unknown): boolean;
/** The id in /v1/jobs/ID or /v1/sweeps/ID, of a path or a whole address. */
export declare function idOf(location: string): string;
