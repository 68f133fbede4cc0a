// The gallery: every problem with its drawing, opened with one click.

import type { VNode } from "preact";
import { useMemo, useRef, useState } from "preact/hooks";
import type { RequestDocument } from "../api/documents";
import { shapeNode } from "../app/shape_view";
import { drawingFigure } from "../figures";
import { kGallery, type Problem } from "../model/gallery";
import { kPractice } from "../model/practice";
import { loadExamples } from "./session";

const kThumb = { width: 320, height: 170 };  // scaled down by the style sheet

function Thumb({ problem, request }: { problem: Problem; request: RequestDocument | undefined }) {
  const picture = useMemo(() => {
    if (!request) return null;
    const { nodes, sections, members, supports = [], springs = [], foundations = [] } = request.model;
    const bare = { nodes, sections, members, supports, springs, foundations };
    return shapeNode(drawingFigure({ model: bare, caption: false, dimensions: false }, kThumb));
  }, [request]);
  const { document: own } = problem;
  return (
    <div class="thumb" aria-hidden="true">{own ? <img src={`docs/${own.picture}`} alt="" loading="lazy" /> : picture}</div>
  );
}

interface ListProps {
  name: string;
  problems: readonly Problem[];
  chosen: Problem | null;
  examples: Map<string, RequestDocument> | null;
  onChoose: (problem: Problem) => void;
}

function ProblemList({ name, problems, chosen, examples, onChoose }: ListProps) {
  return (
    <>
      <h3>{name}</h3>
      <ul>
        {problems.map((problem) => (
          <li key={problem.example}>
            <button type="button" aria-current={problem === chosen} onClick={() => onChoose(problem)}>
              <Thumb problem={problem} request={examples?.get(problem.example)} />
              <strong>{problem.heading}</strong>
              <span>{problem.text}</span>
            </button>
          </li>
        ))}
      </ul>
    </>
  );
}

interface Gallery {
  open: () => void;
  dialog: VNode;
}

/** The gallery's dialog, to be put on the page, and what opens it. Whether it is open is known to the dialog alone: the browser
 *  closes it on its own, and tells it later, so that a copy of what it knows would be wrong in between. */
export function useGallery(chosen: Problem | null, onChoose: (problem: Problem) => void): Gallery {
  const dialog = useRef<HTMLDialogElement>(null);
  const [examples, setExamples] = useState<Map<string, RequestDocument> | null>(null);
  const open = (): void => {
    dialog.current?.showModal();
    loadExamples().then(setExamples, () => undefined);
  };
  const close = (): void => dialog.current?.close();
  const lists = { chosen, examples, onChoose: (problem: Problem): void => {
    close();
    onChoose(problem);
  } };
  return { open, dialog: (
    <dialog ref={dialog} class="gallery" aria-label="Gallery" onClick={(event) => (event.target === dialog.current ? close() : undefined)}>
      <header class="card-head"><h2>Gallery</h2><button type="button" onClick={close}>Close</button></header>
      <ProblemList name="To begin with" problems={kGallery} {...lists} />
      <ProblemList name="From practice, with design charts and published values" problems={kPractice} {...lists} />
    </dialog>
  ) };
}
