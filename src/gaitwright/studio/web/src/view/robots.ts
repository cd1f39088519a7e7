// Robots as instanced parts: one draw per kind of part, however many robots there are.

import {
  type BufferGeometry, Color, Group, InstancedMesh, Matrix4, MeshStandardMaterial, Quaternion, Vector3,
} from "three";
import type { Robot } from "../protocol";
import type { Link, Pose } from "./kinematics";
import { eyes, foot, girths, housing, length, taperedLink, trunk } from "./robot-shape";

interface Part {
  mesh: InstancedMesh;
  /** Where each instance is: of the pose of a robot. */
  places: { robot: number; link: (pose: Pose) => Link; own: Matrix4 }[];
}

const ONE = new Vector3(1, 1, 1);
const DOWN = new Vector3(0, 0, -1);
const matrix = new Matrix4();

export interface Paint {
  shell: MeshStandardMaterial;
  dark: MeshStandardMaterial;
  metal: MeshStandardMaterial;
  rubber: MeshStandardMaterial;
  lens: MeshStandardMaterial;
}

export function paint(): Paint {
  const of = (color: string, roughness: number, metalness = 0) =>
    new MeshStandardMaterial({ color, roughness, metalness });
  return {
    shell: of("#e4e7ea", 0.42),
    dark: of("#2b3036", 0.5, 0.1),
    metal: of("#9aa3ac", 0.38, 0.35),
    rubber: of("#17191c", 0.95),
    lens: of("#4dabf7", 0.2),
  };
}

/** The ghost of the wished pose: one translucent colour. */
export function ghostPaint(): Paint {
  const one = new MeshStandardMaterial({
    color: "#4dabf7", transparent: true, opacity: 0.32, depthWrite: false, roughness: 0.8,
    polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2,
  });
  return { shell: one, dark: one, metal: one, rubber: one, lens: one };
}

const TINTS = ["#e4e7ea", "#9cc5ee", "#f3bd93", "#a6d9ae", "#d3b0e2", "#8fd3dd", "#f0b3c4", "#e6d58f"];

export class Robots {
  readonly group = new Group();
  private readonly parts = new Map<string, Part>();

  constructor(readonly robots: Robot[], private readonly paint: Paint, shadows = true) {
    robots.forEach((robot, k) => this.build(robot, k));
    for (const part of this.parts.values()) {
      const { mesh, places } = part;
      const whole = new InstancedMesh(mesh.geometry, mesh.material, places.length);
      whole.frustumCulled = false;
      whole.castShadow = shadows;
      whole.receiveShadow = shadows;
      if (mesh.material === paint.shell && shadows) {
        places.forEach((place, k) => whole.setColorAt(k, new Color(TINTS[place.robot % TINTS.length])));
        paint.shell.color.set("#ffffff");
      }
      part.mesh = whole;
      this.group.add(whole);
    }
  }

  /** Puts every part where the poses have it. */
  pose(poses: Pose[]): void {
    for (const { mesh, places } of this.parts.values()) {
      places.forEach(({ robot, link, own }, k) => {
        const { position, turn } = link(poses[robot]);
        mesh.setMatrixAt(k, matrix.compose(position, turn, ONE).multiply(own));
      });
      mesh.instanceMatrix.needsUpdate = true;
    }
  }

  dispose(): void {
    for (const { mesh } of this.parts.values()) {
      mesh.geometry.dispose();
      mesh.dispose();
    }
  }

  private add(
    key: string, make: () => BufferGeometry, material: MeshStandardMaterial, robot: number,
    link: (pose: Pose) => Link, own = new Matrix4(),
  ): void {
    let part = this.parts.get(key);
    if (!part) {
      part = { mesh: new InstancedMesh(make(), material, 0), places: [] };
      this.parts.set(key, part);
    }
    part.places.push({ robot, link, own });
  }

  private build(robot: Robot, k: number): void {
    const kind = `${robot.name} ${JSON.stringify(robot.trunk)}`;
    const base = (pose: Pose) => pose.base;
    this.add(`${kind} shell`, () => trunk(robot).shell, this.paint.shell, k, base);
    this.add(`${kind} dark`, () => trunk(robot).dark, this.paint.dark, k, base);
    this.add(`${kind} eyes`, () => eyes(robot), this.paint.lens, k, base);
    robot.legs.forEach((_, leg) => this.buildLeg(robot, k, leg));
  }

  private buildLeg(robot: Robot, k: number, leg: number): void {
    const { paint } = this;
    const [out, thigh, shank] = robot.offset[leg];
    const g = girths(robot, leg);
    const of = (index: 0 | 1 | 2) => (pose: Pose) => pose.links[leg][index];
    const name = (part: string, ...sizes: number[]) => `${part} ${sizes.map((n) => n.toFixed(4)).join(" ")}`;
    const hip = () => housing(0.92 * g.motor, g.wide, "x");
    this.add(name("hip", g.motor), hip, paint.dark, k, (pose) => pose.hips[leg]);
    if (length(out) > 0.3 * g.motor) {
      const make = () => taperedLink(length(out), 0.7 * g.motor, 0.7 * g.motor, 1);
      this.add(name("out", length(out), g.motor), make, paint.shell, k, of(0), towards(out));
    }
    const motor = () => housing(g.motor, g.wide, "y");
    this.add(name("motor", g.motor, 1), motor, paint.dark, k, of(1));
    const upper = () => taperedLink(length(thigh), g.thighUpper, g.thighLower, 0.72);
    this.add(name("thigh", length(thigh), g.motor), upper, paint.shell, k, of(1), towards(thigh));
    const knee = () => housing(g.knee, 0.85 * g.wide, "y");
    this.add(name("knee", g.knee), knee, paint.dark, k, of(2));
    const lower = () => taperedLink(length(shank), g.shankUpper, g.shankLower, 0.8);
    this.add(name("shank", length(shank), g.motor), lower, paint.metal, k, of(2), towards(shank));
    const radius = robot.foot_radius[leg];
    const tip = new Matrix4().makeTranslation(...shank);
    this.add(name("foot", radius), () => foot(radius), paint.rubber, k, of(2), tip);
  }
}

/** Turns −z to a direction, y staying as it is where it can. */
function towards(offset: readonly [number, number, number]): Matrix4 {
  const turn = new Quaternion().setFromUnitVectors(DOWN, new Vector3(...offset).normalize());
  return new Matrix4().makeRotationFromQuaternion(turn);
}
