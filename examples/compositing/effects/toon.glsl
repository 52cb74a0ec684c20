/* Light in steps, as in a drawing; the hue stays. */

uniform float steps = 3.0;

void PLUG_lighting_apply(inout vec4 color, const in vec4 vertex_eye, const in vec3 normal_eye) {
    float brightness = max(color.r, max(color.g, color.b));
    if (brightness > 0.0)
        color.rgb *= (floor(min(brightness, 0.999) * steps) + 0.5) / (steps * brightness);
}
