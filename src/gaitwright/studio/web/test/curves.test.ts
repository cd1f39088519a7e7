import { expect, test } from "vitest";
import {
  aheadOf, between, digitsOf, forwardAt, isFixed, lineAt, phaseOf, pointAt, type Scale, spanOf, ticksIn, toPixels, toValues,
  withPoint,
} from "../src/curves/geometry";
import type { Curve } from "../src/protocol";

const cycle: Curve = {
  kind: "cycle", skill: "trot", leg: "FL", legs: ["FL"], stance: [0, 0.6], offset: 0, period: 0.4, velocity: [0.5, 0, 0],
  points: [[0, -0.5, 0], [0.5, 0, 0.2], [1, 0.5, 0]],
  line: [[0, 0.3, 0], [0.6, -0.3, 0], [0.8, 0, 0.2], [1, 0.3, 0]],
  limits: {
    columns: ["share", "forward", "height"], units: ["", "strides", "body heights"], lower: [0, -0.5, 0], upper: [1, 0.5, 1],
    fewest: 4, most: 64, nearest: 0.01, fixed: [1, 3], periodic: false, drift: 0.4, stride: 0.2, height: 0.3,
  },
  measured: [], undo: false, redo: false, edited: false, pending: false, ahead: null,
};

test("a place is the same after it went to pixels and back", () => {
  const scale: Scale = { x: [-1, 3], y: [0, 5], left: 30, top: 6, width: 200, height: 90 };
  const [x, y] = toValues(scale, toPixels(scale, [0.7, 4.2]));
  expect(x).toBeCloseTo(0.7);
  expect(y).toBeCloseTo(4.2);
});

test("what the hip sees and what the ground sees of a point are one", () => {
  for (const row of cycle.points) expect(forwardAt(cycle, row[0], aheadOf(cycle, row))).toBeCloseTo(row[1]);
  expect(cycle.points.map((row) => aheadOf(cycle, row))).toEqual([-0.3, 0, 0.3].map((ahead) => expect.closeTo(ahead)));
  expect(phaseOf(cycle, cycle.points[1])).toBeCloseTo(0.8);
});

test("a new point lies on the line, in order, and in the swing alone", () => {
  const row = pointAt(cycle, cycle.points, 0.7)!;
  expect(row[0]).toBeCloseTo(0.25);
  expect([aheadOf(cycle, row), row[2]]).toEqual([expect.closeTo(-0.15), expect.closeTo(0.1)]);
  expect(lineAt(cycle, 0.7)).toEqual([expect.closeTo(-0.15), expect.closeTo(0.1)]);
  expect(withPoint(cycle.points, row).map(([share]) => share)).toEqual([0, expect.closeTo(0.25), 0.5, 1]);
  expect(pointAt(cycle, cycle.points, 0.3)).toBeNull();
  expect(pointAt(cycle, cycle.points, 0.802)).toBeNull();
});

test("first and last stay fixed when a point is put between", () => {
  const more = withPoint(cycle.points, [0.25, -0.2, 0.1]);
  expect(more.map((row) => isFixed(cycle, row))).toEqual([true, false, false, true]);
});

test("a point stays between its neighbours, around the cycle too", () => {
  expect(between(cycle, cycle.points, 1, 2)).toBeCloseTo(0.99);
  expect(between(cycle, cycle.points, 1, -1)).toBeCloseTo(0.01);
  const periodic = { ...cycle, limits: { ...cycle.limits, periodic: true } };
  const points = [[0, 1], [0.5, 1], [0.9, 1]];
  expect(between(periodic, points, 2, 3)).toBeCloseTo(0.99);
});

test("scales and ticks are round, and keep while numbers change a little", () => {
  expect(spanOf([0, 1], 0.1, 0.1)).toEqual(spanOf([0, 1.003], 0.1, 0.1));
  const ticks = ticksIn([0, 1], 4);
  expect(ticks).toEqual([0, 0.5, 1]);
  expect(digitsOf([0, 0.25])).toBe(2);
  expect(digitsOf(ticks)).toBe(1);
  expect(digitsOf([0, 20])).toBe(0);
});
