// The JSON editor, loaded when it is opened. It lives in a shadow root, where its style sheets are adopted ones: the page's content
// security policy allows no style elements.

import { autocompletion, completionKeymap, type CompletionContext, type CompletionResult } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap, indentWithTab } from "@codemirror/commands";
import { json } from "@codemirror/lang-json";
import { bracketMatching, HighlightStyle, indentOnInput, syntaxHighlighting, syntaxTree } from "@codemirror/language";
import { lintGutter, linter, lintKeymap, type Diagnostic } from "@codemirror/lint";
import { EditorState } from "@codemirror/state";
import { drawSelection, EditorView, highlightActiveLine, keymap, lineNumbers } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import type { Description, Finding } from "../api/documents";
import { placeNear, placesOf } from "./places";
import { fieldsAt, wordsAt } from "./schema";

type SyntaxNode = ReturnType<ReturnType<typeof syntaxTree>["resolveInner"]>;

export interface EditorParts {
  text: string;
  /** Every mistake of a text; called when typing pauses. */
  check: (text: string) => Promise<readonly Finding[]>;
  description: Promise<Description>;
  onText: (text: string) => void;
}

export interface Editor {
  setText(text: string): void;
  focus(): void;
  destroy(): void;
}

const kLintDelay = 250;  // ms

const looks = EditorView.theme({
  "&": { height: "100%", color: "var(--ink)", backgroundColor: "var(--paper)", fontSize: "12px" },
  ".cm-scroller": { fontFamily: 'ui-monospace, "DejaVu Sans Mono", monospace', lineHeight: "1.5" },
  ".cm-gutters": { backgroundColor: "var(--paper)", color: "var(--muted)", border: "0" },
  ".cm-activeLine, .cm-activeLineGutter": { backgroundColor: "var(--accent-soft)" },
  ".cm-content": { caretColor: "var(--ink)" },
  ".cm-cursor": { borderLeftColor: "var(--ink)" },
  "&.cm-focused .cm-selectionBackground, .cm-selectionBackground": { backgroundColor: "var(--strong) !important" },
  ".cm-tooltip": { backgroundColor: "var(--paper)", color: "var(--ink)", border: "1px solid var(--strong)", borderRadius: "6px" },
  ".cm-tooltip-autocomplete ul li[aria-selected]": { backgroundColor: "var(--accent)", color: "var(--paper)" },
  // The marks of @codemirror/lint are data: images, which the content security policy refuses.
  ".cm-lintRange-error": { backgroundImage: "none", textDecoration: "underline wavy var(--bad)" },
  ".cm-lint-marker-error": { content: "normal", width: "8px", height: "8px", margin: "5px 3px", borderRadius: "50%", backgroundColor: "var(--bad)" },
  ".cm-diagnostic-error": { borderLeftColor: "var(--bad)" },
});

const colours = syntaxHighlighting(HighlightStyle.define([
  { tag: tags.propertyName, color: "var(--ink)", fontWeight: "600" },
  { tag: tags.string, color: "var(--good)" },
  { tag: [tags.number, tags.bool, tags.null], color: "var(--accent)" },
]));

/** Names and numbers of what is around a node, from the outside in. */
function pathOf(node: SyntaxNode | null, state: EditorState): string[] {
  const path: string[] = [];
  for (let here = node; here; here = here.parent) {
    if (here.name === "Property") {
      const name = here.getChild("PropertyName");
      if (name) path.unshift(state.sliceDoc(name.from + 1, name.to - 1));
    } else if (here.parent?.name === "Array") {
      let index = 0;
      for (let before = here.prevSibling; before; before = before.prevSibling) index += /^[A-Z]/.test(before.name) ? 1 : 0;
      path.unshift(String(index));
    }
  }
  return path;
}

function completionsFrom(description: Promise<Description>) {
  return async (context: CompletionContext): Promise<CompletionResult | null> => {
    const word = context.matchBefore(/"[\w]*/);
    if (!word && !context.explicit) return null;
    const schema = await description.catch(() => null);
    if (!schema) return null;
    const node = syntaxTree(context.state).resolveInner(context.pos, -1);
    const from = word?.from ?? context.pos;
    const before = context.state.sliceDoc(Math.max(0, from - 200), from).trimEnd();
    const isValue = before.endsWith(":");
    const owner = node.name === "PropertyName" || node.name === "Property" ? (node.name === "Property" ? node : node.parent) : node;
    const path = pathOf(isValue ? node : owner?.name === "Property" ? owner.parent : owner, context.state);
    const found = isValue ? wordsAt(schema, path) : fieldsAt(schema, path);
    const closed = context.state.sliceDoc(context.pos, context.pos + 1) === '"';
    return found.length === 0 ? null : {
      from, options: found.map(({ text, detail }) => ({
        label: `"${text}"`, apply: `"${text}${closed ? "" : '"'}${isValue || closed ? "" : ": "}`, info: detail,
      })),
    };
  };
}

function marks(text: string, findings: readonly Finding[]): Diagnostic[] {
  const places = placesOf(text);
  return findings.map(({ pointer, detail }) => {
    const line = /line (\d+), column (\d+)/.exec(detail);
    const place = line && pointer === "" ? atLine(text, Number(line[1]), Number(line[2])) : placeNear(places, pointer);
    const from = Math.min(place.from, text.length);
    return { from, to: Math.min(text.length, Math.max(from, place.to)), severity: "error", message: detail };
  });
}

function atLine(text: string, line: number, column: number): { from: number; to: number } {
  const start = text.split("\n").slice(0, line - 1).reduce((sum, one) => sum + one.length + 1, 0);
  return { from: start + column - 1, to: start + column };
}

export function makeEditor(place: HTMLElement, parts: EditorParts): Editor {
  const root = place.shadowRoot ?? place.attachShadow({ mode: "open" });
  let silent = false;
  const view = new EditorView({
    root,
    parent: root,
    state: EditorState.create({
      doc: parts.text,
      extensions: [
        lineNumbers(), history(), drawSelection(), indentOnInput(), bracketMatching(), highlightActiveLine(), json(), looks, colours,
        autocompletion({ override: [completionsFrom(parts.description)] }), lintGutter(),
        linter(async (editor) => marks(editor.state.doc.toString(), await parts.check(editor.state.doc.toString())), { delay: kLintDelay }),
        keymap.of([...completionKeymap, ...lintKeymap, ...historyKeymap, ...defaultKeymap, indentWithTab]),
        EditorView.contentAttributes.of({ "aria-label": "Request as JSON. Escape, then Tab, leaves the editor." }),
        EditorView.updateListener.of((update) => {
          if (update.docChanged && !silent) parts.onText(update.state.doc.toString());
        }),
      ],
    }),
  });
  view.scrollDOM.tabIndex = 0;  // what scrolls can be reached by keys
  return {
    setText: (text) => {
      silent = true;
      view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: text } });
      silent = false;
    },
    focus: () => view.focus(),
    destroy: () => view.destroy(),
  };
}
