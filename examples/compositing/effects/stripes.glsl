/* Stripes around the object, in its material's colour before light falls on it. */
uniform vec3 stripe_color = vec3(0.95, 0.9, 0.2);
varying vec3 place_object;

void PLUG_main_texture_apply(inout vec4 fragment_color, const in vec3 normal_eye) {
    if (fract(4.0 * place_object.y) < 0.4)
        fragment_color.rgb = stripe_color;
}
