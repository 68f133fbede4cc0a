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

type Group = readonly SectionQuantity[];

/** What is shown together where there is no room for everything; the first group is shown first. */
const kWideGroups: readonly Group[] = [["N", "Q", "M"], ["rotation", "reaction"]];
const kNarrowGroups: readonly Group[] = [["N", "M"], ["Q", "rotation"], ["reaction"]];
const kNarrow = 480;  // px
const kRoomy = 300;   // px of height that have room for everything
const kAll: Group = ["N", "Q", "M", "rotation", "reaction"];

/** Without foundations there is no reaction to show. */
function groupsFor(size: Size | null, model: Model): readonly Group[] {
  const all = size !== null && size.height > kRoomy ? [kAll] : size !== null && size.width < kNarrow ? kNarrowGroups : kWideGroups;
  if ((model.foundations ?? []).length > 0) return all;
  return all.map((group) => group.filter((quantity) => quantity !== "reaction")).filter((group) => group.length > 0);
}

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
  const [chosen, setChosen] = useState(0);
  const groups = useMemo(() => groupsFor(size, model), [size, model]);
  const quantities = groups[Math.min(chosen, groups.length - 1)];
  const input = useMemo<SectionsInput | null>(() => (state ? { model, state, cursor, quantities } : null),
                                              [model, state, cursor, quantities]);
  const file = fileName(model.title ?? "", "-sections");
  const take = (): ReturnType<typeof sectionsFigure> | null =>
    input && sectionsFigure({ ...input, cursor: null }, size ?? { width: 700, height: 160 });
  const withFigure = (act: (figure: ReturnType<typeof sectionsFigure>) => void) => (): void => {
    const figure = take();
    if (figure) act(figure);
  };
  return (
    <Card title="Section forces" class={`sections-card ${input ? "" : "empty"} ${name}`} tools={input ? (
      <>
      {groups.length > 1 && !twin ? (
        <select aria-label="What is shown" value={chosen} onChange={(event) => setChosen(Number(event.currentTarget.value))}>
          {groups.map((group, i) => <option key={i} value={i}>{group.join(", ")}</option>)}
        </select>
      ) : null}
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
