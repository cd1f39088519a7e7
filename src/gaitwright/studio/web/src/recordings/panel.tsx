// Recordings: one that is being made, and those that were kept, to take home and to play.

import { useEffect, useState } from "preact/hooks";
import type { Recordings } from "../protocol";
import { drives, type Source } from "../source";
import { ask } from "../ui/ask";
import { Section } from "../ui/controls";
import { Icon } from "../ui/icons";
import { download } from "./download";
import { addressOf, duration, formsOf, once, readName, size, stem } from "./names";
import { openReplay } from "./replay";
import "./recordings.css";

/** Where it was not told which there are, it is asked again [ms]. */
const AGAIN = 3000;

export function RecordingsPanel({ source }: { source: Source }) {
  const recording = source.status.value?.recording ?? false;
  const link = source.link.value;
  useEffect(() => {
    if (link !== "open" || recording) return;
    let gone = false;
    let timer = 0;
    const look = async () => {
      const { because } = await ask(source, { do: "recordings" });
      if (because && !gone) timer = window.setTimeout(() => void look(), AGAIN);
    };
    void look();
    return () => {
      gone = true;
      clearTimeout(timer);
    };
  }, [source, recording, link]);
  const known = source.recordings.value;
  const kept = once(known?.names ?? []);
  return (
    <>
      <Recorder source={source} recording={recording} />
      <Section title="Kept" aside={kept.length ? `${kept.length}, the last first` : ""}>
        {!kept.length && <p class="faint about">{known ? "There is none yet." : "looking …"}</p>}
        <ul class="kept" data-testid="recordings">
          {kept.map((one) => (
            <Kept key={one.name} {...one} made={source.hello.value?.choices.forms} />
          ))}
        </ul>
      </Section>
    </>
  );
}

function Recorder({ source, recording }: { source: Source; recording: boolean }) {
  const [because, setBecause] = useState("");
  const [last, setLast] = useState("");
  const driving = drives(source);
  const turn = async () => {
    const { more, because } = await ask<{ recording?: string }>(source, { do: "record", on: !recording });
    setBecause(because);
    setLast(more?.recording ?? "");
  };
  return (
    <Section title="Record">
      <div class="recorder">
        <button
          class={`icon-text ${recording ? "recording" : ""}`}
          data-testid="record-turn"
          aria-pressed={recording}
          disabled={!driving}
          onClick={() => void turn()}
        >
          <Icon name={recording ? "stop" : "record"} />
          {recording ? "End and keep" : "Record"}
        </button>
        <span class={recording ? "recorded on" : "recorded"} data-testid="recorded">
          {duration(source.status.value?.recorded ?? 0)}
        </span>
      </div>
      {because && (
        <p class="refusal" data-testid="record-refused">
          {because}
        </p>
      )}
      {last && !recording && <p class="faint about">Kept as {last}</p>}
    </Section>
  );
}

function Kept({ name, bytes, made }: Recordings["names"][number] & { made?: string[] }) {
  const { day, time, what } = readName(name);
  const [because, setBecause] = useState("");
  const [waits, setWaits] = useState("");
  const take = async (ending: string) => {
    if (waits) return;
    setBecause("");
    setWaits(ending);
    setBecause(await download(`${stem(name)}.${ending}`));
    setWaits("");
  };
  return (
    <li data-testid="recording" data-name={name}>
      <button class="icon" data-testid="play" title="Play it" onClick={() => openReplay(name)}>
        <Icon name="play" />
      </button>
      <span class="kept-name" title={name}>
        <strong>{what}</strong> {time} <span class="faint">{day}</span>
      </span>
      <span class="kept-forms">
        <span class="faint">{size(bytes)}</span>
        {formsOf(name, made).map(({ ending, title }) => {
          const file = `${stem(name)}.${ending}`;
          return (
            <a
              key={ending}
              href={addressOf(file, location.search)}
              download={file}
              title={waits === ending ? "It is being made …" : title}
              class={waits === ending ? "waits" : ""}
              data-testid={`download-${ending}`}
              onClick={(event) => {
                event.preventDefault();
                void take(ending);
              }}
            >
              {ending}
            </a>
          );
        })}
      </span>
      {because && (
        <p class="refusal" data-testid="download-refused">
          {because}
        </p>
      )}
    </li>
  );
}
