// Where the maps look: both at the same place, at the same scale.

import { signal } from "@preact/signals";
import type { Vec2 } from "../protocol";
import { remembered } from "../ui/remembered";

/** Middle of the maps [m]. */
export const middle = signal<Vec2>([0, 0]);
/** Pixels a metre. */
export const scale = remembered("map.scale", 40);
/** Whether the robot stays in the middle. */
export const follows = remembered("map.follows", true);
export const layout = remembered<"beside" | "over">("map.layout", "beside");

const [LEAST, MOST] = [1.2, 400];

export interface Frame {
  width: number;
  height: number;
}

export function toScreen({ width, height }: Frame, x: number, y: number): Vec2 {
  const [cx, cy] = middle.peek();
  return [width / 2 + (x - cx) * scale.peek(), height / 2 - (y - cy) * scale.peek()];
}

export function toWorld({ width, height }: Frame, px: number, py: number): Vec2 {
  const [cx, cy] = middle.peek();
  return [cx + (px - width / 2) / scale.peek(), cy - (py - height / 2) / scale.peek()];
}

/** Zooms by a factor; the place under the pointer stays there, unless the robot is followed. */
export function zoom(factor: number, frame?: Frame, at?: Vec2): void {
  const before = frame && at && !follows.peek() ? toWorld(frame, ...at) : null;
  scale.value = Math.max(LEAST, Math.min(MOST, scale.peek() * factor));
  if (!before || !frame || !at) return;
  const after = toWorld(frame, ...at);
  const [cx, cy] = middle.peek();
  middle.value = [cx + before[0] - after[0], cy + before[1] - after[1]];
}

export function pan(dx: number, dy: number): void {
  const [cx, cy] = middle.peek();
  follows.value = false;
  middle.value = [cx - dx / scale.peek(), cy + dy / scale.peek()];
}

/** All of a field. */
export function fit([x0, y0, x1, y1]: number[], { width, height }: Frame): void {
  follows.value = false;
  middle.value = [(x0 + x1) / 2, (y0 + y1) / 2];
  scale.value = Math.max(LEAST, 0.96 * Math.min(width / (x1 - x0), height / (y1 - y0)));
}
