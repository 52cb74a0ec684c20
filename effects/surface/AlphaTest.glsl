/* What is too transparent is not there: Appearance.alphaMode "MASK" and alphaCutoff, ISO/IEC 19775-1 V4
 * 12.4.2; textures whose alpha is all or nothing are tested against a half. */

uniform float alphaCutoff = 0.5;

void PLUG_fragment_end(const in vec4 fragment_color) {
    if (fragment_color.a < alphaCutoff)
        discard;
}
