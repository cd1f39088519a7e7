// The last lessons, each to be taken back.

import { useState } from "preact/hooks";
import type { Lesson } from "../protocol";
import { drives, type Source } from "../source";
import { ask } from "../ui/ask";
import { Section } from "../ui/controls";

export function Lessons({ source, lessons }: { source: Source; lessons: Lesson[] }) {
  const [refused, setRefused] = useState({ lesson: "", because: "" });
  const driving = drives(source);
  const forget = async (lesson: string) => {
    const { because } = await ask(source, { do: "forget", lesson });
    setRefused({ lesson, because });
  };
  return (
    <Section title="Lessons" aside={lessons.length ? "the last first" : ""}>
      {!lessons.length && <p class="faint about">Nothing was taught yet.</p>}
      <ul class="lessons" data-testid="lessons">
        {lessons.map(({ id, rule, given, about }) => (
          <li key={id} data-testid="lesson" data-lesson={id}>
            <span class="lesson-said">
              <strong>{rule}</strong> <span class={given === "corrected" ? "warn" : "faint"}>{given}</span>
              {about && <span class="faint"> because of {about}</span>}
              <span class="lesson-where" title={id}>
                {id}
              </span>
              {refused.lesson === id && refused.because && <span class="refusal">{refused.because}</span>}
            </span>
            <button data-testid="forget" disabled={!driving} title="Forget this lesson" onClick={() => void forget(id)}>
              Take back
            </button>
          </li>
        ))}
      </ul>
    </Section>
  );
}
