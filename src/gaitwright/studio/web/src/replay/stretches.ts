// How long each skill, driver or rule held.

import type { ReplayEvent } from "../protocol";

export interface Stretch {
  name: string;
  from: number;
  to: number;
}

/** How long something held, one stretch after another. */
export function stretches(events: ReplayEvent[], key: "skill" | "driver" | "rule", end: number): Stretch[] {
  const out: Stretch[] = [];
  events.forEach((event, k) => {
    const to = events[k + 1]?.time ?? end;
    const last = out.at(-1);
    if (last && last.name === event[key]) last.to = to;
    else out.push({ name: event[key], from: event.time, to });
  });
  return out.filter(({ from, to }) => to > from);
}
