// What is so: who drives and why, which rule, what lies ahead, how it stands, what is broken.

import type { Rule, Status } from "../protocol";
import type { Source } from "../source";
import { driverColour, skillColour } from "../ui/colours";
import { Field, number, Section } from "../ui/controls";
import { Balance } from "./balance";

export function StatusPanel({ source }: { source: Source }) {
  const status = source.status.value;
  if (!status) return <p class="faint nothing">nothing is known yet</p>;
  return (
    <>
      {(status.over || status.outcome) && <Over status={status} />}
      <InControl status={status} />
      <Reason source={source} status={status} />
      <Ahead status={status} />
      <Balance source={source} />
      <Faults faults={status.faults} />
    </>
  );
}

function Over({ status }: { status: Status }) {
  const how = status.fell ? "bad" : status.arrived && !status.over ? "good" : "";
  return (
    <p class={`banner ${how}`} data-testid="over">
      {status.over ?? status.outcome}
    </p>
  );
}

function InControl({ status }: { status: Status }) {
  const share = Object.entries(status.share ?? {}).filter(([, part]) => part > 0.0005);
  return (
    <Section title="In control">
      <Field label="Joints">
        <span class="chip" style={{ "--chip": driverColour(status.controller) }}>
          {status.controller || "nobody"}
        </span>
        {status.driver !== status.controller && <span class="faint">for {status.driver}</span>}
      </Field>
      <Field label="Skill">
        <span class="chip" style={{ "--chip": skillColour(status.skill) }}>
          {status.skill || "none"}
        </span>
        {status.held ? <span class="faint">held</span> : null}
      </Field>
      <Field label="Asked for">
        <span data-testid="asked">
          {number(status.velocity[0])} m/s, left {number(status.velocity[1])}, turn {number(status.velocity[2])} rad/s
        </span>
      </Field>
      {share.length > 0 && (
        <div class="share" data-testid="share">
          <div class="share-bar">
            {share.map(([name, part]) => (
              <span key={name} style={{ flexGrow: part, background: driverColour(name) }} title={name} />
            ))}
          </div>
          <div class="share-names">
            {share.map(([name, part]) => (
              <span key={name} style={{ "--line-colour": driverColour(name) }}>
                <i />
                {name} {number(100 * part, part > 0.0995 ? 0 : 1)} %
              </span>
            ))}
          </div>
        </div>
      )}
    </Section>
  );
}

function Reason({ source, status }: { source: Source; status: Status }) {
  const rule = source.rules.value?.rules.find(({ name }) => name === status.rule);
  return (
    <Section title="Why" aside={status.rule ? "by a rule" : ""}>
      <p class="because" data-testid="because">
        {status.because || "–"}
      </p>
      {status.rule && (
        <div class="rule lit" data-testid="active-rule" data-rule={status.rule}>
          <div class="rule-head">
            <strong>{status.rule}</strong>
            {rule && <span class="faint">{rule.status}</span>}
          </div>
          {rule && <RuleBody rule={rule} />}
        </div>
      )}
    </Section>
  );
}

function RuleBody({ rule }: { rule: Rule }) {
  return (
    <>
      <p>{rule.sentence || rule.action}</p>
      <p class="faint">
        right in {rule.right}, wrong in {rule.wrong}; since {rule.quiet} no mark moved
      </p>
    </>
  );
}

function Ahead({ status }: { status: Status }) {
  const trouble = [status.no_way, status.halt, status.pause].filter(Boolean);
  return (
    <Section title="Ahead">
      <Field label="Obstacle">
        <span data-testid="obstacle" class={status.obstacle ? "" : "faint"}>
          {status.obstacle || "none"}
        </span>
      </Field>
      <Field label="Goal">
        <span data-testid="goal" class={status.goal ? "" : "faint"}>
          {status.goal ? `${number(status.goal[0])}, ${number(status.goal[1])} m` : "none"}
          {status.route.length > 1 && <span class="faint"> · {status.route.length} points of the way left</span>}
        </span>
      </Field>
      {trouble.map((sentence) => (
        <p class="warning" key={sentence}>
          {sentence}
        </p>
      ))}
    </Section>
  );
}

function Faults({ faults }: { faults: string[] }) {
  return (
    <Section title="Faults" aside={faults.length ? `${faults.length}` : ""}>
      {faults.length ? (
        faults.map((sentence) => (
          <p class="warning bad" data-testid="fault" key={sentence}>
            {sentence}
          </p>
        ))
      ) : (
        <p class="faint none">none noticed</p>
      )}
    </Section>
  );
}
