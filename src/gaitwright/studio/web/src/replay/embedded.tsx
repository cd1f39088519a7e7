// The recording in a replay page: this one's, or another one's that was dropped onto it.

import type { Embedded } from "../protocol";

/** The recording, or a sentence on why there is none. */
export function embedded(page: Document): Embedded | string {
  const text = page.getElementById("recording")?.textContent?.trim();
  if (!text) return "This replay page has no recording in it.";
  let found: unknown;
  try {
    found = JSON.parse(text);
  } catch {
    return "The recording in this page is damaged.";
  }
  const { world, columns, rows, count, rate } = (found ?? {}) as Partial<Embedded>;
  const whole = typeof world === "string" && Array.isArray(columns) && typeof rows === "string" && Number(count) > 0 && Number(rate) > 0;
  return whole ? (found as Embedded) : "The recording in this page lacks a part.";
}

/** From a file that was dropped. */
export async function dropped(file: File): Promise<Embedded | string> {
  const page = new DOMParser().parseFromString(await file.text(), "text/html");
  return embedded(page);
}

export function noRecording(why: string) {
  return (
    <p class="nothing" data-testid="no-recording">
      {why}
    </p>
  );
}
