// What is under the pointer: a robot, a box, the ground.

import { Box3, Matrix4, Raycaster, Vector2, Vector3 } from "three";
import type { Box } from "../protocol";
import type { Engine } from "../view/engine";
import type { Rig } from "../view/rig";

export type Picked =
  | { kind: "robot"; robot: number; at: Vector3 }
  | { kind: "box"; box: Box; at: Vector3 }
  | { kind: "ground"; at: Vector3 };

const ray = new Raycaster();
const pointer = new Vector2();
const inverse = new Matrix4();
const hit = new Vector3();
const ONE = new Vector3(1, 1, 1);

export function aim(event: PointerEvent | WheelEvent, place: HTMLElement, rig: Rig): Raycaster {
  const box = place.getBoundingClientRect();
  pointer.set(
    (2 * (event.clientX - box.left)) / box.width - 1,
    1 - (2 * (event.clientY - box.top)) / box.height,
  );
  rig.camera.updateMatrixWorld();
  ray.setFromCamera(pointer, rig.camera);
  return ray;
}

/** What a ray meets first in a view; `null` for the sky. A robot is met through what is seen through. */
export function pick(engine: Engine, aimed: Raycaster, rig: Rig): Picked | null {
  const found: { far: number; what: Picked }[] = [];
  engine.poses.forEach((pose, robot) => {
    const at = onTrunk(engine, robot, aimed);
    if (at) found.push({ far: at.distanceTo(aimed.ray.origin), what: { kind: "robot", robot, at: pose.base.position.clone() } });
  });
  const box = engine.scenery?.boxes.pick(aimed);
  const isClear = box && engine.views.find((view) => view.rig === rig)?.through.shares.has(box.box.id);
  if (box && !(isClear && found.length)) {
    const at = aimed.ray.at(box.far, new Vector3());
    found.push({ far: box.far, what: { kind: "box", box: box.box, at } });
  }
  const { origin, direction } = aimed.ray;
  const far = engine.scenery?.heights.hit(
    [origin.x, origin.y, origin.z],
    [direction.x, direction.y, direction.z],
  );
  if (far !== null && far !== undefined) {
    found.push({ far, what: { kind: "ground", at: aimed.ray.at(far, new Vector3()) } });
  }
  found.sort((a, b) => a.far - b.far);
  return found[0]?.what ?? null;
}

/** Where a ray meets a robot's body: its trunk, a little larger and as wide as its hips. */
function onTrunk(engine: Engine, robot: number, aimed: Raycaster): Vector3 | null {
  const pose = engine.poses[robot];
  if (!engine.row(robot)) return null;
  const [centre, half] = pose.robot.trunk;
  const wide = Math.max(half[1], ...pose.robot.hip.map((hip) => Math.abs(hip[1]))) + 0.05;
  const box = new Box3(
    new Vector3(centre[0] - half[0] - 0.02, centre[1] - wide, centre[2] - half[2] - 0.03),
    new Vector3(centre[0] + half[0] + 0.02, centre[1] + wide, centre[2] + half[2] + 0.03),
  );
  const matrix = new Matrix4().compose(pose.base.position, pose.base.turn, ONE);
  const local = aimed.ray.clone().applyMatrix4(inverse.copy(matrix).invert());
  return local.intersectBox(box, hit) ? hit.clone().applyMatrix4(matrix) : null;
}

/** Where a ray meets the level plane at a height; `null` where it does not. */
export function onLevel(aimed: Raycaster, z: number): Vector3 | null {
  const { origin, direction } = aimed.ray;
  const far = (z - origin.z) / direction.z;
  return far > 0 && far < 100 ? aimed.ray.at(far, new Vector3()) : null;
}
