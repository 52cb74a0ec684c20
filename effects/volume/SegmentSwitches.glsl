/* In general programs, the segments, or the surfaces of equal value, that switches of the scene turn off:
 * nothing of them is drawn (ISO/IEC 19775-1 V4 41.4.11, segmentEnabled). */

const int MOST_MAPS = 256;
uniform vec4 segmentMaps[MOST_MAPS]; /* hidden where z is negative */
uniform int segmentMapCount = 1;     /* the last one is that of all numbers above */

void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
#if OF_SURFACES
    int number = s.surface;
#else
    int number = s.segment;
#endif
    if (segmentMaps[clamp(number, 0, segmentMapCount - 1)].z < 0.0)
        color = vec4(0.0);
}
