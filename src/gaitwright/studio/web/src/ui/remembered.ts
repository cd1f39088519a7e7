// Signals that keep their value over visits, where the browser lets them.

import { effect, signal, type Signal } from "@preact/signals";

export function remembered<T>(name: string, first: T): Signal<T> {
  const key = `gaitwright.${name}`;
  let value = first;
  try {
    const kept = localStorage.getItem(key);
    if (kept !== null) value = JSON.parse(kept) as T;
  } catch {
    // no storage, or something else's value: start anew
  }
  if (typeof value !== typeof first || value === null) value = first;
  const kept = signal(value);
  let begun = false;
  effect(() => {
    const now = JSON.stringify(kept.value);
    if (!begun) {
      begun = true;
      return;
    }
    try {
      localStorage.setItem(key, now);
    } catch {
      // full, or forbidden: it holds for this visit
    }
  });
  return kept;
}
