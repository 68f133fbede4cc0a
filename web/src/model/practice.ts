// Problems of practice: each has a document with a design chart and published values (docs/gallery/NAME.md).

import { kBuriedPipe, kTunnelArch, kWalls, type Choice, type Problem } from "./gallery";
import { foundations, wall, type Slider } from "./sliders";

interface Entry {
  heading: string;
  text: string;
  picture: string;
  sliders: Slider[];
  choice: Choice;
  /** NAME of examples/gallery/NAME.json, where it is not that of the document. */
  request?: string;
}

const kAtEnd: Choice = { kind: "along", branch: 0, share: 1 };

function practice(name: string, { request = name, picture, ...entry }: Entry): Problem {
  return { ...entry, example: `gallery/${request}`, document: { name: `gallery/${name}`, picture: `gallery/${picture}.svg` } };
}

const kPlasticPipe = 862e3 / (1 - 0.3 ** 2);  // kN/m², in plane strain

/** The force that lifts the crown, 0.39 N at 6 mm, goes with the bending stiffness of the wall. */
function linerWall(): Slider {
  const slider = wall(kPlasticPipe, 3, 15);
  const lifting = { pointer: "/model/loads/1/force/1", scale: -0.00039014236863671003 / 6 ** 3, power: 3 };
  return { ...slider, targets: [...slider.targets, lifting] };
}

/** Half of a hump, or of a crooked piece, that falls as a cosine does: its height at the first offsets, as shares of the largest. */
const kCosine = [1, 0.85355339, 0.5, 0.14644661];

function hump(scale = 1): { pointer: string; scale: number }[] {
  return kCosine.map((share, i) => ({ pointer: `/model/imperfections/0/offsets/${i}/1`, scale: scale * share }));
}

const kLifted = 0.0324 * 1500;  // m of the pipe whose friction one spring has, since they may lift off
const kFriction = 0.5;          // of the pipe on the seabed, over weight and cover
const kFrictionReach = 0.002;   // m: capacity over initial stiffness
const kSegments = 7;            // of the tunnel lining's ring, each with its ground

export const kPractice: readonly Problem[] = [
  practice("liner", {
    heading: "Liner in a host pipe", picture: "liner_path", choice: { kind: "critical" },
    text: "Ground water presses on a plastic liner that the old pipe keeps from moving outwards. How much pressure does it bear?",
    sliders: [
      linerWall(),
      { name: "Gap between liner and old pipe", unit: "mm", min: 0, max: 10, log: false, step: 0.1, targets: foundations(1, "gap", 1e-3) },
    ],
  }),
  practice("pile", {
    heading: "Pile in sand and in clay, with axial and lateral load", request: "pile_sand", picture: "pile_forces", choice: kAtEnd,
    text: "How far does a pile move under lateral and axial load, in sand whose resistance grows with depth?",
    sliders: [
      { name: "Lateral force", unit: "kN", min: 50, max: 800, log: false, step: 5, targets: [{ pointer: "/model/loads/0/force/0" }] },
      { name: "Axial load", unit: "kN", min: 0, max: 4000, log: false, step: 50, targets: [{ pointer: "/model/loads/0/force/1", scale: -1 }] },
      { name: "Bending stiffness EI", unit: "kN m²", min: 2e4, max: 1e6, log: true, targets: [{ pointer: "/model/sections/0/EI" }] },
    ],
  }),
  practice("concrete_pile", {
    heading: "Concrete pile that cracks and yields", picture: "concrete_pile_forces", choice: { kind: "critical" },
    text: "A bored pile of reinforced concrete in sand. How much lateral force does it bear when the concrete cracks and the steel yields?",
    sliders: [
      { name: "Scour", unit: "m", min: 0, max: 2, log: false, step: 0.05, targets: [{ pointer: "/model/soils/0/scour/general" }] },
      {
        name: "Share of the resistance in a group", unit: "", min: 0.3, max: 1, log: false, step: 0.05,
        targets: [{ pointer: "/model/foundations/0/multiplier/p" }],
      },
      { name: "Weight of the sand under water", unit: "kN/m³", min: 6, max: 12, log: false, step: 0.5, targets: [
        { pointer: "/model/soils/0/layers/0/unit_weight" }] },
    ],
  }),
  practice("upheaval", {
    heading: "Upheaval of a heated pipeline", picture: "upheaval_path", choice: { kind: "along", branch: 0, share: 0.6 },
    text: "Over a hump of the seabed a heated pipe lifts off. When, and when does it come down again?",
    sliders: [
      { name: "Height of the hump", unit: "m", min: 0.05, max: 0.4, log: true, targets: hump() },
      { name: "Weight and cover", unit: "kN/m", min: 1, max: 12, log: false, step: 0.1, targets: [
        { pointer: "/model/loads/0/force/1", scale: -1 },
        { pointer: "/model/foundations/1/law/capacity", scale: kFriction },
        { pointer: "/model/foundations/1/law/stiffness", scale: kFriction / kFrictionReach },
        { pointer: "/model/springs/0/law/capacity", scale: kFriction * kLifted },
        { pointer: "/model/springs/0/law/stiffness", scale: kFriction * kLifted / kFrictionReach }] },
    ],
  }),
  practice("buried_pipe", {
    heading: "Buried flexible pipe with soil and overburden", picture: "buried_pipe_path", choice: { kind: "critical" },
    text: "How high may the fill above a flexible pipe be?",
    sliders: kBuriedPipe.sliders,
  }),
  practice("tunnel_arch", {
    heading: "Tunnel arch", picture: "tunnel_arch_path", choice: { kind: "critical" },
    text: "What does ground that can only push add to the limit load of a shallow arch?",
    sliders: kTunnelArch.sliders,
  }),
  practice("tunnel_lining", {
    heading: "Tunnel lining whose joints open", picture: "tunnel_lining_shape", choice: kAtEnd,
    text: "A ring of seven concrete segments in ground that presses more from above. How oval does it become when its joints open?",
    sliders: [
      { name: "Stiffness of the ground", unit: "kN/m³", min: 1000, max: 50000, log: true, targets: foundations(kSegments, "stiffness") },
      { name: "Thickness of the segments", unit: "mm", min: 250, max: 600, log: false, step: 10, targets: [
        { pointer: "/model/sections/0/shape/thickness", scale: 1e-3 }] },
    ],
  }),
  practice("column_between_walls", {
    heading: "Column between walls", picture: "column_between_walls_path", choice: { kind: "critical" },
    text: "When does a strip that lies on one wall snap to the other?",
    sliders: kWalls.sliders,
  }),
  practice("railway_track", {
    heading: "Railway track in heat", picture: "railway_track_path", choice: { kind: "critical" },
    text: "How warm may the rails become before a crooked track moves sideways?",
    sliders: [
      { name: "Crookedness", unit: "mm", min: 2, max: 40, log: true, targets: hump(1e-3) },
      { name: "Resistance of the ballast across", unit: "kN/m", min: 2, max: 20, log: true, targets: [
        { pointer: "/model/foundations/0/law/capacity" }, { pointer: "/model/foundations/0/law/stiffness", scale: 200 }] },
    ],
  }),
  practice("portal", {
    heading: "Portal frame with semi-rigid joints on footings that lift", request: "portal_footing", picture: "portal_path",
    choice: { kind: "critical" },
    text: "How far can a frame be pushed whose joints give and whose footings lift?",
    sliders: [
      { name: "Load on each column", unit: "kN", min: 50, max: 800, log: false, step: 10, targets: [
        { pointer: "/model/loads/0/force/1", scale: -1 }, { pointer: "/model/loads/1/force/1", scale: -1 }] },
      { name: "Stiffness of the joints", unit: "kN m", min: 1000, max: 1e6, log: true, targets: [
        { pointer: "/model/members/2/release/end/rotation" }, { pointer: "/model/members/5/release/end/rotation" }] },
      { name: "Stiffness of the soil", unit: "kN/m²", min: 3000, max: 300000, log: true, targets: foundations(4, "stiffness") },
    ],
  }),
  practice("braced_bay", {
    heading: "Braced bay with rods", picture: "braced_bay_shape", choice: kAtEnd,
    text: "Two crossed rods brace a bay, and only the stretched one acts. How far does the bay sway?",
    sliders: [
      { name: "Force at the corner", unit: "kN", min: -100, max: 100, log: false, step: 5, targets: [{ pointer: "/model/loads/0/force/0" }] },
      { name: "Axial stiffness of the rods", unit: "kN", min: 4000, max: 400000, log: true, targets: [{ pointer: "/model/sections/1/EA" }] },
    ],
  }),
  practice("guyed_mast", {
    heading: "Guyed mast with pretensioned ropes", picture: "guyed_mast_shape", choice: { kind: "critical" },
    text: "Two ropes hold a mast and cannot push. Which load does its head bear in the wind before the lee rope is slack?",
    sliders: [
      {
        name: "Pretension of the ropes", unit: "kN", min: 0.5, max: 10, log: false, step: 0.5,
        targets: [{ pointer: "/model/members/1/pretension/force" }, { pointer: "/model/members/2/pretension/force" }],
      },
      { name: "Wind", unit: "kN/m", min: 0.01, max: 0.25, log: false, step: 0.01, targets: [{ pointer: "/model/loads/1/force/0" }] },
      { name: "Axial stiffness of the ropes", unit: "kN", min: 100, max: 1000, log: true, targets: [{ pointer: "/model/sections/1/EA" }] },
    ],
  }),
  practice("ropeway", {
    heading: "Ropeway with a carriage", picture: "ropeway_shape", choice: kAtEnd,
    text: "A rope that cannot bend hangs between two supports. How deep does it hang under a carriage, and how much does it pull?",
    sliders: [
      { name: "Load of the carriage", unit: "kN", min: 0, max: 20, log: false, step: 1, targets: [{ pointer: "/model/loads/1/force/1", scale: -1 }] },
      { name: "Axial stiffness of the rope", unit: "kN", min: 10000, max: 100000, log: true, targets: [{ pointer: "/model/sections/0/EA" }] },
    ],
  }),
  practice("riser", {
    heading: "Touchdown of a riser", picture: "riser_shape", choice: kAtEnd,
    text: "A vessel lifts a pipe off the seabed. Where does the pipe touch down, and how is it bent there?",
    sliders: [
      { name: "Horizontal tension", unit: "kN", min: 300, max: 900, log: false, step: 10, targets: [{ pointer: "/model/loads/1/force/0" }] },
      { name: "Height of the vessel", unit: "m", min: 50, max: 220, log: false, step: 5, targets: [{ pointer: "/model/supports/1/displacement/y" }] },
    ],
  }),
  practice("film", {
    heading: "Thin film that wrinkles and then folds", picture: "film_path", choice: { kind: "along", branch: 0, share: 0.9 },
    text: "A stiff film on a soft substrate, pressed from its end: when does it wrinkle, and how does it fold?",
    sliders: [
      { name: "Substrate stiffness", unit: "K", min: 0.5, max: 2, log: true, targets: foundations(1, "stiffness") },
      { name: "Length of the half", unit: "", min: 20, max: 80, log: false, step: 1, targets: [{ pointer: "/model/nodes/1/x" }] },
    ],
  }),
  practice("masonry_arch", {
    heading: "Masonry arch with elastic backing", picture: "masonry_arch_shape", choice: { kind: "critical" },
    text: "What does backing behind the haunches add to an arch that is loaded at its quarter?",
    sliders: [
      { name: "Stiffness of the backing", unit: "kN/m³", min: 100, max: 1e6, log: true, targets: foundations(2, "stiffness") },
      { name: "Depth of the rib", unit: "m", min: 0.15, max: 0.6, log: false, step: 0.01, targets: [{ pointer: "/model/sections/0/shape/depth" }] },
    ],
  }),
];
