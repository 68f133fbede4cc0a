// The text field of a number. A text that is no number stays in the field, and the field says why.

import { useState } from "preact/hooks";
import { readNumber } from "../model/typed_number";

export interface TypedField {
  /** What is typed; null where the field shows its value. */
  typed: string | null;
  /** Why it is no number; "" where nothing is wrong. */
  trouble: string;
  /** Takes what stands in the field. */
  input: (text: string) => void;
  /** Hands the number on, or says why there is none. */
  accept: () => void;
  /** Enter accepts, Escape goes back to the value. */
  key: (event: KeyboardEvent) => void;
}

/** @param onNumber called with another number than `value` */
export function useTypedNumber(value: number | null, onNumber: (value: number) => void): TypedField {
  const [typed, setTyped] = useState<string | null>(null);
  const [trouble, setTrouble] = useState("");
  const input = (text: string): void => {
    setTyped(text);
    setTrouble("");
  };
  const leave = (): void => {
    setTyped(null);
    setTrouble("");
  };
  const accept = (): void => {
    if (typed === null) return;
    const read = readNumber(typed);
    if ("trouble" in read) {
      setTrouble(read.trouble);
      return;
    }
    leave();
    if (read.value !== value) onNumber(read.value);
  };
  const key = (event: KeyboardEvent): void => {
    if (event.key === "Enter") accept();
    if (event.key === "Escape") leave();
  };
  return { typed, trouble, input, accept, key };
}
