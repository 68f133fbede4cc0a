// Section forces of the chosen state along the members; pointing at them shows the place in the drawing, and the other way.

import { useMemo, useState } from "preact/hooks";
import type { Model, State } from "../api/documents";
import { shapeNode } from "../app/shape_view";
import { useSize } from "../app/size";
import { fileName, savePng, saveSvg, saveText } from "../export/files";
import {
  sectionsChart, sectionsFigure, sectionsLocate, sectionTable, tableCsv, type SectionQuantity, type SectionsInput, type Size,
} from "../figures";
import { Card, Menu } from "./card";
import type { Pointed } from "./drawing_card";
import { LongTable } from "./long_table";

const kForces: readonly SectionQuantity[] = ["N", "Q", "M"];
const kOthers: readonly SectionQuantity[] = ["rotation", "reaction"];

interface SectionsProps {
  model: Model;
  state: State | null;
  cursor: Pointed | null;
  onCursor: (cursor: Pointed | null) => void;
  class?: string;
}

function Panels({ input, size, onCursor }: { input: SectionsInput; size: Size; onCursor: SectionsProps["onCursor"] }) {
  const chart = useMemo(() => sectionsChart(input, size), [input.model, input.state, input.quantities, size]);
  const figure = useMemo(() => shapeNode(sectionsFigure(input, size, chart)), [input, chart]);
  return (
    <div class="picture" onPointerLeave={() => onCursor(null)} onPointerMove={(event) => {
      const box = event.currentTarget.getBoundingClientRect();
      const place = sectionsLocate(chart, { x: event.clientX - box.left, y: event.clientY - box.top });
      onCursor(place && { member: place.member, s: place.s });
    }}>{figure}</div>
  );
}

export function SectionsCard({ model, state, cursor, onCursor, class: name = "" }: SectionsProps) {
  const [place, size] = useSize<HTMLDivElement>();
  const [twin, setTwin] = useState(false);
  const [others, setOthers] = useState(false);
  const input = useMemo<SectionsInput | null>(() => {
    const roomy = size !== null && size.height > 300;
    return state ? { model, state, cursor, ...(roomy ? {} : { quantities: others ? kOthers : kForces }) } : null;
  }, [model, state, cursor, others, size]);
  const file = fileName(model.title ?? "", "-sections");
  const take = (): ReturnType<typeof sectionsFigure> | null =>
    input && sectionsFigure({ ...input, cursor: null }, size ?? { width: 700, height: 160 });
  const withFigure = (act: (figure: ReturnType<typeof sectionsFigure>) => void) => (): void => {
    const figure = take();
    if (figure) act(figure);
  };
  return (
    <Card title="Section forces" class={`sections-card ${name}`} tools={input ? (
      <>
      {size && size.height <= 300 && !twin
        ? <button type="button" onClick={() => setOthers(!others)}>{others ? "N, Q, M" : "Rotation, reaction"}</button> : null}
      <Menu label="Export" items={[
        { text: twin ? "Show the curves" : "Show as table", act: () => setTwin(!twin) },
        { text: "SVG", act: withFigure((figure) => saveSvg(`${file}.svg`, figure)) },
        { text: "PNG", act: withFigure((figure) => void savePng(`${file}.png`, figure)) },
        { text: "CSV", act: () => saveText(`${file}.csv`, tableCsv(sectionTable(input)), "text/csv") },
      ]} />
      </>
    ) : null}>
      <div class="fill" ref={place}>
        {input && twin ? <LongTable table={sectionTable(input)} caption="Section forces of the chosen state" /> : null}
        {input && !twin && size && size.height > 20 ? <Panels input={input} size={size} onCursor={onCursor} /> : null}
        {input ? null : <p class="hint">No state: an analysis of a path gives some.</p>}
      </div>
    </Card>
  );
}
