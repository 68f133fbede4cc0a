// A table of any length: only the rows in view are in the document.

import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { tableText, type FigureTable } from "../figures";

const kRow = 28;     // px, as page.css has it
const kBeyond = 12;  // rows above and below the view

interface LongTableProps {
  table: FigureTable;
  caption: string;
  /** Called with the index of a row that was chosen. */
  onRow?: ((row: number) => void) | undefined;
}

export function LongTable({ table, caption, onRow }: LongTableProps) {
  const place = useRef<HTMLDivElement>(null);
  const above = useRef<HTMLTableRowElement>(null);
  const below = useRef<HTMLTableRowElement>(null);
  const [view, setView] = useState({ top: 0, height: 600 });
  const first = Math.max(0, Math.floor(view.top / kRow) - kBeyond);
  const last = Math.min(table.rows.length, Math.ceil((view.top + view.height) / kRow) + kBeyond);
  useLayoutEffect(() => {
    if (above.current) above.current.style.height = `${first * kRow}px`;
    if (below.current) below.current.style.height = `${(table.rows.length - last) * kRow}px`;
    const height = place.current?.clientHeight ?? 600;
    if (Math.abs(height - view.height) > 1) setView({ ...view, height });
  });
  const rows = tableText({ columns: table.columns, rows: table.rows.slice(first, last) });
  return (
    <div class="twin" tabIndex={0} role="region" aria-label={caption} ref={place}
         onScroll={(event) => setView({ top: event.currentTarget.scrollTop, height: event.currentTarget.clientHeight })}>
      <table aria-rowcount={table.rows.length + 1}>
        <caption class="unseen">{caption}</caption>
        <thead>
          <tr>
            {table.columns.map((name) => <th scope="col" key={name}>{name}</th>)}
            {onRow ? <th scope="col">open</th> : null}
          </tr>
        </thead>
        <tbody>
          <tr ref={above} aria-hidden="true" />
          {rows.map((cells, i) => (
            <tr key={first + i} aria-rowindex={first + i + 2}>
              {cells.map((cell, j) => <td key={j}>{cell}</td>)}
              {onRow ? (
                <td><button type="button" class="quiet" aria-label={`Open row ${first + i + 1}`}
                            onClick={() => onRow(first + i)}>open</button></td>
              ) : null}
            </tr>
          ))}
          <tr ref={below} aria-hidden="true" />
        </tbody>
      </table>
    </div>
  );
}
