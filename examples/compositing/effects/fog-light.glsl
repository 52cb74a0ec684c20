/* Light that a lamp scatters in the fog towards the eye: the integral of 1/d^2 along the ray has a closed
 * form (Sun, Ramamoorthi, Narasimhan, Nayar, "A Practical Analytic Single Scattering Model for Real
 * Time Rendering", 2005, without their absorption term). */

uniform vec3 lamp = vec3(0.0, 1.0, 0.0); /* in the world */
uniform vec3 lamp_color = vec3(1.0, 0.7, 0.3);

void PLUG_fog_light(inout vec3 fog_color, const in vec3 eye, const in vec3 point) {
    vec3 way = point - eye;
    float far = length(way);
    vec3 ray = way / far;
    float nearest = dot(lamp - eye, ray);
    float aside = max(length(lamp - eye - nearest * ray), 0.02);
    float scattered = (atan((far - nearest) / aside) + atan(nearest / aside)) / aside;
    fog_color += lamp_color * scattered;
}
