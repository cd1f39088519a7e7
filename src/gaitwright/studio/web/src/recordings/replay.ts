// The door to the replay page: whoever can show a recording says so here.

import { signal } from "@preact/signals";

/** Shows a recording of this studio by its name; `null`: there is nobody who can. */
export const replayer = signal<((name: string) => void) | null>(null);

export function openReplay(name: string): void {
  replayer.peek()?.(name);
}
