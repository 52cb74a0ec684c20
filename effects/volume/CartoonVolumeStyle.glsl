/* A few flat colours by the angle between surface and view. ISO/IEC 19775-1 V4 41.4.3: the angles from 0 to
 * pi/2 between normal and direction to the viewer are divided into colorSteps equal parts. The first has
 * orthogonalColor, the last parallelColor, and every one between them the colour at its middle,
 * interpolated in HSV, and linearly in alpha. One step: orthogonalColor.
 *
 * The colour replaces Cv; its alpha scales the opacity, Og = Ov alpha. Back faces "have no colour": their
 * opacity is 0. Where there is no normal nothing changes. */

uniform vec4 parallelColor = vec4(0.0, 0.0, 0.0, 1.0);
uniform vec4 orthogonalColor = vec4(1.0);
uniform int colorSteps = 4;

vec4 cartoon_color(const in float angle) {
    float steps = float(max(colorSteps, 1));
    float part = floor(min(angle / 1.57079632679490 * steps, steps - 0.5));
    if (part == 0.0)
        return orthogonalColor;
    if (part == steps - 1.0)
        return parallelColor;
    float share = (part + 0.5) / steps;
    return vec4(mix_in_hsv(orthogonalColor.rgb, parallelColor.rgb, share),
                mix(orthogonalColor.a, parallelColor.a, share));
}

void PLUG_volume_shade(inout vec4 color, const in VolumeSample s) {
    vec3 normal = style_normal(s);
    if (normal == vec3(0.0))
        return;
    vec3 view = direction_to_viewer(vec4(s.position_eye, 1.0));
    float facing = dot(normal, view);
    if (facing < 0.0) {
        color.a = 0.0;
        return;
    }
    /* not acos: it loses digits at small angles, and Mesa's is coarse everywhere */
    vec4 flat_color = cartoon_color(atan(length(cross(normal, view)), facing));
    color = vec4(flat_color.rgb, color.a * flat_color.a);
}
