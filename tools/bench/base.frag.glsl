#version 330 core
in vec4 castle_vertex_eye;
in vec3 castle_normal_eye;
uniform vec4 color;
out vec4 result;
/* PLUG-DECLARATIONS */
void main()
{
  vec4 fragment_color = color;
  vec3 normal_eye = normalize(castle_normal_eye);
  /* PLUG: fragment_eye_space (castle_vertex_eye, normal_eye) */
  fragment_color.rgb *= max(normal_eye.z, 0.0);
  /* PLUG: lighting_apply (fragment_color, castle_vertex_eye, normal_eye) */
  /* PLUG: fragment_modify (fragment_color) */
  /* PLUG: fog_apply (fragment_color, normal_eye) */
  result = fragment_color;
}
