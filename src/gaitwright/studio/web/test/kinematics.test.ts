// The page's forward kinematics against the Python package's (`model.kinematics.feet`), at random joint angles.

import { expect, test } from "vitest";
import { Layout } from "../src/layout";
import type { Robot } from "../src/protocol";
import { Pose } from "../src/view/kinematics";
import cases from "./feet.json";

test.each(cases.map((one) => [one.robot.name, one] as const))("feet of %s", (_, one) => {
  const robot = one.robot as unknown as Robot;
  const layout = new Layout([
    { name: "position_w", size: 3 },
    { name: "orientation_wb", size: 4 },
    { name: "q", size: one.q.length },
  ]);
  const pose = new Pose(robot);
  pose.set(new Float32Array([...one.position, ...one.orientation, ...one.q]), layout);
  one.feet.forEach((foot, k) => {
    const off = Math.hypot(...foot.map((value, axis) => value - pose.feet[k].getComponent(axis)));
    expect(off).toBeLessThan(1e-5);
  });
});
