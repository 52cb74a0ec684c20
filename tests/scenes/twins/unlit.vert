#version 330 core
in vec4 castle_Vertex;
uniform mat4 castle_ModelViewMatrix;
uniform mat4 castle_ProjectionMatrix;

void main() {
    gl_Position = castle_ProjectionMatrix * (castle_ModelViewMatrix * castle_Vertex);
}
