/* A two-dimensional texture of Appearance, whatever its node type. It multiplies the colour before
 * light, alpha too: the rule of ISO/IEC 19775-1 V4 17.2.2 for every number of components (version 3
 * let RGB replace the colour). The host lets L read as (l, l, l, 1), LA as (l, l, l, a), RGB as
 * (r, g, b, 1). `self` is the texture of the node that this effect stands for. */

uniform sampler2D self;

in vec4 tex_coord;

void PLUG_surface_texture(inout vec4 fragment_color) {
    vec4 texture_color = textureProj(self, tex_coord);
    /* PLUG: texture_color (texture_color, self, tex_coord) (texture_color, tex_coord) */
    fragment_color *= texture_color;
}
