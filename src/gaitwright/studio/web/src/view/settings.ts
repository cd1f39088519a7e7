// What the views show: how many, from where, and what is laid over them.

import { signal } from "@preact/signals";
import { remembered } from "../ui/remembered";
import type { Kind } from "./rig";

export const viewCount = remembered<1 | 2 | 4>("views", 1);
export const kinds = remembered<Kind[]>("view.kinds", ["follow", "top", "side", "foot"]);

export const OVERLAYS = [
  { id: "forces", label: "Contact forces", first: true },
  { id: "support", label: "Support polygon, centre of gravity", first: true },
  { id: "footholds", label: "Foothold targets", first: true },
  { id: "route", label: "Route and goal", first: true },
  { id: "trail", label: "Way that it came", first: false },
  { id: "velocity", label: "Velocity", first: false },
  { id: "ghost", label: "Wished pose", first: false },
  { id: "seen", label: "Ground as it is seen", first: false },
  { id: "reach", label: "Reach of the feet", first: false },
] as const;
export type OverlayId = (typeof OVERLAYS)[number]["id"];

const first = Object.fromEntries(OVERLAYS.map(({ id, first }) => [id, first])) as Record<OverlayId, boolean>;
export const shown = remembered<Record<OverlayId, boolean>>("overlays", first);

export function show(id: OverlayId, on: boolean): void {
  shown.value = { ...shown.value, [id]: on };
}

/** The robot that cameras follow and plots are of. */
export const watched = signal(0);

export function look(view: number, kind: Kind): void {
  kinds.value = kinds.value.map((old, k) => (k === view ? kind : old));
}
