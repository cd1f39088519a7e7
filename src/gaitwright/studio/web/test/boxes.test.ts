// Boxes that stand, and things that move by themselves.

import { expect, test } from "vitest";
import type { Box } from "../src/protocol";
import { Boxes, isMoving } from "../src/view/boxes";

const box = (id: number, x = 0): Box => ({ id, x, y: 0, z: 0.5, lx: 1, ly: 1, lz: 1, yaw: 0 });
const places = (boxes: Boxes) => boxes.all.map(({ id, x }) => [id, x]);

test("things that move are those that are told, beside boxes of the same numbers", () => {
  const boxes = new Boxes([box(0), box(1, 1)]);
  boxes.move([box(0, 5), box(1, 6)]);
  expect(places(boxes)).toEqual([[0, 0], [1, 1], ["moving 0", 5], ["moving 1", 6]]);
  expect(boxes.all.map(({ id }) => isMoving(id))).toEqual([false, false, true, true]);
  boxes.move([box(1, 7)]);
  boxes.replace([box(1, 2)]);
  expect(places(boxes)).toEqual([[1, 2], ["moving 1", 7]]);
  boxes.move([]);
  expect(places(boxes)).toEqual([[1, 2]]);
});

test("a box in the hand stays there, whatever the server says of it", () => {
  const boxes = new Boxes([box(0), box(1, 1)]);
  boxes.hold(1);
  boxes.put(1, { x: 3, y: 0, z: 0.5, yaw: 0 });
  boxes.replace([box(0, 9), box(1, 1)]);
  expect(places(boxes)).toEqual([[0, 9], [1, 3]]);
  boxes.hold(null);
  boxes.replace([box(0, 9), box(1, 1)]);
  expect(places(boxes)).toEqual([[0, 9], [1, 1]]);
});
