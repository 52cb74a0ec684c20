/* Sensors of the environment, the matrices of the camera, and graphs that nobody should write. */
#include <time.h>

#include "events_test.h"

/* At `place`, turned by `angle` around the y axis; its picture is a square of 90 degrees. */
static plr_viewer viewer_at(const double place[3], double angle) {
    double c = cos(angle), s = sin(angle), x = place[0], y = place[1], z = place[2];
    return (plr_viewer){
        .eye_to_world = {c, 0, -s, 0, 0, 1, 0, 0, s, 0, c, 0, x, y, z, 1},
        .world_to_eye = {c, 0, s, 0, 0, 1, 0, 0, -s, 0, c, 0, s * z - c * x, -y, -s * x - c * z, 1},
        .projection = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, -1, 0, 0, -2, 0}};
}

static plr_scene *scene_seen(const char *text, double time, const plr_viewer *viewer) {
    plr_diags *diags;
    plr_scene *scene = parse_text(text, "scene", &diags);
    plr_scene_set_time(scene, time, viewer, diags);
    check_these_faults("sensors", diags, "");
    plr_diags_destroy(&diags);
    return scene;
}

static void test_proximity(void) {
    const char *text =
        CLASSIC("Transform { translation 1 0 0 rotation 0 1 0 1.570796 scale 2 2 2 children [\n"
                "DEF P ProximitySensor { center 0 0 0 size 4 4 4 } ] }\n"
                "DEF S ProximitySensor { size 0 0 0 } DEF OFF ProximitySensor { size 9 9 9 "
                "enabled FALSE }\n"
                "DEF V Viewpoint { centerOfRotation 1 0 -2 }");
    plr_viewer viewer = viewer_at((double[]){3, 1, 0}, 0);
    plr_scene *scene = scene_seen(text, 4, &viewer);
    check_field(scene, "inside", "P.isActive", "1");
    check_field(scene, "inside", "P.position_changed", "0 0.5 1");
    check_field(scene, "inside", "P.orientation_changed", "0 -1 0 1.5708");
    check_field(scene, "inside", "P.centerOfRotation_changed", "1 0 0");
    check_field(scene, "a size of 0 senses nothing", "S.isActive", "0");
    check_field(scene, "not enabled", "OFF.isActive", "0");
    viewer = viewer_at((double[]){6, 1, 0}, 0);
    plr_scene_set_time(scene, 4, &viewer, NULL);
    check_field(scene, "outside", "P.isActive", "0");
    plr_scene_set_time(scene, 4, NULL, NULL);
    check_field(scene, "nobody looks", "P.isActive", "0");
    plr_scene_destroy(&scene);
}

/* A clock that a huge sensor starts: it runs from the time of loading. */
static void test_started_at_load(void) {
    const char *text = CLASSIC("DEF P ProximitySensor { size 1000 1000 1000 }\n"
                               "DEF T TimeSensor { cycleInterval 10 }\n"
                               "ROUTE P.enterTime TO T.startTime");
    plr_viewer viewer = viewer_at((double[]){0, 0, 10}, 0);
    plr_scene *scene = scene_seen(text, 0, &viewer);
    check_field(scene, "started at load", "T.isActive", "1");
    plr_scene_set_time(scene, 2.5, &viewer, NULL);
    check_field(scene, "started at load", "T.elapsedTime", "2.5");
    plr_scene_destroy(&scene);
}

/* The sensor is carried to the viewer at time 5 and past him at 7. */
static void test_carried_sensor(void) {
    const char *text = CLASSIC("DEF T TimeSensor { loop TRUE cycleInterval 100 }\n"
                               "DEF I PositionInterpolator { key [0 1] keyValue [0 0 0 100 0 0] }\n"
                               "DEF M Transform { children DEF P ProximitySensor { size 2 2 2 } }\n"
                               "DEF C TimeSensor { cycleInterval 50 }\n"
                               "ROUTE T.fraction_changed TO I.set_fraction\n"
                               "ROUTE I.value_changed TO M.translation\n"
                               "ROUTE P.enterTime TO C.startTime ROUTE P.exitTime TO C.stopTime");
    plr_viewer viewer = viewer_at((double[]){6, 0, 0}, 0);
    plr_scene *scene = scene_seen(text, 4.9, &viewer);
    check_field(scene, "carried there", "P.isActive", "0");
    plr_scene_set_time(scene, 6.5, &viewer, NULL);
    check_field(scene, "carried there", "P.isActive", "1");
    check_field(scene, "carried there", "P.enterTime", "5");
    check_field(scene, "carried there", "C.elapsedTime", "1.5");
    plr_scene_set_time(scene, 9, &viewer, NULL);
    check_field(scene, "carried past", "P.isActive", "0");
    check_field(scene, "carried past", "P.exitTime", "7.0313"); /* the next tick after 7 */
    check_field(scene, "carried past", "C.isActive", "0");
    plr_scene_destroy(&scene);
}

static void test_others(void) {
    const char *text =
        CLASSIC("DEF A VisibilitySensor { center 0 0 -5 size 1 1 1 }\n"
                "DEF B VisibilitySensor { center 0 0 5 size 1 1 1 }\n"
                "DEF C VisibilitySensor { center 9 0 -5 size 1 1 1 }\n"
                "Transform { translation 5 0 0 children DEF X TransformSensor { size 4 4 4 "
                "targetObject DEF G Transform { translation 1 0 0 rotation 0 0 1 0.5 } } }");
    plr_viewer viewer = viewer_at((double[]){0, 0, 0}, 0);
    plr_scene *scene = scene_seen(text, 1, &viewer);
    check_field(scene, "in sight", "A.isActive", "1");
    check_field(scene, "behind", "B.isActive", "0");
    check_field(scene, "beside", "C.isActive", "0");
    check_field(scene, "a target", "X.position_changed", "1 0 0");
    check_field(scene, "a target", "X.orientation_changed", "0 0 1 0.5");
    viewer = viewer_at((double[]){0, 0, 0}, 3.141592653589793);
    plr_scene_set_time(scene, 1, &viewer, NULL);
    check_field(scene, "turned around", "A.isActive", "0");
    check_field(scene, "turned around", "B.isActive", "1");
    plr_scene_destroy(&scene);
}

/* 5 from the centre as the tree counts: 10 in the world. It tells at first, and when it changes. */
static void test_octants(void) {
    const char *text =
        CLASSIC("Transform { translation 1 0 0 scale 2 2 2 children DEF O OctTree { center 0 0 1 "
                "range 5 highRes DEF G Group { } } }\n"
                "DEF FAR OctTree { range 0 } DEF S Group { visible FALSE }\n"
                "DEF T TimeSensor { cycleInterval 10 } DEF B BooleanFilter { } DEF C TimeTrigger { "
                "}\n"
                "ROUTE O.lowResActive TO G.visible ROUTE O.lowResActive TO B.set_boolean\n"
                "ROUTE O.lowResActive TO S.bboxDisplay\n"
                "ROUTE B.inputTrue TO C.set_boolean ROUTE C.triggerTime TO T.startTime");
    plr_viewer viewer = viewer_at((double[]){1, 0, 11.9}, 0);
    plr_scene *scene = scene_seen(text, 3, &viewer);
    check_field(scene, "near", "O.lowResActive", "0");
    check_field(scene, "it tells at first", "G.visible", "0");
    check_field(scene, "a range of 0", "FAR.lowResActive", "1");
    check_field(scene, "near", "T.isActive", "0");
    viewer = viewer_at((double[]){1, 0, 12}, 0);
    plr_scene_set_time(scene, 3, &viewer, NULL);
    check_field(scene, "far", "O.lowResActive", "1");
    check_field(scene, "far", "G.visible", "1");
    check_field(scene, "far", "S.bboxDisplay", "1");
    check_field(scene, "far from the start, and told no more", "T.elapsedTime", "3");
    plr_scene_set_time(scene, 3, NULL, NULL);
    check_field(scene, "nobody looks", "FAR.lowResActive", "0");
    plr_scene_destroy(&scene);
}

/* The tree moves away from the viewer, 5 at time 5. */
static void test_octants_move(void) {
    const char *text =
        CLASSIC("DEF T TimeSensor { loop TRUE cycleInterval 100 }\n"
                "DEF I PositionInterpolator { key [0 1] keyValue [0 0 0 100 0 0] }\n"
                "DEF M Transform { children DEF O OctTree { range 5 } }\n"
                "DEF C TimeSensor { cycleInterval 50 } DEF G TimeTrigger { } DEF F BooleanFilter { "
                "}\n"
                "ROUTE T.fraction_changed TO I.set_fraction ROUTE I.value_changed TO "
                "M.translation\n"
                "ROUTE O.lowResActive TO F.set_boolean ROUTE F.inputTrue TO G.set_boolean\n"
                "ROUTE G.triggerTime TO C.startTime");
    plr_viewer viewer = viewer_at((double[]){0, 0, 0}, 0);
    plr_scene *scene = scene_seen(text, 4.9, &viewer);
    check_field(scene, "still near", "O.lowResActive", "0");
    check_field(scene, "still near", "C.isActive", "0");
    plr_scene_set_time(scene, 9, &viewer, NULL);
    check_field(scene, "gone", "O.lowResActive", "1");
    check_field(scene, "when it went", "C.elapsedTime", "4");
    plr_scene_destroy(&scene);
}

static void test_camera(void) {
    const char *text =
        CLASSIC("DEF V Viewpoint { } DEF W Viewpoint { } DEF E Effect { inputOnly SFMatrix4f m "
                "inputOnly SFMatrix3f r } ROUTE V.cameraMatrix TO E.m ROUTE "
                "V.cameraRotationInverseMatrix TO E.r");
    plr_viewer viewer = viewer_at((double[]){1, 2, 3}, 1.5707963267948966);
    plr_scene *scene = scene_seen(text, 0, &viewer);
    /* rows: (x y z) of the world is (-z + 3, y - 2, x - 1) of the eye */
    check_field(scene, "rows", "E.m", "0 0 -1 3 0 1 0 -2 1 0 0 -1 0 0 0 1");
    check_field(scene, "rows", "V.cameraInverseMatrix", "0 0 1 1 0 1 0 2 -1 0 0 3 0 0 0 1");
    check_field(scene, "rows", "E.r", "0 0 1 0 1 0 -1 0 0");
    check_field(scene, "the other is not used", "W.cameraMatrix",
                "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1");
    viewer.viewpoint = plr_scene_find(scene, "W");
    plr_scene_set_time(scene, 0, &viewer, NULL);
    check_field(scene, "another is asked for", "W.isBound", "1");
    check_field(scene, "another is asked for", "V.isBound", "0");
    check_field(scene, "another is asked for", "E.m", "0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0");
    plr_scene_destroy(&scene);
}

/* ---- Costs ---- */

static double seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Every node tells every other one; and clocks that start each other without end. */
static void test_hostile(void) {
    enum {
        NODES = 150
    };
    char *text = malloc(4000000), *at = text;
    at +=
        sprintf(at, "#X3D V3.3 utf8\nPROFILE Full\nDEF T TimeSensor { loop TRUE cycleInterval 1e-9 "
                    "}\nDEF C TimeSensor { cycleInterval 1e-9 } DEF F BooleanFilter { } DEF G "
                    "TimeTrigger { } ROUTE T.cycleTime TO C.startTime ROUTE C.isActive TO "
                    "F.set_boolean ROUTE F.inputFalse TO G.set_boolean ROUTE G.triggerTime TO "
                    "C.startTime\n");
    for (int i = 0; i < NODES; i++)
        at += sprintf(at, "DEF M%d Material { }\n", i);
    at += sprintf(at, "ROUTE T.fraction_changed TO M0.transparency\n");
    for (int i = 0; i < NODES; i++)
        for (int k = 0; k < NODES; k++)
            at += sprintf(at, "ROUTE M%d.transparency TO M%d.transparency\n", i, k);
    plr_diags *diags;
    plr_scene *scene = parse_text(text, "scene", &diags);
    double start = seconds();
    CHECK(plr_scene_set_time(scene, 1e9, NULL, diags));
    double spent = seconds() - start;
    TAP_RESULT(spent < 10, "%d ROUTEs in rings, and a thousand million seconds: %.1f s",
               NODES * NODES, spent);
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
    free(text);
}

int main(void) {
    test_proximity();
    test_started_at_load();
    test_carried_sensor();
    test_others();
    test_octants();
    test_octants_move();
    test_camera();
    test_hostile();
    return tap_done();
}
