/* Holes, by a lattice in the object. */
varying vec3 place_object;

void PLUG_fragment_eye_space(const vec4 vertex_eye, inout vec3 normal_eye) {
    vec3 cell = fract(3.0 * place_object) - 0.5;
    if (dot(cell, cell) < 0.16)
        discard;
}
