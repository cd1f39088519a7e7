// What a person is about to do to the world: which box is taken hold of, and whether one is being placed.

import { signal } from "@preact/signals";
import type { Box } from "../protocol";
import { remembered } from "../ui/remembered";

export const placing = signal(false);
/** The box that was clicked. */
export const chosen = signal<Box["id"] | null>(null);

/** Sizes of a new box [m], and its direction [°]. */
export const size = {
  long: remembered("box.long", 0.4),
  wide: remembered("box.wide", 0.4),
  high: remembered("box.high", 0.1),
  yaw: remembered("box.yaw", 0),
};
