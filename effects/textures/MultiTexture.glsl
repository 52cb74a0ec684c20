/* ISO/IEC 19775-1 V4 18.4.3: textures one after the other, each mixed with what there was before it, before
 * light. `color` and `alpha` are the source FACTOR; the material's own colour is DIFFUSE. */

uniform vec3 color = vec3(1.0);
uniform float alpha = 1.0;

void PLUG_surface_texture(inout vec4 fragment_color) {
    vec4 primary = fragment_color;
    /* PLUG: texture_stage (fragment_color, primary) */
}
