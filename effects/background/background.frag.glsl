#version 330 core
/* The base of what lies behind everything: a colour for each direction. */

uniform vec4 viewport; /* x, y, width, height in pixels */

out vec4 plugray_FragColor;

/* PLUG-DECLARATIONS */

void main() {
    vec2 place = (gl_FragCoord.xy - viewport.xy) / viewport.zw;
    vec2 ndc = place * 2.0 - 1.0;
    mat4 p = castle_ProjectionMatrix;
    vec3 direction_eye = vec3(0.0, 0.0, -1.0);
    if (p[2][3] != 0.0)
        direction_eye = normalize(vec3((ndc + p[2].xy) / vec2(p[0][0], p[1][1]), -1.0));
    vec4 color = vec4(0.0, 0.0, 0.0, 1.0);
    /* PLUG: background_color (color, direction_eye) (color, direction_eye, place) */

    /* for effects of the background: it is an unlit surface all around the viewer */
    /* PLUG: main_texture_apply (color, -direction_eye) */
    /* PLUG: lighting_apply (color, vec4(direction_eye, 1.0), -direction_eye) */
    /* PLUG: fragment_modify (color) */
    /* PLUG: fog_apply (color, -direction_eye) */
    plugray_FragColor = vec4(color.rgb * color.a, color.a);
    /* PLUG: fragment_end (plugray_FragColor) */
}
