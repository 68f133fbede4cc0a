/** The documents that the service reads and answers, as its JavaScript client has them. */
export type * from "../../../clients/js/src/documents.js";
