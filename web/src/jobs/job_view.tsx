export function JobView({ id }: { id: string }) { return <main class="plain">{id}</main>; }
