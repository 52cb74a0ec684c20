/* Water, what all ways to make waves share: the normal comes from the plug water_normal, in the plane of the
 * water (x along, y up, z across), and is carried to eye space. */

uniform float roughness = 1.0; /* how steep the waves are */

varying vec3 place_object;

void PLUG_fragment_eye_space(const vec4 vertex_eye, inout vec3 normal_eye) {
    vec3 normal_object = vec3(0.0, 1.0, 0.0);
    /* PLUG: water_normal (normal_object, place_object.xz) */
    normal_object.xz *= roughness;
    normal_eye = normalize(castle_NormalMatrix * normal_object);
}
