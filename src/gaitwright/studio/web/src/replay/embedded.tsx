// The recording in a replay page: this one's, or another one's that was dropped onto it.

import type { Embedded, Story } from "../protocol";
import type { Clock } from "./clock";
import { Player } from "./player";

/** Columns that views and plots read. */
const NEEDED = [
  "time", "position_w", "orientation_wb", "velocity_w", "angular_velocity_b", "q", "tau", "load", "stance",
  "forces_w", "command", "driver", "power",
];
const DAMAGED = "The recording in this page is damaged.";

/** The recording in a page, ready to be played, or a sentence on why there is none. */
export async function playerOf(page: Document, clock: Clock): Promise<Player | string> {
  const text = page.getElementById("recording")?.textContent?.trim();
  if (!text) return "This replay page has no recording in it.";
  const found = read(text);
  if (typeof found === "string") return found;
  // what is packed is seen to be whole only when it is unpacked
  return Player.of(found, clock).catch(() => DAMAGED);
}

/** From a file that was dropped. */
export async function dropped(file: File, clock: Clock): Promise<Player | string> {
  const text = await file.text().catch(() => "");
  return playerOf(new DOMParser().parseFromString(text, "text/html"), clock);
}

/** A recording as its page has it, or what is wrong with it. */
export function read(text: string): Embedded | string {
  let found: unknown;
  try {
    found = JSON.parse(text);
  } catch {
    return DAMAGED;
  }
  const missing = lacks((found ?? {}) as Partial<Embedded>);
  return missing ? `The recording in this page lacks a part: ${missing}.` : (found as Embedded);
}

const areTimed = (all: unknown): boolean => Array.isArray(all) && all.every((one) => Number.isFinite(one?.time));

/** The first part that is not there, or not of its kind; "": none. */
function lacks(found: Partial<Embedded>): string {
  const { world, columns, movers = [], others = [] } = found;
  const areColumns = Array.isArray(columns) && columns.every((one) => typeof one?.name === "string" && one.size > 0);
  const parts: Record<string, boolean> = {
    world: typeof world === "string",
    columns: areColumns && NEEDED.every((name) => columns.some((column) => column.name === name)),
    movers: areTimed(movers) && movers.every(({ things }) => Array.isArray(things)),
    others: Array.isArray(others) && others.every((story) => !lacksOfStory(story ?? {})),
  };
  return lacksOfStory(found) || missing(parts);
}

function lacksOfStory({ title, rows, count, rate, drivers, events, notes = [] }: Partial<Story>): string {
  return missing({
    title: typeof title === "string",
    rows: typeof rows === "string" && Number(count) > 0 && Number(rate) > 0,
    drivers: Array.isArray(drivers),
    events: areTimed(events),
    notes: areTimed(notes),
  });
}

function missing(parts: Record<string, boolean>): string {
  return Object.keys(parts).find((name) => !parts[name]) ?? "";
}

export function noRecording(why: string) {
  return (
    <p class="nothing" data-testid="no-recording">
      {why}
    </p>
  );
}
