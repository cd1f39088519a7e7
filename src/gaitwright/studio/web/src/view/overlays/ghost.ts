// The pose that is wished for, translucent.

import { Group } from "three";
import { Pose } from "../kinematics";
import { ghostPaint, Robots } from "../robots";
import type { Moment, Overlay } from "./overlay";

export class Ghost implements Overlay {
  readonly object = new Group();
  readonly needs = ["q_reference", "reference_orientation_wb"];
  private robots: Robots | null = null;
  private pose: Pose | null = null;
  private readonly paint = ghostPaint();

  arrange(): void {
    if (this.robots) this.object.remove(this.robots.group);
    this.robots?.dispose();
    this.robots = null;
  }

  update({ layout, row, pose }: Moment): void {
    if (!this.robots || this.pose?.robot !== pose.robot) {
      this.arrange();
      this.pose = new Pose(pose.robot);
      this.robots = new Robots([pose.robot], this.paint, false);
      this.object.add(this.robots.group);
    }
    this.pose!.set(row, layout, true);
    this.robots.pose([this.pose!]);
  }
}
