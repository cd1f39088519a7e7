// The bar below: time and its pace, what the robot says, recording, reset, abort.

import { effect, type Signal, signal } from "@preact/signals";
import { useEffect } from "preact/hooks";
import { drives, type Source } from "../source";
import { number, Segmented } from "../ui/controls";
import { Icon } from "../ui/icons";

const PACES = [0.1, 0.25, 0.5, 1, 2];
const TICKS = [1, 25];

export function BottomBar({ source }: { source: Source }) {
  const status = source.status.value;
  const watching = !drives(source);
  const send = source.send.bind(source);
  const paused = status?.paused ?? true;
  return (
    <footer class="bottom-bar" data-testid="bottom-bar">
      <button
        class="icon-text"
        data-testid={paused ? "resume" : "pause"}
        disabled={watching || !status}
        onClick={() => void send({ do: paused ? "resume" : "pause" })}
      >
        <Icon name={paused ? "play" : "pause"} />
        {paused ? "Resume" : "Pause"}
      </button>
      {TICKS.map((ticks) => (
        <button
          key={ticks}
          class="icon-text"
          title={ticks === 1 ? "One tick on" : `${ticks} ticks on`}
          data-testid={`step-${ticks}`}
          disabled={watching || !paused}
          onClick={() => void send({ do: "step", ticks })}
        >
          <Icon name="step" />
          {ticks}
        </button>
      ))}
      <Segmented
        id="pace"
        choices={PACES.map((pace) => ({ value: pace, label: `${pace}×`, title: `${pace} times real time` }))}
        value={status?.pace ?? 1}
        choose={(factor) => void send({ do: "pace", factor })}
        disabled={watching}
      />
      <span class="clock" title="Time of the run" data-testid="time">
        {number(status?.time, 2)}
        <span class="unit"> s</span>
      </span>
      <span class="faint clock-rate" title="Real-time factor that is reached" data-testid="real-time">
        {number(status?.real_time, 2)}×
      </span>
      <Message source={source} />
      <button
        class={`icon-text ${status?.recording ? "recording" : ""}`}
        data-testid="record"
        disabled={watching}
        onClick={() => void send({ do: "record", on: !status?.recording })}
      >
        <Icon name="record" />
        {status?.recording ? "Recording" : "Record"}
      </button>
      <button
        class="icon-text"
        title="Another run from the start: same robot, same scene (others under “World”)"
        data-testid="reset"
        disabled={watching}
        onClick={() => void send({ do: "reset" })}
      >
        <Icon name="reset" />
        Reset
      </button>
      <button
        class="icon-text danger"
        title="The robot comes to a stand, is let down, and its motors go off"
        data-testid="abort"
        disabled={watching}
        onClick={() => void send({ do: "abort" })}
      >
        <Icon name="stop" />
        Abort
      </button>
    </footer>
  );
}

const STAYS = 6000;
const refusal = signal("");
const remark = signal("");

/** Shows a sentence for some seconds. */
function forAWhile(place: Signal<string>, sentence: () => string): () => void {
  let timer = 0;
  return effect(() => {
    place.value = sentence();
    clearTimeout(timer);
    if (place.peek()) timer = window.setTimeout(() => (place.value = ""), STAYS);
  });
}

/** What the robot, or the studio, has to say: a refusal, else what happened, else why it stands or ended, else why this skill. */
function Message({ source }: { source: Source }) {
  useEffect(() => {
    const stops = [
      forAWhile(refusal, () => source.refusal.value),
      forAWhile(remark, () => source.remark.value?.sentence ?? ""),
    ];
    return () => {
      for (const stop of stops) stop();
    };
  }, [source]);
  const status = source.status.value;
  const bad = source.lost.value || source.closed.value || refusal.value || (status?.fell ? status.over : "") || status?.halt || status?.no_way || "";
  const text = bad || remark.value || status?.over || status?.pause || status?.outcome || status?.because || "";
  return (
    <span class={`message ${bad ? "bad" : ""}`} title={text} data-testid="message">
      {text}
    </span>
  );
}
