#version 330 core
in vec4 castle_Vertex;
in vec3 castle_Normal;
in vec4 castle_MultiTexCoord0;
uniform mat4 castle_ModelViewMatrix;
uniform mat3 castle_NormalMatrix;
uniform mat4 castle_ProjectionMatrix;
out vec4 castle_vertex_eye;
out vec3 castle_normal_eye;
out vec4 castle_TexCoord0;

void main() {
    vec4 place = castle_ModelViewMatrix * castle_Vertex;
    vec3 normal = castle_NormalMatrix * castle_Normal;
    castle_vertex_eye = place;
    castle_normal_eye = normal * inversesqrt(dot(normal, normal) + 1e-37);
    castle_TexCoord0 = castle_MultiTexCoord0;
    gl_Position = castle_ProjectionMatrix * place;
}
