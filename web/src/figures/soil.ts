// Foundations that name a soil, as figures draw them: one foundation for the sum of the laws that the soil gives along a member.
// And pipes in soil: one foundation for each of their reactions.

import type { components } from "../api/types";
import { at, interpolate, last } from "./geometry";

type Schemas = components["schemas"];
type Model = Schemas["Model"];
type State = Schemas["State"];
type FoundationState = State["foundations"][string];
type SoilFoundation = Extract<Schemas["Foundation"], { soil: string }>;
type PipeFoundation = Extract<Schemas["Foundation"], { pipe: Schemas["BuriedPipe"] }>;

/** A foundation with a stiffness or law of its own. */
export type GivenFoundation = Exclude<Schemas["Foundation"], SoilFoundation | PipeFoundation>;
/** A model whose foundations all have a stiffness or law. */
export type GivenModel = Omit<Model, "foundations"> & { foundations?: GivenFoundation[] };

/** Kinds of curves, as the ids of results name them, with what they resist. */
const kKinds = [["", "normal"], [" axial", "tangent"], [" rotation", "rotation"]] as const;

function namesSoil(foundation: Schemas["Foundation"]): foundation is SoilFoundation {
  return "soil" in foundation;
}
function hasPipe(foundation: Schemas["Foundation"]): foundation is PipeFoundation {
  return "pipe" in foundation;
}

/** Whether a member runs to the right, so that what is above it lies on its left. */
function runsToTheRight(model: Model, id: string): boolean {
  const found = model.members.find((one) => one.id === id);
  const x = (node: string | undefined) => model.nodes.find((one) => one.id === node)?.x ?? 0;
  return x(found?.end) > x(found?.start);
}

/** The reactions around a pipe that a state has; without a state one foundation along the pipe. */
function reactionsOf(model: Model, { id, member }: PipeFoundation, state: State | null | undefined): GivenFoundation[] {
  if (!state) return [{ id, member, stiffness: 0 }];
  const above = runsToTheRight(model, member) ? "left" : "right", below = above === "left" ? "right" : "left";
  const pushes = { member, stiffness: 0, reaction: "compression_only" } as const;
  const all: GivenFoundation[] = [
    { id: `${id} axial`, member, stiffness: 0, component: "tangent" },
    { id: `${id} lateral`, member, stiffness: 0 },
    { id: `${id} uplift`, ...pushes, side: above },
    { id: `${id} bearing`, ...pushes, side: below },
  ];
  return all.filter((one) => one.id in state.foundations);
}

/** The part of the member that is in the ground, by fractions of its length; null where the model does not say. */
function buriedRange(model: Model, { member, ground_level: level = 0 }: SoilFoundation): [number, number] | null {
  const found = model.members.find(({ id }) => id === member);
  const y = (node: string | undefined) => model.nodes.find(({ id }) => id === node)?.y;
  const start = y(found?.start), end = y(found?.end);
  if (start === undefined || end === undefined || Math.min(start, end) >= level) return null;
  if (Math.max(start, end) <= level) return [0, 1];
  const surface = (start - level) / (start - end);
  return start > end ? [surface, 1] : [0, surface];
}

/** The states of the curves of one kind of a foundation, those of a layer or part of it together, in the order along the member. */
function layersOf(state: State, id: string, kind: string): FoundationState[][] {
  const layers = new Map<string, FoundationState[]>();
  const name = /^( layer \d+(?: part \d+)?)( axial| rotation|)(?: curve \d+)?$/;
  for (const [key, one] of Object.entries(state.foundations)) {
    const parts = key.startsWith(id) ? name.exec(key.slice(id.length)) : null;
    if (!parts || parts[2] !== kind || one.s.length === 0) continue;
    const layer = parts[1] ?? "";
    layers.set(layer, [...(layers.get(layer) ?? []), one]);
  }
  const begin = (layer: FoundationState[]) => Math.min(...layer.map(({ s }) => at(s, 0)));
  return [...layers.values()].sort((a, b) => begin(a) - begin(b));
}

/** The sum of states whose ranges overlap. */
function sumOf(states: readonly FoundationState[]): Pick<FoundationState, "s" | "reaction" | "displacement"> {
  const s = [...new Set(states.flatMap((one) => one.s))].sort((a, b) => a - b);
  const covering = (place: number) => states.filter((one) => at(one.s, 0) <= place && place <= last(one.s));
  return {
    s,
    reaction: s.map((place) => covering(place).reduce((sum, one) => sum + interpolate(one.s, one.reaction, place), 0)),
    displacement: s.map((place) => {
      const [one] = covering(place);
      return one ? interpolate(one.s, one.displacement, place) : 0;
    }),
  };
}

/** The state of all curves of one kind; layers follow one another, and the reaction may jump between them. */
function joined(layers: readonly FoundationState[][]): FoundationState {
  const sums = layers.map(sumOf);
  const s = sums.flatMap((one) => one.s);
  const reaction = sums.flatMap((one) => one.reaction);
  const peak = (value: number) => ({ value, s: at(s, reaction.indexOf(value)) });
  const total = (field: "fx" | "fy" | "moment") => layers.flat().reduce((sum, one) => sum + one.resultant[field], 0);
  return {
    s, reaction, displacement: sums.flatMap((one) => one.displacement),
    contact: sums.map((one): [number, number] => [at(one.s, 0), last(one.s)]),
    resultant: { fx: total("fx"), fy: total("fy"), moment: total("moment") },
    extremes: { min: peak(Math.min(...reaction)), max: peak(Math.max(...reaction)) },
  };
}

/**
 * The model and the state with one foundation for each kind of curve in place of each foundation that names a soil, or for each
 * reaction around a pipe; without a state one along the buried part. They are the same objects when there are no such foundations.
 */
export function withSoil<S extends State | null | undefined>(model: Model, state: S): { model: GivenModel; state: S } {
  if (!model.foundations?.some((one) => namesSoil(one) || hasPipe(one))) return { model: model as GivenModel, state };
  const states = { ...(state?.foundations ?? {}) };
  const foundations = model.foundations.flatMap((foundation): GivenFoundation[] => {
    if (hasPipe(foundation)) return reactionsOf(model, foundation, state);
    if (!namesSoil(foundation)) return [foundation];
    const { id, member } = foundation;
    const range = buriedRange(model, foundation);
    if (!range) return [];
    if (!state) return [{ id, member, stiffness: 0, range }];
    return kKinds.flatMap(([kind, component]): GivenFoundation[] => {
      const layers = layersOf(state, id, kind);
      if (layers.length === 0) return [];
      states[`${id}${kind}`] = joined(layers);
      return [{ id: `${id}${kind}`, member, stiffness: 0, range, component }];
    });
  });
  return { model: { ...model, foundations }, state: state ? { ...state, foundations: states } : state };
}
