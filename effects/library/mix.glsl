/* Mixing several volumes at one step, as physics does: optical depths add up, colours are weighted by
 * them; opaque samples hide translucent ones and are averaged among themselves. */

struct VolumeMix {
    vec4 sum;    /* of colour * optical depth, and of the depths; or of opaque colours, and how many */
    bool opaque; /* whether any sample is */
};

/* `length_ratio`: step length over reference length, both in the volume's own coordinates. */
void volume_mix_add(inout VolumeMix mixed, const in vec4 color, const in float length_ratio) {
    bool opaque = color.a >= 1.0;
    if (mixed.opaque && !opaque)
        return;
    float weight = opaque ? 1.0 : -log(1.0 - color.a) * length_ratio;
    vec4 added = weight * vec4(color.rgb, 1.0);
    mixed.sum = mixed.opaque == opaque ? mixed.sum + added : added;
    mixed.opaque = opaque;
}

/* What an optical depth hides: 1 - exp(-depth). That loses its digits where little is hidden, as in
 * many short steps: there the series. */
float opacity_of_depth(const in float depth) {
    float few = depth * (1.0 - depth * (0.5 - depth * (1.0 / 6.0 - depth * (1.0 / 24.0))));
    return depth < 0.02 ? few : 1.0 - exp(-depth);
}

/* Straight colour and the opacity of the step. */
vec4 volume_mix_color(const in VolumeMix mixed) {
    vec4 color = vec4(mixed.sum.rgb * (1.0 / max(mixed.sum.a, 1.0e-37)), mixed.opaque ? 1.0 : opacity_of_depth(mixed.sum.a));
    return mixed.sum.a > 0.0 ? color : vec4(0.0);
}
