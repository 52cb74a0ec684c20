/* A lacquered surface: white highlights, small and bright. */
void PLUG_material_specular(inout vec3 specular) {
    specular = vec3(1.0);
}

void PLUG_material_shininess(inout float shininess) {
    shininess = max(shininess, 60.0);
}
