/* Cuts rays to an upright cylinder of elliptic section: what stands around the patient is left out. */

uniform vec2 middle = vec2(0.0);     /* in the volume's own coordinates */
uniform vec2 half_axes = vec2(1.0);

void PLUG_volume_ray(inout float t_enter, inout float t_exit, const in vec3 origin_eye, const in vec3 direction_eye) {
    vec2 from = ((plugray_InverseModelViewMatrix * vec4(origin_eye, 1.0)).xy - middle) / half_axes;
    vec2 along = (plugray_InverseModelViewMatrix * vec4(direction_eye, 0.0)).xy / half_axes;
    float a = dot(along, along), b = dot(from, along), c = dot(from, from) - 1.0;
    float root = b * b - a * c;
    if (a > 0.0 && root > 0.0) {
        t_enter = max(t_enter, (-b - sqrt(root)) / a);
        t_exit = min(t_exit, (-b + sqrt(root)) / a);
    } else if (c > 0.0) {
        t_exit = t_enter;
    }
}
