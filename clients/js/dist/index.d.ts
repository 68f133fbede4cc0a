export { Client, isActive, type Answer, type ClientOptions, type Solution, type SolveOptions, type SubmitOptions, type SweepOptions, } from "./client.js";
export { idOf, isAbort, Refused, Unreachable } from "./errors.js";
export { type ServerEvent } from "./events.js";
export type * from "./documents.js";
export type { components, operations, paths } from "./types.js";
