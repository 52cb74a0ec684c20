/* Colour and opacity from a transfer function. ISO/IEC 19775-1 V4 41.4.7; never lit. The look-up itself
 * is in style.glsl. */

#if LEADING
#if SKIPS
/* Whether the function makes anything of a value. Of one component that is a comparison: outside of an
 * open interval all values are clear. */
#if defined(IN_ATLAS) && voxels_COMPONENTS == 1
uniform vec2 visibleValues;

void PLUG_volume_visible(inout bool visible, const in vec4 value) {
    visible = value.r > visibleValues.x && value.r < visibleValues.y;
}
#else
void PLUG_volume_visible(inout bool visible, const in vec4 value) {
    visible = style_transfer(value).a > 0.0;
}
#endif
#endif

void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) {
    color = style_transfer(s.value);
}
#else
void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
    color = style_transfer(s.value);
}
#endif
