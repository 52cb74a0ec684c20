/* Where a ray crosses surfaces of equal value, one after the other. A unit of effects that have a ray
 * (ray_origin, ray_direction, value_at), voxels (grid.glsl) and surfaces (levels.glsl).
 *
 * Along a ray, trilinear values are a cubic in each cell of voxels (Parker et al., Visualization '98).
 * Four values make it; it is monotone between its extrema, and where two of these lie on two sides of a
 * surface, there is one crossing between them: none is missed, none is found twice. Values that an
 * author's effect has changed are no cubics: they are compared at the ends of steps.
 *
 * Loops test at their top alone, and only what earlier rounds have left: the software renderer of Mesa
 * 22 may else read after a loop what later rounds of neighbouring pixels have computed. */

const float FAR_VALUE = 3.0e38;
const int MOST_CELLS = 1 << 20; /* of a ray, or steps */

float way_start; /* t, and where that is in the box */
vec3 way_position;
float way_length;
float cell_start; /* of the cell, or step: behind way_start */
float cell_length;
float bracket_start; /* in the cell, which is from 0 to 1: what is not looked at yet begins here */
int surfaces_below;  /* the value there is between two surfaces */
float level_below;
float level_above;
int event_surface; /* of the last crossing */
#if PLUG_USED(volume_sample)
float cell_value; /* at its start and end */
float cell_value_end;
#else
vec4 cubic;
vec3 node; /* the extrema in the cell, and its end, and the values there */
vec3 node_value;
vec3 way_speed; /* in voxels */
vec3 face;      /* of cells, the next along the ray, in voxels from where it starts */
#endif

void set_neighbours() {
    level_below = surfaces_below > 0 ? surfaces[surfaces_below - 1].x : -FAR_VALUE;
    level_above = surfaces_below < surfaceCount ? surfaces[surfaces_below].x : FAR_VALUE;
}

/* Goes through the surface that is next where the value is `value`; what level it has. */
float pass_surface(const in float value) {
    bool up = value >= level_above;
    float level = up ? level_above : level_below;
    event_surface = up ? surfaces_below : surfaces_below - 1;
    surfaces_below += up ? 1 : -1;
    set_neighbours();
    return level;
}

bool is_beyond(const in float value) {
    return value >= level_above || value < level_below;
}

#if PLUG_USED(volume_sample)
void begin_cells(const in float value) {
    cell_value = cell_value_end = value;
}

bool cell_has_event() {
    return is_beyond(cell_value_end);
}

void next_cell(const in float step_length) {
    cell_start += cell_length;
    cell_length = min(step_length, way_length - cell_start);
    bracket_start = 0.0;
    cell_value = cell_value_end;
    cell_value_end = value_at(way_start + cell_start + cell_length);
}

/* The Illinois method (Dowell and Jarratt, BIT 11, 1971), which never leaves the bracket. */
float find_in_cell() {
    float level = pass_surface(cell_value_end);
    float a = bracket_start, b = 1.0;
    float fa = cell_value - level, fb = cell_value_end - level;
    for (int i = 0; i < 12 && fa != fb && abs(b - a) > 1.0e-6; i++) {
        float c = b - fb * (b - a) / (fb - fa);
        float fc = value_at(way_start + cell_start + c * cell_length) - level;
        bool other_side = (fc < 0.0) != (fb < 0.0);
        a = other_side ? b : a;
        fa = other_side ? fb : 0.5 * fa;
        b = c;
        fb = fc;
    }
    bracket_start = b; /* what follows lies behind */
    cell_value = level;
    return b;
}
#else
void begin_cells(const in float value) {
    node = vec3(1.0);
    node_value = vec3(value);
    way_speed = ray_direction * voxel_count();
    vec3 at = way_position * voxel_count() - 0.5;
    bvec3 forward = greaterThan(way_speed, vec3(0.0));
    face = mix(ceil(at) - 1.0, floor(at) + 1.0, forward) - at;
}

float cubic_value(const in float u) {
    return ((cubic.w * u + cubic.z) * u + cubic.y) * u + cubic.x;
}

/* Through four values at 0, 1/3, 2/3 and 1: of differences, so that what is constant stays so. */
vec4 cubic_through(const in vec4 values) {
    vec3 d = values.yzw - values.x;
    return vec4(values.x, 9.0 * d.x - 4.5 * d.y + d.z, -22.5 * d.x + 18.0 * d.y - 4.5 * d.z,
                13.5 * (d.x - d.y) + 4.5 * d.z);
}

void find_nodes(const in float value_end) {
    vec2 inside = vec2(1.0);
    float discriminant = cubic.z * cubic.z - 3.0 * cubic.y * cubic.w;
    if (discriminant > 0.0) {
        float q = -(cubic.z + (cubic.z < 0.0 ? -1.0 : 1.0) * sqrt(discriminant));
        float a = q / (3.0 * cubic.w), b = cubic.y / q;
        inside = vec2(a > 0.0 && a < 1.0 ? a : 1.0, b > 0.0 && b < 1.0 ? b : 1.0);
    }
    node = vec3(min(inside.x, inside.y), max(inside.x, inside.y), 1.0);
    node_value = vec3(node.x < 1.0 ? cubic_value(node.x) : value_end,
                      node.y < 1.0 ? cubic_value(node.y) : value_end, value_end);
}

bool cell_has_event() {
    return is_beyond(node_value.x) || is_beyond(node_value.y) || is_beyond(node_value.z);
}

vec3 face_distances() {
    return mix(face / way_speed, vec3(NOWHERE), equal(way_speed, vec3(0.0)));
}

float way_value(const in float distance) {
    return scalar_at(way_position + distance * ray_direction);
}

void next_cell(const in float step_length) {
    cell_start += cell_length;
    vec3 distances = face_distances();
    float end = min(min(distances.x, distances.y), min(distances.z, way_length));
    cell_length = max(end - cell_start, 0.0);
    bracket_start = 0.0;
    face += mix(vec3(0.0), sign(way_speed), lessThanEqual(distances, vec3(end)));
    float third = cell_length / 3.0;
    float value_end = way_value(cell_start + cell_length);
    cubic = cubic_through(vec4(node_value.z, way_value(cell_start + third),
                               way_value(cell_start + 2.0 * third), value_end));
    find_nodes(value_end);
}

/* Nearer to where the cubic, which rises in the bracket (or, with `up` -1, falls), is 0: Euler's method,
 * exact for squares, held in the bracket. Five of these leave an error of floats alone. */
float refine(const in float u, const in vec4 f, const in float up, inout float a, inout float b) {
    float value = up * (((f.w * u + f.z) * u + f.y) * u + f.x);
    float slope = up * ((3.0 * f.w * u + 2.0 * f.z) * u + f.y);
    float bend = up * (6.0 * f.w * u + 2.0 * f.z);
    a = value < 0.0 ? u : a;
    b = value < 0.0 ? b : u;
    float next = u - 2.0 * value / (slope + sqrt(max(slope * slope - 2.0 * value * bend, 0.0)));
    return next >= a && next <= b ? next : 0.5 * (a + b);
}

/* The next crossing of the cell. */
float find_in_cell() {
    bool first = is_beyond(node_value.x), second = is_beyond(node_value.y);
    float a = first ? bracket_start : second ? node.x : node.y;
    float b = first ? node.x : second ? node.y : node.z;
    float value = first ? node_value.x : second ? node_value.y : node_value.z;
    float up = value >= level_above ? 1.0 : -1.0;
    vec4 f = cubic;
    f.x -= pass_surface(value);
    float u = 0.5 * (a + b);
    u = refine(u, f, up, a, b);
    u = refine(u, f, up, a, b);
    u = refine(u, f, up, a, b);
    u = refine(u, f, up, a, b);
    u = refine(u, f, up, a, b);
    bracket_start = u; /* what follows lies behind */
    node.x = first ? node.x : second ? node.y : node.z;
    node.y = first || second ? node.y : node.z;
    node_value.x = value;
    node_value.y = first || second ? node_value.y : node_value.z;
    return u;
}
#endif

/* From one t to another. */
void begin_way(const in float from, const in float to) {
    way_start = from;
    way_position = ray_origin + from * ray_direction;
    way_length = to - from;
    cell_start = 0.0;
    cell_length = 0.0;
    bracket_start = 1.0;
    float value = value_at(from);
    surfaces_below = count_below(value);
    set_neighbours();
    begin_cells(value);
}

float find_any_crossing(const in float step_length) {
    for (int i = 0; i < MOST_CELLS && !cell_has_event() && cell_start + cell_length < way_length; i++)
        next_cell(step_length);
    if (!cell_has_event())
        return NOWHERE;
    float u = find_in_cell();
    return way_start + min(cell_start + u * cell_length, way_length);
}

/* The next crossing, NOWHERE behind the last. Where values are compared at the ends of steps, these are
 * as long as `step_length`. */
float next_crossing(const in float step_length) {
    float t = find_any_crossing(step_length);
#if defined(GIVEN_surfaceTolerance)
    while (t < NOWHERE && !is_steep(ray_origin + t * ray_direction))
        t = find_any_crossing(step_length);
#endif
    return t;
}
