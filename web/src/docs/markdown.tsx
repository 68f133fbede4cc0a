// Markdown as elements of the page, token by token: no text is ever read as HTML.

import { marked, type Token, type Tokens } from "marked";
import type { ComponentChildren, VNode } from "preact";
import { linkTarget, sectionName } from "./contents";

export interface Section {
  name: string;
  heading: string;
  depth: number;
}

export interface MarkdownDocument {
  tokens: Token[];
  sections: Section[];
}

export function readMarkdown(text: string): MarkdownDocument {
  const tokens: Token[] = marked.lexer(text);
  const sections: Section[] = [];
  for (const token of tokens) {
    if (token.type === "heading") {
      const { depth, text: heading } = token as Tokens.Heading;
      sections.push({ name: sectionName(heading), heading: heading.replace(/`/g, ""), depth });
    }
  }
  return { tokens, sections };
}

function spans(tokens: Token[] | undefined, from: string): ComponentChildren[] {
  return (tokens ?? []).map((token, i) => <Span key={i} token={token} from={from} />);
}

function Link({ token, from }: { token: Tokens.Link; from: string }) {
  const target = linkTarget(from, token.href);
  return target === null ? <>{spans(token.tokens, from)}</> : <a href={target}>{spans(token.tokens, from)}</a>;
}

function Span({ token, from }: { token: Token; from: string }): VNode | null {
  switch (token.type) {
    case "strong": return <strong>{spans((token as Tokens.Strong).tokens, from)}</strong>;
    case "em": return <em>{spans((token as Tokens.Em).tokens, from)}</em>;
    case "codespan": return <code>{(token as Tokens.Codespan).text}</code>;
    case "br": return <br />;
    case "link": return <Link token={token as Tokens.Link} from={from} />;
    case "image": {
      const { href, text } = token as Tokens.Image;
      const target = linkTarget(from, href);
      return target === null ? <>{text}</> : <img src={target} alt={text} loading="lazy" />;
    }
    case "html": return null;  // comments for those who edit
    default: {
      const { tokens, text, raw } = token as Tokens.Text;
      return <>{tokens ? spans(tokens, from) : text ?? raw}</>;
    }
  }
}

function Table({ token, from }: { token: Tokens.Table; from: string }) {
  const side = (i: number): string => (token.align[i] === "right" ? "right" : "left");
  return (
    <div class="scroller" tabIndex={0} role="group" aria-label="Table">
      <table>
        <thead><tr>{token.header.map((cell, i) => <th key={i} class={side(i)}>{spans(cell.tokens, from)}</th>)}</tr></thead>
        <tbody>
          {token.rows.map((row, r) => (
            <tr key={r}>{row.map((cell, i) => <td key={i} class={side(i)}>{spans(cell.tokens, from)}</td>)}</tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

function List({ token, from }: { token: Tokens.List; from: string }) {
  const items = token.items.map((item, i) => <li key={i}><Blocks tokens={item.tokens} from={from} /></li>);
  return token.ordered ? <ol start={Number(token.start) || 1}>{items}</ol> : <ul>{items}</ul>;
}

function Heading({ token, from }: { token: Tokens.Heading; from: string }) {
  const Level = `h${Math.min(token.depth, 5)}` as "h1";
  return <Level id={sectionName(token.text)} tabIndex={-1}>{spans(token.tokens, from)}</Level>;
}

function Block({ token, from }: { token: Token; from: string }): VNode | null {
  switch (token.type) {
    case "heading": return <Heading token={token as Tokens.Heading} from={from} />;
    case "paragraph": return <p>{spans((token as Tokens.Paragraph).tokens, from)}</p>;
    case "code": return <pre tabIndex={0}><code>{(token as Tokens.Code).text}</code></pre>;
    case "table": return <Table token={token as Tokens.Table} from={from} />;
    case "list": return <List token={token as Tokens.List} from={from} />;
    case "blockquote": return <blockquote><Blocks tokens={(token as Tokens.Blockquote).tokens} from={from} /></blockquote>;
    case "hr": return <hr />;
    case "space":
    case "html": return null;
    default: return <Span token={token} from={from} />;
  }
}

/** @param from the document's name, which its links start from */
export function Blocks({ tokens, from }: { tokens: Token[]; from: string }) {
  return <>{tokens.map((token, i) => <Block key={i} token={token} from={from} />)}</>;
}
