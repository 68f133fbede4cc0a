export { Client, isActive, } from "./client.js";
export { idOf, isAbort, Refused, Unreachable } from "./errors.js";
export {} from "./events.js";
