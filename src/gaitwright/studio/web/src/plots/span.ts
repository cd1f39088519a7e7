// The stretch of time that all plots show.

import { computed, signal } from "@preact/signals";
import { remembered } from "../ui/remembered";

export const WINDOWS = [5, 10, 20, 60];

/** Seconds that are shown. */
export const seconds = remembered("plot.seconds", 10);

/** Where time was stopped or zoomed in: from, to [s]; `null`: it goes on. */
export const held = signal<[number, number] | null>(null);
export const isHeld = computed(() => held.value !== null);

/** From, to: a live plot ends now, one of a recording has now in its middle unless it shows all. */
export function span(now: number, replay: boolean, last: number): [number, number] {
  const kept = held.peek();
  if (kept) return kept;
  const long = seconds.peek();
  if (!replay) return now < long ? [0, long] : [now - long, now];
  if (last <= long) return [0, Math.max(last, 0.1)];
  const from = Math.max(0, Math.min(now - long / 2, last - long));
  return [from, from + long];
}
