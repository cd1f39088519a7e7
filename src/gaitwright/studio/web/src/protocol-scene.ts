// Robots and worlds as the protocol has them. Lengths m, angles rad; quaternions (w, x, y, z).

export type Vec2 = [number, number];
export type Vec3 = [number, number, number];
export type Quat = [number, number, number, number];

export interface Column {
  name: string;
  size: number;
}

export interface Mesh {
  /** base64 of little-endian float32 x, y, z … */
  points: string;
  /** base64 of uint32, three per triangle */
  indices: string;
}

export interface Robot {
  name: string;
  legs: string[];
  hip: Vec3[];
  frame: Quat[];
  offset: [Vec3, Vec3, Vec3][];
  sign: number[];
  foot_radius: number[];
  trunk: [Vec3, Vec3];
  tau_max: Vec3[];
  q_min: Vec3[];
  q_max: Vec3[];
  height: number;
  mass: number;
}

export interface Box {
  id: string | number;
  x: number;
  y: number;
  /** of the centre */
  z: number;
  lx: number;
  ly: number;
  lz: number;
  yaw: number;
}

export interface Sphere {
  x: number;
  y: number;
  z: number;
  radius: number;
}

export interface World {
  say: "world";
  scene: string;
  seed: number;
  robots: Robot[];
  ground: Mesh;
  boxes: Box[];
  spheres: Sphere[];
  meshes: Mesh[];
  bounds: [number, number, number, number];
  start: Vec3;
  goal: Vec2 | null;
}

/** Something that moves by itself, by the box around it; its numbers are not those of boxes. */
export type Thing = Box;
