// Where swinging feet are to come down, in the colour of each leg.

import { DoubleSide, Group, Mesh, MeshBasicMaterial, RingGeometry } from "three";
import { LEGS } from "../../ui/colours";
import { Ribbon } from "../ribbon";
import type { Moment, Overlay } from "./overlay";

export class Footholds implements Overlay {
  readonly object = new Group();
  readonly needs = ["footholds_w"];
  private readonly rings: Mesh[] = [];
  private readonly lines: Ribbon[] = [];

  update({ layout, row, pose, size, height }: Moment): void {
    const at = layout.at("footholds_w");
    const stance = layout.at("stance");
    pose.feet.forEach((foot, k) => {
      const ring = (this.rings[k] ??= this.ring(k));
      const line = (this.lines[k] ??= this.line(k));
      const [x, y] = [row[at + 3 * k], row[at + 3 * k + 1]];
      const swings = row[stance + k] < 0.5 && Number.isFinite(x + y);
      ring.visible = line.mesh.visible = swings;
      if (!swings) return;
      const z = height(x, y) + 0.007;
      const radius = Math.max(pose.robot.foot_radius[k], 0.015);
      ring.position.set(x, y, z);
      ring.scale.setScalar(radius);
      line.scale = size;
      const ground = height(foot.x, foot.y) + 0.007;
      line.set([[foot.x, foot.y, ground], [x, y, z]]);
    });
    for (let k = pose.feet.length; k < this.rings.length; k++) {
      this.rings[k].visible = this.lines[k].mesh.visible = false;
    }
  }

  private ring(k: number): Mesh {
    const paint = new MeshBasicMaterial({ color: LEGS[k % LEGS.length], side: DoubleSide, toneMapped: false });
    const ring = new Mesh(new RingGeometry(1, 1.45, 28), paint);
    this.object.add(ring);
    return ring;
  }

  private line(k: number): Ribbon {
    const line = new Ribbon(LEGS[k % LEGS.length], 0.004, 0.6);
    this.object.add(line.mesh);
    return line;
  }
}
