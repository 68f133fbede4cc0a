// One document: its sections at the side, its text beside them.

import { useMemo } from "preact/hooks";
import { documentAddress } from "./contents";
import { Blocks, readMarkdown } from "./markdown";
import { useSection } from "./section";

interface DocumentProps {
  name: string;
  text: string;
  /** The section to begin with, "" for the start. */
  section: string;
}

export function MarkdownView({ name, text, section }: DocumentProps) {
  const { tokens, sections } = useMemo(() => readMarkdown(text), [text]);
  useSection(text, section);
  return (
    <>
      <nav class="card sections" aria-label="Sections">
        <p><a href="#/docs">All documents</a></p>
        <ul>
          {sections.filter(({ depth }) => depth === 2 || depth === 3).map(({ name: at, heading, depth }) => (
            <li key={at} class={depth === 3 ? "deeper" : ""}><a href={documentAddress(name, at)}>{heading}</a></li>
          ))}
        </ul>
      </nav>
      <article class="card document"><Blocks tokens={tokens} from={name} /></article>
    </>
  );
}
