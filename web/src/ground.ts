// Material of flat surfaces: uniformly lit, except in shadow.

import { Color, ShaderMaterial, UniformsLib, UniformsUtils } from "three";

const VERTEX = /* glsl */ `
#include <common>
#include <shadowmap_pars_vertex>
#include <lights_pars_begin>
#include <colorspace_pars_fragment>
uniform vec3 diffuse;
varying vec3 inSun;
varying vec3 inShade;
varying float seen;

vec3 shown(vec3 irradiance) {
  return sRGBTransferOETF(vec4(RECIPROCAL_PI * diffuse * irradiance, 1.0)).rgb;
}

void main() {
  #include <beginnormal_vertex>
  #include <defaultnormal_vertex>
  #include <begin_vertex>
  #include <project_vertex>
  #include <worldpos_vertex>
  #include <shadowmap_vertex>
  vec3 normal = normalize(transformedNormal);
  vec3 light = getHemisphereLightIrradiance(hemisphereLights[0], normal);
  #pragma unroll_loop_start
  for (int i = 1; i < NUM_DIR_LIGHTS; i ++) {
    light += max(dot(normal, directionalLights[i].direction), 0.0) * directionalLights[i].color;
  }
  #pragma unroll_loop_end
  vec3 sun = max(dot(normal, directionalLights[0].direction), 0.0) * directionalLights[0].color;
  inSun = shown(light + sun);
  inShade = shown(light);
  #ifdef USE_COLOR_ALPHA
    seen = color.a;
  #else
    seen = 1.0;
  #endif
}
`;

const FRAGMENT = /* glsl */ `
varying vec3 inSun;
varying vec3 inShade;
varying float seen;
#ifdef USE_SHADOWMAP
  uniform sampler2DShadow directionalShadowMap[NUM_DIR_LIGHT_SHADOWS];
  varying vec4 vDirectionalShadowCoord[NUM_DIR_LIGHT_SHADOWS];
#endif

void main() {
  float lit = 1.0;
  #ifdef USE_SHADOWMAP
    vec3 place = vDirectionalShadowCoord[0].xyz;
    vec2 off = abs(place.xy - 0.5);
    if (max(off.x, off.y) < 0.5) lit = texture(directionalShadowMap[0], place);
  #endif
  gl_FragColor = vec4(mix(inShade, inSun, lit), seen);
}
`;

/** Lambert shading by sky, sun and camera light; only for planes, with one normal each. */
export class Ground extends ShaderMaterial {
  /** @param veiled whether the alpha of the vertex colours makes it transparent. */
  constructor(veiled: boolean, offset: number) {
    super({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: UniformsUtils.merge([UniformsLib.lights, { diffuse: { value: new Color() } }]),
      lights: true,
      vertexColors: veiled,
      transparent: veiled,
      polygonOffset: true,
      polygonOffsetFactor: offset,
      polygonOffsetUnits: 1,
    });
  }

  get color(): Color {
    return this.uniforms.diffuse.value as Color;
  }
}
