// The drawing of a state: pan, zoom, and what the state says at the place that is pointed at.

import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import type { Mode, Model, State } from "../api/documents";
import { shapeNode } from "../app/shape_view";
import { useSize } from "../app/size";
import { fileName, savePng, saveSvg } from "../export/files";
import {
  drawingFigure, drawingView, formatWithUnit, locate, modeMotion, suggestedFactor, unitOf, zoomed, type DrawingInput, type Located,
  type Pixel, type Shape, type Size, type View,
} from "../figures";
import { Card, Menu } from "./card";

export interface Pointed {
  member: string;
  s: number;
}

interface DrawingProps {
  model: Model;
  state: State | null;
  mode: Mode | null;
  /** The shape of the mode's motion a quarter of a period later; null where the whole motion then passes the equilibrium. */
  quadrature: Mode | null;
  /** Whether the mode swings about the equilibrium. */
  animated: boolean;
  loadFactor: number | null;
  unstable: boolean;
  room: readonly State[];
  cursor: Pointed | null;
  onCursor: (cursor: Pointed | null) => void;
  class?: string;
}

const kZoomStep = 1.25;
const kPeriod = 2000;  // ms, the period of an animated mode, whatever its frequency is

function pixelIn(element: Element, event: MouseEvent): Pixel {
  const box = element.getBoundingClientRect();
  return { x: event.clientX - box.left, y: event.clientY - box.top };
}

/** What stands beside the pointer. */
function Told({ place, model, size }: { place: Located; model: Model; size: Size }) {
  const { state } = place;
  const units = model.units;
  const rows: [string, string][] = [["s", formatWithUnit(place.s, unitOf(units, "length"))]];
  if (state) {
    rows.push(["displacement", formatWithUnit(state.displacement, unitOf(units, "length"))],
              ["N", formatWithUnit(state.N, unitOf(units, "force"))], ["Q", formatWithUnit(state.Q, unitOf(units, "force"))],
              ["M", formatWithUnit(state.M, unitOf(units, "moment"))]);
    for (const one of state.reactions) {
      rows.push([one.contact ? "reaction" : "no contact", formatWithUnit(one.reaction, unitOf(units, "line_load"))]);
    }
  }
  const corner = `told ${place.pixel.x > size.width / 2 ? "at-left" : "at-right"} ${place.pixel.y > size.height / 2 ? "at-top" : "at-bottom"}`;
  return (
    <dl class={corner}>
      <div class="told-name">{place.member}</div>
      {rows.map(([name, value], i) => <div key={i}><dt>{name}</dt><dd>{value}</dd></div>)}
    </dl>
  );
}

/** Keys that move and zoom the drawing, and the part of its size that each moves by. */
const kMoves: Record<string, readonly [number, number]> = {
  ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1],
};

/** Draws the lines of a mode that swings, and nothing else, at each frame. The phase is 0 when the component appears. */
function MovingMode({ motion }: { motion: (phase: number) => Shape }) {
  const [phase, setPhase] = useState(0);
  useEffect(() => {
    let begin: number | null = null;
    const show = (time: number): void => {
      begin ??= time;
      setPhase(2 * Math.PI * (((time - begin) / kPeriod) % 1));
      frame = requestAnimationFrame(show);
    };
    let frame = requestAnimationFrame(show);
    return () => cancelAnimationFrame(frame);
  }, []);
  return <>{shapeNode(motion(phase))}</>;
}

interface PictureProps {
  input: DrawingInput;
  size: Size;
  animated: boolean;
  onCursor: DrawingProps["onCursor"];
}

function Picture({ input, size, animated, onCursor }: PictureProps) {
  const fitted = useMemo(() => drawingView(input, size), [input.model, input.room, input.factor, size]);
  const [moved, setMoved] = useState<{ fitted: View; view: View } | null>(null);
  const view = moved?.fitted === fitted ? moved.view : fitted;
  const [told, setTold] = useState<Located | null>(null);
  const drag = useRef<Pixel | null>(null);
  const setView = (next: View): void => setMoved({ fitted, view: next });
  const figure = useMemo(() => {
    const motion = animated ? modeMotion(input, view) : null;
    return shapeNode(drawingFigure(input, size, view), undefined, (shape, key) =>
      motion && shape.attributes["class"] === "modes" ? <MovingMode key={key} motion={motion} /> : null);
  }, [input, size, view, animated]);
  const middle = { x: size.width / 2, y: size.height / 2 };
  const point = (event: PointerEvent): void => {
    const at = pixelIn(event.currentTarget as Element, event);
    if (drag.current) {
      setView(zoomed(view, 1, at, { x: at.x - drag.current.x, y: at.y - drag.current.y }));
      drag.current = at;
      return;
    }
    const place = locate(input, size, at, view);
    const near = place && place.distance < 40 ? place : null;
    setTold(near);
    onCursor(near && { member: near.member, s: near.s });
  };
  const press = (event: KeyboardEvent): void => {
    const move = kMoves[event.key];
    if (move) setView(zoomed(view, 1, middle, { x: move[0] * size.width, y: move[1] * size.height }));
    else if (event.key === "+" || event.key === "=") setView(zoomed(view, kZoomStep, middle));
    else if (event.key === "-") setView(zoomed(view, 1 / kZoomStep, middle));
    else if (event.key === "0" || event.key === "Home") setMoved(null);
    else return;
    event.preventDefault();
  };
  return (
    <div class="picture pannable" tabIndex={0} role="group" aria-label="Drawing. Arrow keys move it, plus and minus zoom, 0 shows all."
         onKeyDown={press} onDblClick={() => setMoved(null)}
         onWheel={(event) => {
           event.preventDefault();
           setView(zoomed(view, kZoomStep ** (-event.deltaY / 100), pixelIn(event.currentTarget, event)));
         }}
         onPointerDown={(event) => {
           if (event.pointerType === "touch") return;
           drag.current = pixelIn(event.currentTarget, event);
           event.currentTarget.setPointerCapture(event.pointerId);
         }}
         onPointerUp={() => (drag.current = null)} onPointerMove={point}
         onPointerLeave={() => {
           setTold(null);
           onCursor(null);
         }}>
      {figure}
      {told ? <Told place={told} model={input.model} size={size} /> : null}
    </div>
  );
}

export function DrawingCard(props: DrawingProps) {
  const [place, size] = useSize<HTMLDivElement>();
  const [enlarged, setEnlarged] = useState(false);
  const { model, state, mode, quadrature, loadFactor, unstable, room, cursor } = props;
  const factor = enlarged && state ? suggestedFactor({ model, state }) : 1;
  const input = useMemo<DrawingInput>(() => ({ model, state, mode, quadrature, loadFactor, unstable, room, cursor, factor }),
                                      [model, state, mode, quadrature, loadFactor, unstable, room, cursor, factor]);
  const small = state !== null && suggestedFactor({ model, state }) > 1;
  const name = fileName(model.title ?? "", "");
  const take = (): ReturnType<typeof drawingFigure> => drawingFigure({ ...input, cursor: null }, size ?? { width: 600, height: 500 });
  return (
    <Card title="Drawing" class={`drawing-card ${props.class ?? ""}`} tools={
      <>
        {small || enlarged
          ? <label class="check"><input type="checkbox" checked={enlarged}
                                        onChange={(event) => setEnlarged(event.currentTarget.checked)} />enlarge displacements</label>
          : null}
        <Menu label="Export" items={[
          { text: "SVG", act: () => saveSvg(`${name}-drawing.svg`, take()) },
          { text: "PNG", act: () => void savePng(`${name}-drawing.png`, take()) },
        ]} />
      </>
    }>
      <div class="fill" ref={place}>
        {size && size.height > 20 ? <Picture input={input} size={size} animated={props.animated} onCursor={props.onCursor} /> : null}
      </div>
    </Card>
  );
}
