/* The surface shines by itself. */
uniform vec3 glow_color = vec3(0.0, 0.25, 0.12);

void PLUG_material_emissive(inout vec3 emissive) {
    emissive += glow_color;
}
