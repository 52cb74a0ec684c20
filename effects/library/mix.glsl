/* Mixing several volumes at one step, as physics does: optical depths add up, colours are weighted by
 * them; opaque samples hide translucent ones and are averaged among themselves. */

struct VolumeMix {
    vec3 weighted;  /* sum of colour * optical depth */
    float depth;    /* sum of optical depths */
    vec3 opaque;    /* sum of the colours of opaque samples */
    float opaques;  /* how many */
};

/* `length_ratio`: step length over reference length, both in the volume's own coordinates. */
void volume_mix_add(inout VolumeMix mixed, const in vec4 color, const in float length_ratio) {
    if (color.a >= 1.0) {
        mixed.opaque += color.rgb;
        mixed.opaques += 1.0;
        return;
    }
    float depth = -log(1.0 - color.a) * length_ratio;
    mixed.weighted += color.rgb * depth;
    mixed.depth += depth;
}

/* What an optical depth hides: 1 - exp(-depth). That loses its digits where little is hidden, as in
 * many short steps: there the series. */
float opacity_of_depth(const in float depth) {
    if (depth < 0.02)
        return depth * (1.0 - depth * (0.5 - depth * (1.0 / 6.0 - depth / 24.0)));
    return 1.0 - exp(-depth);
}

/* Straight colour and the opacity of the step. */
vec4 volume_mix_color(const in VolumeMix mixed) {
    if (mixed.opaques > 0.0)
        return vec4(mixed.opaque / mixed.opaques, 1.0);
    if (!(mixed.depth > 0.0))
        return vec4(0.0);
    return vec4(mixed.weighted / mixed.depth, opacity_of_depth(mixed.depth));
}
