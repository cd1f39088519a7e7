import { expect, test } from "vitest";
import type { Tree } from "../src/protocol";
import { leavesOf, runs, shapeOf, verdictOf, verdicts, weightOf } from "../src/rules/tree-shape";

const obstacle: Tree = {
  name: "obstacle", about: "an obstacle is", unit: "",
  values: ["any", "close", "clear", "near", "far or none"], parents: [-1, 0, 0, 2, 2],
};
const slope: Tree = { name: "slope", about: "", unit: "°", values: ["any", "a to b", "c", "d"], parents: [-1, 0, 0, 0] };

test("leaves stand in order, and each value spans its own", () => {
  const { nodes, leaves, depth } = shapeOf(obstacle);
  expect(leaves).toEqual(["close", "near", "far or none"]);
  expect(depth).toBe(2);
  expect(nodes.map(({ from, to }) => [from, to])).toEqual([[0, 2], [0, 0], [1, 2], [1, 1], [2, 2]]);
});

test("a mark is a value, a run of neighbours, or any leaves, though names have such words themselves", () => {
  const shape = shapeOf(obstacle);
  expect([...leavesOf(shape, "clear")]).toEqual([1, 2]);
  expect([...leavesOf(shape, "far or none")]).toEqual([2]);
  expect([...leavesOf(shape, "close or far or none")]).toEqual([0, 2]);
  expect([...leavesOf(shapeOf(slope), "a to b to c")]).toEqual([0, 1]);
  expect([...leavesOf(shape, null)]).toEqual([]);
  expect([...leavesOf(shape, "nothing of it")]).toEqual([]);
});

test("outside the upper mark it does not fire, inside the lower one it does, between them nobody knows", () => {
  const shape = shapeOf(obstacle);
  const leaves = verdicts(shape, { upper: "clear", lower: "near" });
  expect(leaves).toEqual(["no", "yes", "grey"]);
  expect(shape.nodes.map((node) => verdictOf(node, leaves))).toEqual([null, "no", null, "yes", "grey"]);
  expect(verdicts(shape, { upper: "any", lower: null })).toEqual(["grey", "grey", "grey"]);
});

test("a tree has to be met, is open, or does not matter", () => {
  expect(weightOf(obstacle, { upper: "clear", lower: "near" })).toBe("met");
  expect(weightOf(obstacle, { upper: "any", lower: "near" })).toBe("open");
  expect(weightOf(obstacle, { upper: "any", lower: "any" })).toBe("any");
});

test("neighbours make a run", () => {
  expect(runs(new Set([4, 0, 1, 5, 7]))).toEqual([[0, 1], [4, 5], [7, 7]]);
});
