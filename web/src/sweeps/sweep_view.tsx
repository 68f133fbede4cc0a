export function SweepView({ id }: { id: string }) { return <main class="plain">{id}</main>; }
