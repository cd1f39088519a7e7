// Which charts a curve is shown by: a cycle by its path and its height, angles and torques joint by joint.

import type { Curve, Preview } from "../protocol";
import { JOINTS } from "../ui/colours";
import type { Drawing } from "./chart";
import { aheadOf, between, firstAt, forwardAt, phaseOf, type Place, spanOf } from "./geometry";

const PHASES = [0, 0.25, 0.5, 0.75, 1];
const CYCLE = "#1971c2";
const [ROOM, LEAST_HEIGHT, LEAST_AHEAD] = [0.12, 0.05, 0.3];

export function drawingsOf(curve: Curve, preview: Preview | null): Drawing[] {
  return curve.kind === "cycle" ? [path(curve, preview), height(curve, preview)] : joints(curve);
}

/** Kinds that a foot is raised over by their own height. */
const RAISED = new Set(["block", "step up", "step down"]);

/** What is ahead of the leg, as a line as high as it is [body heights]. */
function lineAhead({ ahead, limits }: Curve): { high: number; label: string } | undefined {
  if (!ahead || !limits.height || !RAISED.has(ahead.kind)) return undefined;
  return { high: ahead.size / limits.height, label: ahead.kind };
}

/** The closed path of a foot in side view, as its hip sees it. */
function path(curve: Curve, preview: Preview | null): Drawing {
  const { stride = 0, height: body = 1 } = curve.limits;
  const placed = ([, ahead, high]: number[]): Place => [ahead, high];
  const line = curve.line.map(placed);
  const ghost = curve.measured.map(placed);
  const seen = preview ? closed(preview.path.map(placed)) : undefined;
  const all = [...line, ...ghost, ...(seen ?? [])];
  const ahead = lineAhead(curve);
  return {
    id: "path",
    title: "Path of the foot, from the side",
    unit: stride ? "cm" : "cm high",
    height: 168,
    colour: CYCLE,
    x: spanOf(all.map(([x]) => x), ROOM, LEAST_AHEAD),
    y: spanOf([...all.map(([, y]) => y), ...(ahead ? [ahead.high] : [])], ROOM, LEAST_HEIGHT),
    times: [stride ? 100 * stride : 1, 100 * body],
    xUnit: stride ? "" : "strides",
    ahead,
    line,
    ghost: closed(ghost),
    seen,
    closed: true,
    place: (row) => [aheadOf(curve, row), row[2]],
    moved: (rows, k, [x, y]) => [rows[k][0], forwardAt(curve, rows[k][0], x), y],
    phaseAt: (at) => nearestPhase(curve, at),
  };
}

/** When the foot is how high. */
function height(curve: Curve, preview: Preview | null): Drawing {
  const body = curve.limits.height ?? 1;
  const placed = ([phase, , high]: number[]): Place => [phase, high];
  const line = curve.line.map(placed);
  const ghost = curve.measured.map(placed);
  const seen = preview?.path.map(placed);
  const ahead = lineAhead(curve);
  const heights = [...line, ...ghost, ...(seen ?? [])].map(([, y]) => y);
  return {
    id: "height",
    title: "Height over the phase",
    unit: "cm",
    height: 118,
    colour: CYCLE,
    x: [0, 1],
    y: spanOf(ahead ? [...heights, ahead.high] : heights, ROOM, LEAST_HEIGHT),
    times: [1, 100 * body],
    xTicks: PHASES,
    xUnit: "",
    stance: curve.stance,
    ahead,
    line,
    ghost,
    seen,
    place: (row) => [phaseOf(curve, row), row[2]],
    moved: (rows, k, [x, y]) => [between(curve, rows, k, firstAt(curve, x)), rows[k][1], y],
    phaseAt: ([x]) => x,
  };
}

/** A value of each joint over the phase. */
function joints(curve: Curve): Drawing[] {
  const { columns, units, lower, upper } = curve.limits;
  return columns.slice(1).map((name, joint) => {
    const column = joint + 1;
    const placed = (row: number[]): Place => [row[0], row[column]];
    const line = curve.line.map(placed);
    const ghost = curve.measured.map(placed);
    return {
      id: name.replaceAll(" ", "-"),
      title: name,
      unit: units[column],
      height: 122,
      colour: JOINTS[joint % JOINTS.length],
      x: [0, 1],
      y: spanOf([...line, ...ghost].map(([, y]) => y), 0.2, curve.kind === "torque" ? 4 : 0.3),
      xTicks: PHASES,
      xUnit: "",
      stance: curve.stance,
      bounds: [lower[column], upper[column]],
      line,
      ghost,
      place: placed,
      moved: (rows, k, [x, y]) => rows[k].with(0, between(curve, rows, k, x)).with(column, y),
      phaseAt: ([x]) => x,
    };
  });
}

/** The leg's own phase of the line's place in the swing that is nearest to a place. */
function nearestPhase(curve: Curve, [x, y]: Place): number {
  const { stride = 0, height: body = 1 } = curve.limits;
  let [nearest, found] = [Infinity, 1];
  for (const [phase, ahead, high] of curve.line) {
    const away = Math.hypot((ahead - x) * (stride || body), (high - y) * body);
    if (phase > curve.stance[1] && away < nearest) [nearest, found] = [away, phase];
  }
  return found;
}

function closed(places: Place[]): Place[] {
  return places.length ? [...places, places[0]] : places;
}
