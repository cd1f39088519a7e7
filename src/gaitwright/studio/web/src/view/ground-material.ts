// The ground's material: a quiet surface with a metric grid, steeper parts a little darker.

import { Color, MeshStandardMaterial } from "three";

export interface GroundLook {
  flatColour: { value: Color };
  steep: { value: Color };
  line: { value: Color };
}

export function groundMaterial(): { material: MeshStandardMaterial; look: GroundLook } {
  const look: GroundLook = {
    flatColour: { value: new Color() },
    steep: { value: new Color() },
    line: { value: new Color() },
  };
  const material = new MeshStandardMaterial({ roughness: 0.96, metalness: 0 });
  material.onBeforeCompile = (shader) => {
    Object.assign(shader.uniforms, look);
    shader.vertexShader = shader.vertexShader
      .replace("#include <common>", "#include <common>\nvarying vec3 vPlace;\nvarying float vUp;")
      .replace("#include <begin_vertex>", "#include <begin_vertex>\nvPlace = position;\nvUp = normal.z;");
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", `#include <common>\n${FUNCTIONS}`)
      .replace("#include <color_fragment>", `#include <color_fragment>\n${COLOUR}`);
  };
  return { material, look };
}

const FUNCTIONS = /* glsl */ `
varying vec3 vPlace;
varying float vUp;
uniform vec3 flatColour;
uniform vec3 steep;
uniform vec3 line;

float gridLine(vec2 place, float size, float width) {
  vec2 cell = place / size;
  vec2 wide = fwidth(cell);
  vec2 off = abs(fract(cell - 0.5) - 0.5);
  vec2 there = 1.0 - smoothstep(wide * 0.5 * width, wide * (0.5 * width + 1.0), off);
  float far = max(wide.x, wide.y);
  return max(there.x, there.y) * (1.0 - smoothstep(0.12, 0.45, far));
}

float hash(vec2 p) {
  p = fract(p * vec2(123.34, 456.21));
  p += dot(p, p + 45.32);
  return fract(p.x * p.y);
}

float noise(vec2 p) {
  vec2 i = floor(p), f = fract(p);
  f = f * f * (3.0 - 2.0 * f);
  return mix(mix(hash(i), hash(i + vec2(1, 0)), f.x), mix(hash(i + vec2(0, 1)), hash(i + vec2(1, 1)), f.x), f.y);
}
`;

const COLOUR = /* glsl */ `
float level = smoothstep(0.55, 0.98, vUp);
float grain = noise(vPlace.xy * 9.0) * 0.6 + noise(vPlace.xy * 31.0) * 0.4;
vec3 earth = mix(steep, flatColour, level) * (0.965 + 0.07 * grain);
float lines = max(gridLine(vPlace.xy, 1.0, 1.3) * 0.62, gridLine(vPlace.xy, 0.2, 0.6) * 0.2) * level;
diffuseColor.rgb = mix(earth, line, lines);
`;
