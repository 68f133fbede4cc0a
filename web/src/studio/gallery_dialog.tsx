// The gallery: every problem with its drawing, opened with one click.

import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import type { RequestDocument } from "../api/documents";
import { shapeNode } from "../app/shape_view";
import { drawingFigure } from "../figures";
import { kProblems, type Problem } from "../model/gallery";
import { loadExamples } from "./session";

const kThumb = { width: 320, height: 170 };  // scaled down by the style sheet

function Thumb({ request }: { request: RequestDocument | undefined }) {
  const picture = useMemo(() => {
    if (!request) return null;
    const { nodes, sections, members, supports = [], springs = [], foundations = [] } = request.model;
    const bare = { nodes, sections, members, supports, springs, foundations };
    return shapeNode(drawingFigure({ model: bare, caption: false, dimensions: false }, kThumb));
  }, [request]);
  return <div class="thumb" aria-hidden="true">{picture}</div>;
}

interface GalleryProps {
  open: boolean;
  onClose: () => void;
  onChoose: (problem: Problem) => void;
  chosen: Problem | null;
}

export function GalleryDialog({ open, onClose, onChoose, chosen }: GalleryProps) {
  const dialog = useRef<HTMLDialogElement>(null);
  const [examples, setExamples] = useState<Map<string, RequestDocument> | null>(null);
  useEffect(() => {
    if (!open) {
      dialog.current?.close();
      return;
    }
    if (!dialog.current?.open) dialog.current?.showModal();
    loadExamples().then(setExamples, () => undefined);
  }, [open]);
  return (
    <dialog ref={dialog} class="gallery" aria-label="Gallery" onClose={onClose}
            onClick={(event) => (event.target === dialog.current ? onClose() : undefined)}>
      <header class="card-head"><h2>Gallery</h2><button type="button" onClick={onClose}>Close</button></header>
      <ul>
        {open ? kProblems.map((problem) => (
          <li key={problem.example}>
            <button type="button" aria-current={problem === chosen} onClick={() => onChoose(problem)}>
              <Thumb request={examples?.get(problem.example)} />
              <strong>{problem.heading}</strong>
              <span>{problem.text}</span>
            </button>
          </li>
        )) : null}
      </ul>
    </dialog>
  );
}
