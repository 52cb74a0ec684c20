/* Front to back: what is accumulated lies over what comes. (Porter, Duff 1984, "over".) */

void PLUG_volume_composite(inout vec4 accumulated, inout vec4 color, const in VolumeSample s) {
    accumulated += (1.0 - accumulated.a) * vec4(color.rgb * color.a, color.a);
}
