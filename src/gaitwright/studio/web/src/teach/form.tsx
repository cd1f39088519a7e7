// What is right: a skill, and what else a person cares to say of it. What the server refuses stands beside it.

import type { ComponentChildren } from "preact";
import type { Source } from "../source";
import { Field as Row } from "../ui/controls";
import { type Field, refused, type Said, said, tellWhatIsRight, waits } from "./teaching";

export function Form({ source, disabled }: { source: Source; disabled: boolean }) {
  const now = said.value;
  const skills = source.hello.value?.choices.skills ?? [];
  const numbers = source.rules.value?.numbers ?? [];
  const say = (change: Partial<Said>) => {
    said.value = { ...said.peek(), ...change };
    refused.value = null;
  };
  return (
    <form
      data-testid="right-form"
      onSubmit={(event) => {
        event.preventDefault();
        void tellWhatIsRight(source);
      }}
    >
      <Line label="Skill" field="skill">
        <select
          data-testid="right-skill"
          value={skills.includes(now.skill) ? now.skill : ""}
          disabled={disabled}
          onChange={(event) => say({ skill: event.currentTarget.value })}
        >
          <option value="">which?</option>
          {skills.map((name) => (
            <option key={name} value={name}>
              {name}
            </option>
          ))}
        </select>
      </Line>
      <Line label="Speed" field="speed">
        <input
          type="text"
          inputMode="decimal"
          data-testid="right-speed"
          placeholder="as meant"
          value={now.speed}
          disabled={disabled}
          onInput={(event) => say({ speed: event.currentTarget.value })}
        />
        <span class="unit">m/s</span>
      </Line>
      <Line label="Because of" field="about">
        <select
          data-testid="right-about"
          value={now.about}
          disabled={disabled}
          title="What counts here"
          onChange={(event) => say({ about: event.currentTarget.value })}
        >
          <option value="">it finds out</option>
          {numbers.map((name) => (
            <option key={name} value={name}>
              {name}
            </option>
          ))}
        </select>
      </Line>
      <Line label="Called" field="name">
        <input
          type="text"
          data-testid="right-name"
          placeholder="as the skill"
          maxLength={80}
          value={now.name}
          disabled={disabled}
          onInput={(event) => say({ name: event.currentTarget.value })}
        />
      </Line>
      <button class="wide" type="submit" data-testid="right" disabled={disabled || waits.value}>
        {waits.value ? "Looking …" : "See what it would do"}
      </button>
      <Refusal field="form" />
    </form>
  );
}

function Line({ label, field, children }: { label: string; field: Field; children: ComponentChildren }) {
  return (
    <>
      <Row label={label}>{children}</Row>
      <Refusal field={field} />
    </>
  );
}

function Refusal({ field }: { field: Field }) {
  const now = refused.value;
  return now?.field === field ? (
    <p class="refusal" data-testid={`refusal-${field}`}>
      {now.because}
    </p>
  ) : null;
}
