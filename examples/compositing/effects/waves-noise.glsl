/* Waves from noise in two dimensions and time: the gradient of a height, by differences. */

uniform float time = 0.0;
uniform float scale = 1.6;
uniform float height = 0.16;

float turbulence(vec3 place);

void PLUG_water_normal(inout vec3 normal_object, const in vec2 place) {
    vec3 p = vec3(place * scale, 0.8 * time);
    float d = 0.02;
    vec2 slope = vec2(turbulence(p + vec3(d, 0.0, 0.0)) - turbulence(p - vec3(d, 0.0, 0.0)),
                      turbulence(p + vec3(0.0, d, 0.0)) - turbulence(p - vec3(0.0, d, 0.0))) / (2.0 * d);
    normal_object = normalize(vec3(-height * scale * slope.x, 1.0, -height * scale * slope.y));
}
