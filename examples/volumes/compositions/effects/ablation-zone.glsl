/* One zone of ablation: an ellipsoid of revolution around its applicator. For the plug of ablation.glsl. */

uniform vec3 center;                /* in the volume's own coordinates */
uniform vec3 axis = vec3(0.0, 0.0, 1.0);
uniform vec2 radii = vec2(0.02);    /* along the axis, across */

void PLUG_ablation_zone(inout float nearest, const in vec3 place) {
    vec3 from = place - center;
    float along = dot(from, normalize(axis));
    float across = sqrt(max(dot(from, from) - along * along, 0.0));
    nearest = min(nearest, length(vec2(along / radii.x, across / radii.y)));
}
