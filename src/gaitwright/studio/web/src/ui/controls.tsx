// The few controls that everything is made of.

import type { ComponentChildren } from "preact";

export function Section(props: { title: string; children: ComponentChildren; aside?: ComponentChildren }) {
  return (
    <section class="section">
      <h2>
        {props.title}
        {props.aside !== undefined && <span class="aside">{props.aside}</span>}
      </h2>
      {props.children}
    </section>
  );
}

/** A label and what belongs to it, aligned with all others. */
export function Field({ label, children }: { label: string; children: ComponentChildren }) {
  return (
    <div class="field">
      <span class="label">{label}</span>
      <div class="value">{children}</div>
    </div>
  );
}

interface Choice<T extends string | number> {
  value: T;
  label?: ComponentChildren;
  title?: string;
}

/** One of a few, side by side. */
export function Segmented<T extends string | number>(props: {
  id: string;
  choices: Choice<T>[];
  value: T;
  choose: (value: T) => void;
  disabled?: boolean;
}) {
  return (
    <div class="segmented" role="radiogroup" data-testid={props.id}>
      {props.choices.map(({ value, label, title }) => (
        <button
          key={value}
          role="radio"
          aria-checked={value === props.value}
          title={title}
          disabled={props.disabled}
          data-testid={`${props.id}-${value}`}
          onClick={() => props.choose(value)}
        >
          {label ?? value}
        </button>
      ))}
    </div>
  );
}

export function Select(props: {
  id: string;
  choices: string[];
  value: string;
  choose: (value: string) => void;
  disabled?: boolean;
  title?: string;
  /** Of each choice. */
  titles?: Record<string, string>;
}) {
  return (
    <select
      data-testid={props.id}
      value={props.value}
      title={props.title}
      disabled={props.disabled}
      onChange={(event) => props.choose(event.currentTarget.value)}
    >
      {!props.choices.includes(props.value) && <option value={props.value}>{props.value || "–"}</option>}
      {props.choices.map((choice) => (
        <option key={choice} value={choice} title={props.titles?.[choice]}>
          {choice || "–"}
        </option>
      ))}
    </select>
  );
}

export function Slider(props: {
  id: string;
  label: string;
  unit: string;
  value: number;
  least: number;
  most: number;
  step: number;
  digits?: number;
  change: (value: number) => void;
  release?: () => void;
  disabled?: boolean;
}) {
  return (
    <label class="slider">
      <span class="label">{props.label}</span>
      <input
        type="range"
        data-testid={props.id}
        min={props.least}
        max={props.most}
        step={props.step}
        value={props.value}
        disabled={props.disabled}
        onInput={(event) => props.change(event.currentTarget.valueAsNumber)}
        onPointerUp={props.release}
      />
      <output>
        {number(props.value, props.digits ?? 2)} <span class="unit">{props.unit}</span>
      </output>
    </label>
  );
}

export function Switch(props: { id: string; label: string; on: boolean; change: (on: boolean) => void }) {
  return (
    <label class="switch">
      <input
        type="checkbox"
        checked={props.on}
        data-testid={props.id}
        onChange={(event) => props.change(event.currentTarget.checked)}
      />
      {props.label}
    </label>
  );
}

/** A number with a true minus sign, so that columns stay aligned. */
export function number(value: number | undefined | null, digits = 2): string {
  if (value === undefined || value === null || !Number.isFinite(value)) return "–";
  const text = Math.abs(value).toFixed(digits);
  return value < 0 && Number(text) !== 0 ? `−${text}` : text;
}
