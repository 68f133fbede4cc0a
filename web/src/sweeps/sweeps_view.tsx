// Sweeps, newest first, live.

import { useState } from "preact/hooks";
import type { Sweep } from "../api/documents";
import { isActive, service } from "../api/client";
import { usePolled } from "../app/polled";
import { ago, badgeOf, kStatuses } from "../app/words";
import { formatNumber } from "../figures";
import { Trouble } from "../studio/trouble";

const kEvery = 2000;  // ms
const kPage = 25;

function Row({ sweep, onChanged }: { sweep: Sweep; onChanged: () => void }) {
  const { points, counts } = sweep;
  const busy = isActive(sweep.status);
  const act = (work: Promise<unknown>): void => {
    void work.catch(() => undefined).then(onChanged);
  };
  return (
    <tr>
      <td><span class={badgeOf(sweep.status)}>{sweep.status}</span></td>
      <td class="left wide"><a href={`#/sweeps/${sweep.id}`}>{sweep.title === "" ? sweep.id : sweep.title}</a></td>
      <td class="left">{sweep.label ?? ""}</td>
      <td>{formatNumber(points - counts.remaining, 6)} of {formatNumber(points, 6)}</td>
      <td>{counts.failed > 0 ? formatNumber(counts.failed, 6) : ""}</td>
      <td>{ago(sweep.created)}</td>
      <td>
        {busy
          ? <button type="button" class="quiet" aria-label={`Dismiss ${sweep.title}`}
                    onClick={() => act(service.dismissSweep(sweep.id))}>Dismiss</button>
          : <button type="button" class="quiet" aria-label={`Delete ${sweep.title}`}
                    onClick={() => act(service.deleteSweep(sweep.id))}>Delete</button>}
      </td>
    </tr>
  );
}

export function SweepsView() {
  const [status, setStatus] = useState("");
  const query = new URLSearchParams({ limit: String(kPage), ...(status === "" ? {} : { status }) }).toString();
  const [list, trouble, again] = usePolled(() => service.sweeps(query), query, kEvery);
  return (
    <main id="main" tabIndex={-1} class="plain">
      <section class="card" aria-labelledby="sweeps-title">
        <h1 id="sweeps-title">Sweeps</h1>
        <div class="filters">
          <label>State <select value={status} onChange={(event) => setStatus(event.currentTarget.value)}>
            <option value="">all</option>{kStatuses.map((one) => <option key={one}>{one}</option>)}</select></label>
        </div>
        <Trouble error={trouble} />
        <div class="scroller" tabIndex={0} role="region" aria-label="Table of sweeps">
          <table class="list">
            <thead><tr><th scope="col">State</th><th scope="col" class="left">Model</th><th scope="col" class="left">Label</th>
              <th scope="col">Done</th><th scope="col">Failed</th><th scope="col">Submitted</th>
              <th scope="col"><span class="unseen">Actions</span></th></tr></thead>
            <tbody>{list?.sweeps.map((sweep) => <Row key={sweep.id} sweep={sweep} onChanged={again} />)}</tbody>
          </table>
        </div>
        {list && list.sweeps.length === 0
          ? <p class="hint">No sweeps. Build one from the sliders of the <a href="#/studio">studio</a>, under Sweep.</p> : null}
      </section>
    </main>
  );
}
