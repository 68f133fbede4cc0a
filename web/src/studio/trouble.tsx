// What went wrong, in words: mistakes in a request at their place, a failed analysis with its code, a service that is gone.

import type { Finding } from "../api/documents";
import { Refused, Unreachable } from "../api/client";
import { withShortNumbers } from "../app/words";

/** The mistakes of a document, with pointers into it and not into the envelope that it was sent in. */
export function findingsOf(error: unknown): readonly Finding[] {
  const errors = error instanceof Refused ? error.problem.errors ?? [] : [];
  return errors.map((one) => ({ ...one, pointer: one.pointer.replace(/^\/request(?=\/|$)/, "") }));
}

const kSeveral = 6;

export function Trouble({ error }: { error: unknown }) {
  if (error === null || error === undefined) return null;
  if (error instanceof Unreachable) {
    return <div class="trouble" role="alert"><strong>The service does not answer.</strong> What is drawn is the last answer.</div>;
  }
  if (!(error instanceof Refused)) {
    return <div class="trouble" role="alert"><strong>Something went wrong.</strong> {error instanceof Error ? error.message : ""}</div>;
  }
  const findings = findingsOf(error);
  const { code, detail, title, reached } = error.problem;
  return (
    <div class="trouble" role="alert">
      <strong>{code ? code.replace(/_/g, " ") : title}</strong>{" "}
      {findings.length === 0 ? withShortNumbers(detail) : `${findings.length} ${findings.length === 1 ? "mistake" : "mistakes"} in the model:`}
      {findings.length > 0 ? (
        <ul>{findings.slice(0, kSeveral).map((one, i) => <li key={i}><code>{one.pointer || "/"}</code> {one.detail}</li>)}</ul>
      ) : null}
      {reached ? <p>What was reached is drawn.</p> : null}
    </div>
  );
}
