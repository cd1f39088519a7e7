// Forward kinematics: a row of a frame → where every link of a robot is, in the world.

import { Quaternion, Vector3 } from "three";
import type { Layout } from "../layout";
import type { Robot } from "../protocol";

export interface Link {
  position: Vector3;
  turn: Quaternion;
}

const X = new Vector3(1, 0, 0);
const Y = new Vector3(0, 1, 0);
const step = new Vector3();
const hinge = new Quaternion();

export class Pose {
  readonly base: Link = { position: new Vector3(), turn: new Quaternion() };
  /** Where the first link's housing is: at the hip, not turned by the first joint. */
  readonly hips: Link[];
  /** Per leg: links turned by joints 1, 2 and 3, each at its hinge. */
  readonly links: [Link, Link, Link][];
  /** Centres of the feet. */
  readonly feet: Vector3[];
  private readonly hipAt: Vector3[];
  private readonly frame: Quaternion[];
  private readonly offset: [Vector3, Vector3, Vector3][];

  constructor(readonly robot: Robot) {
    const none = (): Link => ({ position: new Vector3(), turn: new Quaternion() });
    this.hips = robot.legs.map(none);
    this.links = robot.legs.map(() => [none(), none(), none()]);
    this.feet = robot.legs.map(() => new Vector3());
    this.hipAt = robot.hip.map((at) => new Vector3(...at));
    this.frame = robot.frame.map(([w, x, y, z]) => new Quaternion(x, y, z, w));
    this.offset = robot.offset.map(
      (three) => three.map((at) => new Vector3(...at)) as [Vector3, Vector3, Vector3],
    );
  }

  /** As sensed, or, with `reference`, as it should be. */
  set(row: Float32Array, layout: Layout, reference = false): void {
    const p = layout.at(reference ? "reference_position_w" : "position_w");
    const o = layout.at(reference ? "reference_orientation_wb" : "orientation_wb");
    const q = layout.at(reference ? "q_reference" : "q");
    this.base.position.set(row[p], row[p + 1], row[p + 2]);
    this.base.turn.set(row[o + 1], row[o + 2], row[o + 3], row[o]);
    for (let k = 0; k < this.links.length; k++) {
      this.setLeg(k, row[q + 3 * k], row[q + 3 * k + 1], row[q + 3 * k + 2]);
    }
  }

  private setLeg(k: number, q1: number, q2: number, q3: number): void {
    const [first, second, third] = this.links[k];
    const offset = this.offset[k];
    const hip = this.hips[k];
    step.copy(this.hipAt[k]).applyQuaternion(this.base.turn);
    hip.position.copy(this.base.position).add(step);
    hip.turn.copy(this.base.turn).multiply(this.frame[k]);
    first.position.copy(hip.position);
    first.turn.copy(hip.turn).multiply(hinge.setFromAxisAngle(X, q1));
    along(first, offset[0], second.position);
    second.turn.copy(first.turn).multiply(hinge.setFromAxisAngle(Y, q2));
    along(second, offset[1], third.position);
    third.turn.copy(second.turn).multiply(hinge.setFromAxisAngle(Y, this.robot.sign[k] * q3));
    along(third, offset[2], this.feet[k]);
  }

  /** Direction in which the robot looks, world [rad]. */
  get heading(): number {
    const { x, y, z, w } = this.base.turn;
    return Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
  }
}

function along(link: Link, offset: Vector3, out: Vector3): void {
  out.copy(link.position).add(step.copy(offset).applyQuaternion(link.turn));
}
