// A motion that is composed by driving the robot, and played back (mode "guide").

import type { Status } from "../protocol";
import type { Source } from "../source";
import { number, Section } from "../ui/controls";
import { Icon } from "../ui/icons";

export function Motion({ source, watching }: { source: Source; watching: boolean }) {
  const status = source.status.value;
  if (!status) return null;
  const { composing = false, playing = false, composed = 0, composed_seconds = 0, played_seconds = 0 } = status;
  const share = playing && composed_seconds > 0 ? played_seconds / composed_seconds : 0;
  return (
    <Section title="Motion" aside={<Length status={status} />}>
      <div class="motion-buttons">
        <button
          class={`icon-text ${composing ? "recording" : ""}`}
          data-testid="compose"
          disabled={watching}
          title={composing ? "The motion is whole" : "Note what is asked of the robot from now on"}
          onClick={() => void source.send({ do: "compose", on: !composing })}
        >
          <Icon name={composing ? "stop" : "record"} />
          {composing ? "End" : "Compose"}
        </button>
        <button
          class="icon-text"
          data-testid="play"
          disabled={watching || (!composed && !playing)}
          title={playing ? "The robot stands" : "Ask it all again, as it was asked"}
          onClick={() => void source.send({ do: playing ? "stand" : "play" })}
        >
          <Icon name={playing ? "stop" : "play"} />
          {playing ? "Stop" : "Play"}
        </button>
      </div>
      <div class="motion-way" data-testid="motion-way" aria-hidden={!playing}>
        <i style={{ width: `${100 * share}%` }} />
      </div>
      <p class="faint about" data-testid="motion-hint">
        {hint(composing, playing, composed)}
      </p>
    </Section>
  );
}

function Length({ status }: { status: Status }) {
  const { composing, composed = 0, composed_seconds } = status;
  if (!composing && !composed) return null;
  return (
    <span data-testid="motion-length">
      {composed} {composed === 1 ? "move" : "moves"} · {number(composed_seconds, 1)} s
    </span>
  );
}

function hint(composing: boolean, playing: boolean, composed: number): string {
  if (playing) return "It plays; whoever moves the robot ends that.";
  if (composing) return "Move the robot: steer, hold a skill, send it somewhere. All that is noted.";
  return composed ? "Play it back, or compose another one." : "Compose a motion: what moves the robot is noted.";
}
