// The document of a sweep over numbers of a request: outputs that answer most questions, and rows where the curves need them.

import type { RequestDocument, SweepDocument } from "../api/documents";
import { pointerOf } from "./pointer";

export const kWithin = 0.01;  // share of an output by which a straight line between rows may be off
const kTexts: ReadonlySet<string> = new Set(["/summary/critical_type"]);

/** Outputs that answer most questions, by what the analysis gives. */
export function outputsOf(request: RequestDocument): string[] {
  if (request.analysis.type === "buckling") return ["/buckling/load_factors/0"];
  if (request.analysis.type === "vibration") return ["/vibrations/0/frequencies/omega_squared/0"];
  const monitors = (request.model.monitors ?? []).slice(0, 3).map(({ id }) => id);
  if (request.analysis.type === "static") {
    const last = (request.analysis.load_factors?.length ?? 1) - 1;
    return monitors.map((id) => pointerOf(["static", "monitors", id, last]));
  }
  const places = monitors.map((id) => pointerOf(["critical_points", 0, "monitors", id]));
  const softest = ["/summary/softest/load_factor", "/summary/softest/stiffness_ratio"];
  return ["/summary/critical_load_factor", "/summary/critical_type", "/summary/error_estimate", ...softest, ...places];
}

/** The output by which the rows of a sweep are chosen; null where no output is a number or the last parameter is a list of values. */
export function refinedOutput(parameters: SweepDocument["parameters"], outputs: readonly string[]): string | null {
  const last = parameters[parameters.length - 1];
  return last && "range" in last ? outputs.find((output) => !kTexts.has(output)) ?? null : null;
}

/** A grid over parameters; `refined` asks for more rows where the curves along the last parameter bend or jump. */
export function sweepOf(request: RequestDocument, parameters: SweepDocument["parameters"], refined: boolean): SweepDocument {
  const outputs = outputsOf(request);
  const output = refined ? refinedOutput(parameters, outputs) : null;
  return {
    model: request.model, analysis: { ...request.analysis, output: { states: "none", points_per_member: 2 } }, parameters,
    design: "grid", ...(output === null ? {} : { refine: { output, within: kWithin } }), outputs,
  };
}
