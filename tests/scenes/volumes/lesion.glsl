/* Lesion and fluid of a brain, told apart by two contrasts on the grid of a third. */

uniform sampler3D t2;
uniform sampler3D flair;
uniform float cut;    /* the head is open above; texture coordinates */
uniform float bright; /* of both contrasts */

void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) {
    if (s.position.z > cut)
        color.a = 0.0;
}

void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
    float in_t2 = texture(t2, s.position).r;
    float in_flair = texture(flair, s.position).r;
    float lesion = smoothstep(bright, bright + 0.08, min(in_t2, in_flair));
    float fluid = smoothstep(bright, bright + 0.15, in_t2) * smoothstep(0.4, 0.25, in_flair);
    float above = s.position.z - cut;
    if (above > 0.0) {
        color = vec4(1.0, 0.25, 0.15, 0.12 * lesion); /* above the cut the lesion alone */
        return;
    }
    if (above > -0.015)
        color.rgb = vec3(1.15 * s.value.r); /* on the cut: the scan itself */
    color.rgb = mix(color.rgb, vec3(0.2, 0.45, 1.0), fluid * step(-0.015, above));
    color.rgb = mix(color.rgb, vec3(1.0, 0.2, 0.12), lesion * step(-0.015, above));
}
