// The gallery: problems, each a request of the repository (examples/NAME.json), with the sliders that matter.

import { foundations, wall, type Slider, type Target } from "./sliders";

/** What is chosen when a problem is opened: the first loss of stability, or a share of a branch's way. */
export type Choice = { kind: "critical" } | { kind: "along"; branch: number; share: number };

export interface Problem {
  /** NAME of examples/NAME.json. */
  example: string;
  /** Also that of its own document, or of its section in docs/gallery.md where it has none. */
  heading: string;
  /** What is seen, in two sentences. */
  text: string;
  sliders: Slider[];
  choice: Choice;
  /** Its own document, docs/NAME.md, and the picture of the example's result, docs/PICTURE. */
  document?: { name: string; picture: string };
}

export const kBuriedPipe: Problem = {
  example: "buried_pipe",
  heading: "Buried flexible pipe",
  text: "The soil can only push, and the ground above presses with 10 kN/m² times the load factor. At the limit load the crown snaps through.",
  sliders: [
    { name: "Soil stiffness", unit: "kN/m²", targets: foundations(2, "stiffness"), min: 2000, max: 200000, log: true },
    wall(8e5, 15, 40),
    { name: "Gap around the pipe", unit: "mm", targets: foundations(2, "gap", 1e-3), min: 0, max: 20, log: false, step: 0.5 },
  ],
  choice: { kind: "critical" },
};

export const kTunnelArch: Problem = {
  example: "tunnel_arch",
  heading: "Tunnel arch in the ground",
  text: "The crown goes down and the haunches press into the ground, which holds them. Stiffer ground moves the limit point " +
    "and takes the sideways bifurcation away.",
  sliders: [
    { name: "Ground stiffness", unit: "K R⁴/EI", targets: [{ pointer: "/model/foundations/0/stiffness", scale: 1.4e-8 }],
      min: 1e3, max: 1e8, log: true },
    { name: "Rib's axial stiffness", unit: "EA R²/EI", targets: [{ pointer: "/model/sections/0/EA", scale: 1.4e-4 }],
      min: 3e5, max: 3e7, log: true },
  ],
  choice: { kind: "along", branch: 0, share: 0.2 },
};

/** Numbers of the pile's laws at its tip and its head for an undrained strength of 1 kN/m² at the tip, a quarter at the head. */
function clay(): Target[] {
  const perStrength = [["0/law/stiffness", 100], ["0/law/capacity", 1.8], ["1/law/stiffness", 125], ["1/law/capacity", 0.625]] as const;
  return perStrength.flatMap(([field, scale]) => [
    { pointer: `/model/foundations/${field}/along/0/1`, scale }, { pointer: `/model/foundations/${field}/along/1/1`, scale: scale / 4 },
  ]);
}

const kPile: Problem = {
  example: "pile_in_soil",
  heading: "Pile in soft soil",
  text: "Clay whose strength grows with depth holds the pile on all sides until it yields where the pile bends; there the load has its " +
    "maximum. A crookedness of 5 mm costs a quarter of the buckling load.",
  sliders: [
    { name: "Clay's strength at the tip", unit: "kN/m²", targets: clay(), min: 1, max: 40, log: true },
    { name: "Crookedness", unit: "mm", targets: [{ pointer: "/model/imperfections/0/amplitude", scale: 1e-3 }],
      min: 0.5, max: 50, log: true },
    { name: "Bending stiffness EI", unit: "kN m²", targets: [{ pointer: "/model/sections/0/EI" }], min: 1000, max: 8000,
      log: true },
  ],
  choice: { kind: "critical" },
};

export const kWalls: Problem = {
  example: "column_between_walls",
  heading: "Strip between two walls",
  text: "The strip bows until it lies on a wall, where it can bear more. Then it snaps and touches both walls.",
  sliders: [
    { name: "Gap to each wall", unit: "mm", targets: foundations(2, "gap", 1e-3), min: 8, max: 50, log: false, step: 0.5 },
    { name: "Stiffness of the walls", unit: "kN/m²", targets: foundations(2, "stiffness"), min: 500, max: 50000, log: true },
    { name: "Crookedness", unit: "mm", targets: [{ pointer: "/model/imperfections/0/amplitude", scale: 1e-3 }],
      min: 0.2, max: 10, log: true },
  ],
  choice: { kind: "along", branch: 0, share: 0.8 },
};

const kPortal: Problem = {
  example: "portal_sway",
  heading: "Portal frame that sways",
  text: "Under equal loads the frame stays straight, until its path bifurcates. Then it sways to either side and bears hardly more.",
  sliders: [
    { name: "Beam stiffness EI", unit: "kN m²", targets: [{ pointer: "/model/sections/1/EI" }], min: 800, max: 80000, log: true },
    { name: "Span", unit: "m", min: 2, max: 12, log: false, step: 0.1,
      targets: [{ pointer: "/model/nodes/2/x" }, { pointer: "/model/nodes/3/x" }] },
  ],
  choice: { kind: "along", branch: 1, share: 0.55 },
};

const kFriction = 0.5;  // of the pipe on the seabed, reached within about 5 mm

const kPipeline: Problem = {
  example: "pipeline_upheaval",
  heading: "Pipeline lifting off the seabed",
  text: "Held at its ends, the pipe is pressed when it is heated. Over a hump it lifts off, and a low hump is the more dangerous: " +
    "the pipe snaps up.",
  sliders: [
    { name: "Height of the hump", unit: "m", min: 0.06, max: 0.5, log: true, targets: [
      { pointer: "/model/imperfections/0/offsets/3/1" }, { pointer: "/model/imperfections/0/offsets/2/1", scale: 0.5 },
      { pointer: "/model/imperfections/0/offsets/4/1", scale: 0.5 }] },
    { name: "Weight and cover", unit: "kN/m", min: 1, max: 15, log: false, step: 0.1, targets: [
      { pointer: "/model/loads/0/force/1", scale: -1 }, { pointer: "/model/foundations/1/law/capacity", scale: kFriction },
      { pointer: "/model/foundations/1/law/stiffness", scale: kFriction / 0.005 }] },
    { name: "Stiffness of the seabed", unit: "kN/m²", targets: foundations(1, "stiffness"), min: 200, max: 20000, log: true },
  ],
  choice: { kind: "along", branch: 0, share: 0.7 },
};

const kFilm: Problem = {
  example: "film_on_substrate",
  heading: "Film that wrinkles",
  text: "A stiff film on a soft substrate buckles into many equal waves. They localise as it is pressed on, and the load falls.",
  sliders: [
    { name: "Substrate stiffness", unit: "K", min: 25, max: 400, log: true, targets: [
      { pointer: "/model/foundations/0/stiffness" }, { pointer: "/model/loads/0/force/0", scale: -1, power: 0.5 }] },
    { name: "Length of the film", unit: "", targets: [{ pointer: "/model/nodes/1/x" }], min: 6, max: 20, log: false, step: 0.1 },
  ],
  choice: { kind: "along", branch: 1, share: 0.9 },
};

const kBareArch: Problem = {
  example: "arch_no_base",
  heading: "Shallow arch, bare",
  text: "Nothing holds this arch sideways, so it bifurcates below its limit point. Click the diamond to see the mode it leaves in.",
  sliders: [
    { name: "Opening angle", unit: "°", targets: [{ pointer: "/model/members/0/curve/sweep_degrees", scale: -1 }], min: 8, max: 60,
      log: false, step: 0.5 },
    { name: "Rib's axial stiffness", unit: "kN", targets: [{ pointer: "/model/sections/0/EA" }], min: 42, max: 4200, log: true },
    { name: "Bending stiffness EI", unit: "", targets: [{ pointer: "/model/sections/0/EI" }], min: 0.5, max: 5, log: true },
  ],
  choice: { kind: "critical" },
};

const kModes: Problem = {
  example: "frame_portal",
  heading: "Buckling modes of a frame",
  text: "The linearised buckling loads of a clamped portal and their modes. Choose a load to see its mode.",
  sliders: [
    { name: "Second moment of area", unit: "cm⁴", targets: [{ pointer: "/model/sections/0/I", scale: 1e-8 }], min: 500, max: 20000,
      log: true },
    { name: "Height", unit: "m", min: 2, max: 8, log: false, step: 0.1,
      targets: [{ pointer: "/model/nodes/1/y" }, { pointer: "/model/nodes/2/y" }] },
  ],
  choice: { kind: "critical" },
};

const kUnequalBays: Problem = {
  example: "frame_nearly_unstable",
  heading: "Frame of unequal bays",
  text: "A symmetric frame sways at a bifurcation. This one only comes near one: its stiffness falls to a few hundredths, and its limit " +
    "point lies far above, after metres of sway. With the last column at 18.6 m it is symmetric.",
  sliders: [
    { name: "Place of the last column", unit: "m", min: 16, max: 24, log: false, step: 0.1,
      targets: [{ pointer: "/model/nodes/6/x" }, { pointer: "/model/nodes/7/x" }] },
    { name: "Second moment of area", unit: "cm⁴", targets: [{ pointer: "/model/sections/0/I", scale: 1e-8 }], min: 1000, max: 20000,
      log: true },
  ],
  choice: { kind: "along", branch: 0, share: 0.16 },
};

export const kGallery: readonly Problem[] = [
  kBuriedPipe, kTunnelArch, kWalls, kPile, kPortal, kPipeline, kFilm, kBareArch, kUnequalBays, kModes,
];
