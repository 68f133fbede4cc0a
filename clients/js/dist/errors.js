// What a call may throw. An AbortError (DOMException) comes from the signal of whoever called.
function messageOf(problem) {
    const findings = (problem.errors ?? []).map(({ pointer, detail }) => `\n${pointer === "" ? "the document" : pointer}: ${detail}`);
    return problem.detail + (problem.code === undefined ? "" : ` (${problem.code})`) + findings.join("");
}
/**
 * The service refused, or an analysis could not be completed: a problem document (docs/service.md, Errors). Its message has every
 * mistake with its JSON Pointer.
 */
export class Refused extends Error {
    problem;
    location;
    name = "Refused";
    /** @param location address of the job, where there is one */
    constructor(problem, location) {
        super(messageOf(problem));
        this.problem = problem;
        this.location = location;
    }
    /** Such as `invalid-request`, `analysis-failed`, `unauthorized`. */
    get kind() {
        return this.problem.type.replace("urn:snapthrough:problem:", "");
    }
    /** Every mistake of a document: `pointer`, `code`, `detail`. */
    get findings() {
        return this.problem.errors ?? [];
    }
    /** The result of a failed analysis as far as it got. */
    get reached() {
        return this.problem.reached ?? null;
    }
    /** Id of the job whose analysis failed; empty where there is none. */
    get job() {
        return idOf(this.location ?? "");
    }
}
/** No answer came, or it broke off. */
export class Unreachable extends Error {
    name = "Unreachable";
}
export function isAbort(error) {
    return error instanceof DOMException && error.name === "AbortError";
}
/** The id in /v1/jobs/ID or /v1/sweeps/ID, of a path or a whole address. */
export function idOf(location) {
    return /\/v1\/(?:jobs|sweeps)\/([^/?]*)/.exec(location)?.[1] ?? "";
}
