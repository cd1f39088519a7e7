// What there is to plot: charts by groups, each line a number of a row.

import type { Layout } from "../layout";
import type { Robot } from "../protocol";
import { JOINTS, LEGS } from "../ui/colours";

export interface Line {
  label: string;
  colour: string;
  dash?: number[];
  value: (row: Float32Array) => number;
}

export interface Chart {
  id: string;
  title: string;
  unit: string;
  digits: number;
  lines: Line[];
  /** Lines are those of the legs, whose colours are known. */
  perLeg?: boolean;
  /** Least range of the axis: it grows beyond where it must. */
  range?: [number, number];
}

export const GROUPS = [
  { id: "torques", label: "Torques" },
  { id: "angles", label: "Angles" },
  { id: "forces", label: "Forces" },
  { id: "speed", label: "Speed" },
  { id: "attitude", label: "Attitude" },
  { id: "power", label: "Power" },
] as const;
export type GroupId = (typeof GROUPS)[number]["id"];

const JOINT_NAMES = ["hip 1", "hip 2", "knee"];
const DEGREES = 180 / Math.PI;
const GRAVITY = 9.81;
const DASH = [4, 3];

export function chartsOf(group: GroupId, layout: Layout, robot: Robot): Chart[] {
  switch (group) {
    case "torques":
      return perJoint("tau", "Torque", "N·m", 1, 1, layout, robot);
    case "angles":
      return perJoint("q", "Angle", "°", 0, DEGREES, layout, robot);
    case "forces":
      return [forces(layout, robot)];
    case "speed":
      return speeds(layout);
    case "attitude":
      return [attitude(layout)];
    case "power":
      return power(layout, robot);
  }
}

function perJoint(
  column: string, title: string, unit: string, digits: number, scale: number, layout: Layout, robot: Robot,
): Chart[] {
  const at = layout.at(column);
  return JOINT_NAMES.map((joint, j) => ({
    id: `${column}-${j}`,
    title: `${title}, ${joint}`,
    unit,
    digits,
    perLeg: true,
    lines: robot.legs.map((leg, k) => ({
      label: leg,
      colour: LEGS[k % LEGS.length],
      value: (row) => scale * row[at + 3 * k + j],
    })),
  }));
}

function forces(layout: Layout, robot: Robot): Chart {
  const at = layout.at("load");
  return {
    id: "load", title: "Normal force", unit: "N", digits: 0, perLeg: true, range: [0, (robot.mass * GRAVITY) / 2],
    lines: robot.legs.map((leg, k) => ({ label: leg, colour: LEGS[k % LEGS.length], value: (row) => row[at + k] })),
  };
}

function speeds(layout: Layout): Chart[] {
  const [v, c, o, w] = ["velocity_w", "command", "orientation_wb", "angular_velocity_b"].map((n) => layout.at(n));
  const along = (row: Float32Array, side: boolean) => {
    const yaw = attitudeOf(row, o)[2];
    const [cos, sin] = [Math.cos(yaw), Math.sin(yaw)];
    return side ? cos * row[v + 1] - sin * row[v] : cos * row[v] + sin * row[v + 1];
  };
  return [
    {
      id: "speed", title: "Speed", unit: "m/s", digits: 2, range: [-0.1, 0.6],
      lines: [
        { label: "forward", colour: JOINTS[0], value: (row) => along(row, false) },
        { label: "asked", colour: JOINTS[0], dash: DASH, value: (row) => row[c] },
        { label: "left", colour: JOINTS[1], value: (row) => along(row, true) },
        { label: "asked", colour: JOINTS[1], dash: DASH, value: (row) => row[c + 1] },
      ],
    },
    {
      id: "turn", title: "Yaw rate", unit: "rad/s", digits: 2, range: [-0.2, 0.2],
      lines: [
        { label: "turn", colour: JOINTS[2], value: (row) => row[w + 2] },
        { label: "asked", colour: JOINTS[2], dash: DASH, value: (row) => row[c + 2] },
      ],
    },
  ];
}

function attitude(layout: Layout): Chart {
  const o = layout.at("orientation_wb");
  return {
    id: "attitude", title: "Attitude", unit: "°", digits: 1, range: [-5, 5],
    lines: [
      { label: "roll", colour: JOINTS[0], value: (row) => DEGREES * attitudeOf(row, o)[0] },
      { label: "pitch", colour: JOINTS[1], value: (row) => DEGREES * attitudeOf(row, o)[1] },
    ],
  };
}

function power(layout: Layout, robot: Robot): Chart[] {
  const [p, v] = [layout.at("power"), layout.at("velocity_w")];
  const cost = (row: Float32Array) => {
    const speed = Math.hypot(row[v], row[v + 1]);
    return speed > 0.1 ? row[p] / (robot.mass * GRAVITY * speed) : NaN;
  };
  return [
    {
      id: "power", title: "Power", unit: "W", digits: 0, range: [0, 50],
      lines: [{ label: "Σ|τ q̇|", colour: JOINTS[0], value: (row) => row[p] }],
    },
    {
      id: "cost", title: "Cost of transport", unit: "–", digits: 2, range: [0, 1],
      lines: [{ label: "P/(m g v)", colour: JOINTS[1], value: cost }],
    },
  ];
}

/** Roll, pitch (positive nose down) and yaw of a quaternion in a row [rad]. */
export function attitudeOf(row: Float32Array, at: number): [number, number, number] {
  const [w, x, y, z] = [row[at], row[at + 1], row[at + 2], row[at + 3]];
  const roll = Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y));
  const pitch = Math.asin(Math.max(-1, Math.min(1, 2 * (w * y - z * x))));
  const yaw = Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
  return [roll, pitch, yaw];
}
