// What the parts of a robot look like, from its numbers: lengths, radii, boxes.

import { BufferGeometry, CylinderGeometry, LatheGeometry, SphereGeometry, Vector2 } from "three";
import { RoundedBoxGeometry } from "three/addons/geometries/RoundedBoxGeometry.js";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import type { Robot, Vec3 } from "../protocol";

const ROUND = 20;

export const length = (v: Vec3): number => Math.hypot(...v);

/** A link from the origin down −z: two round ends of different radii, flattened across y. */
export function taperedLink(long: number, upper: number, lower: number, flatten: number): BufferGeometry {
  const profile: Vector2[] = [];
  const steps = 8;
  for (let k = 0; k <= steps; k++) {
    const angle = (Math.PI / 2) * (1 - k / steps);
    profile.push(new Vector2(upper * Math.cos(angle), upper * Math.sin(angle)));
  }
  // a waist: thinner than a straight cone, as links are
  for (let k = 1; k < steps; k++) {
    const t = k / steps;
    const straight = upper + (lower - upper) * t;
    profile.push(new Vector2(straight * (1 - 0.16 * Math.sin(Math.PI * t)), -long * t));
  }
  for (let k = 0; k <= steps; k++) {
    const angle = (Math.PI / 2) * (k / steps);
    profile.push(new Vector2(lower * Math.cos(angle), -long - lower * Math.sin(angle)));
  }
  profile[0].x = profile[profile.length - 1].x = 0;
  const shape = new LatheGeometry(profile.reverse(), ROUND);
  shape.rotateX(Math.PI / 2);
  shape.scale(1, flatten, 1);
  shape.computeVertexNormals();
  return shape;
}

/** A motor's housing: a short cylinder with bevelled ends along an axis. */
export function housing(radius: number, wide: number, axis: "x" | "y"): BufferGeometry {
  const bevel = Math.min(0.2 * radius, 0.25 * wide);
  const half = wide / 2;
  const profile = [
    [0, -half], [radius - bevel, -half], [radius, -half + bevel], [radius, half - bevel],
    [radius - bevel, half], [radius * 0.45, half], [radius * 0.45, half - 0.3 * bevel], [0, half - 0.3 * bevel],
  ].map(([x, y]) => new Vector2(x, y));
  const shape = new LatheGeometry(profile, ROUND);
  if (axis === "x") shape.rotateZ(-Math.PI / 2);
  return shape;
}

export function trunk(robot: Robot): { shell: BufferGeometry; dark: BufferGeometry } {
  const [centre, half] = robot.trunk;
  const [hx, hy, hz] = half;
  const soft = 0.38 * Math.min(hx, hy, hz);
  const shell = new RoundedBoxGeometry(2 * hx, 2 * hy, 2 * hz, 4, soft);
  shell.translate(...centre);
  // dark parts: a plate on the back, a visor in front that shows which way it looks, a belly
  const plate = new RoundedBoxGeometry(1.15 * hx, 1.25 * hy, 0.3 * hz, 2, 0.1 * hz);
  plate.translate(centre[0] - 0.15 * hx, centre[1], centre[2] + 0.95 * hz);
  const visor = new RoundedBoxGeometry(0.22 * hx, 1.5 * hy, 0.85 * hz, 3, 0.25 * hz);
  visor.translate(centre[0] + 0.94 * hx, centre[1], centre[2] + 0.12 * hz);
  const belly = new RoundedBoxGeometry(1.5 * hx, 1.5 * hy, 0.4 * hz, 2, 0.15 * hz);
  belly.translate(centre[0] - 0.05 * hx, centre[1], centre[2] - 0.9 * hz);
  return { shell, dark: mergeGeometries([plate, visor, belly]) };
}

/** Two lenses in front. */
export function eyes(robot: Robot): BufferGeometry {
  const [centre, [hx, hy, hz]] = robot.trunk;
  const lenses = [-1, 1].map((side) => {
    const lens = new CylinderGeometry(0.17 * hz, 0.17 * hz, 0.02 * hx, 16);
    lens.rotateZ(-Math.PI / 2);
    lens.translate(centre[0] + 1.055 * hx, centre[1] + side * 0.42 * hy, centre[2] + 0.2 * hz);
    return lens;
  });
  return mergeGeometries(lenses);
}

export function foot(radius: number): BufferGeometry {
  return new SphereGeometry(radius, 20, 14);
}

/** Radii of the parts of a leg, from the lengths of its links. */
export function girths(robot: Robot, leg: number) {
  const [, thigh, shank] = robot.offset[leg].map(length);
  const foot_ = robot.foot_radius[leg];
  const size = Math.min(thigh || shank, 1.3 * shank);
  const motor = Math.max(0.21 * size, 1.3 * foot_);
  return {
    motor,
    wide: 1.05 * motor,
    thighUpper: 0.78 * motor,
    thighLower: 0.5 * motor,
    knee: 0.58 * motor,
    shankUpper: 0.46 * motor,
    shankLower: Math.min(0.3 * motor, 0.85 * foot_),
  };
}
