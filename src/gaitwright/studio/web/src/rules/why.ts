// The situation behind a rule that is looked at, and which rule fires: asked every second. Sentences on it take
// the studio longer, and are asked for by a person (`Asking`).

import { useEffect, useState } from "preact/hooks";
import type { Why } from "../protocol";
import type { Source } from "../source";
import { ask } from "../ui/ask";

const EVERY = 1000;

export type Now = Pick<Why, "situation" | "fires">;

/** What is so of a rule now, as long as it is looked at; `null` before it is known. */
export function useNow(source: Source, rule: string): Now | null {
  const [now, setNow] = useState<Now | null>(null);
  const fires = source.status.value?.rule;
  useEffect(() => watchOver(source, rule, setNow), [source, rule, fires]);
  return now;
}

/** Asks now and every second, one question at a time, until it is told to stop. */
export function watchOver(source: Source, rule: string, tell: (now: Now) => void): () => void {
  let gone = false;
  let waits = false;
  const look = async () => {
    if (waits || source.link.peek() !== "open" || document.hidden) return;
    waits = true;
    const { more } = await ask<Now>(source, { do: "why", rule, brief: true });
    waits = false;
    if (more && !gone) tell(more);
  };
  void look();
  const timer = setInterval(() => void look(), EVERY);
  return () => {
    gone = true;
    clearInterval(timer);
  };
}
