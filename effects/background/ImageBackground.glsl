/* One picture over the whole viewport. Extension: `texCoords` are the coordinates at the viewport's
 * corners, from the lower left one against the clock; `color` is multiplied with the picture, and
 * stands alone where there is none. */

#if HAS_IMAGE
uniform sampler2D self; /* of the node in the field texture */
#endif
uniform vec4 color = vec4(1.0);
uniform vec2 texCoords[4];

void PLUG_background_color(inout vec4 behind, const in vec3 direction_eye, const in vec2 place) {
    behind = color;
#if HAS_IMAGE
    vec2 coord = mix(mix(texCoords[0], texCoords[1], place.x),
                     mix(texCoords[3], texCoords[2], place.x), place.y);
    behind *= textureLod(self, coord, 0.0);
#endif
}
