/* What fluoresces shines and hides nothing: along a ray light adds up, of one channel and of many, in any order. In an Effect
 * with placement "REPLACE" and target "Composite", on the volume or, of volumes that overlap, on the group around them. */

uniform float exposure = 1.0;

/* color is the mean of what the volumes have here, weighted by their densities, and its alpha that of a step of their sum:
 * their product is the sum of what each sends out. */
void PLUG_volume_composite(inout vec4 accumulated, inout vec4 color, const in VolumeSample s) {
    accumulated.rgb += color.rgb * (-exposure * log(1.0 - min(color.a, 0.999)));
}

/* Alpha stays 0: what is behind shines through, and light is added to it. */
