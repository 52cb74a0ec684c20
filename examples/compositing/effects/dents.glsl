/* Dents: only the normal changes, by a wave over the object. */
varying vec3 place_object;

void PLUG_fragment_eye_space(const vec4 vertex_eye, inout vec3 normal_eye) {
    vec3 wave = cos(14.0 * place_object);
    normal_eye = normalize(normal_eye + 0.35 * castle_NormalMatrix * wave);
}
