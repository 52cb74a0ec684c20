/* Where rays meet opaque geometry. */
#include "reference.h"

#include <math.h>
#include <string.h>

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static const double ROUNDING = 1e-12;

static double meet_plane(const double plane[4], const double origin[3], const double way[3],
                         bool *grazes) {
    double growth = dot(plane, way), at = dot(plane, origin) + plane[3];
    *grazes |= growth == 0 && fabs(at) < ROUNDING;
    return growth != 0 ? -at / growth : INFINITY;
}

static double meet_sphere(const double numbers[4], const double origin[3], const double way[3],
                          bool *grazes) {
    double away[3];
    for (int i = 0; i < 3; i++)
        away[i] = origin[i] - numbers[i];
    double a = dot(way, way), b = dot(away, way), c = dot(away, away) - numbers[3] * numbers[3];
    double discriminant = b * b - a * c;
    *grazes |= fabs(discriminant) < ROUNDING * b * b;
    return discriminant >= 0 ? (-b - sqrt(discriminant)) / a : INFINITY;
}

static double meet_box(const double numbers[6], const double origin[3], const double way[3],
                       bool *grazes) {
    double enter = -INFINITY, leave = INFINITY;
    bool along = false;
    for (int i = 0; i < 3; i++) {
        double low = numbers[i] - origin[i], high = numbers[3 + i] - origin[i];
        if (way[i] == 0) {
            along |= fmin(fabs(low), fabs(high)) < ROUNDING;
            if (low > 0 || high < 0)
                leave = -INFINITY;
            continue;
        }
        enter = fmax(enter, fmin(low / way[i], high / way[i]));
        leave = fmin(leave, fmax(low / way[i], high / way[i]));
    }
    *grazes |= along || fabs(leave - enter) < ROUNDING * (1 + fabs(enter));
    return enter <= leave ? enter : INFINITY;
}

static double meet_parallelogram(const double numbers[9], const double origin[3],
                                 const double way[3], bool *grazes) {
    const double *u = numbers + 3, *v = numbers + 6;
    double normal[4] = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                        u[0] * v[1] - u[1] * v[0]};
    normal[3] = -dot(normal, numbers);
    double t = meet_plane(normal, origin, way, grazes), at[3];
    if (!isfinite(t))
        return INFINITY;
    for (int i = 0; i < 3; i++)
        at[i] = origin[i] + t * way[i] - numbers[i];
    double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), au = dot(at, u), av = dot(at, v);
    double p = (au * vv - av * uv) / (uu * vv - uv * uv);
    double q = (av * uu - au * uv) / (uu * vv - uv * uv);
    double inside = fmin(fmin(p, 1 - p), fmin(q, 1 - q));
    *grazes |= fabs(inside) < ROUNDING;
    return inside >= 0 ? t : INFINITY;
}

static double (*const meetings[])(const double *, const double[3], const double[3], bool *) = {
    [REF_PLANE] = meet_plane,
    [REF_SPHERE] = meet_sphere,
    [REF_BOX] = meet_box,
    [REF_PARALLELOGRAM] = meet_parallelogram,
};

double ref_solids_meet(const ref_scene *scene, const double origin[3], const double way[3],
                       double start, double limit, double color[3], bool *uncertain) {
    *uncertain = false;
    for (size_t i = 0; i < scene->solid_count; i++) {
        const ref_solid *solid = &scene->solids[i];
        double place[3], along[3];
        ref_matrix_point(solid->to_own, origin, 1, place);
        ref_matrix_point(solid->to_own, way, 0, along);
        double t = meetings[solid->kind](solid->numbers, place, along, uncertain);
        if (t > start && t < limit) {
            limit = t;
            memcpy(color, solid->color, sizeof solid->color);
        }
    }
    return limit;
}
