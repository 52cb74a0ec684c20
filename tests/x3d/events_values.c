/* Interpolators by hand-computed values, and lists of keys that nobody should write. */
#include "events_test.h"

/* A clock that is at `time / 10` between 0 and 10, and a node that it drives. */
#define DRIVEN(node)                                                                               \
    CLASSIC("DEF T TimeSensor { loop TRUE cycleInterval 10 } DEF I " node                          \
            " ROUTE T.fraction_changed TO I.set_fraction")

static const struct row {
    const char *what, *text;
    double time;
    const char *expected;
} rows[] = {
    {"scalar", DRIVEN("ScalarInterpolator { key [0 0.5 1] keyValue [1 3 0] }"), 2.5, "2"},
    {"scalar, second span", DRIVEN("ScalarInterpolator { key [0 0.5 1] keyValue [1 3 0] }"), 7.5,
     "1.5"},
    {"before the first key", DRIVEN("ScalarInterpolator { key [0.5 1] keyValue [1 3] }"), 2, "1"},
    {"behind the last key", DRIVEN("ScalarInterpolator { key [0 0.5] keyValue [1 3] }"), 8, "3"},
    {"a jump: the later value counts",
     DRIVEN("ScalarInterpolator { key [0 0.5 0.5 1] keyValue [0 1 5 6] }"), 5, "5"},
    {"before a jump", DRIVEN("ScalarInterpolator { key [0 0.5 0.5 1] keyValue [0 1 5 6] }"), 4,
     "0.8"},
    {"position", DRIVEN("PositionInterpolator { key [0 1] keyValue [0 1 2 10 0 2] }"), 5,
     "5 0.5 2"},
    {"position 2D", DRIVEN("PositionInterpolator2D { key [0 1] keyValue [0 1 10 0] }"), 5, "5 0.5"},
    {"coordinates",
     DRIVEN("CoordinateInterpolator { key [0 1] keyValue [0 0 0 1 1 1 2 0 0 1 3 1] }"), 5,
     "1 0 0 1 2 1"},
    {"coordinates 2D", DRIVEN("CoordinateInterpolator2D { key [0 1] keyValue [0 0 1 1 2 0 1 3] }"),
     5, "1 0 1 2"},
    {"vector", DRIVEN("VectorInterpolator { key [0 1] keyValue [0 1 2 10 11 12] }"), 5, "5 6 7"},
    /* red to blue: the shorter way round goes through magenta */
    {"colour, in HSV", DRIVEN("ColorInterpolator { key [0 1] keyValue [1 0 0 0 0 1] }"), 5,
     "1 0 1"},
    {"colour, a quarter", DRIVEN("ColorInterpolator { key [0 1] keyValue [1 0 0 0 0 1] }"), 2.5,
     "1 0 0.5"},
    /* hue 0 to 120 degrees, half as bright in the end */
    {"colour, value", DRIVEN("ColorInterpolator { key [0 1] keyValue [1 0 0 0 0.5 0] }"), 5,
     "0.75 0.75 0"},
    {"colour, from grey", DRIVEN("ColorInterpolator { key [0 1] keyValue [1 1 1 0 1 0] }"), 5,
     "0.5 1 0.5"},
    {"colour at a key", DRIVEN("ColorInterpolator { key [0 0.5] keyValue [1 0 0 0.1 0.2 0.3] }"), 5,
     "0.1 0.2 0.3"},
    {"colours", DRIVEN("ColorSetInterpolator { key [0 1] keyValue [1 0 0 0 1 0 0 0 1 0 1 0] }"), 5,
     "1 0 1 0 1 0"},
    {"orientation", DRIVEN("OrientationInterpolator { key [0 1] keyValue [0 1 0 0 0 1 0 2] }"), 5,
     "0 1 0 1"},
    {"orientation, shorter way",
     DRIVEN("OrientationInterpolator { key [0 1] keyValue [0 1 0 3 0 1 0 -3] }"), 5,
     "0 1 0 3.1416"},
    {"orientation, other axes",
     DRIVEN("OrientationInterpolator { key [0 1] keyValue [0 0 1 0 1 0 0 1.570796] }"), 5,
     "1 0 0 0.7854"},
    {"normals", DRIVEN("NormalInterpolator { key [0 1] keyValue [1 0 0 0 1 0] }"), 5,
     "0.7071 0.7071 0"},
    {"normals, a third", DRIVEN("NormalInterpolator { key [0 0.75] keyValue [1 0 0 0 1 0] }"), 2.5,
     "0.866 0.5 0"},
    {"orientation 2D", DRIVEN("OrientationInterpolator2D { key [0 1] keyValue [0 2] axis 0 1 0 }"),
     5, "0 1 0 1"},
    {"control points, a line",
     DRIVEN("CubicBezierPositionInterpolator { key [0 1] keyValue [0 0 0 4 8 0] controlPoints "
            "[0.25 0.25 0.75 0.75] }"),
     2.5, "1 2 0"},
    /* x = y by symmetry at the middle */
    {"control points, ease",
     DRIVEN("CubicBezierPositionInterpolator { key [0 1] keyValue [0 0 0 4 8 0] controlPoints "
            "[0.42 0 0.58 1] }"),
     5, "2 4 0"},
    /* half way between two keys at even distances: (-p0 + 9 p1 + 9 p2 - p3) / 16 */
    {"spline", DRIVEN("SplineScalarInterpolator { key [0 0.25 0.5 0.75] keyValue [0 1 4 2] }"),
     3.75, "2.6875"},
    /* an end without velocity: 0 there, (1 - 0) / 2 behind; p = (0 + 1) / 2 - t1 / 8 */
    {"spline, first span", DRIVEN("SplineScalarInterpolator { key [0 0.5 1] keyValue [0 1 1] }"),
     2.5, "0.4375"},
    {"spline with velocities",
     DRIVEN("SplineScalarInterpolator { key [0 1] keyValue [0 1] keyVelocity [4 0] }"), 5, "1"},
    {"spline with velocities of the length of the path",
     DRIVEN("SplineScalarInterpolator { key [0 1] keyValue [0 1] keyVelocity [4 0] "
            "normalizeVelocity TRUE }"),
     5, "0.625"},
    /* closed: before the first key comes the last but one, 1 and -1 */
    {"spline, closed",
     DRIVEN("SplineScalarInterpolator { key [0 0.25 0.5 0.75 1] keyValue [0 1 0 -1 0] closed TRUE "
            "}"),
     1.25, "0.625"},
    /* uneven keys: the speed is the same on both sides of a key, so that a line stays a line */
    {"spline on a line, uneven keys",
     DRIVEN(
         "SplineScalarInterpolator { key [0 0.2 0.8 1] keyValue [0 2 8 10] keyVelocity [2 4 4 2] "
         "}"),
     5, "5"},
    {"spline position",
     DRIVEN("SplinePositionInterpolator { key [0 0.25 0.5 0.75] keyValue [0 0 0 1 "
            "0 1 4 0 4 2 0 2] }"),
     3.75, "2.6875 0 2.6875"},
    {"spline position 2D",
     DRIVEN("SplinePositionInterpolator2D { key [0 0.25 0.5 0.75] keyValue [0 "
            "0 1 0 4 0 2 0] }"),
     3.75, "2.6875 0"},
    /* turns about one axis at even steps are even all the way */
    {"squad",
     DRIVEN("SquadOrientationInterpolator { key [0 0.25 0.5 0.75] keyValue [0 1 0 0 0 1 0 "
            "0.5 0 1 0 1 0 1 0 1.5] }"),
     3.75, "0 1 0 0.75"},
    {"squad at a key",
     DRIVEN("SquadOrientationInterpolator { key [0 0.5 1] keyValue [0 1 0 0 1 0 0 "
            "0.5 0 1 0 1] }"),
     5, "1 0 0 0.5"},
    {"sequence", DRIVEN("IntegerSequencer { key [0 0.5 0.75] keyValue [1 2 3] }"), 6, "2"},
    {"sequence, before the first key", DRIVEN("IntegerSequencer { key [0.5 0.75] keyValue [1 2] }"),
     1, "1"},
    {"sequence of bools", DRIVEN("BooleanSequencer { key [0 0.5] keyValue [FALSE TRUE] }"), 7, "1"},
    /* ---- What nobody should write ---- */
    {"no key", DRIVEN("ScalarInterpolator { }"), 5, "0"},
    {"no value", DRIVEN("ScalarInterpolator { key [0 1] }"), 5, "0"},
    {"fewer values than keys", DRIVEN("ScalarInterpolator { key [0 0.5 1] keyValue [1 3] }"), 10,
     "3"},
    {"more values than keys", DRIVEN("ScalarInterpolator { key [0 1] keyValue [1 3 9] }"), 5, "2"},
    {"too few coordinates", DRIVEN("CoordinateInterpolator { key [0 1] keyValue [1 2 3] }"), 5, ""},
    {"coordinates that do not divide",
     DRIVEN("CoordinateInterpolator { key [0 1] keyValue [0 0 0 2 2 2 9 9 9] }"), 5, "1 1 1"},
    {"keys out of order: some value between two of them",
     DRIVEN("ScalarInterpolator { key [0 0.9 0.1 1] keyValue [1 1 1 1] }"), 5, "1"},
    {"a rotation about nothing",
     DRIVEN("OrientationInterpolator { key [0 1] keyValue [0 0 0 1 0 0 0 2] }"), 5, "0 0 1 0"},
    {"sequence without values", DRIVEN("IntegerSequencer { key [0 0.5] }"), 6, "0"},
};

static void test_eases(void) {
    const char *text =
        CLASSIC("DEF T TimeSensor { loop TRUE cycleInterval 10 } DEF I EaseInEaseOut "
                "{ key [0 1] easeInEaseOut [0 0.5 0.5 0] } ROUTE "
                "T.fraction_changed TO I.set_fraction");
    const double times[] = {0, 2.5, 5, 7.5, 10};
    const char *expected[] = {"0", "0.125", "0.5", "0.875", "1"};
    for (size_t i = 0; i < 5; i++)
        check_at("ease in, ease out", text, times[i], "I.modifiedFraction_changed", expected[i]);
}

/* Numbers that are none come in through set fields. */
static void test_no_numbers(void) {
    plr_diags *diags;
    plr_scene *scene =
        parse_text(DRIVEN("ScalarInterpolator { key [0 0.2 0.5 1] keyValue [7 7 7 7] "
                          "}"),
                   "scene", &diags);
    plr_node *node = plr_scene_find(scene, "I"), *clock = plr_scene_find(scene, "T");
    const float keys[4] = {NAN, 0, NAN, INFINITY};
    plr_node_set(scene, node, "key", keys, 4);
    plr_scene_set_time(scene, 3, NULL, diags);
    check_field(scene, "keys that are no numbers", "I.value_changed", "7");
    const double cycles[] = {NAN, INFINITY, -1, 1e-300};
    for (size_t i = 0; i < 4; i++) {
        plr_node_set(scene, clock, "cycleInterval", &cycles[i], 1);
        const plr_field *fraction = plr_node_field(clock, "fraction_changed");
        plr_scene_set_time(scene, 3.5, NULL, diags);
        CHECK(fraction->value.floats[0] >= 0 && fraction->value.floats[0] <= 1);
    }
    const double times[] = {NAN, -5, 1e300, INFINITY};
    for (size_t i = 0; i < 4; i++)
        CHECK(plr_scene_set_time(scene, times[i], NULL, diags));
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

int main(void) {
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        check_at(rows[i].what, rows[i].text, rows[i].time, "I.value_changed", rows[i].expected);
    test_eases();
    test_no_numbers();
    return tap_done();
}
