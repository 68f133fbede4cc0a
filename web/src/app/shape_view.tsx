// Figures as nodes of the page: the same tree that an exported file is written from.

import { h, type VNode } from "preact";
import type { Shape } from "../figures";

/** Gives the node that replaces a shape; null keeps the shape. */
export type Replace = (shape: Shape, key: number | undefined) => VNode | null;

export function shapeNode(shape: Shape | string, key?: number, replace?: Replace): VNode | string {
  if (typeof shape === "string") return shape;
  const other = replace?.(shape, key);
  if (other) return other;
  const children = shape.children.map((child, i) => shapeNode(child, i, replace));
  return h(shape.name, { ...shape.attributes, key }, ...children) as VNode;
}
