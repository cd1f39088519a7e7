// How boxes look: faces with edges a little lighter, 8 mm wide whatever the size.

import { MeshStandardMaterial } from "three";

/** Each instance has a `share`: of glass how much of it is seen; of others whether they are drawn at all, while
    their shadow stays. */
export function edged(glass: boolean): MeshStandardMaterial {
  const material = new MeshStandardMaterial({ roughness: 0.8, transparent: glass, depthWrite: !glass });
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader
      .replace(
        "#include <common>",
        `#include <common>
        attribute float share;
        varying float vShare;
        varying vec3 vIn;
        varying vec3 vSize;`,
      )
      .replace(
        "#include <begin_vertex>",
        `#include <begin_vertex>
        vShare = share;
        vIn = position;
        #ifdef USE_INSTANCING
        vSize = vec3(length(instanceMatrix[0].xyz), length(instanceMatrix[1].xyz), length(instanceMatrix[2].xyz));
        #else
        vSize = vec3(1.0);
        #endif`,
      )
      .replace(
        "#include <project_vertex>",
        `#include <project_vertex>
        if (share <= 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);`,
      );
    shader.fragmentShader = shader.fragmentShader
      .replace("#include <common>", "#include <common>\nvarying float vShare;\nvarying vec3 vIn;\nvarying vec3 vSize;")
      .replace(
        "#include <color_fragment>",
        `#include <color_fragment>
        vec3 toEdge = (0.5 - abs(vIn)) * vSize;
        // the smallest of the three is the face itself
        float a = min(min(toEdge.x, toEdge.y), toEdge.z);
        float c = max(max(toEdge.x, toEdge.y), toEdge.z);
        float second = toEdge.x + toEdge.y + toEdge.z - a - c;
        float w = fwidth(second);
        float edge = 1.0 - smoothstep(0.006 - w, 0.006 + w, second);
        diffuseColor.rgb *= mix(1.0, 1.22, edge);
        diffuseColor.a *= mix(vShare, max(vShare, 0.6), edge);`,
      );
  };
  material.customProgramCacheKey = () => `edged ${glass}`;
  return material;
}
