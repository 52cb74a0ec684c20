/* Light does not reach the lower side: a simple ambient occlusion by height. */
varying vec3 place_object;

void PLUG_material_occlusion(inout vec4 color) {
    color.rgb *= smoothstep(-1.2, 0.6, place_object.y);
}
