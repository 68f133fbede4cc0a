// One sweep: its rows as a chart over one parameter, as a map over two, and as a table.

import { useEffect, useMemo, useState } from "preact/hooks";
import type { Sweep, SweepDocument, Table } from "../api/documents";
import { isActive, isAbort, service } from "../api/client";
import { go } from "../app/router";
import { shapeNode } from "../app/shape_view";
import { useSize } from "../app/size";
import { badgeOf } from "../app/words";
import { fileName, savePng, saveSvg, saveText } from "../export/files";
import {
  changesOf, changeText, columnLabel, curveAxes, errorsOf, formatNumber, nearestInSweep, piecesOf, sweepLine, sweepLineChart, sweepMap, sweepMapChart, sweepMapLocate,
  sweepTable, type Pixel, type Shape, type Size, type SweepAxis,
} from "../figures";
import { place } from "../figures/chart/axes";
import { openAny } from "../studio/session";
import { Trouble } from "../studio/trouble";
import { Card, Menu } from "../views/card";
import { LongTable } from "../views/long_table";
import { kindOf } from "../views/trust_card";

const kReadAgain = 700;  // ms between readings of the table while rows come
const kMostMarks = 4000;
const kMostRead = 100;  // breaks of curves in the list for screen readers

interface Shown {
  sweep: Sweep | null;
  document: SweepDocument | null;
  table: Table | null;
  trouble: unknown;
}

const kNothing: Shown = { sweep: null, document: null, table: null, trouble: null };

async function watch(id: string, signal: AbortSignal, show: (part: Partial<Shown>) => void): Promise<void> {
  const [sweep, document] = await Promise.all([service.sweepStatus(id), service.sweepRequest(id)]);
  show({ sweep, document });
  let reading = false;
  let last = 0;
  const read = async (): Promise<void> => {
    reading = true;
    show({ table: await service.sweepTable(id), sweep: await service.sweepStatus(id) });
    reading = false;
    last = performance.now();
  };
  await read();
  await service.follow(`/v1/sweeps/${id}`, () => {
    if (!reading && performance.now() - last > kReadAgain) void read().catch(() => (reading = false));
  }, signal);
  await read();
}

function useSweep(id: string): [Shown, () => void] {
  const [shown, setShown] = useState(kNothing);
  const [turn, setTurn] = useState(0);
  useEffect(() => {
    const control = new AbortController();
    const show = (part: Partial<Shown>): void => {
      if (!control.signal.aborted) setShown((old) => ({ ...old, ...part }));
    };
    watch(id, control.signal, show).catch((error: unknown) => (isAbort(error) ? undefined : show({ trouble: error })));
    return () => control.abort();
  }, [id, turn]);
  return [shown, () => setTurn(turn + 1)];
}

function isLog(document: SweepDocument, name: string): boolean {
  const parameter = document.parameters.find((one) => one.name === name);
  return parameter !== undefined && "range" in parameter && parameter.range.spacing === "log";
}

function axisOf(document: SweepDocument, name: string): SweepAxis {
  return { column: name, log: isLog(document, name) };
}

interface Picture {
  shape: Shape;
  /** The row at a pixel. */
  rowAt: (pixel: Pixel) => number | null;
  /** Where a row is. */
  placeOf: (row: number) => Pixel | null;
}

function pixelOf(frame: { x: Parameters<typeof place>[0]; y: Parameters<typeof place>[0] }, spot: Pixel | undefined): Pixel | null {
  const pixel = spot && { x: place(frame.x, spot.x), y: place(frame.y, spot.y) };
  return pixel && Number.isFinite(pixel.x + pixel.y) ? pixel : null;
}

/** What lines are drawn over and what tells them apart: the last parameter of a refined sweep and the others, else the first two. */
function lineAxes(document: SweepDocument, table: Table): { x: string; series: readonly string[] } {
  const [first, second] = document.parameters;
  return curveAxes(table) ?? { x: first?.name ?? "", series: second ? [second.name] : [] };
}

/** A chart over one parameter, or a map over the first two. */
function pictureOf(document: SweepDocument, table: Table, output: string, map: boolean, size: Size): Picture {
  const [first, second] = document.parameters;
  const value = { column: output };
  if (map && second) {
    const input = { table, x: axisOf(document, first?.name ?? ""), y: axisOf(document, second.name), value };
    const chart = sweepMapChart(input, size);
    const spots = new Map(chart.spots.map((spot) => [spot.row, spot]));
    return {
      shape: sweepMap(input, size, chart), rowAt: (pixel) => sweepMapLocate(chart, pixel)?.row ?? null,
      placeOf: (row) => pixelOf(chart.frame, spots.get(row)),
    };
  }
  const { x, series } = lineAxes(document, table);
  const input = { table, x: axisOf(document, x), y: value, series };
  const chart = sweepLineChart(input, size);
  const spots = new Map(chart.lines.flatMap((line) => line.spots).map((spot) => [spot.row, spot]));
  return {
    shape: sweepLine(input, size, chart),
    placeOf: (row) => pixelOf(chart.frame, spots.get(row)),
    rowAt: (pixel) => {
      const near = nearestInSweep(chart, pixel);
      return near && near.distance < 40 ? near.row : null;
    },
  };
}

/** What the row under the pointer says. */
function RowNote({ table, row, onOpen }: { table: Table; row: number | null; onOpen: (row: number) => void }) {
  if (row === null) return <p class="hint">Point at the chart to read a point; click it to open that analysis.</p>;
  const cells = table.rows[row] ?? [];
  const error = errorsOf({ ...table, rows: [cells] })[0];
  const change = piecesOf({ ...table, rows: [cells] })?.changes[0];
  const shown = change === undefined ? table.columns : table.columns.slice(0, -3);
  return (
    <div class="note" role="status">
      {shown.map((column, i) => {
        const cell = cells[i];
        if (column === "error" || cell === null || cell === undefined || typeof cell === "object") return null;
        return <span key={column}>{columnLabel({ column })} <strong>{typeof cell === "number" ? formatNumber(cell, 5) : kindOf(String(cell))}</strong></span>;
      })}
      {change ? <span>the curve breaks before this point: <strong>{changeText(change)}</strong></span> : null}
      {error ? <span class="wrong">{error.code.replace(/_/g, " ")}: {error.detail}</span> : null}
      <button type="button" onClick={() => onOpen(row)}>Open this analysis</button>
    </div>
  );
}

/** Where the curves of a refined sweep break, for those who do not see the chart. */
function BreakList({ table }: { table: Table }) {
  const changes = useMemo(() => changesOf(table), [table]);
  if (changes.length === 0) return null;
  const valueText = (value: unknown): string => (typeof value === "number" ? formatNumber(value, 5) : String(value));
  return (
    <div class="unseen">
      <p>Where the curves break</p>
      <ul>
        {changes.slice(0, kMostRead).map(({ row, where, change }) => (
          <li key={row}>{where.map(({ name, value }) => `${name} = ${valueText(value)}`).join(", ")}: {change}</li>
        ))}
        {changes.length > kMostRead ? <li>{changes.length - kMostRead} more, which the column change of the table names</li> : null}
      </ul>
    </div>
  );
}

interface ChartProps {
  document: SweepDocument;
  table: Table;
  output: string;
  map: boolean;
  chosen: number | null;
  onChosen: (row: number | null) => void;
  onOpen: (row: number) => void;
}

function Chart({ document: sweep, table, output, map, chosen, onChosen, onOpen }: ChartProps) {
  const [frame, size] = useSize<HTMLDivElement>();
  const picture = useMemo(() => (size ? pictureOf(sweep, table, output, map, size) : null), [sweep, table, output, map, size]);
  const ring = chosen === null ? null : picture?.placeOf(chosen) ?? null;
  const node = useMemo(() => (picture ? shapeNode(picture.shape) : null), [picture]);
  const at = (event: PointerEvent): number | null => {
    const box = (event.currentTarget as Element).getBoundingClientRect();
    return picture?.rowAt({ x: event.clientX - box.left, y: event.clientY - box.top }) ?? null;
  };
  const step = (event: KeyboardEvent): void => {
    const move = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (move !== undefined) onChosen(Math.min(table.rows.length - 1, Math.max(0, (chosen ?? -move) + move)));
    else if (event.key === "Enter" && chosen !== null) onOpen(chosen);
    else return;
    event.preventDefault();
  };
  return (
    <div class="fill" ref={frame}>
      <div class="picture walkable" tabIndex={0} role="group" aria-label="Chart of the sweep. Left and right go from point to point, Enter opens one."
           onKeyDown={step} onPointerMove={(event) => {
             const row = at(event);
             if (row !== null) onChosen(row);
           }} onClick={(event) => {
             const row = at(event as unknown as PointerEvent);
             if (row !== null) onOpen(row);
           }}>
        {node}
        {size && ring ? (
          <svg class="figure overlay" width={size.width} height={size.height} aria-hidden="true">
            <circle class="chosen-ring open" cx={ring.x} cy={ring.y} r={6.5} />
          </svg>
        ) : null}
      </div>
    </div>
  );
}

function ChartCard({ id, sweep, document, table }: { id: string; sweep: Sweep; document: SweepDocument; table: Table }) {
  const numeric = document.outputs.filter((output) => {
    const index = table.columns.indexOf(output);
    return table.rows.some((row) => typeof row[index] === "number");
  });
  const [wanted, setWanted] = useState<string | null>(null);
  const [flat, setFlat] = useState(false);
  const [chosen, setChosen] = useState<number | null>(null);
  const output = wanted !== null && numeric.includes(wanted) ? wanted : numeric[0] ?? document.outputs[0] ?? "";
  const two = document.parameters.length > 1;
  const map = two && !flat && document.design === "grid";
  const name = fileName(sweep.title, "-sweep");
  const open = (row: number): void => {
    void service.pointRequest(id, table.points[row] ?? row).then((request) => {
      void openAny({ ...request, analysis: { ...request.analysis, output: {} } }).then(() => go("#/studio"));
    });
  };
  const rows = useMemo(() => <LongTable table={sweepTable(table)} caption="Rows of the sweep" onRow={open} />, [table, id]);
  const take = (): Shape => pictureOf(document, table, output, map, { width: 800, height: 520 }).shape;
  const csv = async (): Promise<void> => {
    const text = await (await service.call(`/v1/sweeps/${id}/table?format=csv`)).text();
    saveText(`${name}.csv`, text, "text/csv");
  };
  return (
    <div class="sweep-chart">
      <Card title={columnLabel({ column: output })} class="path-card" tools={
        <>
          {numeric.length > 1 ? (
            <select aria-label="Output" value={output} onChange={(event) => setWanted(event.currentTarget.value)}>
              {numeric.map((one) => <option key={one} value={one}>{columnLabel({ column: one })}</option>)}
            </select>
          ) : null}
          {two ? <button type="button" aria-pressed={flat} onClick={() => setFlat(!flat)}>As lines</button> : null}
          <Menu label="Export" items={[
            { text: "SVG", act: () => saveSvg(`${name}.svg`, take()) },
            { text: "PNG", act: () => void savePng(`${name}.png`, take()) },
            { text: "CSV", act: () => void csv() },
          ]} />
        </>
      }>
        {table.rows.length > kMostMarks && !map ? <p class="hint">{formatNumber(table.rows.length, 6)} rows</p> : null}
        <Chart document={document} table={table} output={output} map={map} chosen={chosen} onChosen={setChosen} onOpen={open} />
        <BreakList table={table} />
        <div class="row-note"><RowNote table={table} row={chosen} onOpen={open} /></div>
      </Card>
      <Card title={`Table of ${formatNumber(table.rows.length, 6)} rows`} class="table-card">
        <div class="fill">{rows}</div>
      </Card>
    </div>
  );
}

export function SweepView({ id }: { id: string }) {
  const [{ sweep, document, table, trouble }, again] = useSweep(id);
  const busy = sweep !== null && isActive(sweep.status);
  return (
    <main id="main" tabIndex={-1} class="plain">
      <section class="card" aria-labelledby="sweep-title">
        <h1 id="sweep-title">{sweep && sweep.title !== "" ? sweep.title : "Sweep"}</h1>
        <Trouble error={trouble} />
        {sweep ? (
          <div class="progress-row">
            <span class={badgeOf(sweep.status)}>{sweep.status}</span>
            <progress max={sweep.points} value={sweep.points - sweep.counts.remaining} aria-label={document?.refine ? "Curves that are there" : "Rows that are there"} />
            <span>{sweep.message}</span>
            {busy ? <button type="button" onClick={() => void service.dismissSweep(id).then(again, again)}>Dismiss</button>
              : <button type="button" onClick={() => void service.deleteSweep(id).then(() => go("#/sweeps"), again)}>Delete</button>}
          </div>
        ) : trouble ? null : <p class="hint">Loading…</p>}
      </section>
      {sweep && document && table && table.rows.length > 0 ? <ChartCard id={id} sweep={sweep} document={document} table={table} /> : null}
    </main>
  );
}
