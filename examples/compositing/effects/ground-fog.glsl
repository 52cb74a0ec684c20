/* Fog that lies between the floor and a height: the way of the ray through the slab, by Beer's law.
 * What a light adds to it comes through the plug fog_light. */

uniform float height = 1.0;      /* of the top of the fog, in the world */
uniform float density = 0.5;     /* per metre */
uniform vec3 fog_color = vec3(0.75, 0.8, 0.85);

varying vec4 place_eye;

/* The part of the way from the eye to a point that runs below the height. */
float way_in_fog(vec3 eye, vec3 point) {
    float rise = point.y - eye.y;
    float start = eye.y < height ? 0.0 : 1.0, end = point.y < height ? 1.0 : 0.0;
    if (abs(rise) > 1e-5) {
        float crossing = clamp((height - eye.y) / rise, 0.0, 1.0);
        start = eye.y < height ? 0.0 : crossing;
        end = point.y < height ? 1.0 : crossing;
    }
    return max(end - start, 0.0) * distance(eye, point);
}

void PLUG_fog_apply(inout vec4 fragment_color, const vec3 normal_eye) {
    vec3 eye = plugray_InverseViewMatrix[3].xyz;
    vec3 point = (plugray_InverseViewMatrix * place_eye).xyz;
    vec3 color = fog_color;
    /* PLUG: fog_light (color, eye, point) */
    fragment_color.rgb = mix(color, fragment_color.rgb, exp(-density * way_in_fog(eye, point)));
}
