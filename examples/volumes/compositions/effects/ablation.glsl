/* How zones of ablation look in a volume that is cut above a plane. What is a zone is said by other effects, through the plug
 * ablation_zone: `nearest` is below 1 inside one of them. */

uniform vec3 floor;                 /* of the cut: height, and how it rises to both sides; texture coordinates */
uniform vec3 zone_color = vec3(1.0, 0.4, 0.1);

float above_cut(const in vec3 position) {
    return position.z - floor.x - dot(position.xy - 0.5, floor.yz);
}

float zone_at(const in vec3 position_eye) {
    float nearest = 1.0e9;
    vec3 place = (plugray_InverseModelViewMatrix * vec4(position_eye, 1.0)).xyz;
    /* PLUG: ablation_zone (nearest, place) */
    return nearest;
}

void PLUG_volume_classify(inout vec4 color, const in VolumeSample s) {
    if (above_cut(s.position) > 0.0)
        color.a = 0.0;
}

/* How squarely the viewer looks at the nearest zone, from 0 to 1. */
float zone_facing(const in vec3 position_eye, const in float zone) {
    const float STEP = 0.0005;
    vec3 slope = vec3(zone_at(position_eye + vec3(STEP, 0.0, 0.0)), zone_at(position_eye + vec3(0.0, STEP, 0.0)),
                      zone_at(position_eye + vec3(0.0, 0.0, STEP))) - zone;
    return dot(slope, slope) > 0.0 ? abs(dot(normalize(slope), direction_to_viewer(vec4(position_eye, 1.0)))) : 0.0;
}

void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
    float above = above_cut(s.position);
    float zone = zone_at(s.position_eye);
    if (above > 0.0) {
        /* the body of the zone in the open, as of glass: its skin is dense where it is seen from the side */
        if (zone < 1.0) {
            float facing = zone_facing(s.position_eye, zone);
            float skin = smoothstep(0.86, 0.93, zone);
            color = vec4(zone_color * (0.45 + 0.75 * facing), 0.02 + skin * mix(0.45, 0.06, facing));
        }
        return;
    }
    if (above > -0.012) {
        color.rgb = vec3(1.9 * s.value.r); /* on the cut: the scan itself */
        if (zone < 1.0)
            color.rgb = mix(color.rgb, zone_color, zone > 0.86 ? 1.0 : 0.4);
    }
}
