/* See LineProperties.glsl. */

out float line_distance;

void PLUG_vertex_attributes() {
    line_distance = plugray_LineDistance;
}
