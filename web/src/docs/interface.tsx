// The interface's document as a page: every operation, then every schema with its fields, bounds and units.

import type { ComponentChildren } from "preact";
import { useMemo } from "preact/hooks";
import { documentAddress } from "./contents";
import { boundsOf, callsOf, curlOf, nameOf, reachable, type Answer, type Call, type OpenApi, type Schema } from "./openapi";
import { useSection } from "./section";

const kName = "interface";
/** What explains the schemas that each of these refers to, the first that does. */
const kExplained: readonly [string, string][] = [["Request", "requests"], ["Result", "results"], ["SweepDocument", "sweeps"]];

function schemaSection(name: string): string {
  return `schema-${name}`;
}

function Reference({ to }: { to: string }) {
  const name = nameOf(to);
  return <a href={documentAddress(kName, schemaSection(name))}>{name}</a>;
}

function separated(parts: ComponentChildren[], separator: string): ComponentChildren[] {
  return parts.flatMap((part, i) => (i === 0 ? [part] : [separator, part]));
}

/** What a value is, in a line; schemas that have a name are links. */
function Kind({ schema }: { schema: Schema }) {
  if (schema.$ref) return <Reference to={schema.$ref} />;
  if (schema.const !== undefined) return <code>{JSON.stringify(schema.const)}</code>;
  if (schema.enum) return <>{separated(schema.enum.map((value) => <code>{JSON.stringify(value)}</code>), ", ")}</>;
  const choice = schema.oneOf ?? schema.anyOf;
  if (choice?.every((one) => one.properties)) return <>object in one of {choice.length} forms</>;
  if (choice && !schema.properties) return <>{separated(choice.map((one) => <Kind schema={one} />), " or ")}</>;
  if (schema.prefixItems) return <>[{separated(schema.prefixItems.map((one) => <Kind schema={one} />), ", ")}]</>;
  if (schema.items) return <>list of <Kind schema={schema.items} /></>;
  if (!schema.properties && typeof schema.additionalProperties === "object") {
    return <>by name: <Kind schema={schema.additionalProperties} /></>;
  }
  return <>{[schema.type ?? "any value"].flat().join(" or ")}</>;
}

/** Parts of a value that has no schema of its own: choices that say more than their kind, fields, entries. */
function Inside({ schema }: { schema: Schema }) {
  const choices = (schema.oneOf ?? schema.anyOf ?? []).filter((one) => !one.$ref || one.description);
  const parts = [...choices, ...(schema.prefixItems ?? [])];
  return (
    <>
      {parts.some((one) => one.description || one.properties || boundsOf(one).length > 0)
        ? <ul>{parts.map((one, i) => <li key={i}><Kind schema={one} />: <Said schema={one} /></li>)}</ul> : null}
      {schema.items ? <Inside schema={schema.items} /> : null}
      {schema.properties ? <Fields schema={schema} /> : null}
      {typeof schema.additionalProperties === "object" ? <Inside schema={schema.additionalProperties} /> : null}
    </>
  );
}

/** Description, bounds and parts of a value. */
function Said({ schema }: { schema: Schema }) {
  const bounds = boundsOf(schema);
  return (
    <>
      {schema.description}
      {bounds.length > 0 ? <span class="bounds">{schema.description ? " · " : ""}{bounds.join(" · ")}</span> : null}
      <Inside schema={schema} />
    </>
  );
}

function Table({ heads, rows }: { heads: string[]; rows: ComponentChildren[][] }) {
  return (
    <div class="scroller" tabIndex={0} role="group" aria-label="Table">
      <table>
        <thead><tr>{heads.map((head) => <th key={head} class="left">{head}</th>)}</tr></thead>
        <tbody>{rows.map((row, r) => <tr key={r}>{row.map((cell, c) => <td key={c} class="left">{cell}</td>)}</tr>)}</tbody>
      </table>
    </div>
  );
}

function Fields({ schema }: { schema: Schema }) {
  const required = new Set(schema.required);
  return (
    <Table heads={["field", "value", "what"]} rows={Object.entries(schema.properties ?? {}).map(([name, field]) => [
      <><code>{name}</code>{required.has(name) ? " (required)" : ""}</>, <Kind schema={field} />, <Said schema={field} />])} />
  );
}

function Content({ content }: { content: Answer["content"] }) {
  return <>{separated(Object.entries(content ?? {}).map(([type, { schema }]) => (
    <>{schema ? <><Kind schema={schema} /> as </> : null}<code>{type}</code></>
  )), "; ")}</>;
}

function OperationBlock({ api, call, origin }: { api: OpenApi; call: Call; origin: string | null }) {
  const { method, path, operation, parameters } = call;
  const body = operation.requestBody?.content;
  const example = Object.values(body ?? {}).find((one) => one.example !== undefined)?.example;
  const answers = Object.entries(operation.responses).map(([status, given]): [string, Answer] =>
    [status, given.$ref ? api.components.responses[nameOf(given.$ref)] ?? given : given]);
  return (
    <section>
      <h3 id={operation.operationId} tabIndex={-1}><code>{method} {path}</code></h3>
      <p>{operation.summary}.{operation.description ? ` ${operation.description}` : ""}</p>
      {parameters.length > 0 ? <Table heads={["parameter", "in", "value", "what"]} rows={parameters.map((one) => [
        <><code>{one.name}</code>{one.required ? " (required)" : ""}</>, one.in, <Kind schema={one.schema} />,
        <Said schema={{ ...one.schema, description: one.description ?? "" }} />])} /> : null}
      {body ? <p>Body: <Content content={body} /></p> : null}
      {origin !== null ? <pre tabIndex={0}><code>{curlOf(call, origin)}</code></pre> : null}
      {example !== undefined ? <pre tabIndex={0} aria-label="example.json"><code>{JSON.stringify(example, null, 1)}</code></pre> : null}
      <Table heads={["status", "answer", "what"]} rows={answers.map(([status, answer]) => [
        status, <Content content={answer.content} />,
        <>{answer.description}{answer.headers ? <ul>{Object.entries(answer.headers).map(([name, header]) => (
          <li key={name}><code>{name}</code>: {header.description}</li>))}</ul> : null}</>])} />
    </section>
  );
}

function SchemaBlock({ name, schema, explained }: { name: string; schema: Schema; explained: string | undefined }) {
  return (
    <section>
      <h3 id={schemaSection(name)} tabIndex={-1}>{name}</h3>
      <p>
        <Kind schema={schema} />. <Said schema={schema} />
      </p>
      {explained ? <p class="hint">Examples and rules: <a href={documentAddress(explained)}>{explained}</a></p> : null}
    </section>
  );
}

export function InterfaceView({ text, section }: { text: string; section: string }) {
  const api = useMemo(() => JSON.parse(text) as OpenApi, [text]);
  const calls = useMemo(() => callsOf(api, api.paths), [api]);
  const explained = useMemo(() => kExplained.map(([root, name]): [Set<string>, string] =>
    [reachable(api, { $ref: `#/components/schemas/${root}` }), name]), [api]);
  useSection(text, section);
  const at = (name: string, heading: string): ComponentChildren => (
    <li key={name} class="deeper"><a href={documentAddress(kName, name)}>{heading}</a></li>);
  return (
    <>
      <nav class="card sections" aria-label="Sections">
        <p><a href="#/docs">All documents</a></p>
        <ul>
          {api.tags.flatMap(({ name }) => [
            <li key={name}><a href={documentAddress(kName, name)}>{name}</a></li>,
            ...calls.filter(({ operation }) => operation.tags.includes(name))
              .map(({ method, path, operation }) => at(operation.operationId, `${method} ${path}`))])}
          <li><a href={documentAddress(kName, "schemas")}>Documents and their fields</a></li>
          {Object.keys(api.components.schemas).map((name) => at(schemaSection(name), name))}
        </ul>
      </nav>
      <article class="card document interface">
        <h1>The interface</h1>
        <p>{api.info.description}</p>
        <p><a href="/v1/openapi.json">OpenAPI document</a>, version {api.info.version}. How answers, waiting and errors belong
          together: <a href={documentAddress("service")}>The service</a>.</p>
        {api.tags.map(({ name, description }) => (
          <section key={name}>
            <h2 id={name} tabIndex={-1}>{description}</h2>
            {calls.filter(({ operation }) => operation.tags.includes(name)).map((call) => (
              <OperationBlock key={call.operation.operationId} api={api} call={call} origin={location.origin} />))}
          </section>
        ))}
        <h2 id="webhooks" tabIndex={-1}>What the service sends</h2>
        {callsOf(api, api.webhooks).map((call) => (
          <OperationBlock key={call.operation.operationId} api={api} call={call} origin={null} />))}
        <h2 id="schemas" tabIndex={-1}>Documents and their fields</h2>
        {Object.entries(api.components.schemas).map(([name, schema]) => (
          <SchemaBlock key={name} name={name} schema={schema} explained={explained.find(([names]) => names.has(name))?.[1]} />))}
      </article>
    </>
  );
}
