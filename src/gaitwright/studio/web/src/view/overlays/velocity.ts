// The velocity asked for (grey) and the one there is (blue), above the robot: 1 m/s is half a metre long.

import { Group, Vector3 } from "three";
import { Arrows } from "../arrows";
import type { Moment, Overlay } from "./overlay";

const METRES = 0.5;
const from = new Vector3();
const along = new Vector3();

export class VelocityArrow implements Overlay {
  readonly object = new Group();
  private readonly is = new Arrows(1, "#1c7ed6", 0.008);
  private readonly asked = new Arrows(1, "#868e96", 0.006);

  constructor() {
    this.object.add(this.is.group, this.asked.group);
  }

  update({ layout, row, pose, size }: Moment): void {
    this.is.scale = this.asked.scale = size;
    const { position } = pose.base;
    const [v, c] = [layout.at("velocity_w"), layout.at("command")];
    from.set(position.x, position.y, position.z + 0.55 * pose.robot.height);
    this.is.set(0, from, along.set(row[v], row[v + 1], 0).multiplyScalar(METRES));
    const [cos, sin] = [Math.cos(pose.heading), Math.sin(pose.heading)];
    along.set(cos * row[c] - sin * row[c + 1], sin * row[c] + cos * row[c + 1], 0).multiplyScalar(METRES);
    from.z += 0.03;
    this.asked.set(0, from, along);
  }
}
