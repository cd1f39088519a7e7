// Keys of a replay: space plays, arrows step (with shift a second), home and end.

import { writes } from "../drive/keys";
import type { Clock } from "./clock";

/** `rate`: rows per second. */
export function listenToKeys(clock: Clock, rate: number): () => void {
  const press = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey || writes(event.target)) return;
    const step = event.shiftKey ? 1 : 1 / Math.max(1, rate);
    const now = clock.time.peek();
    const to: Record<string, number> = {
      ArrowLeft: now - step, ArrowRight: now + step, Home: 0, End: clock.duration.peek(),
    };
    if (event.code === "Space") {
      event.preventDefault();
      clock.toggle();
    } else if (event.code in to) {
      event.preventDefault();
      clock.playing.value = false;
      clock.seek(to[event.code]);
    }
  };
  addEventListener("keydown", press);
  return () => removeEventListener("keydown", press);
}
