// What the curve editor and the server say to each other.

import type { Vec3 } from "./protocol-scene";

export type CurveKind = "cycle" | "torque" | "angle";

export interface CurveLimits {
  columns: string[];
  units: string[];
  lower: number[];
  upper: number[];
  fewest: number;
  most: number;
  /** Least distance of two points along the first column. */
  nearest: number;
  /** Points that stay where they are, counted from 1. */
  fixed: number[];
  periodic: boolean;
  /** Of a cycle: the hip sees a point at forward − drift · (share − 0.5). */
  drift?: number;
  /** Of a cycle [m]. */
  stride?: number;
  /** Of a cycle: body height [m]. */
  height?: number;
}

/** A curve: rows of a phase of the leg's own (a cycle's points: the share of its swing) and values. */
export interface Curve {
  kind: CurveKind;
  skill: string;
  leg: string;
  legs: string[];
  points: number[][];
  line: number[][];
  limits: CurveLimits;
  /** From, to, as shares of the cycle. */
  stance: [number, number];
  offset: number;
  /** [s] */
  period: number;
  velocity: Vec3;
  measured: number[][];
  undo: boolean;
  redo: boolean;
  edited: boolean;
  /** Whether legs are still to follow what was asked for. */
  pending: boolean;
  /** What the leg will have to get over next; a size in m. */
  ahead: { kind: string; size: number } | null;
}

/** What was seen of an edit in physics. */
export interface Preview {
  seconds: number;
  fell: boolean;
  failed: string;
  /** [m/s] */
  velocity_error: number;
  torque_share: number;
  /** Of the foot, as a cycle's `measured`. */
  path: number[][];
  /** [s] */
  took: number;
}

/** Answer to `edit`. */
export interface Edited {
  taken: boolean;
  because: string;
  /** Counted from 1. */
  point: number | null;
  preview: Preview | null;
  /** What an edit at an obstacle taught, as a rule. */
  learned?: string;
  curve: Curve;
}
