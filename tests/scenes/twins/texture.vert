#version 330 core
in vec4 castle_Vertex;
in vec4 castle_MultiTexCoord0;
uniform mat4 castle_ModelViewMatrix;
uniform mat4 castle_ProjectionMatrix;
out vec4 castle_TexCoord0;

void main() {
    castle_TexCoord0 = castle_MultiTexCoord0;
    gl_Position = castle_ProjectionMatrix * (castle_ModelViewMatrix * castle_Vertex);
}
