#version 330 core
uniform vec2 hull[48];

void main() {
    int corner = gl_VertexID % 3;
    gl_Position = vec4(hull[corner == 0 ? 0 : gl_VertexID / 3 + corner], 0.0, 1.0);
}
