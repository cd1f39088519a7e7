// Buttons that ask why, why not, and what would have to be different; the answer below them.

import { useState } from "preact/hooks";
import type { Why } from "../protocol";
import type { Source } from "../source";
import { ask } from "../ui/ask";
import { number } from "../ui/controls";

type Question = "why" | "different";

interface Answered {
  question: Question;
  sentences: string[];
  time: number;
}

/** `rule`: of which it is asked; "": of what it does now. */
export function Asking({ source, rule, fires }: { source: Source; rule: string; fires: boolean }) {
  const [answer, setAnswer] = useState<Answered | null>(null);
  const [because, setBecause] = useState("");
  const put = async (question: Question) => {
    const time = source.status.peek()?.time ?? 0;
    const { more, because } = await ask<Why>(source, { do: "why", rule });
    setBecause(because);
    if (!more) return;
    const sentences = question === "why" ? more.sentences : [more.different || "no rule is known yet"];
    setAnswer({ question, sentences: sentences.filter(Boolean), time });
  };
  const what = rule && !fires ? "why-not" : "why";
  return (
    <>
      <div class="asking">
        <button data-testid={`ask-${what}`} aria-pressed={answer?.question === "why"} onClick={() => void put("why")}>
          {what === "why" ? "Why" : "Why not"}
        </button>
        <button
          data-testid="ask-different"
          aria-pressed={answer?.question === "different"}
          onClick={() => void put("different")}
        >
          What would have to be different
        </button>
      </div>
      {because && <p class="refusal">{because}</p>}
      {answer && (
        <div class="answer" data-testid="why-answer">
          <span class="faint">at {number(answer.time, 2)} s</span>
          {answer.sentences.map((sentence) => (
            <p key={sentence}>{sentence}</p>
          ))}
        </div>
      )}
    </>
  );
}
