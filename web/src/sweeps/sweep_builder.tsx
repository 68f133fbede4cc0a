import type { RequestDocument } from "../api/documents";
import type { Slider } from "../model/sliders";

export function SweepBuilder({ sliders }: { request: RequestDocument; sliders: readonly Slider[] }) {
  return <p class="hint">{sliders.length} sliders</p>;
}
