// The curve of a support's law beside its fields: reaction over displacement, as a chart or a table.

import { useMemo, useState } from "preact/hooks";
import { shapeNode } from "../app/shape_view";
import { useSize } from "../app/size";
import { fileName, savePng, saveSvg, saveText } from "../export/files";
import { drawnLaw, lawChart, lawFigure, lawTable, tableCsv, type LawInput, type Shape, type Size } from "../figures";
import { Menu } from "../views/card";
import { LongTable } from "../views/long_table";

const kFileSize: Size = { width: 420, height: 260 };

function figureOf(input: LawInput, size: Size): Shape | null {
  const chart = lawChart(input, size);
  return chart && lawFigure(input, size, chart);
}

function Curve(input: LawInput) {
  const { list, support, units } = input;
  const [place, size] = useSize<HTMLDivElement>();
  const [twin, setTwin] = useState(false);
  const figure = useMemo(() => (size && size.height > 20 ? figureOf(input, size) : null), [list, support, units, size]);
  const id = String(support["id"]);
  const name = `Law of ${id}`;
  const file = fileName(name, "");
  const withFile = (act: (figure: Shape) => void) => (): void => {
    const picture = figureOf(input, kFileSize);
    if (picture) act(picture);
  };
  return (
    <section class="law-figure" aria-label={name}>
      <div class="card-head">
        <p>{name}</p>
        <div class="tools">
          <Menu label="Export" items={[
            { text: twin ? "Show the curve" : "Show as table", act: () => setTwin(!twin) },
            { text: "SVG", act: withFile((picture) => saveSvg(`${file}.svg`, picture)) },
            { text: "PNG", act: withFile((picture) => void savePng(`${file}.png`, picture)) },
            { text: "CSV", act: () => saveText(`${file}.csv`, tableCsv(lawTable(input)), "text/csv") },
          ]} />
        </div>
      </div>
      <div class="law-place" ref={place}>
        {twin ? <LongTable table={lawTable(input)} caption={`Reactions of ${id}`} /> : figure && shapeNode(figure)}
      </div>
    </section>
  );
}

/** Nothing where the support has no law, or one that is not right yet. */
export function LawFigure(input: LawInput) {
  return drawnLaw(input) ? <Curve {...input} /> : null;
}
