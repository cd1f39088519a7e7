// Teaching: what it does is right, or something else is; what a lesson would do, before it is kept.

import { useRef } from "preact/hooks";
import type { Status } from "../protocol";
import { drives, type Source } from "../source";
import { skillColour } from "../ui/colours";
import { number, Section } from "../ui/controls";
import { Form } from "./form";
import { Outcome } from "./outcome";
import { confirm, learned, object, refused, takeBack } from "./teaching";
import "./teach.css";

export function TeachPanel({ source }: { source: Source }) {
  const status = source.status.value;
  const form = useRef<HTMLDivElement>(null);
  if (!status) return <p class="faint nothing">nothing is known yet</p>;
  const driving = drives(source);
  const otherwise = () => {
    void object(source);
    form.current?.querySelector("select")?.focus();
  };
  return (
    <div class="teach">
      {!driving && <p class="banner">You watch; who drives can teach.</p>}
      {status.mode === "apprentice" ? (
        <Proposal source={source} status={status} driving={driving} otherwise={otherwise} />
      ) : (
        <Doing source={source} status={status} driving={driving} />
      )}
      <div ref={form}>
        <Section title="Right here is">
          <Form source={source} disabled={!driving} />
        </Section>
      </div>
      <Outcome source={source} disabled={!driving} />
      {learned.value && (
        <p class="learned" data-testid="learned">
          <span>
            Learned: <span class="faint">{learned.value}</span>
          </span>
          <button data-testid="take-back" disabled={!driving} onClick={() => void takeBack(source)}>
            Take back
          </button>
        </p>
      )}
    </div>
  );
}

/** What an apprentice does, for its teacher to accept or not. */
function Proposal(props: { source: Source; status: Status; driving: boolean; otherwise: () => void }) {
  const { source, status, driving, otherwise } = props;
  const speed = Math.hypot(status.velocity[0], status.velocity[1]);
  return (
    <div
      class={`proposal ${status.firm ? "firm" : ""}`}
      style={{ "--chip": skillColour(status.skill) }}
      data-testid="proposal"
      data-skill={status.skill}
    >
      <span class="proposal-head">It does</span>
      <strong data-testid="proposal-skill">
        {status.skill || "wait"}
        {speed > 0.005 && <span class="unit"> at {number(speed)} m/s</span>}
      </strong>
      <p>{status.because || "–"}</p>
      <div class="verdict">
        <button class="primary" data-testid="accept" disabled={!driving} onClick={() => void confirm(source)}>
          Right
        </button>
        <button data-testid="refuse" disabled={!driving} onClick={otherwise}>
          Not right
        </button>
      </div>
      <Refusal />
      {status.paused && <p class="faint">Time stands: say below what is right here.</p>}
    </div>
  );
}

function Doing({ source, status, driving }: { source: Source; status: Status; driving: boolean }) {
  return (
    <Section title="It does now" aside={status.rule ? "by a rule" : status.held ? "held" : ""}>
      <div class="in-use">
        <span class="chip" style={{ "--chip": skillColour(status.skill) }}>
          {status.skill || "none"}
        </span>
        {status.rule && status.rule !== status.skill && <strong>{status.rule}</strong>}
      </div>
      <p class="because">{status.because || "–"}</p>
      <button class="wide" data-testid="ok" disabled={!driving} onClick={() => void confirm(source)}>
        What it does is right
      </button>
      <Refusal />
    </Section>
  );
}

function Refusal() {
  const now = refused.value;
  return now?.field === "ok" ? (
    <p class="refusal" data-testid="refusal-ok">
      {now.because}
    </p>
  ) : null;
}
