/* A window on the values, as on a light box: from black to white, opaque; what is darker than the window is nothing. */

uniform vec2 window = vec2(0.0, 1.0);

void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
    float grey = clamp((s.value.r - window.x) / (window.y - window.x), 0.0, 1.0);
    color = vec4(vec3(grey), grey > 0.04 ? 1.0 : 0.0);
}
