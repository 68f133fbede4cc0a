// One slider: its name, its value as a field that takes any number, and the way between.

import { useState } from "preact/hooks";
import type { RequestDocument } from "../api/documents";
import { formatNumber } from "../figures";
import { kPlaces, placeOf, valueAtPlace, valueOf, type Slider } from "../model/sliders";

interface SliderProps {
  slider: Slider;
  request: RequestDocument;
  onValue: (value: number) => void;
  onRemove: (() => void) | null;
}

/** A number as people type it: 1e4, 10 000, 0,5. */
export function readNumber(text: string): number | null {
  const plain = text.replace(/[\s\u202f\u00a0]/g, "").replace(/−/g, "-").replace(",", ".");
  const value = plain === "" ? Number.NaN : Number(plain);
  return Number.isFinite(value) ? value : null;
}

export function SliderRow({ slider, request, onValue, onRemove }: SliderProps) {
  const value = valueOf(slider, request) ?? slider.min;
  const [typed, setTyped] = useState<string | null>(null);
  const place = placeOf(slider, value);
  const id = `slider-${slider.targets[0]?.pointer ?? ""}`;
  const accept = (): void => {
    const next = typed === null ? null : readNumber(typed);
    if (next !== null && next !== value) onValue(next);
    setTyped(null);
  };
  return (
    <div class="slider">
      <div class="slider-head">
        <label for={id}>{slider.name}</label>
        {onRemove ? <button type="button" class="quiet" aria-label={`Remove the slider ${slider.name}`} onClick={onRemove}>Remove</button> : null}
        <span class="slider-value">
          <input type="text" inputMode="decimal" aria-label={`${slider.name}, value${slider.unit ? ` in ${slider.unit}` : ""}`}
                 size={Math.max(4, (typed ?? formatNumber(value, 4)).length)} value={typed ?? formatNumber(value, 4)}
                 onFocus={(event) => event.currentTarget.select()} onInput={(event) => setTyped(event.currentTarget.value)}
                 onBlur={accept} onKeyDown={(event) => (event.key === "Enter" ? accept() : undefined)} />
          <span class="unit">{slider.unit}</span>
        </span>
      </div>
      <div class="track">
        <svg viewBox={`0 0 ${kPlaces} 4`} preserveAspectRatio="none" aria-hidden="true">
          <rect class="track-all" width={kPlaces} height="4" /><rect class="track-part" width={place} height="4" />
        </svg>
        <input id={id} type="range" min={0} max={kPlaces} step={1} value={place}
               aria-valuetext={`${formatNumber(value, 4)} ${slider.unit}`}
               onInput={(event) => onValue(valueAtPlace(slider, Number(event.currentTarget.value)))} />
      </div>
    </div>
  );
}
