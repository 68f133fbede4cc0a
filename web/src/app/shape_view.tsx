// Figures as nodes of the page: the same tree that an exported file is written from.

import { h, type VNode } from "preact";
import type { Shape } from "../figures";

export function shapeNode(shape: Shape | string, key?: number): VNode | string {
  if (typeof shape === "string") return shape;
  const children = shape.children.map((child, i) => shapeNode(child, i));
  return h(shape.name, { ...shape.attributes, key }, ...children) as VNode;
}
