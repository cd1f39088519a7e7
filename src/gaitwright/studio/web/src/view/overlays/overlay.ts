// What is laid over the world: each kind in a file of its own.

import type { Object3D } from "three";
import type { Layout } from "../../layout";
import type { World } from "../../protocol";
import type { Source } from "../../source";
import type { Pose } from "../kinematics";

/** The robot that is watched, now. */
export interface Moment {
  source: Source;
  layout: Layout;
  row: Float32Array;
  pose: Pose;
  /** 1 for a robot as large as Go2: lines are thicker for larger ones. */
  size: number;
  /** Height of what stands at a place. */
  height: (x: number, y: number) => number;
}

export interface Overlay {
  readonly object: Object3D;
  /** Columns without which there is nothing to show. */
  readonly needs?: readonly string[];
  arrange?(world: World): void;
  update(moment: Moment): void;
}
