/* See Color.glsl. */

out vec4 vertex_color;

void PLUG_vertex_attributes() {
    vertex_color = castle_ColorPerVertex;
}
