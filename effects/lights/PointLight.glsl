/* ISO/IEC 19775-1 V4 17.4, PointLight, and 17.2.2. `nodeToEye` carries the light's own coordinates
 * to eye space. A zero normal gets ambient light only. What meets the light, and how, is the
 * material's: material_reflection. */

uniform mat4 nodeToEye = mat4(1.0);
uniform mat4 eyeToNode = mat4(1.0);
uniform vec3 location = vec3(0.0);
uniform vec3 color = vec3(1.0);
uniform float intensity = 1.0;
uniform float ambientIntensity = 0.0;
uniform vec3 attenuation = vec3(1.0, 0.0, 0.0);
uniform float radius = 100.0;

/* For effects on this light: where it stands. */
vec3 light_location_eye = (nodeToEye * vec4(location, 1.0)).xyz;

void PLUG_add_light(inout vec4 lit, const in vec4 vertex_eye, const in vec3 normal_eye,
                    const in MaterialInfo material) {
    vec3 to_light = (nodeToEye * vec4(location, 1.0)).xyz - vertex_eye.xyz / vertex_eye.w;
    vec3 light_dir = unit_or_zero(to_light);
    float scale = 1.0;
    /* PLUG: light_scale (scale, normal_eye, light_dir) (scale, normal_eye, light_dir, vertex_eye) */
    scale *= light_attenuation(mat3(eyeToNode) * to_light, attenuation, radius);
    vec3 light_color = color;
    /* PLUG: light_color (light_color, vertex_eye, light_dir) */
    lit.rgb += scale * light_color *
               (ambientIntensity * material.ambient +
                intensity * material_reflection(material, vertex_eye, normal_eye, light_dir));
}
