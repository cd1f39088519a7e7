// Why a rule fires or not: asked once by a person, and every second for the situation behind it.

import { useEffect, useState } from "preact/hooks";
import type { Why } from "../protocol";
import type { Source } from "../source";
import { ask } from "../ui/ask";

const EVERY = 1000;

/** What is so of a rule now, as long as it is looked at; `null` before it is known. */
export function useWhy(source: Source, rule: string): Why | null {
  const [why, setWhy] = useState<Why | null>(null);
  const link = source.link.value;
  useEffect(() => {
    let gone = false;
    let waits = false;
    const look = async () => {
      if (waits || link !== "open" || document.hidden) return;
      waits = true;
      const { more } = await ask<Why>(source, { do: "why", rule });
      waits = false;
      if (more && !gone) setWhy(more);
    };
    void look();
    const timer = setInterval(() => void look(), EVERY);
    return () => {
      gone = true;
      clearInterval(timer);
    };
  }, [source, rule, link]);
  return why;
}
