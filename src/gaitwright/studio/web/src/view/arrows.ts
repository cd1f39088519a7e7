// Arrows, many in one draw.

import {
  type ColorRepresentation, ConeGeometry, CylinderGeometry, Group, InstancedMesh, Matrix4, MeshStandardMaterial,
  Quaternion, Vector3,
} from "three";

const UP = new Vector3(0, 0, 1);
const ZERO = new Matrix4().makeScale(0, 0, 0);
const turn = new Quaternion();
const unit = new Vector3();
const size = new Vector3();
const tip = new Vector3();
const matrix = new Matrix4();

export class Arrows {
  readonly group = new Group();
  private readonly shafts: InstancedMesh;
  private readonly heads: InstancedMesh;
  /** Thicker for larger robots. */
  scale = 1;

  constructor(private readonly most: number, colour: ColorRepresentation, private readonly thin: number) {
    const shaft = new CylinderGeometry(1, 1, 1, 12).rotateX(Math.PI / 2).translate(0, 0, 0.5);
    const head = new ConeGeometry(1, 1, 16).rotateX(Math.PI / 2).translate(0, 0, 0.5);
    const paint = new MeshStandardMaterial({ color: colour, roughness: 0.6, emissive: colour, emissiveIntensity: 0.35 });
    this.shafts = new InstancedMesh(shaft, paint, most);
    this.heads = new InstancedMesh(head, paint, most);
    for (const mesh of [this.shafts, this.heads]) {
      mesh.frustumCulled = false;
      this.group.add(mesh);
    }
    for (let k = 0; k < most; k++) this.hide(k);
  }

  private get radius(): number {
    return this.thin * this.scale;
  }

  /** From a place along a vector; too short a one is hidden. */
  set(k: number, from: Vector3, along: Vector3): void {
    if (k >= this.most) return;
    const long = along.length();
    if (!(long > 2 * this.radius)) return this.hide(k);
    unit.copy(along).divideScalar(long);
    turn.setFromUnitVectors(UP, unit);
    const head = Math.min(6 * this.radius, 0.5 * long);
    this.shafts.setMatrixAt(k, matrix.compose(from, turn, size.set(this.radius, this.radius, long - head)));
    tip.copy(from).addScaledVector(unit, long - head);
    this.heads.setMatrixAt(k, matrix.compose(tip, turn, size.set(2.6 * this.radius, 2.6 * this.radius, head)));
    this.changed();
  }

  hide(k: number): void {
    this.shafts.setMatrixAt(k, ZERO);
    this.heads.setMatrixAt(k, ZERO);
    this.changed();
  }

  private changed(): void {
    this.shafts.instanceMatrix.needsUpdate = true;
    this.heads.instanceMatrix.needsUpdate = true;
  }
}
