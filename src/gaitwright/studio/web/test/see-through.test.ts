import { Vector3 } from "three";
import { expect, test } from "vitest";
import type { Box } from "../src/protocol";
import { isBetween } from "../src/view/see-through";

const eye = new Vector3(-2, 0, 0.5);
const robot = new Vector3(0, 0, 0.3);
const wall = (x: number, more: Partial<Box> = {}): Box => ({
  id: 0, x, y: 0, z: 0.5, lx: 0.2, ly: 1, lz: 1, yaw: 0, ...more,
});

test("a box before the robot is between, one behind it or beside the way is not", () => {
  expect(isBetween(wall(-1), eye, robot, 0)).toBe(true);
  expect(isBetween(wall(1), eye, robot, 0)).toBe(false);
  expect(isBetween(wall(-3), eye, robot, 0)).toBe(false);
  expect(isBetween(wall(-1, { y: 0.6 }), eye, robot, 0)).toBe(false);
});

test("a box that is turned counts as it is turned", () => {
  const beside = { y: 0.5, ly: 1.4, lx: 0.1 };
  expect(isBetween(wall(-1, beside), eye, robot, 0)).toBe(true);
  expect(isBetween(wall(-1, { ...beside, yaw: Math.PI / 2 }), eye, robot, 0)).toBe(false);
});

test("a camera inside a box looks through it", () => {
  expect(isBetween(wall(-2, { lx: 1 }), eye, robot, 0)).toBe(true);
});

test("what a foot stands on is not before it", () => {
  const top = wall(0, { z: 0.05, lz: 0.1, lx: 2, ly: 2 });
  expect(isBetween(top, new Vector3(-2, 0, 1), new Vector3(0, 0, 0.12), 0.05)).toBe(false);
});
