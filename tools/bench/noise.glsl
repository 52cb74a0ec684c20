uniform float amount, scale;
uniform vec3 tint;
varying vec3 position;
const int OCTAVES = 4;

/* Smooth noise in space. */
float hash(vec3 p) { return fract(sin(dot(p, vec3(12.9898, 78.233, 37.719))) * 43758.5453); }

float noise(vec3 p)
{
  vec3 i = floor(p), f = fract(p);
  f = f * f * (3.0 - 2.0 * f); // smooth
  float a = mix(hash(i), hash(i + vec3(1.0, 0.0, 0.0)), f.x);
  float b = mix(hash(i + vec3(0.0, 1.0, 0.0)), hash(i + vec3(1.0, 1.0, 0.0)), f.x);
  float c = mix(hash(i + vec3(0.0, 0.0, 1.0)), hash(i + vec3(1.0, 0.0, 1.0)), f.x);
  float d = mix(hash(i + vec3(0.0, 1.0, 1.0)), hash(i + vec3(1.0, 1.0, 1.0)), f.x);
  return mix(mix(a, b, f.y), mix(c, d, f.y), f.z);
}

void PLUG_fragment_modify(inout vec4 fragment_color)
{
  float sum = 0.0, weight = 0.5;
  vec3 p = position * scale;
  for (int i = 0; i < OCTAVES; i++) {
    sum += noise(p) * weight;
    p *= 2.0;
    weight *= 0.5;
  }
  fragment_color.rgb = mix(fragment_color.rgb, tint, amount * sum);
}
