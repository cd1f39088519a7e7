// What a lesson would do: followed or not, where else it would decide differently, which lessons it breaks.

import type { Source } from "../source";
import { Section } from "../ui/controls";
import { drop, keep, refused, tried } from "./teaching";

export function Outcome({ source, disabled }: { source: Source; disabled: boolean }) {
  const now = tried.value;
  const because = refused.value?.field === "keep" ? refused.value.because : "";
  if (!now) return because ? <p class="refusal outcome-refusal">{because}</p> : null;
  return (
    <Section title="What that would do">
      <div class={`outcome ${now.followed ? "followed" : "ignored"}`} data-testid="tried" data-followed={`${now.followed}`}>
        <p>
          <strong>{now.sentence}</strong>
        </p>
        <p class={now.followed ? "good" : "warn"} data-testid="followed">
          {now.followed ? "It would do so here." : "It would still do something else here."}
        </p>
        <div class="verdict">
          <button class="primary" data-testid="keep" disabled={disabled} onClick={() => void keep(source)}>
            Keep
          </button>
          <button data-testid="drop" disabled={disabled} onClick={() => void drop(source)}>
            Drop
          </button>
        </div>
        {because && <p class="refusal">{because}</p>}
        <List id="moves" title="It would learn" lines={now.moves} />
        <List id="stretches" title="It would have decided differently" lines={now.stretches} />
        <List id="broken" title="It would no longer follow" lines={now.broken} tone="bad" />
        <List id="mended" title="It would follow again" lines={now.mended} tone="good" />
      </div>
    </Section>
  );
}

function List({ id, title, lines, tone = "" }: { id: string; title: string; lines: string[]; tone?: string }) {
  if (!lines.length) return null;
  return (
    <details open={lines.length <= 6 || tone === "bad"} data-testid={`tried-${id}`}>
      <summary>
        {title} <span class={tone || "faint"}>{lines.length}</span>
      </summary>
      <ul>
        {lines.map((line, k) => (
          <li key={k}>{line}</li>
        ))}
      </ul>
    </details>
  );
}
