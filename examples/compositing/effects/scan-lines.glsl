/* Every other line of the picture is dark, written where the picture is. */
void PLUG_fragment_end(inout vec4 fragment_color) {
    if (mod(floor(gl_FragCoord.y / 2.0), 2.0) < 1.0)
        fragment_color.rgb *= 0.6;
}
