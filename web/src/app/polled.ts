// A value that is asked for again and again while the page is looked at.

import { useCallback, useEffect, useRef, useState } from "preact/hooks";
import { connection } from "../api/client";

/** @returns the last value, what went wrong with the last question, and a way to ask at once. */
export function usePolled<T>(ask: () => Promise<T>, key: string, every: number): [T | null, unknown, () => void] {
  const [value, setValue] = useState<T | null>(null);
  const [trouble, setTrouble] = useState<unknown>(null);
  const asked = useRef(ask);
  asked.current = ask;
  const once = useCallback((): Promise<void> => asked.current().then((next) => {
    setValue(next);
    setTrouble(null);
  }, setTrouble), []);
  useEffect(() => {
    setValue(null);
    let timer: ReturnType<typeof setTimeout>;
    let ended = false;
    const loop = async (): Promise<void> => {
      if (!document.hidden && connection.get().state === "there") await once();
      if (!ended && every > 0) timer = setTimeout(() => void loop(), every);
    };
    void loop();
    const end = connection.subscribe(() => void (connection.get().state === "there" ? once() : undefined));
    return () => {
      ended = true;
      clearTimeout(timer);
      end();
    };
  }, [key, every]);
  return [value, trouble, () => void once()];
}
