// A sweep from one or two sliders of the studio.

import { useState } from "preact/hooks";
import type { RequestDocument, SweepDocument } from "../api/documents";
import { service } from "../api/client";
import { go } from "../app/router";
import { formatNumber } from "../figures";
import { parameterOf, type Slider } from "../model/sliders";
import { kWithin, outputsOf, sweepOf } from "../model/sweep_document";
import { numberOf, readNumber } from "../model/typed_number";
import { Trouble } from "../studio/trouble";

interface Range {
  slider: number;
  from: string;
  to: string;
  count: string;
}

function rangeOf(sliders: readonly Slider[], index: number, count: number): Range {
  const slider = sliders[index];
  const plain = (value: number): string => String(Number(value.toPrecision(4)));
  return { slider: index, from: plain(slider?.min ?? 0), to: plain(slider?.max ?? 1), count: String(count) };
}

function parameters(sliders: readonly Slider[], ranges: readonly Range[]): SweepDocument["parameters"] | string {
  const made: SweepDocument["parameters"] = [];
  for (const range of ranges) {
    const slider = sliders[range.slider];
    if (!slider) return "Choose a slider.";
    const numbers: number[] = [];
    for (const typed of [range.from, range.to, range.count].map(readNumber)) {
      if ("trouble" in typed) return `${slider.name}: ${typed.trouble}`;
      numbers.push(typed.value);
    }
    const [from = 0, to = 0, count = 0] = numbers;
    if (from === to || !Number.isInteger(count) || count < 2) return `${slider.name}: from and to differ, count is 2 or more.`;
    made.push(parameterOf(slider, slider.unit === "" ? slider.name : `${slider.name} (${slider.unit})`, from, to, count));
  }
  return new Set(made.map((one) => one.name)).size < made.length ? "Choose two different sliders." : made;
}

function RangeFields({ sliders, range, label, onChange }: {
  sliders: readonly Slider[]; range: Range; label: string; onChange: (range: Range) => void;
}) {
  const field = (name: "from" | "to" | "count") => (
    <label>{name}<input type="text" inputMode="decimal" value={range[name]}
                        onInput={(event) => onChange({ ...range, [name]: event.currentTarget.value })} /></label>
  );
  return (
    <fieldset class="range">
      <legend>{label}</legend>
      <select aria-label={label} value={range.slider}
              onChange={(event) => onChange(rangeOf(sliders, Number(event.currentTarget.value), Number(range.count) || 2))}>
        {sliders.map((slider, i) => <option key={slider.name} value={i}>{slider.name}</option>)}
      </select>
      <div class="range-fields">{field("from")}{field("to")}{field("count")}</div>
    </fieldset>
  );
}

/** What a sweep computes: a grid as it was typed, and where its curves need more. */
function sizeText(points: number, refined: boolean): string {
  const count = formatNumber(points, 6);
  return refined ? `${count} analyses, and more until straight lines between rows are within ${formatNumber(100 * kWithin)} % of the curve.`
                 : `${count} analyses, each computed alone.`;
}

export function SweepBuilder({ request, sliders }: { request: RequestDocument; sliders: readonly Slider[] }) {
  const [first, setFirst] = useState(() => rangeOf(sliders, 0, 41));
  const [second, setSecond] = useState<Range | null>(null);
  const [refined, setRefined] = useState(true);
  const [trouble, setTrouble] = useState<unknown>(null);
  if (outputsOf(request).length === 0) {
    return <p class="hint">Give the model a monitor first: a sweep of static analyses lists what monitors read at the last load factor.</p>;
  }
  if (sliders.length === 0) return <p class="hint">Give a number of the model a slider first; a sweep goes where its slider goes.</p>;
  const made = parameters(sliders, second ? [first, second] : [first]);
  const points = [first, ...(second ? [second] : [])].reduce((product, range) => product * (numberOf(range.count) ?? 0), 1);
  const submit = async (): Promise<void> => {
    if (typeof made === "string") return;
    try {
      const sweep = await service.submitSweep(sweepOf(request, made, refined));
      go(`#/sweeps/${sweep.id}`);
    } catch (error) {
      setTrouble(error);
    }
  };
  return (
    <div class="sweep-builder">
      <RangeFields sliders={sliders} range={first} label="Along" onChange={setFirst} />
      {second ? <RangeFields sliders={sliders} range={second} label="And along" onChange={setSecond} /> : null}
      {second ? <button type="button" onClick={() => setSecond(null)}>One parameter only</button>
        : sliders.length > 1 ? <button type="button" onClick={() => {
            setFirst({ ...first, count: "21" });
            setSecond(rangeOf(sliders, first.slider === 0 ? 1 : 0, 21));
          }}>Add a second parameter</button> : null}
      <label class="check"><input type="checkbox" checked={refined} onChange={(event) => setRefined(event.currentTarget.checked)} />
        More values where the curve needs them</label>
      <p class={typeof made === "string" ? "wrong" : "hint"}>{typeof made === "string" ? made : sizeText(points, refined)}</p>
      <Trouble error={trouble} />
      <button type="button" class="main" disabled={typeof made === "string"} onClick={() => void submit()}>Start the sweep</button>
    </div>
  );
}
