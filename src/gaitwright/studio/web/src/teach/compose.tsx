// Mode "guide": a motion is composed by driving the robot, and played back.

import { useState } from "preact/hooks";
import type { Status } from "../protocol";
import type { Source } from "../source";
import { ask } from "../ui/ask";
import { Section } from "../ui/controls";
import { Icon } from "../ui/icons";

export function Compose({ source, status, driving }: { source: Source; status: Status; driving: boolean }) {
  const [because, setBecause] = useState("");
  const { composing = false, playing = false, composed = 0 } = status;
  const turn = async () => setBecause((await ask(source, { do: "compose", on: !composing })).because);
  const play = async () => setBecause((await ask(source, { do: "play" })).because);
  const words = `${composed} ${composed === 1 ? "word" : "words"}`;
  return (
    <Section title="A motion" aside={composed ? words : ""}>
      <div class="verdict compose">
        <button
          class={`icon-text ${composing ? "recording" : ""}`}
          data-testid="compose"
          aria-pressed={composing}
          disabled={!driving}
          onClick={() => void turn()}
        >
          <Icon name={composing ? "stop" : "record"} />
          {composing ? "It is whole" : "Compose"}
        </button>
        <button class="icon-text" data-testid="play-motion" disabled={!driving || !composed} onClick={() => void play()}>
          <Icon name="play" />
          Play
        </button>
      </div>
      <p class="faint about" data-testid="motion-state" data-playing={`${playing}`}>
        {playing
          ? "It is played; whoever steers ends it."
          : composing
            ? "Drive the robot: skills, velocities and goals are noted with their time."
            : "What you do with the robot from “Compose” on can be played again."}
      </p>
      {!composing && !playing && source.remark.value && (
        <p class="about" data-testid="remark">
          {source.remark.value.sentence}
        </p>
      )}
      {because && <p class="refusal">{because}</p>}
    </Section>
  );
}
