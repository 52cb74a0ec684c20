/* The textures of a shape whose author wrote the complete shader: they are mixed into the colour at its
 * plug main_texture_apply, or at the older texture_apply if it offers that alone (OLD_NAME). */

#if OLD_NAME
void PLUG_texture_apply(inout vec4 fragment_color, const in vec3 normal_eye) {
    /* PLUG: surface_texture (fragment_color) */
}
#else
void PLUG_main_texture_apply(inout vec4 fragment_color, const in vec3 normal_eye) {
    /* PLUG: surface_texture (fragment_color) */
}
#endif
