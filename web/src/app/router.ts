// Addresses: #/studio, #/model, #/jobs, #/jobs/ID, #/sweeps, #/sweeps/ID, #/docs, #/docs/NAME.

import { useEffect, useState } from "preact/hooks";

export interface Route {
  view: string;
  id: string | null;
  query: URLSearchParams;
}

export function readRoute(hash: string): Route {
  const [path = "", query = ""] = hash.replace(/^#\/?/, "").split("?");
  const [view = "", ...rest] = path.split("/");
  const id = rest.map(decodeURIComponent).join("/");
  return { view: view === "" ? "studio" : view, id: id === "" ? null : id, query: new URLSearchParams(query) };
}

export function useRoute(): Route {
  const [route, setRoute] = useState(() => readRoute(location.hash));
  useEffect(() => {
    const changed = (): void => setRoute(readRoute(location.hash));
    addEventListener("hashchange", changed);
    return () => removeEventListener("hashchange", changed);
  }, []);
  return route;
}

export function go(hash: string): void {
  location.hash = hash;
}
