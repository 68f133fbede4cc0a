// The request as a form: every number of it, and the choices that people change most. What a form can't show well is edited as
// JSON; both edit the same document.

import type { ComponentChildren } from "preact";
import { useEffect, useRef } from "preact/hooks";
import type { Finding, RequestDocument } from "../api/documents";
import { formatNumber } from "../figures";
import { numbersIn, segments, valueAt, withValue } from "../model/pointer";
import { LawFigure } from "./law_figure";
import { useTypedNumber } from "./typed_field";

const kMostItems = 30;  // of each list

interface FormProps {
  request: RequestDocument;
  findings: readonly Finding[];
  /** Pointers that have a slider. */
  slid: ReadonlySet<string>;
  onChange: (request: RequestDocument) => void;
  onSlider: (pointer: string) => void;
}

const kLists = [
  ["nodes", "Nodes"], ["sections", "Sections"], ["members", "Members"], ["supports", "Supports"], ["springs", "Springs"],
  ["foundations", "Foundations"], ["loads", "Loads"], ["masses", "Masses"], ["imperfections", "Imperfections"],
] as const;

/** Fields with a few words to choose from, by their list; the first is the default. */
const kChoices: Record<string, Record<string, readonly string[]>> = {
  foundations: { reaction: ["bilateral", "compression_only", "tension_only"], side: ["left", "right"] },
  springs: { reaction: ["bilateral", "compression_only", "tension_only"] },
  loads: { pattern: ["proportional", "constant"] },
};

const kIndexNames: Record<string, readonly string[]> = { force: ["x", "y"], direction: ["x", "y"], range: ["from", "to"] };

/** A field's name within its item: "force y", "offsets 3, 2". */
function fieldName(pointer: string, depth: number): string {
  const parts = segments(pointer).slice(depth);
  const [field = "", ...indices] = parts;
  const names = kIndexNames[field];
  const rest = indices.map((part) => (/^\d+$/.test(part) ? names?.[Number(part)] ?? String(Number(part) + 1) : part));
  return [field.replace(/_/g, " "), ...rest].join(" ");
}

function findingsAt(findings: readonly Finding[], pointer: string): readonly Finding[] {
  return findings.filter((one) => one.pointer === pointer);
}

interface NumberProps extends FormProps {
  pointer: string;
  name: string;
}

function NumberField({ request, findings, slid, onChange, onSlider, pointer, name }: NumberProps) {
  const value = valueAt(request, pointer);
  const { typed, trouble, input, accept, key } = useTypedNumber(typeof value === "number" ? value : null,
                                                               (next) => onChange(withValue(request, pointer, next)));
  const wrong = trouble === "" ? findingsAt(findings, pointer).map((one) => one.detail) : [trouble];
  const shown = typed ?? (typeof value === "number" ? formatNumber(value, 6) : "");
  const id = `field${pointer}`;
  return (
    <div class="field">
      <label for={id}>{name}</label>
      <button type="button" class="quiet" disabled={slid.has(pointer)} onClick={() => onSlider(pointer)}
              aria-label={`Give ${name} a slider`}>+ slider</button>
      <input id={id} type="text" inputMode="decimal" value={shown} aria-invalid={wrong.length > 0}
             aria-describedby={wrong.length > 0 ? `${id}-wrong` : undefined}
             onInput={(event) => input(event.currentTarget.value)} onBlur={accept} onKeyDown={key} />
      {wrong.length > 0 ? <p class="wrong" id={`${id}-wrong`}>{wrong.join(" ")}</p> : null}
    </div>
  );
}

function ChoiceField({ request, onChange, pointer, name, options }: FormProps & {
  pointer: string; name: string; options: readonly string[];
}) {
  const value = valueAt(request, pointer);
  return (
    <div class="field">
      <label for={`field${pointer}`}>{name}</label>
      <select id={`field${pointer}`} value={typeof value === "string" ? value : options[0]}
              onChange={(event) => onChange(withValue(request, pointer, event.currentTarget.value))}>
        {options.map((option) => <option key={option} value={option}>{option.replace(/_/g, " ")}</option>)}
      </select>
    </div>
  );
}

/** A field that is true or left out. */
function FlagField({ request, onChange, pointer, name }: FormProps & { pointer: string; name: string }) {
  return (
    <div class="field checks">
      <label>
        <input type="checkbox" checked={valueAt(request, pointer) === true}
               onChange={(event) => onChange(withValue(request, pointer, event.currentTarget.checked))} />{name}
      </label>
    </div>
  );
}

const kComponents = ["x", "y", "rotation"] as const;

function FixedField({ request, onChange, pointer }: FormProps & { pointer: string }) {
  const value = valueAt(request, pointer);
  const fixed = Array.isArray(value) ? (value as string[]) : [];
  return (
    <fieldset class="field checks"><legend>fixed</legend>
      {kComponents.map((component) => (
        <label key={component}>
          <input type="checkbox" checked={fixed.includes(component)} onChange={(event) => {
            const wanted = kComponents.filter((one) => (one === component ? event.currentTarget.checked : fixed.includes(one)));
            onChange(withValue(request, pointer, wanted));
          }} />{component}
        </label>
      ))}
    </fieldset>
  );
}

function titleOf(item: Record<string, unknown>, index: number): string {
  const place = (item["at"] ?? {}) as Record<string, unknown>;
  const name = item["id"] ?? item["node"] ?? item["member"] ?? place["node"] ?? place["member"] ?? "";
  return `${typeof item["type"] === "string" ? `${item["type"].replace(/_/g, " ")} ` : ""}${typeof name === "string" ? name : ""}`.trim() ||
    String(index + 1);
}

/** The choices that an item has: friction along a member is bilateral, and neither it nor a fixed direction has a side. */
function choicesOf(list: string, fields: Record<string, unknown>): [string, readonly string[]][] {
  if (fields["component"] === "tangent" || fields["component"] === "rotation") return [];
  return Object.entries(kChoices[list] ?? {}).filter(([field]) => field !== "side" || !Array.isArray(fields["direction"]));
}

function Item({ list, index, ...form }: FormProps & { list: string; index: number }) {
  const at = `/model/${list}/${index}`;
  const item = valueAt(form.request, at);
  if (typeof item !== "object" || item === null) return null;
  const fields = item as Record<string, unknown>;
  const choices = choicesOf(list, fields);
  const own = form.findings.filter((one) => one.pointer === at || (one.pointer.startsWith(`${at}/`) &&
    typeof valueAt(form.request, one.pointer) !== "number"));
  return (
    <div class="item">
      <p class="item-name">{titleOf(fields, index)}</p>
      {own.map((one) => <p class="wrong" key={one.pointer}>{one.detail}</p>)}
      {numbersIn(item).map(({ pointer }) => (
        <NumberField key={pointer} {...form} pointer={at + pointer} name={fieldName(at + pointer, 3)} />
      ))}
      {choices.map(([field, options]) => (
        <ChoiceField key={field} {...form} pointer={`${at}/${field}`} name={field} options={options} />
      ))}
      {list === "springs" || list === "foundations"
        ? <LawFigure list={list} support={fields} units={form.request.model.units} /> : null}
      {list === "loads" && fields["type"] === "point"
        ? <>
            <FlagField {...form} pointer={`${at}/follows`} name="turns with its place" />
            <FlagField {...form} pointer={`${at}/fixed_line`} name="stays on its line" />
          </> : null}
      {list === "supports" ? <FixedField {...form} pointer={`${at}/fixed`} /> : null}
    </div>
  );
}

/** A part of the form that opens where something is wrong, and stays open when it has been put right. */
function Part({ heading, told, wrong, children }: {
  heading: string; told: string | number; wrong: boolean; children: ComponentChildren;
}) {
  const place = useRef<HTMLDetailsElement>(null);
  useEffect(() => {
    if (wrong && place.current) place.current.open = true;
  }, [wrong]);
  return <details ref={place}><summary>{heading}<span>{told}</span></summary>{children}</details>;
}

function DampingPart(form: FormProps) {
  const { damping } = form.request.model;
  const wrong = form.findings.filter((one) => one.pointer.startsWith("/model/damping"));
  if (!damping && wrong.length === 0) return null;
  const numbers = numbersIn(damping);
  return (
    <Part heading="Damping" told={numbers.length} wrong={wrong.length > 0}>
      <div class="item">
        {wrong.filter((one) => typeof valueAt(form.request, one.pointer) !== "number")
          .map((one) => <p class="wrong" key={one.pointer}>{one.detail}</p>)}
        {numbers.map(({ pointer }) => (
          <NumberField key={pointer} {...form} pointer={`/model/damping${pointer}`} name={fieldName(pointer, 0)} />
        ))}
      </div>
    </Part>
  );
}

export function ModelForm(form: FormProps) {
  const { request, findings } = form;
  return (
    <div class="model-form">
      {kLists.map(([list, heading]) => {
        const items = request.model[list] ?? [];
        const wrong = findings.some((one) => one.pointer.startsWith(`/model/${list}`));
        if (items.length === 0 && !wrong) return null;
        return (
          <Part key={list} heading={heading} told={items.length} wrong={wrong}>
            {findingsAt(findings, `/model/${list}`).map((one) => <p class="wrong" key={one.detail}>{one.detail}</p>)}
            {items.slice(0, kMostItems).map((_, i) => <Item key={i} {...form} list={list} index={i} />)}
            {items.length > kMostItems ? <p class="hint">The first {kMostItems}; the others are in the JSON.</p> : null}
          </Part>
        );
      })}
      <DampingPart {...form} />
      <Part heading="Analysis" told={request.analysis.type} wrong={findings.some((one) => one.pointer.startsWith("/analysis"))}>
        <div class="item">
          <ChoiceField {...form} pointer="/analysis/type" name="type" options={["critical", "path", "buckling", "static", "vibration"]} />
          {request.analysis.type === "path"
            ? <ChoiceField {...form} pointer="/analysis/branches/follow" name="branches" options={["primary", "first", "all"]} /> : null}
          {findings.filter((one) => one.pointer.startsWith("/analysis")).map((one) => (
            <p class="wrong" key={one.pointer}>{one.pointer}: {one.detail}</p>
          ))}
          {numbersIn(request.analysis).map(({ pointer }) => (
            <NumberField key={pointer} {...form} pointer={`/analysis${pointer}`} name={fieldName(pointer, 0)} />
          ))}
        </div>
      </Part>
    </div>
  );
}
