// The ground's mesh: heights, rays, normals; hulls; stretches of a replay.

import { expect, test } from "vitest";
import { stretches } from "../src/replay/stretches";
import { creased } from "../src/view/creased";
import { Heights } from "../src/view/heights";
import { hull } from "../src/view/hull";

// a slope of 1:10 over [0, 2] × [0, 1], then a step up of 0.5
const POINTS = new Float32Array([0, 0, 0, 2, 0, 0.2, 0, 1, 0, 2, 1, 0.2, 2.1, 0, 0.7, 2.1, 1, 0.7, 3, 0, 0.7, 3, 1, 0.7]);
const FACES = new Uint32Array([0, 1, 3, 0, 3, 2, 1, 4, 5, 1, 5, 3, 4, 6, 7, 4, 7, 5]);

test("heights are those of the mesh", () => {
  const heights = new Heights(POINTS, FACES);
  expect(heights.at(1, 0.5)).toBeCloseTo(0.1, 3);
  expect(heights.at(2.6, 0.9)).toBeCloseTo(0.7, 5);
  expect(heights.at(-1, 0)).toBeNaN();
});

test("a ray meets the ground where it is", () => {
  const heights = new Heights(POINTS, FACES);
  const far = heights.hit([1, 0.5, 3], [0, 0, -1]);
  expect(3 - far!).toBeCloseTo(0.1, 3);
  expect(heights.hit([1, 0.5, 3], [0, 0, 1])).toBeNull();
  expect(heights.hit([9, 9, 3], [0, 0, -1])).toBeNull();
});

test("a steep ray meets level ground from wherever it begins", () => {
  const level = new Float32Array([-9, -9, 0, 9, -9, 0, 9, 9, 0, -9, 9, 0]);
  const heights = new Heights(level, new Uint32Array([0, 1, 2, 0, 2, 3]));
  for (let high = 1; high < 6; high += 0.037) expect(heights.hit([0.3, 0.2, high], [0, 0, -1])).toBeCloseTo(high, 2);
});

test("normals are sharp at the step and point up on the level", () => {
  const { normal, position, index } = creased(POINTS, FACES);
  const up = (corner: number) => normal[3 * index[corner] + 2];
  expect(up(12)).toBe(1);
  expect(up(0)).toBeCloseTo(Math.cos(Math.atan(0.1)), 5);
  // at both edges of the step each of two points has two normals
  expect(position.length / 3).toBe(8 + 4);
});

test("a hull goes around all points", () => {
  const around = hull([[0, 0], [2, 0], [1, 0.5], [2, 2], [0, 2], [1, 1]]);
  expect(around).toEqual([[0, 0], [2, 0], [2, 2], [0, 2]]);
  expect(hull([[1, 1], [0, 0]])).toEqual([[0, 0], [1, 1]]);
});

test("stretches join what stays the same and end with the recording", () => {
  const event = (time: number, skill: string) => ({ time, skill, driver: "", because: "", rule: "" });
  expect(stretches([event(0, "trot"), event(1, "trot"), event(2, "walk")], "skill", 5)).toEqual([
    { name: "trot", from: 0, to: 2 },
    { name: "walk", from: 2, to: 5 },
  ]);
});
