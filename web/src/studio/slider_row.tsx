// One slider: its name, its value as a field that takes any number, and the way between.

import type { RequestDocument } from "../api/documents";
import { formatNumber } from "../figures";
import { kPlaces, placeOf, valueAtPlace, valueOf, type Slider } from "../model/sliders";
import { useTypedNumber } from "./typed_field";

interface SliderProps {
  slider: Slider;
  request: RequestDocument;
  onValue: (value: number) => void;
  onRemove: (() => void) | null;
}

export function SliderRow({ slider, request, onValue, onRemove }: SliderProps) {
  const value = valueOf(slider, request) ?? slider.min;
  const { typed, trouble, input, accept, key } = useTypedNumber(value, onValue);
  const place = placeOf(slider, value);
  const id = `slider-${slider.targets[0]?.pointer ?? ""}`;
  return (
    <div class="slider">
      <div class="slider-head">
        <label for={id}>{slider.name}</label>
        {onRemove ? <button type="button" class="quiet" aria-label={`Remove the slider ${slider.name}`} onClick={onRemove}>Remove</button> : null}
        <span class="slider-value">
          <input type="text" inputMode="decimal" aria-label={`${slider.name}, value${slider.unit ? ` in ${slider.unit}` : ""}`}
                 size={Math.max(4, (typed ?? formatNumber(value, 4)).length)} value={typed ?? formatNumber(value, 4)}
                 aria-invalid={trouble !== ""} aria-describedby={trouble === "" ? undefined : `${id}-wrong`}
                 onFocus={(event) => event.currentTarget.select()} onInput={(event) => input(event.currentTarget.value)}
                 onBlur={accept} onKeyDown={key} />
          <span class="unit">{slider.unit}</span>
        </span>
      </div>
      {trouble === "" ? null : <p class="wrong" id={`${id}-wrong`} role="alert">{trouble}</p>}
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
