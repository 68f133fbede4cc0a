// The request as JSON text.

import { useEffect, useState } from "preact/hooks";
import type { Finding, RequestDocument } from "../api/documents";
import { service } from "../api/client";

interface JsonProps {
  request: RequestDocument;
  onChange: (request: RequestDocument) => void;
}

export function JsonPanel({ request, onChange }: JsonProps) {
  const [text, setText] = useState(() => JSON.stringify(request, null, 2));
  const [findings, setFindings] = useState<readonly Finding[]>([]);
  useEffect(() => {
    const control = new AbortController();
    const timer = setTimeout(() => {
      service.check(text, control.signal).then((answer) => {
        setFindings(answer.errors);
        if (answer.valid) onChange(JSON.parse(text) as RequestDocument);
      }, () => undefined);
    }, 300);
    return () => {
      clearTimeout(timer);
      control.abort();
    };
  }, [text]);
  return (
    <div class="json">
      <textarea value={text} spellcheck={false} rows={30} onInput={(event) => setText(event.currentTarget.value)} />
      <ul>{findings.map((one, i) => <li key={i}><code>{one.pointer}</code> {one.detail}</li>)}</ul>
    </div>
  );
}
