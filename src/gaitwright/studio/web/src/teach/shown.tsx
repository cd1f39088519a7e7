// What a person showed an apprentice by doing it, or a rule that is to come before another: is it right?
// Asked over the views, until it is said.

import { useEffect } from "preact/hooks";
import type { Tried } from "../protocol";
import { tabs } from "../shell/docks";
import { drives, type Source } from "../source";
import { drop, keep, propose, proposed, refused, tried } from "./teaching";
import "./teach.css";

/** So many lines of what would be learned; the others under “Teach”. */
const MOST = 3;

const questionOf = ({ sentence }: Tried) => `Is ${sentence.replace(/ is right here$/, "")} right here?`;
const times = (count: number) => (count === 1 ? "one stretch of this run" : `${count} stretches of this run`);

export function Shown({ source }: { source: Source }) {
  const told = source.tried.value;
  useEffect(() => {
    if (told?.proposed) propose(told, { question: questionOf(told), told: true });
    else if (proposed.peek()?.told) propose(null, null);
  }, [told]);
  const now = tried.value;
  const asked = proposed.value;
  if (!now || !asked) return null;
  const driving = drives(source);
  const broken = now.broken.length;
  return (
    <div class="shown" data-testid="proposed" data-followed={`${now.followed}`}>
      <p>
        <strong>{asked.question}</strong>
      </p>
      {now.moves.slice(0, MOST).map((line) => (
        <p key={line} class="shown-line" title={line}>
          {line}
        </p>
      ))}
      <p class={broken || !now.followed ? "warn" : "faint"}>
        {now.followed ? "It would do so from now on" : "It would still do something else here"}
        {now.stretches.length > 0 && `; it would have decided otherwise in ${times(now.stretches.length)}`}
        {broken > 0 && `, and no longer follow ${broken} of its lessons`}.
      </p>
      <div class="verdict">
        <button class="primary" data-testid="proposed-keep" disabled={!driving} onClick={() => void keep(source)}>
          Keep
        </button>
        <button data-testid="proposed-drop" disabled={!driving} onClick={() => void drop(source)}>
          Drop
        </button>
        <button data-testid="proposed-more" onClick={() => (tabs.left.value = "teach")}>
          What else?
        </button>
      </div>
      {refused.value?.field === "keep" && <p class="refusal">{refused.value.because}</p>}
    </div>
  );
}
