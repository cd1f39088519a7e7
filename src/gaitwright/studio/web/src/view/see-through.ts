// Boxes between a camera and the robot: seen through, so that the robot is never hidden. One for each view.

import { Vector3 } from "three";
import type { Box } from "../protocol";
import type { Id } from "./boxes";
import type { Pose } from "./kinematics";

/** What is left to be seen of such a box. */
const CLEAR = 0.16;
/** How fast it becomes so [s]. */
const SOON = 0.12;
/** A box on which it stands is not before it: rays end so far before a foot, and aim so far over it [m]. */
const [SHORT, OVER] = [0.06, 0.05];

const aim = new Vector3();
const local = { from: [0, 0, 0] as Triple, along: [0, 0, 0] as Triple };
type Triple = [number, number, number];

export class SeeThrough {
  /** What is seen of the boxes that are not seen whole. */
  readonly shares = new Map<Id, number>();

  /** The same `dt` [s] later, for a camera at a place; without a robot nothing is in its way. */
  look(boxes: readonly Box[], eye: Vector3, pose: Pose | null, dt: number): void {
    const soon = 1 - Math.exp(-dt / SOON);
    const known = new Set<Id>();
    for (const box of boxes) {
      known.add(box.id);
      const isBefore = pose !== null && hides(box, eye, pose);
      const share = this.shares.get(box.id);
      if (!isBefore && share === undefined) continue;
      const now = (share ?? 1) + soon * ((isBefore ? CLEAR : 1) - (share ?? 1));
      if (!isBefore && now > 0.97) this.shares.delete(box.id);
      else this.shares.set(box.id, now);
    }
    for (const id of this.shares.keys()) if (!known.has(id)) this.shares.delete(id);
  }
}

/** Whether a box is between the eye and the robot's middle, a hip or a foot. */
function hides(box: Box, eye: Vector3, pose: Pose): boolean {
  const middle = pose.base.position;
  const size = Math.hypot(box.lx, box.ly, box.lz) / 2 + 2 * pose.robot.height;
  if (farFrom(box, eye, middle) > size) return false;
  if (isBetween(box, eye, middle, 0)) return true;
  return (
    pose.hips.some(({ position }) => isBetween(box, eye, position, 0)) ||
    pose.feet.some((foot) => isBetween(box, eye, foot, OVER))
  );
}

/** Distance of a box's middle from the way between two places. */
function farFrom({ x, y, z }: Box, from: Vector3, to: Vector3): number {
  aim.copy(to).sub(from);
  const share = (aim.x * (x - from.x) + aim.y * (y - from.y) + aim.z * (z - from.z)) / Math.max(1e-9, aim.lengthSq());
  const at = Math.max(0, Math.min(1, share));
  return Math.hypot(from.x + at * aim.x - x, from.y + at * aim.y - y, from.z + at * aim.z - z);
}

/** Whether the way from one place to just before another, a little over it, meets a box. */
export function isBetween(box: Box, from: Vector3, to: Vector3, over: number): boolean {
  aim.copy(to).sub(from);
  aim.z += over;
  const far = aim.length();
  if (far <= SHORT) return false;
  aim.multiplyScalar((far - SHORT) / far);
  const [c, s] = [Math.cos(box.yaw), Math.sin(box.yaw)];
  const [dx, dy] = [from.x - box.x, from.y - box.y];
  local.from = [c * dx + s * dy, c * dy - s * dx, from.z - box.z];
  local.along = [c * aim.x + s * aim.y, c * aim.y - s * aim.x, aim.z];
  const half: Triple = [box.lx / 2, box.ly / 2, box.lz / 2];
  let [enters, leaves] = [0, 1];
  for (let k = 0; k < 3; k++) {
    const [at, along] = [local.from[k], local.along[k]];
    if (Math.abs(along) < 1e-12) {
      if (Math.abs(at) > half[k]) return false;
      continue;
    }
    const [a, b] = [(-half[k] - at) / along, (half[k] - at) / along];
    enters = Math.max(enters, Math.min(a, b));
    leaves = Math.min(leaves, Math.max(a, b));
  }
  return enters < leaves;
}
