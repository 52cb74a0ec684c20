/* Segments that have nothing but an opacity map each (ISO/IEC 19775-1 V4 41.4.7 and 41.4.11): one look-up,
 * however many there are. */

const int MOST_MAPS = 256;
uniform vec4 segmentMaps[MOST_MAPS]; /* places in the texture of functions; none: the segment is hidden */
uniform int segmentMapCount = 1;     /* the last one is that of all segments above */

void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) {
    vec4 place = segmentMaps[clamp(s.segment, 0, segmentMapCount - 1)];
#if voxels_COMPONENTS >= 2
    vec2 at = s.value.rg;
#else
    vec2 at = vec2(s.value.r, 0.0);
#endif
    color = place.z < 0.0 ? vec4(0.0) : transfer_in(place, at);
}
