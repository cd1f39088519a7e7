// Recordings that were kept: to take home.

import { useEffect } from "preact/hooks";
import type { Source } from "../source";
import { number, Section } from "../ui/controls";

export function Recordings({ source }: { source: Source }) {
  const recording = source.status.value?.recording;
  const link = source.link.value;
  useEffect(() => {
    if (link === "open" && !recording) void source.send({ do: "recordings" });
  }, [recording, link]);
  const kept = source.recordings.value?.names ?? [];
  return (
    <Section title="Recordings" aside={`${kept.length}`}>
      <ul class="recordings" data-testid="recordings">
        {kept.map(({ name, bytes }) => (
          <li key={name}>
            <a href={`recordings/${encodeURIComponent(name)}${location.search}`} download={name}>
              {name}
            </a>
            <span class="faint">{number(bytes / 1e6, 1)} MB</span>
          </li>
        ))}
      </ul>
      {!kept.length && <p class="faint about">There is none.</p>}
    </Section>
  );
}
