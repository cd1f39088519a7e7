// Support polygon now and next, and where the centre of gravity is above it.

import { CircleGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial, RingGeometry } from "three";
import type { Scan } from "../../protocol";
import { hull } from "../hull";
import { Ribbon } from "../ribbon";
import type { Moment, Overlay } from "./overlay";

const LIFT = 0.006;

export class Support implements Overlay {
  readonly object = new Group();
  private readonly now = new Ribbon("#0ca678", 0.009, 1, true);
  private readonly next = new Ribbon("#0ca678", 0.005, 0.45);
  private readonly centre = new Group();
  private readonly paint = new MeshBasicMaterial({ color: "#0ca678", side: DoubleSide, toneMapped: false });
  private drawn: Scan | null | undefined;

  constructor() {
    const ring = new Mesh(new RingGeometry(0.018, 0.024, 32), this.paint);
    const dot = new Mesh(new CircleGeometry(0.008, 24), this.paint);
    this.centre.add(ring, dot);
    this.object.add(this.now.mesh, this.next.mesh, this.centre);
  }

  update(moment: Moment): void {
    const scan = moment.source.scan.peek();
    this.now.scale = this.next.scale = moment.size;
    this.centre.scale.setScalar(moment.size);
    if (moment.source.kind === "replay") return this.fromFeet(moment);
    if (scan === this.drawn) return;
    this.drawn = scan;
    this.centre.visible = Boolean(scan);
    const lifted = (points: number[][]) => points.map(([x, y, z]) => [x, y, z + LIFT]);
    this.now.set(lifted(scan?.support ?? []), true);
    this.next.set(lifted(scan?.predicted ?? []), true);
    if (!scan) return;
    const [x, y, z] = scan.cog;
    this.centre.position.set(x, y, z + LIFT);
    // red where it is outside: the robot tips
    this.paint.color.set((scan.margin ?? 0) < 0 ? "#f03e3e" : "#0ca678");
  }

  /** A recording has no scan: the polygon of the feet that stand. */
  private fromFeet({ layout, row, pose }: Moment): void {
    const stance = layout.at("stance");
    const feet = pose.feet
      .filter((_, k) => row[stance + k] > 0.5)
      .map(({ x, y, z }) => [x, y, z - pose.robot.foot_radius[0] + LIFT]);
    this.now.set(hull(feet), true);
    this.centre.visible = this.next.mesh.visible = false;
  }
}
