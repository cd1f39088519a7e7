// A camera and how it moves: around a target, with the robot, from above, from the side, at a foot.

import { MathUtils, PerspectiveCamera, Vector3 } from "three";
import type { Robot } from "../protocol";
import type { Pose } from "./kinematics";

export const KINDS = ["follow", "free", "top", "side", "foot"] as const;
export type Kind = (typeof KINDS)[number];

const START: Record<Kind, { azimuth: number; polar: number; far: number }> = {
  follow: { azimuth: -2.25, polar: 1.12, far: 2.1 },
  free: { azimuth: -2.2, polar: 1.0, far: 6 },
  top: { azimuth: -Math.PI / 2, polar: 0.001, far: 4.5 },
  side: { azimuth: -Math.PI / 2, polar: 1.45, far: 1.7 },
  foot: { azimuth: -0.9, polar: 1.3, far: 0.55 },
};

/** Field of view, upright [°]. */
const FIELD = 38;
const away = new Vector3();
const wished = new Vector3();
const seen = new Vector3();

export class Rig {
  readonly camera = new PerspectiveCamera(FIELD, 1, 0.01, 400);
  readonly target = new Vector3();
  private azimuth = 0;
  private polar = 1;
  private far = 3;
  private heading = 0;
  /** Cameras stay farther away from a larger robot. */
  private size = 1;
  private begun = false;
  /** How far a person moved the view off its target [m]. */
  private readonly shift = new Vector3();
  /** Whose foot is looked at. */
  leg = 0;

  constructor(public kind: Kind) {
    this.camera.up.set(0, 0, 1);
    this.become(kind);
  }

  become(kind: Kind): void {
    this.kind = kind;
    const start = START[kind];
    this.azimuth = start.azimuth;
    this.polar = start.polar;
    this.far = start.far;
    this.begun = false;
    this.shift.set(0, 0, 0);
  }

  orbit(dx: number, dy: number, height: number): void {
    if (this.kind === "top") return this.pan(dx, dy, height);
    this.azimuth -= 0.006 * dx;
    this.polar = MathUtils.clamp(this.polar - 0.006 * dy, 0.02, 1.62);
  }

  /** `height`: of the view [px]. */
  pan(dx: number, dy: number, height: number): void {
    const metres = (2 * this.far * this.size * Math.tan(MathUtils.degToRad(FIELD / 2))) / Math.max(height, 100);
    const around = this.around;
    const [c, s] = [Math.cos(around), Math.sin(around)];
    const flat = metres / Math.max(0.35, Math.cos(this.polar));
    this.shift.x += metres * s * dx - flat * c * dy;
    this.shift.y += -metres * c * dx - flat * s * dy;
  }

  zoom(by: number): void {
    this.far = MathUtils.clamp(this.far * Math.exp(by), 0.15, 60);
  }

  /** Follows the robot; `dt` since the last picture [s]. */
  update(pose: Pose | null, dt: number): void {
    if (pose) this.follow(pose, dt);
    const around = this.around;
    away.set(Math.sin(this.polar) * Math.cos(around), Math.sin(this.polar) * Math.sin(around), Math.cos(this.polar));
    seen.copy(this.target).add(this.shift);
    const far = this.far * this.size;
    this.camera.position.copy(seen).addScaledVector(away, far);
    this.camera.near = Math.max(0.01, 0.02 * far);
    if (this.kind === "top") this.camera.up.set(0, 1, 0);
    else this.camera.up.set(0, 0, 1);
    this.camera.lookAt(seen);
  }

  private get around(): number {
    return this.azimuth + (this.kind === "side" || this.kind === "foot" ? this.heading : 0);
  }

  private follow(pose: Pose, dt: number): void {
    this.size = spread(pose.robot);
    wished.copy(pose.base.position);
    if (this.kind === "foot") wished.copy(pose.feet[Math.min(this.leg, pose.feet.length - 1)]);
    else wished.z -= 0.35 * pose.robot.height;
    const turn = MathUtils.euclideanModulo(pose.heading - this.heading + Math.PI, 2 * Math.PI) - Math.PI;
    if (!this.begun) {
      this.begun = true;
      this.target.copy(wished);
      this.heading = pose.heading;
      return;
    }
    if (this.kind === "free") return;
    const jumped = wished.distanceTo(this.target) > 3;
    const soon = this.kind === "foot" ? 0.6 : 1 - Math.exp(-dt / 0.12);
    this.target.lerp(wished, jumped ? 1 : soon);
    this.heading += turn * (1 - Math.exp(-dt / 0.4));
  }
}

/** How far a robot's feet reach from its middle, as a multiple of what Go2's do (0.63 m). */
export function spread({ hip, offset }: Robot): number {
  const reach = hip.map((at, k) => Math.hypot(...at) + Math.hypot(...offset[k][1]) + Math.hypot(...offset[k][2]));
  return Math.max(0.3, Math.max(...reach) / 0.63);
}
