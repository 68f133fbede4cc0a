// Natural frequencies: beside an equilibrium path, and of a vibration analysis, whose motions are chosen to be drawn.

import { useMemo, useState } from "preact/hooks";
import type { Vibration } from "../api/documents";
import { shapeNode } from "../app/shape_view";
import { useSize } from "../app/size";
import { fileName, savePng, saveSvg, saveText } from "../export/files";
import {
  formatNumber, frequencyChart, frequencyFigure, frequencyTable, motionsOf, nearestMotion, tableCsv, type ChosenMotion,
  type FrequencyInput, type PathPoint, type Size,
} from "../figures";
import type { Run } from "../model/run";
import { Card, Menu } from "./card";
import { LongTable } from "./long_table";

/** The chart of the frequencies along a path; a press chooses the point of the path. */
export function PathFrequencies({ input, size, onPoint }: {
  input: FrequencyInput; size: Size; onPoint: (point: PathPoint) => void;
}) {
  const chart = useMemo(() => frequencyChart(input, size), [input.result, size]);
  const figure = useMemo(() => shapeNode(frequencyFigure(input, size, chart)), [chart, input.load]);
  return (
    <div class="picture" role="group" aria-label="Natural frequencies along the path" onPointerDown={(event) => {
      const box = event.currentTarget.getBoundingClientRect();
      const near = nearestMotion(chart, { x: event.clientX - box.left, y: event.clientY - box.top });
      if (near) onPoint({ branch: near.branch, index: near.row });
    }}>{figure}</div>
  );
}

/** The motions at one load factor; each can be chosen to be drawn. */
function MotionTable({ vibration, motion: chosen, onMotion }: {
  vibration: Vibration; motion: number; onMotion: (motion: number) => void;
}) {
  return (
    <div class="motions" tabIndex={0} role="region" aria-label="Motions at the chosen load factor">
      <table>
        <caption class="unseen">Natural frequencies at load factor {formatNumber(vibration.load_factor, 5)}</caption>
        <thead><tr>
          <th scope="col">motion</th><th scope="col" class="left">kind</th><th scope="col">ω</th><th scope="col">ω / 2π</th><th scope="col">ω²</th>
          <th scope="col">error</th>
        </tr></thead>
        <tbody>
          {motionsOf(vibration.frequencies).map((motion, i) => {
            const error = vibration.error_estimates[i] ?? null;
            const vibrates = motion.kind !== "diverges";
            return (
              <tr key={i}>
                <td><button type="button" class="quiet" aria-pressed={i === chosen} aria-label={`Draw motion ${i + 1}`}
                            onClick={() => onMotion(i)}>{i + 1}</button></td>
                <td class="left">{motion.kind}</td>
                <td>{vibrates ? formatNumber(motion.omega, 5) : ""}</td>
                <td>{vibrates ? formatNumber(motion.omega / (2 * Math.PI), 5) : ""}</td>
                <td>{formatNumber(motion.square, 5)}{motion.imaginary === 0 ? ""
                  : ` ${motion.imaginary < 0 ? "−" : "+"} ${formatNumber(Math.abs(motion.imaginary), 5)} i`}</td>
                <td>{error === null ? "" : formatNumber(error, 2)}</td>
              </tr>
            );
          })}
        </tbody>
      </table>
    </div>
  );
}

interface VibrationProps {
  run: Run;
  vibrations: readonly Vibration[];
  chosen: ChosenMotion;
  onChosen: (chosen: ChosenMotion) => void;
  /** Whether the chosen motion oscillates, so that it can be animated. */
  oscillates: boolean;
  /** Whether motions that oscillate swing in the drawing. */
  animated: boolean;
  onAnimated: (animated: boolean) => void;
}

/** The frequencies of a vibration analysis: a chart of all load factors, and a table of the chosen one. */
export function VibrationCard({ run, vibrations, chosen, onChosen, oscillates, animated, onAnimated }: VibrationProps) {
  const [place, size] = useSize<HTMLDivElement>();
  const [twin, setTwin] = useState(false);
  const input: FrequencyInput = { result: run.result, chosen };
  const name = fileName(run.request.model.title ?? "", "-frequencies");
  const take = (): ReturnType<typeof frequencyFigure> => frequencyFigure(input, size ?? { width: 640, height: 320 });
  const vibration = vibrations[chosen.row];
  const last = (vibration?.frequencies.omega_squared.length ?? 1) - 1;
  return (
    <Card title="Natural frequencies" class="path-card vibration-card" tools={
      <>
        {vibrations.length > 1 ? (
          <label class="axis-choice">load factor
            <select value={chosen.row} onChange={(event) => onChosen({ ...chosen, row: Number(event.currentTarget.value) })}>
              {vibrations.map((one, i) => <option key={i} value={i}>{formatNumber(one.load_factor, 5)}</option>)}
            </select>
          </label>
        ) : null}
        <button type="button" aria-pressed={oscillates && animated} disabled={!oscillates} onClick={() => onAnimated(!animated)}
                title={oscillates ? "The motion swings in the drawing, with a period of 2 seconds" : "This motion grows without oscillating"}>Animate</button>
        <Menu label="Export" items={[
          { text: twin ? "Show the chart" : "Show as table", act: () => setTwin(!twin) },
          { text: "SVG", act: () => saveSvg(`${name}.svg`, take()) }, { text: "PNG", act: () => void savePng(`${name}.png`, take()) },
          { text: "CSV", act: () => saveText(`${name}.csv`, tableCsv(frequencyTable(run.result)), "text/csv") },
        ]} />
      </>
    }>
      <div class="fill" ref={place}>
        {twin ? <LongTable table={frequencyTable(run.result)} caption="Natural frequencies" /> : null}
        {!twin && size && size.height > 20 ? (
          <div class="picture walkable" tabIndex={0} role="group" aria-label="Natural frequencies. Left and right choose a motion."
               onKeyDown={(event) => {
                 if (event.key === "ArrowRight") onChosen({ ...chosen, motion: Math.min(last, chosen.motion + 1) });
                 if (event.key === "ArrowLeft") onChosen({ ...chosen, motion: Math.max(0, chosen.motion - 1) });
               }}
               onPointerDown={(event) => {
                 const box = event.currentTarget.getBoundingClientRect();
                 const near = nearestMotion(frequencyChart(input, size), { x: event.clientX - box.left, y: event.clientY - box.top });
                 if (near) onChosen({ row: near.row, motion: near.motion });
               }}>{shapeNode(take())}</div>
        ) : null}
      </div>
      {vibration && !twin
        ? <MotionTable vibration={vibration} motion={chosen.motion} onMotion={(motion) => onChosen({ ...chosen, motion })} /> : null}
    </Card>
  );
}
