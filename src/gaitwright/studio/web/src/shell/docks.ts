// How wide the docks are, and which tab is open in each.

import { signal } from "@preact/signals";
import { remembered } from "../ui/remembered";

export type Side = "left" | "right";

const FOLDED = 26;
const LEAST = 200;
const MOST = 900;
const MIDDLE = 320;

export const widths = { left: remembered("dock.left", 248), right: remembered("dock.right", 344) };
export const folded = { left: remembered("folded.left", false), right: remembered("folded.right", false) };
export const tabs = { left: remembered("tab.left", ""), right: remembered("tab.right", "") };

const room = signal(innerWidth);
addEventListener("resize", () => {
  room.value = innerWidth;
});

/** Width to draw a dock with [px]: what was chosen, less where the window is narrow. */
export function dockWidth(side: Side): number {
  if (folded[side].value) return FOLDED;
  const share = side === "left" ? 0.26 : 0.6;
  return Math.round(Math.max(LEAST, Math.min(widths[side].value, room.value * share)));
}

export function setWidth(side: Side, width: number): void {
  const other = dockWidth(side === "left" ? "right" : "left");
  widths[side].value = Math.max(LEAST, Math.min(width, MOST, room.value - other - MIDDLE));
}
