// Rules: in their order, how far each has come, which one is in use and why; a rule's trees and history.

import { signal } from "@preact/signals";
import { useEffect, useRef, useState } from "preact/hooks";
import type { Rule, Rules } from "../protocol";
import { drives, type Source } from "../source";
import { order } from "../teach/teaching";
import { skillColour } from "../ui/colours";
import { Section } from "../ui/controls";
import { Icon } from "../ui/icons";
import { Asking } from "./asking";
import { Forest } from "./forest";
import { Lessons } from "./lessons";
import { Operators } from "./operators";
import { Ordered } from "./ordered";
import { useNow } from "./why";
import "./rules.css";
import "./forest.css";

/** The rule that is looked into; "": none. */
export const opened = signal("");

const STEPS = ["proposed", "shell", "stabilised", "firm"];
const ABOUT: Record<string, string> = {
  empty: "empty: nobody has seen it right yet",
  proposed: "proposed by analogy: it fires once it is confirmed",
  shell: "a rule shell: its marks still move",
  stabilised: "stabilised: its marks have not moved for some lessons",
  firm: "firm: upper and lower marks have met",
};

export function RulesPanel({ source }: { source: Source }) {
  const rules = source.rules.value;
  if (!rules) return <p class="faint nothing">no rules are known yet</p>;
  return (
    <>
      <InUse source={source} />
      <Section title="Rules" aside={rules.rules.length ? `${rules.rules.length}, the first that fits fires` : ""}>
        {rules.rules.length === 0 && (
          <p class="faint about" data-testid="no-rules">
            There is none yet: tell the robot what is right, under “Teach”.
          </p>
        )}
        <Ordered source={source} rules={rules.rules}>
          {(rule, lit) => (
            <>
              <RuleLine rule={rule} />
              {opened.value === rule.name && <Detail source={source} rules={rules} rule={rule} lit={lit} />}
            </>
          )}
        </Ordered>
      </Section>
      <Operators source={source} />
      <Lessons source={source} lessons={rules.lessons} />
    </>
  );
}

/** What it does now, and why: by a rule, or because a person asked for it. */
function InUse({ source }: { source: Source }) {
  const status = source.status.value;
  if (!status) return null;
  return (
    <Section title="In use" aside={status.rule ? (status.firm ? "seen right before" : "not seen just like this") : ""}>
      <div class="in-use" data-testid="rule-in-use" data-rule={status.rule}>
        <span class="chip" style={{ "--chip": skillColour(status.skill) }}>
          {status.skill || "none"}
        </span>
        {status.rule ? <strong>{status.rule}</strong> : <span class="faint">{status.held ? "held" : "no rule"}</span>}
      </div>
      <p class="because">{status.because || "–"}</p>
      <Asking source={source} rule="" fires={Boolean(status.rule)} />
    </Section>
  );
}

function RuleLine({ rule }: { rule: Rule }) {
  const open = opened.value === rule.name;
  return (
    <button
      class="rule-line"
      aria-expanded={open}
      data-testid={`rule-${rule.name}`}
      onClick={() => (opened.value = open ? "" : rule.name)}
    >
      <i class="rule-skill" style={{ background: skillColour(rule.skill) }} />
      <span class="rule-name" title={rule.name}>
        {rule.name}
      </span>
      <Progress status={rule.status} />
      <span class="rule-count right" title={`seen right in ${rule.right} situations`}>
        {rule.right ? `+${rule.right}` : ""}
      </span>
      <span class="rule-count wrong" title={`seen wrong in ${rule.wrong} situations`}>
        {rule.wrong ? `−${rule.wrong}` : ""}
      </span>
    </button>
  );
}

/** How far a rule has come, as four steps. */
function Progress({ status }: { status: string }) {
  const reached = STEPS.indexOf(status);
  return (
    <span class={`progress ${status}`} title={ABOUT[status] ?? status} data-testid="rule-status">
      {STEPS.map((step, k) => (
        <i key={step} class={k <= reached ? "done" : ""} />
      ))}
    </span>
  );
}

function Detail({ source, rules, rule, lit }: { source: Source; rules: Rules; rule: Rule; lit: boolean }) {
  const now = useNow(source, rule.name);
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => place.current?.scrollIntoView({ block: "nearest" }), []);
  const fires = now ? now.fires === rule.name : lit;
  return (
    <div class="rule-detail" ref={place} data-testid="rule-detail">
      <p>
        <strong>{rule.action}</strong>
        <span class="faint"> · {ABOUT[rule.status]?.split(":")[0] ?? rule.status}</span>
      </p>
      <p class="rule-sentence">{rule.sentence}</p>
      <Asking source={source} rule={rule.name} fires={fires} />
      <Order source={source} rules={rules} rule={rule} />
      <Legend />
      <Forest trees={rules.trees} rule={rule} situation={now?.situation ?? {}} />
      <h3>
        What moved its marks <span>{rule.history.length}</span>
      </h3>
      <ol class="rule-history" data-testid="rule-history">
        {rule.history.map((line, k) => (
          <li key={k}>{line}</li>
        ))}
      </ol>
      {!rule.history.length && <p class="faint about">Nothing has yet.</p>}
      <p class="faint about">
        {rule.quiet} {rule.quiet === 1 ? "lesson" : "lessons"} since a mark moved
      </p>
    </div>
  );
}

/** Before the rule above it, where both could fire: a lesson, laid before its teacher under “Teach”. */
function Order({ source, rules, rule }: { source: Source; rules: Rules; rule: Rule }) {
  const [because, setBecause] = useState("");
  const above = rules.rules[rules.rules.indexOf(rule) - 1];
  if (!above) return null;
  const put = async () => {
    setBecause(await order(source, rule.name, above.name));
  };
  return (
    <>
      <div class="asking">
        <button class="icon-text" data-testid="order" disabled={!drives(source)} onClick={() => void put()}>
          <Icon name="up" />
          Before {above.name}
        </button>
      </div>
      {because && (
        <p class="refusal" data-testid="refusal-order">
          {because}
        </p>
      )}
    </>
  );
}

function Legend() {
  return (
    <p class="legend">
      <span class="key yes">fires</span>
      <span class="key grey">grey</span>
      <span class="key no">does not</span>
      <span>▲ upper mark</span>
      <span>▼ lower mark</span>
      <span class="key now">now</span>
    </p>
  );
}
