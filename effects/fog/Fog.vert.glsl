/* See Fog.glsl. An author's complete shader (COMPLETE) says where the vertex is at its own plug. */

#if HAS_FOG_COORD && !volumetric
out float fog_coordinate;

#if COMPLETE
void PLUG_vertex_eye_space(const in vec4 vertex_eye, const in vec3 normal_eye) {
    fog_coordinate = castle_FogCoord;
}
#else
void PLUG_vertex_attributes() {
    fog_coordinate = castle_FogCoord;
}
#endif
#elif COMPLETE
out vec4 fog_place;

void PLUG_vertex_eye_space(const in vec4 vertex_eye, const in vec3 normal_eye) {
    fog_place = vertex_eye;
}
#endif
