// A page without a service: its own document says so, and the solver beside it answers what the service would.

type Send = (address: string, request: RequestInit) => Promise<Response>;

const kSolver = "solver/";  // folder of the npm package snapthrough-solver, beside the page

/** Whether the document has <meta name="snapthrough-solver" content="local">, as those of scripts/site.sh. */
export const isLocal = document.querySelector<HTMLMetaElement>('meta[name="snapthrough-solver"]')?.content === "local";

async function startSolver(): Promise<Send> {
  const at = (name: string): string => new URL(kSolver + name, document.baseURI).href;
  const [{ Solver }, { LocalService }] = await Promise.all([import(at("index.js")), import(at("service.js"))]);
  return new LocalService(Solver.create(), document.baseURI).fetch as Send;
}

const solver = isLocal ? startSolver() : null;

/** Asks the service, or the solver of a page without one. */
export const send: Send = solver ? async (address, request) => (await solver)(address, request) : (address, request) => fetch(address, request);
