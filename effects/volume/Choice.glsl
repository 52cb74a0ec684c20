/* The styles of one segment, or of one surface of equal value: what stands inside is called for its
 * samples alone. OTHERS: and for all numbers above. */

uniform int choiceNumber = 0;

bool is_chosen(const in VolumeSample s) {
#if OF_SURFACES
    int number = s.surface;
#else
    int number = s.segment;
#endif
#if OTHERS
    return number >= choiceNumber;
#else
    return number == choiceNumber;
#endif
}

#if !DRAWN
void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
    if (is_chosen(s))
        color = vec4(0.0);
}
#else
#if PLUG_USED(volume_classify)
void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) {
    if (!is_chosen(s))
        return;
    vec4 chosen = color;
    /* PLUG: volume_classify (chosen, s) */
    color = clamped(chosen);
}
#endif

void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
    if (!is_chosen(s))
        return;
    vec4 chosen = color;
    /* PLUG: volume_shade (chosen, s) */
    color = clamped(chosen);
}
#endif
