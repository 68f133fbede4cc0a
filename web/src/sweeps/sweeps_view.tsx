export function SweepsView() { return <main class="plain"></main>; }
