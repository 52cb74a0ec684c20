/* See Texture2D.glsl. */

out vec4 tex_coord;

void PLUG_vertex_attributes() {
    tex_coord = castle_MultiTexCoord0;
    /* PLUG: texture_coord_transform (tex_coord) */
}
