#version 330 core
/* Asks the effects of a volume what they make of many samples, for `plugray check --trust` (engine/trust.c): one trial
 * a pixel. What is written is one quantity of the trial; each is drawn for itself, so that functions that keep
 * something from call to call are called once. */

uniform int quantity; /* see volume/Trial.glsl */

out vec4 plugray_FragColor;

/* PLUG-DECLARATIONS */

void main() {
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    uint number = pixel.y << 16u | pixel.x;
    vec4 result = vec4(0.0);
    /* PLUG: volume_trial (result, number, quantity) */
    plugray_FragColor = result;
}
