// Curves as places in a picture: scales, ticks, lines, and points put in, moved, taken out.

import type { Curve } from "../protocol";

export type Place = [number, number];

export interface Scale {
  /** Values at the left and right, at the bottom and top. */
  x: Place;
  y: Place;
  /** Pixels: left, top, width, height of the picture's inside. */
  left: number;
  top: number;
  width: number;
  height: number;
}

export function toPixels({ x, y, left, top, width, height }: Scale, [a, b]: Place): Place {
  return [left + (width * (a - x[0])) / (x[1] - x[0]), top + (height * (y[1] - b)) / (y[1] - y[0])];
}

export function toValues({ x, y, left, top, width, height }: Scale, [a, b]: Place): Place {
  return [x[0] + ((x[1] - x[0]) * (a - left)) / width, y[1] - ((y[1] - y[0]) * (b - top)) / height];
}

/** Least and greatest of some numbers with a margin, as a share of what is between them; both are round, so
    that a picture keeps its scale while numbers change a little. */
export function spanOf(values: number[], margin: number, least: number): Place {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  if (low > high) [low, high] = [0, 0];
  const wide = Math.max(high - low, least);
  const middle = (low + high) / 2;
  const step = roundStep(wide / 8);
  return [
    Math.floor((middle - wide * (0.5 + margin)) / step) * step,
    Math.ceil((middle + wide * (0.5 + margin)) / step) * step,
  ];
}

/** The least of 1, 2 and 5 times a power of ten that is not below a number. */
function roundStep(raw: number): number {
  const power = 10 ** Math.floor(Math.log10(raw));
  return [1, 2, 5, 10].map((k) => k * power).find((one) => one >= raw * (1 - 1e-9)) ?? raw;
}

/** A few round numbers in a span. */
export function ticksIn([low, high]: Place, most: number): number[] {
  const step = roundStep((high - low) / most);
  const ticks: number[] = [];
  for (let tick = Math.ceil(low / step) * step; tick <= high + 1e-9 * step; tick += step) {
    ticks.push(Math.abs(tick) < 1e-9 * step ? 0 : tick);
  }
  return ticks;
}

/** Digits after the point that ticks need. */
export function digitsOf(ticks: number[]): number {
  const step = ticks.length > 1 ? ticks[1] - ticks[0] : 1;
  const is = (digits: number) => Math.abs(step * 10 ** digits - Math.round(step * 10 ** digits)) < 1e-6;
  return [0, 1, 2, 3].find(is) ?? 4;
}

export function lineThrough(places: Place[]): string {
  return places.map(([x, y], k) => `${k ? "L" : "M"}${x.toFixed(2)} ${y.toFixed(2)}`).join("");
}

/** A smooth line through places, as a hint of what the curve will be (Catmull and Rom). */
export function smoothThrough(places: Place[]): string {
  if (places.length < 3) return lineThrough(places);
  const at = (k: number) => places[Math.max(0, Math.min(places.length - 1, k))];
  let path = `M${at(0)[0].toFixed(2)} ${at(0)[1].toFixed(2)}`;
  for (let k = 0; k + 1 < places.length; k++) {
    const [a, b, c, d] = [at(k - 1), at(k), at(k + 1), at(k + 2)];
    const first = [b[0] + (c[0] - a[0]) / 6, b[1] + (c[1] - a[1]) / 6];
    const second = [c[0] - (d[0] - b[0]) / 6, c[1] - (d[1] - b[1]) / 6];
    path += `C${[...first, ...second, ...c].map((value) => value.toFixed(2)).join(" ")}`;
  }
  return path;
}

// --- a curve's points ---------------------------------------------------------------------------------

/** The leg's own phase at a point: that of a cycle is told by the share of its swing. */
export function phaseOf(curve: Curve, row: number[]): number {
  const duty = curve.stance[1];
  return curve.kind === "cycle" ? duty + (1 - duty) * row[0] : row[0];
}

/** What the first column is at a phase of the leg's own. */
export function firstAt(curve: Curve, phase: number): number {
  const duty = curve.stance[1];
  return curve.kind === "cycle" ? (phase - duty) / (1 - duty) : phase;
}

/** How far ahead the hip sees a point of a cycle [strides]. */
export function aheadOf(curve: Curve, [share, forward]: number[]): number {
  return forward - (curve.limits.drift ?? 0) * (share - 0.5);
}

/** How far ahead of the ground a point of a cycle is that the hip sees there [strides]. */
export function forwardAt(curve: Curve, share: number, ahead: number): number {
  return ahead + (curve.limits.drift ?? 0) * (share - 0.5);
}

/** The line's values at a phase of the leg's own. */
export function lineAt({ line }: Curve, phase: number): number[] {
  const after = Math.max(1, line.findIndex(([own]) => own >= phase));
  const [low, high] = [line[after - 1], line[after]];
  const share = high[0] > low[0] ? (phase - low[0]) / (high[0] - low[0]) : 0;
  return low.slice(1).map((value, k) => value + share * (high[k + 1] - value));
}

/** A new point on the line at a phase; `null` where none can be: outside the curve, or too near another. */
export function pointAt(curve: Curve, points: number[][], phase: number): number[] | null {
  const { lower, upper, nearest } = curve.limits;
  const first = firstAt(curve, phase);
  if (first < lower[0] || first > upper[0]) return null;
  if (points.some((row) => Math.abs(row[0] - first) < nearest)) return null;
  const values = lineAt(curve, phase);
  return curve.kind === "cycle" ? [first, forwardAt(curve, first, values[0]), values[1]] : [first, ...values];
}

/** The points with another one, in order. */
export function withPoint(points: number[][], row: number[]): number[][] {
  const at = points.findIndex(([first]) => first > row[0]);
  return at < 0 ? [...points, row] : points.toSpliced(at, 0, row);
}

/** The first column of a point that is moved, kept between its neighbours. */
export function between({ limits }: Curve, points: number[][], k: number, first: number): number {
  const low = k > 0 ? points[k - 1][0] + limits.nearest : limits.lower[0];
  const last = limits.periodic ? Math.min(1 - 1e-6, 1 + points[0][0] - limits.nearest) : limits.upper[0];
  const high = k + 1 < points.length ? points[k + 1][0] - limits.nearest : last;
  return Math.max(low, Math.min(first, high));
}

/** Whether a point stays where it is, whatever was put in before it. */
export function isFixed({ limits, points }: Curve, row: number[]): boolean {
  return limits.fixed.some((number) => points[number - 1]?.[0] === row[0]);
}
