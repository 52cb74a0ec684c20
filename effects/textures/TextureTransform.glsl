/* ISO/IEC 19775-1 V4 18.4.12, TextureTransform, for coordinates that are made for each
 * fragment. */

#ifdef FRAGMENTS
uniform vec2 translation = vec2(0.0);
uniform vec2 center = vec2(0.0);
uniform float rotation = 0.0;
uniform vec2 scale = vec2(1.0);

void PLUG_texture_coord_transform(inout vec4 tex_coord) {
    tex_coord.st = transformed_tex_coord(tex_coord, translation, center, rotation, scale);
}
#endif
