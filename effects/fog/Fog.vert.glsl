/* See Fog.glsl. */

#if HAS_FOG_COORD && !volumetric
out float fog_coordinate;

void PLUG_vertex_attributes() {
    fog_coordinate = castle_FogCoord;
}
#endif
