/* Colours fade towards their luminance (Rec. 709). */
uniform float amount = 0.85;

void PLUG_fragment_modify(inout vec4 fragment_color) {
    float grey = dot(fragment_color.rgb, vec3(0.2126, 0.7152, 0.0722));
    fragment_color.rgb = mix(fragment_color.rgb, vec3(grey), amount);
}
