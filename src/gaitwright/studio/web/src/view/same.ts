// Whether of two worlds only the boxes differ.

import type { World } from "../protocol";

export function sameGround(a: World, b: World | null): boolean {
  return (
    b !== null &&
    a.scene === b.scene &&
    a.seed === b.seed &&
    a.ground.points === b.ground.points &&
    a.ground.indices === b.ground.indices &&
    JSON.stringify([a.robots, a.spheres, a.meshes]) === JSON.stringify([b.robots, b.spheres, b.meshes])
  );
}
