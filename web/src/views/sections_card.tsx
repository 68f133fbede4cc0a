// Section forces of the chosen state along the members.

import type { Model, State } from "../api/documents";
import { Card } from "./card";
import type { Pointed } from "./drawing_card";

interface SectionsProps {
  model: Model;
  state: State | null;
  cursor: Pointed | null;
  onCursor: (cursor: Pointed | null) => void;
  class?: string;
}

export function SectionsCard({ class: name = "" }: SectionsProps) {
  return <Card title="Section forces" class={`sections-card ${name}`}><div class="fill" /></Card>;
}
