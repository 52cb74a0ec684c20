/* Waves from a book of sixteen normal maps, a page after the other. */

uniform sampler2D book;
uniform float time = 0.0;
uniform float size = 2.0; /* of a page on the water */

vec3 page_normal(float page, vec2 place) {
    page = mod(page, 16.0);
    vec2 inside = fract(place / size) * (62.0 / 64.0) + 1.0 / 64.0;
    vec2 corner = vec2(mod(page, 4.0), 3.0 - floor(page / 4.0));
    return 2.0 * texture2D(book, (corner + inside) / 4.0).rgb - 1.0;
}

void PLUG_water_normal(inout vec3 normal_object, const in vec2 place) {
    float page = 8.0 * time;
    vec3 n = mix(page_normal(floor(page), place), page_normal(floor(page) + 1.0, place), fract(page));
    normal_object = normalize(vec3(n.x, n.z, -n.y));
}
