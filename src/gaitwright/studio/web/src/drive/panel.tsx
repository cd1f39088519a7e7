// Driving: stick and keys, velocities, skills.

import { useEffect, useMemo } from "preact/hooks";
import { drives, type Source } from "../source";
import { skillColour } from "../ui/colours";
import { number, Section, Slider, Switch } from "../ui/controls";
import { remembered } from "../ui/remembered";
import { DRIVERS, MODES } from "../ui/words";
import { listenToKeys } from "./keys";
import { Motion } from "./motion";
import { listenToPad, padName } from "./pad";
import { Stick } from "./stick";
import { full, held, Steering } from "./steering";

/** Whether a skill is asked for at the speed of the slider. */
const atSpeed = remembered("skill.at-speed", false);

let shared: { source: Source; steering: Steering } | null = null;

/** One steering per source: keys work whichever panel is open. */
export function steeringOf(source: Source): Steering {
  if (shared?.source !== source) shared = { source, steering: new Steering(source) };
  return shared.steering;
}

/** Listens to keys and game-pad as long as the page is open. */
export function useHands(source: Source): void {
  useEffect(() => {
    const steering = steeringOf(source);
    const stops = [listenToKeys(steering, source), listenToPad(steering, source)];
    return () => {
      for (const stop of stops) stop();
    };
  }, [source]);
}

export function DrivePanel({ source }: { source: Source }) {
  const steering = useMemo(() => steeringOf(source), [source]);
  const watching = !drives(source);
  return (
    <>
      {source.status.value?.mode === "guide" && <Motion source={source} watching={watching} />}
      <Section title="Steer" aside={<Asked source={source} />}>
        <div class="steer">
          <Stick steering={steering} disabled={watching} />
          <dl class="keys">
            <dt>W S</dt>
            <dd>go, back</dd>
            <dt>A D</dt>
            <dd>turn</dd>
            <dt>Q E</dt>
            <dd>sideways</dd>
            <dt>space</dt>
            <dd>stand</dd>
          </dl>
        </div>
        <Slider id="full-forward" label="Speed" unit="m/s" least={0.05} most={2} step={0.05} value={full.forward.value} change={(v) => (full.forward.value = v)} />
        <Slider id="full-left" label="Sideways" unit="m/s" least={0.02} most={0.6} step={0.02} value={full.left.value} change={(v) => (full.left.value = v)} />
        <Slider id="full-turn" label="Turn" unit="rad/s" least={0.1} most={1.6} step={0.05} value={full.turn.value} change={(v) => (full.turn.value = v)} />
        {padName.value && (
          <p class="faint pad" data-testid="pad" title={padName.value}>
            {padName.value}
          </p>
        )}
        <button class="wide" data-testid="stand" disabled={watching} onClick={() => void source.send({ do: "stand" })}>
          Stand
        </button>
      </Section>
      <Skills source={source} watching={watching} />
      <Section title="With the mouse">
        <ul class="hints">
          <li>click the ground: go there; shift: then there</li>
          <li>drag from the robot: push it</li>
          <li>drag a box: move it; wheel: turn it</li>
          <li>drag elsewhere: turn the view</li>
        </ul>
      </Section>
      <Words source={source} />
    </>
  );
}

/** What the names in the bar above mean. */
function Words({ source }: { source: Source }) {
  const choices = source.hello.value?.choices;
  if (!choices) return null;
  return (
    <>
      <Meanings title="Modes" names={choices.modes} words={MODES} />
      <Meanings title="Who computes the torques" names={choices.drivers} words={DRIVERS} />
    </>
  );
}

function Meanings({ title, names, words }: { title: string; names: string[]; words: Record<string, string> }) {
  return (
    <Section title={title}>
      <dl class="words">
        {names.flatMap((name) => [<dt key={name}>{name}</dt>, <dd key={`${name} is`}>{words[name]}</dd>])}
      </dl>
    </Section>
  );
}

function Asked({ source }: { source: Source }) {
  const asked = source.status.value?.velocity;
  if (!asked || (!held.value && asked.every((value) => value === 0))) return null;
  return (
    <span title="Velocity asked for: forward, left, turn">
      {number(asked[0])} · {number(asked[1])} m/s · {number(asked[2])} rad/s
    </span>
  );
}

function Skills({ source, watching }: { source: Source; watching: boolean }) {
  const status = source.status.value;
  const by = status?.held ?? null;
  const ask = (name: string) => {
    const speed = atSpeed.peek() && name ? { speed: full.forward.peek() } : {};
    void source.send({ do: "skill", name, ...speed });
  };
  return (
    <Section title="Skill" aside={by === null ? undefined : by ? "held" : "rules choose"}>
      <div class="skills">
        <button
          class="all"
          data-testid="skill-rules"
          aria-pressed={by === "" ? "true" : "false"}
          disabled={watching}
          onClick={() => ask("")}
        >
          Rules choose
        </button>
        {(source.hello.value?.choices.skills ?? []).map((name) => (
          <button
            key={name}
            class={`skill ${status?.skill === name ? "now" : ""}`}
            style={{ "--chip": skillColour(name) }}
            data-testid={`skill-${name}`}
            title={name}
            disabled={watching}
            onClick={() => ask(name)}
          >
            {name}
          </button>
        ))}
      </div>
      <Switch
        id="at-speed"
        label={`at ${number(full.forward.value)} m/s, else as it is meant`}
        on={atSpeed.value}
        change={(on) => (atSpeed.value = on)}
      />
    </Section>
  );
}
