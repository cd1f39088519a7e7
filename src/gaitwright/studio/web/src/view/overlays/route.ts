// The way that is planned, and where it leads.

import { CylinderGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial, RingGeometry, SphereGeometry } from "three";
import type { Status } from "../../protocol";
import { Ribbon } from "../ribbon";
import type { Moment, Overlay } from "./overlay";

const PIECE = 0.1;
const LIFT = 0.012;
const COLOUR = "#4c6ef5";

export class RouteLine implements Overlay {
  readonly object = new Group();
  private readonly line = new Ribbon(COLOUR, 0.018);
  private readonly goal = new Group();
  private drawn: Status | null = null;

  constructor() {
    const paint = new MeshBasicMaterial({ color: COLOUR, side: DoubleSide, toneMapped: false });
    const pole = new Mesh(new CylinderGeometry(0.004, 0.004, 0.34, 10).rotateX(Math.PI / 2).translate(0, 0, 0.17), paint);
    const ball = new Mesh(new SphereGeometry(0.026, 20, 14).translate(0, 0, 0.36), paint);
    const ring = new Mesh(new RingGeometry(0.09, 0.105, 48).translate(0, 0, LIFT), paint);
    this.goal.add(pole, ball, ring);
    this.object.add(this.line.mesh, this.goal);
  }

  arrange(): void {
    this.drawn = null;
  }

  update({ source, pose, size, height }: Moment): void {
    const status = source.status.peek();
    if (status === this.drawn) return;
    this.drawn = status;
    this.line.scale = size;
    this.goal.scale.setScalar(size);
    const { x, y } = pose.base.position;
    const corners = status?.route.length ? [[x, y], ...status.route] : [];
    this.line.set(laid(corners, height));
    const goal = status?.goal ?? source.world.peek()?.goal ?? null;
    this.goal.visible = goal !== null;
    if (goal) this.goal.position.set(goal[0], goal[1], height(goal[0], goal[1]));
  }
}

/** A line over the ground, point by point. */
function laid(corners: number[][], height: (x: number, y: number) => number): number[][] {
  const out: number[][] = [];
  for (let k = 0; k + 1 < corners.length; k++) {
    const [a, b] = [corners[k], corners[k + 1]];
    const pieces = Math.min(200, Math.max(1, Math.ceil(Math.hypot(b[0] - a[0], b[1] - a[1]) / PIECE)));
    for (let i = k ? 1 : 0; i <= pieces; i++) {
      const [px, py] = [a[0] + ((b[0] - a[0]) * i) / pieces, a[1] + ((b[1] - a[1]) * i) / pieces];
      out.push([px, py, height(px, py) + LIFT]);
    }
  }
  return out;
}
