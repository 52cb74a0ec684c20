/* A texture that a light or a viewpoint projects: places in its clip space, from 0 to 1; q is the distance
 * that the place is divided by (Everitt 2001, "Projective texture mapping"). `eyeToProjector` has it all. */

uniform mat4 eyeToProjector = mat4(1.0);

void PLUG_texture_coord_generate(inout vec4 tex_coord, const in vec4 vertex_eye) {
    tex_coord = eyeToProjector * vertex_eye;
}
