export function JobsView() { return <main class="plain"></main>; }
