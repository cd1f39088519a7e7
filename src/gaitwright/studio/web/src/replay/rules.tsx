// Which rule held when, and why this skill now.

import type { Source } from "../source";
import { skillColour } from "../ui/colours";
import { number, Section } from "../ui/controls";
import { clock } from "./clock";
import { Player } from "./player";
import { stretches } from "./stretches";

export function RulesOverTime({ source }: { source: Source }) {
  if (!(source instanceof Player)) return null;
  const { events, notes = [] } = source.story.value;
  const now = source.event.value;
  const end = source.duration;
  const names = [...new Set(events.map(({ rule }) => rule).filter(Boolean))];
  const all = stretches(events, "rule", end);
  return (
    <>
      <Section title="Now">
        <p class="because" data-testid="because">
          {now?.because || "–"}
        </p>
      </Section>
      {names.length > 0 && (
        <Section title="Rules">
          {names.map((name) => (
            <div key={name} class={`rule-time ${now?.rule === name ? "lit" : ""}`} data-testid="rule-time" data-rule={name}>
              <span>{name}</span>
              <div class="band">
                {all
                  .filter((stretch) => stretch.name === name)
                  .map(({ from, to }) => (
                    <span key={from} style={{ left: `${(100 * from) / end}%`, width: `${(100 * (to - from)) / end}%` }} />
                  ))}
                <i style={{ left: `${(100 * clock.time.value) / end}%` }} />
              </div>
            </div>
          ))}
        </Section>
      )}
      <Section title="What was decided" aside={`${events.length}`}>
        <ol class="events">
          {events.map((event, k) => (
            <li
              key={k}
              class={event === now ? "lit" : ""}
              data-testid="event"
              onClick={() => clock.seek(event.time)}
            >
              <span class="event-time">{number(event.time, 2)}</span>
              <span class="chip" style={{ "--chip": skillColour(event.skill) }}>
                {event.skill}
              </span>
              <span class="event-why">{event.because}</span>
            </li>
          ))}
        </ol>
      </Section>
      {notes.length > 0 && (
        <Section title="What a person did" aside={`${notes.length}`}>
          <ol class="events">
            {notes.map((note, k) => (
              <li key={k} data-testid="note" onClick={() => clock.seek(note.time)}>
                <span class="event-time">{number(note.time, 2)}</span>
                <span class="chip">{note.kind}</span>
                <span class="event-why">{note.sentence}</span>
              </li>
            ))}
          </ol>
        </Section>
      )}
    </>
  );
}
