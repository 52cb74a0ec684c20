/* Colour and opacity from a transfer function. ISO/IEC 19775-1 V4 41.4.7; never lit. The look-up itself
 * is in style.glsl. */

#if LEADING
void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) {
    color = style_transfer(s.value);
}
#else
void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
    color = style_transfer(s.value);
}
#endif
