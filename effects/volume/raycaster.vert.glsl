#version 330 core
/* A fan of triangles over all pixels in which a volume may be seen; no attributes. */

uniform vec2 hull[48]; /* convex, in clip coordinates; as many in C: PLR_MOST_HULL */

void main() {
    int corner = gl_VertexID % 3;
    gl_Position = vec4(hull[corner == 0 ? 0 : gl_VertexID / 3 + corner], 0.0, 1.0);
}
