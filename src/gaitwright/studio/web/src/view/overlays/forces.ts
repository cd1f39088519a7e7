// Forces of the ground on the feet: a robot's weight is as long as the robot is tall.

import { Vector3 } from "three";
import { Arrows } from "../arrows";
import type { Moment, Overlay } from "./overlay";

const MOST_LEGS = 12;
const force = new Vector3();
const from = new Vector3();

export class Forces implements Overlay {
  private readonly arrows = new Arrows(MOST_LEGS, "#e03131", 0.006);
  readonly object = this.arrows.group;

  update({ layout, row, pose, size }: Moment): void {
    this.arrows.scale = size;
    const at = layout.at("forces_w");
    const metres = (1.3 * pose.robot.height) / (9.81 * pose.robot.mass);
    for (let k = 0; k < MOST_LEGS; k++) {
      const foot = pose.feet[k];
      if (!foot) {
        this.arrows.hide(k);
        continue;
      }
      force.set(row[at + 3 * k], row[at + 3 * k + 1], row[at + 3 * k + 2]).multiplyScalar(metres);
      from.copy(foot).setZ(foot.z - pose.robot.foot_radius[k]);
      this.arrows.set(k, from, force);
    }
  }
}
