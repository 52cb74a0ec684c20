/* ISO/IEC 19775-1 18.4, TextureTransform: Tc' = -C S R C T Tc, the rightmost first. */

uniform vec2 translation = vec2(0.0);
uniform vec2 center = vec2(0.0);
uniform float rotation = 0.0;
uniform vec2 scale = vec2(1.0);

void PLUG_texture_coord_transform(inout vec4 tex_coord) {
    vec2 st = tex_coord.st / tex_coord.q + translation + center;
    float c = cos(rotation), s = sin(rotation);
    st = vec2(c * st.s - s * st.t, s * st.s + c * st.t);
    tex_coord.st = (scale * st - center) * tex_coord.q;
}
