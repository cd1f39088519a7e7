// Boxes that stand in the world, and things that move: one draw, each can be taken hold of.

import {
  BoxGeometry, Color, DynamicDrawUsage, Group, InstancedMesh, Matrix4, MeshStandardMaterial, Quaternion,
  type Raycaster, Vector3,
} from "three";
import type { Box, Thing } from "../protocol";
import type { Palette } from "./palette";

const UP = new Vector3(0, 0, 1);
const matrix = new Matrix4();
const turn = new Quaternion();
const place = new Vector3();
const size = new Vector3();
const SPARE = 64;

export type Id = Box["id"];

export class Boxes {
  readonly group = new Group();
  private mesh: InstancedMesh;
  private boxes: Box[];
  private readonly material = edged();
  private colour = new Color();
  private lightColour = new Color();
  private lit: Id | null = null;
  private held: Id | null = null;

  constructor(boxes: Box[]) {
    this.boxes = boxes.map((box) => ({ ...box }));
    this.mesh = this.made(this.boxes.length + SPARE);
    this.draw();
  }

  private made(most: number): InstancedMesh {
    const mesh = new InstancedMesh(new BoxGeometry(1, 1, 1), this.material, most);
    mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    mesh.castShadow = mesh.receiveShadow = true;
    mesh.frustumCulled = false;
    this.group.add(mesh);
    return mesh;
  }

  /** Other boxes; one that is held stays in the hand. */
  replace(boxes: Box[]): void {
    const held = this.held === null ? undefined : this.find(this.held);
    const moving = this.boxes.filter(({ id }) => isMoving(id));
    this.boxes = [...boxes.map((box) => (held && box.id === held.id ? held : { ...box })), ...moving];
    if (this.boxes.length > this.mesh.instanceMatrix.count) {
      this.group.remove(this.mesh);
      this.mesh.dispose();
      this.mesh = this.made(this.boxes.length + SPARE);
    }
    this.draw();
  }

  find(id: Id): Box | undefined {
    return this.boxes.find((box) => box.id === id);
  }

  /** Where things are now; one that brings its sizes and was not known is something that moves by itself. */
  move(things: readonly (Thing & Partial<Box>)[]): void {
    for (const thing of things) {
      const own = thing.lx !== undefined;
      const id = own ? `moving ${thing.id}` : thing.id;
      let box = this.find(id);
      if (!box && own && this.boxes.length < this.mesh.instanceMatrix.count) {
        box = { lx: 0, ly: 0, lz: 0, ...thing, fixed: true, id };
        this.boxes.push(box);
      }
      if (box) Object.assign(box, { ...thing, id });
    }
    const moving = new Set(things.filter((thing) => thing.lx !== undefined).map((thing) => `moving ${thing.id}`));
    if (moving.size) {
      const gone = (box: Box) => isMoving(box.id) && !moving.has(String(box.id));
      for (let k = this.boxes.length - 1; k >= 0; k--) if (gone(this.boxes[k])) this.boxes.splice(k, 1);
    }
    this.draw();
  }

  /** The box that a ray meets first, and how far away. */
  pick(ray: Raycaster): { box: Box; far: number } | null {
    this.mesh.computeBoundingSphere();
    const [first] = ray.intersectObject(this.mesh);
    return first?.instanceId === undefined ? null : { box: this.boxes[first.instanceId], far: first.distance };
  }

  /** Height of the highest box at a place; −∞ where there is none. */
  top(x: number, y: number): number {
    let top = -Infinity;
    for (const box of this.boxes) {
      const [dx, dy] = [x - box.x, y - box.y];
      const [c, s] = [Math.cos(box.yaw), Math.sin(box.yaw)];
      const inside = Math.abs(c * dx + s * dy) <= box.lx / 2 && Math.abs(c * dy - s * dx) <= box.ly / 2;
      if (inside) top = Math.max(top, box.z + box.lz / 2);
    }
    return top;
  }

  /** Takes one into the hand: where it is, the hand says. */
  hold(id: Id | null): void {
    this.held = id;
  }

  /** Shows which one is chosen. */
  light(id: Id | null): void {
    if (id === this.lit) return;
    this.lit = id;
    this.draw();
  }

  dye(palette: Palette): void {
    this.colour.set(palette.box);
    this.lightColour.set(palette.held);
    this.draw();
  }

  private draw(): void {
    this.boxes.forEach((box, k) => {
      turn.setFromAxisAngle(UP, box.yaw);
      matrix.compose(place.set(box.x, box.y, box.z), turn, size.set(box.lx, box.ly, box.lz));
      this.mesh.setMatrixAt(k, matrix);
      this.mesh.setColorAt(k, box.id === this.lit ? this.lightColour : this.colour);
    });
    this.mesh.count = this.boxes.length;
    this.mesh.instanceMatrix.needsUpdate = true;
    if (this.mesh.instanceColor) this.mesh.instanceColor.needsUpdate = true;
  }
}

function isMoving(id: Id): boolean {
  return typeof id === "string" && id.startsWith("moving ");
}

/** Faces with edges a little lighter, 8 mm wide whatever the size. */
function edged(): MeshStandardMaterial {
  const material = new MeshStandardMaterial({ roughness: 0.8 });
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>\nvarying vec3 vIn;\nvarying vec3 vSize;")
      .replace(
        "#include <begin_vertex>",
        `#include <begin_vertex>
        vIn = position;
        #ifdef USE_INSTANCING
        vSize = vec3(length(instanceMatrix[0].xyz), length(instanceMatrix[1].xyz), length(instanceMatrix[2].xyz));
        #else
        vSize = vec3(1.0);
        #endif`,
      );
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", "#include <common>\nvarying vec3 vIn;\nvarying vec3 vSize;")
      .replace(
        "#include <color_fragment>",
        `#include <color_fragment>
        vec3 toEdge = (0.5 - abs(vIn)) * vSize;
        // the smallest of the three is the face itself
        float a = min(min(toEdge.x, toEdge.y), toEdge.z);
        float c = max(max(toEdge.x, toEdge.y), toEdge.z);
        float second = toEdge.x + toEdge.y + toEdge.z - a - c;
        float w = fwidth(second);
        diffuseColor.rgb *= mix(1.22, 1.0, smoothstep(0.006 - w, 0.006 + w, second));`,
      );
  };
  return material;
}
