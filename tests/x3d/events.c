/* Clocks, ROUTEs, the event utilities, binding, revisions. */
#include "events_test.h"

/* ---- TimeSensor ---- */

#define CLOCK(fields) CLASSIC("DEF T TimeSensor { " fields " }")

static void test_clocks(void) {
    const struct {
        const char *what, *text;
        double time;
        const char *path, *expected;
    } rows[] = {
        {"loop from load", CLOCK("cycleInterval 4 loop TRUE"), 1, "T.fraction_changed", "0.25"},
        {"loop from load", CLOCK("cycleInterval 4 loop TRUE"), 0, "T.fraction_changed", "0"},
        {"loop, second cycle", CLOCK("cycleInterval 4 loop TRUE"), 7, "T.fraction_changed", "0.75"},
        {"end of a cycle", CLOCK("cycleInterval 4 loop TRUE"), 8, "T.fraction_changed", "1"},
        {"loop", CLOCK("cycleInterval 4 loop TRUE"), 7, "T.elapsedTime", "7"},
        {"loop", CLOCK("cycleInterval 4 loop TRUE"), 7, "T.time", "7"},
        {"loop", CLOCK("cycleInterval 4 loop TRUE"), 7, "T.isActive", "1"},
        {"loop", CLOCK("cycleInterval 4 loop TRUE"), 7, "T.cycleTime", "4"},
        {"backwards", CLOCK("cycleInterval 4 loop TRUE fractionIncreasing FALSE"), 1,
         "T.fraction_changed", "0.75"},
        {"not started", CLOCK("startTime 2"), 1.5, "T.isActive", "0"},
        {"started", CLOCK("startTime 2 cycleInterval 2"), 3, "T.fraction_changed", "0.5"},
        {"over", CLOCK("startTime 2 cycleInterval 2"), 9, "T.fraction_changed", "1"},
        {"over", CLOCK("startTime 2 cycleInterval 2"), 9, "T.isActive", "0"},
        {"over", CLOCK("startTime 2 cycleInterval 2"), 9, "T.time", "4"},
        {"over at its end", CLOCK("startTime 2 cycleInterval 2"), 4, "T.isActive", "0"},
        {"over at its end", CLOCK("startTime 2 cycleInterval 2"), 4, "T.elapsedTime", "2"},
        {"began before load", CLOCK("startTime -1 cycleInterval 4"), 1, "T.fraction_changed",
         "0.5"},
        {"began before load, over", CLOCK("startTime -1 cycleInterval 4"), 9, "T.time", "3"},
        {"over before load", CLOCK("startTime -9 cycleInterval 4"), 1, "T.time", "0"},
        {"the default is long past", CLOCK("cycleInterval 4"), 1, "T.isActive", "0"},
        {"unless time begins at load",
         CLOCK("cycleInterval 4 } KambiNavigationInfo { timeOriginAtLoad TRUE"), 1,
         "T.fraction_changed", "0.25"},
        {"stopped", CLOCK("cycleInterval 4 loop TRUE stopTime 6"), 9, "T.fraction_changed", "0.5"},
        {"stopped", CLOCK("cycleInterval 4 loop TRUE stopTime 6"), 9, "T.isActive", "0"},
        {"stopTime before startTime", CLOCK("startTime 3 loop TRUE cycleInterval 4 stopTime 2"), 9,
         "T.elapsedTime", "6"},
        {"paused", CLOCK("loop TRUE cycleInterval 10 pauseTime 2"), 7, "T.elapsedTime", "2"},
        {"paused", CLOCK("loop TRUE cycleInterval 10 pauseTime 2"), 7, "T.isPaused", "1"},
        {"disabled", CLOCK("loop TRUE enabled FALSE"), 3, "T.isActive", "0"},
        {"no cycle", CLOCK("loop TRUE cycleInterval 0"), 3.25, "T.fraction_changed", "0.25"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        check_at(rows[i].what, rows[i].text, rows[i].time, rows[i].path, rows[i].expected);
}

/* Clocks that events start, stop, pause and resume. */
#define CHAIN                                                                                      \
    CLASSIC("DEF A TimeSensor { startTime 1.1 cycleInterval 1.5 }\n"                               \
            "DEF OVER BooleanFilter { } DEF WHEN TimeTrigger { }\n"                                \
            "DEF B TimeSensor { cycleInterval 4 }\n"                                               \
            "ROUTE A.isActive TO OVER.set_boolean\n"                                               \
            "ROUTE OVER.inputFalse TO WHEN.set_boolean\n"                                          \
            "ROUTE WHEN.triggerTime TO B.startTime\n")
#define PAUSES                                                                                     \
    CLASSIC("DEF A TimeSensor { loop TRUE cycleInterval 100 }\n"                                   \
            "DEF P TimeSensor { startTime 2 cycleInterval 3 }\n"                                   \
            "DEF F BooleanFilter { } DEF G TimeTrigger { } DEF H TimeTrigger { }\n"                \
            "ROUTE P.isActive TO F.set_boolean ROUTE F.inputTrue TO G.set_boolean\n"               \
            "ROUTE G.triggerTime TO A.pauseTime ROUTE F.inputFalse TO H.set_boolean\n"             \
            "ROUTE H.triggerTime TO A.resumeTime\n")
#define RESTART                                                                                    \
    CLASSIC("DEF A TimeSensor { startTime 1 cycleInterval 4 }\n"                                   \
            "DEF B TimeSensor { startTime 2 cycleInterval 1 }\n"                                   \
            "ROUTE B.cycleTime TO A.set_startTime\n")

static void test_chains(void) {
    check_at("a clock starts another", CHAIN, 2.59, "B.isActive", "0");
    check_at("a clock starts another", CHAIN, 2.6, "B.fraction_changed", "0");
    check_at("a clock starts another", CHAIN, 2.6, "B.isActive", "1");
    check_at("a clock starts another, exactly", CHAIN, 3.6, "B.elapsedTime", "1");
    check_at("paused by an event", PAUSES, 4, "A.elapsedTime", "2");
    check_at("resumed by an event", PAUSES, 9, "A.elapsedTime", "6");
    check_at("resumed by an event", PAUSES, 9, "A.isPaused", "0");
    check_at("a running clock keeps its start", RESTART, 4, "A.elapsedTime", "3");
    check_at("a running clock keeps its start", RESTART, 4, "A.startTime", "1");
}

/* ---- ROUTEs ---- */

static void test_routes(void) {
    check_at("forwarding",
             CLASSIC("DEF T TimeSensor { loop TRUE cycleInterval 10 } DEF A Material { } DEF B "
                     "Material { } DEF C Material { } ROUTE T.fraction_changed TO A.transparency "
                     "ROUTE A.transparency_changed TO B.set_transparency ROUTE B.transparency TO "
                     "C.transparency"),
             5, "C.transparency", "0.5");
    check_at("fan-out and fan-in, the last ROUTE stands",
             CLASSIC("DEF T TimeSensor { loop TRUE cycleInterval 10 } DEF A Material { } DEF I "
                     "ScalarInterpolator { key [0 1] keyValue [0 1] } DEF J ScalarInterpolator { "
                     "key [0 1] keyValue [1 0] } ROUTE T.fraction_changed TO I.set_fraction ROUTE "
                     "T.fraction_changed TO J.set_fraction ROUTE I.value_changed TO "
                     "A.transparency ROUTE J.value_changed TO A.transparency"),
             2, "A.transparency", "0.8");
    check_at("the clock that ended last stands",
             CLASSIC("DEF A TimeSensor { startTime 1 cycleInterval 6 fractionIncreasing FALSE } "
                     "DEF B TimeSensor { startTime 2 cycleInterval 2 } DEF M Material { "
                     "transparency 0.5 } ROUTE A.fraction_changed TO M.transparency ROUTE "
                     "B.fraction_changed TO M.transparency"),
             9, "M.transparency", "0");
    check_at("a ring ends",
             CLASSIC("DEF T TimeSensor { loop TRUE cycleInterval 10 } DEF A Material { } DEF B "
                     "Material { } ROUTE T.fraction_changed TO A.transparency ROUTE "
                     "A.transparency TO B.transparency ROUTE B.transparency TO A.transparency"),
             3, "A.transparency", "0.3");
    check_at("through a prototype",
             CLASSIC("PROTO Fade [ inputOutput SFFloat t 0.5 outputOnly SFFloat f ] { Group { } "
                     "DEF T TimeSensor { loop TRUE cycleInterval 10 fraction_changed IS f } DEF M "
                     "Material { transparency IS t } ROUTE T.fraction_changed TO M.transparency }\n"
                     "DEF F Fade { } DEF N Material { } ROUTE F.f TO N.transparency ROUTE F.t TO "
                     "N.shininess"),
             4, "N.transparency", "0.4");
    check_at("an exposed field of a prototype tells what is inside",
             CLASSIC("PROTO Fade [ inputOutput SFFloat t 0.5 ] { Group { } "
                     "DEF T TimeSensor { loop TRUE cycleInterval 10 } DEF M "
                     "Material { transparency IS t } ROUTE T.fraction_changed TO M.transparency }\n"
                     "DEF F Fade { } DEF N Material { } ROUTE F.t_changed TO N.shininess"),
             4, "N.shininess", "0.4");
    check_at("into declared fields",
             CLASSIC("DEF T TimeSensor { loop TRUE } DEF E Effect { inputOnly SFTime time "
                     "inputOutput SFFloat x 7 } ROUTE T.time TO E.time ROUTE T.fraction_changed "
                     "TO E.set_x"),
             2.5, "E.time", "2.5");
    check_at("a string",
             CLASSIC("DEF A WorldInfo { title \"first\" } DEF L LoadSensor { children "
                     "ImageTexture { url \"data:image/png,\" } } DEF S Switch { whichChoice 0 } "
                     "DEF I IntegerTrigger { integerKey 5 } ROUTE L.isLoaded TO I.set_boolean "
                     "ROUTE I.triggerValue TO S.whichChoice"),
             0, "S.whichChoice", "5");
}

/* ---- Event utilities ---- */

/* A pulse of one second every second from 1 on: TRUE at 1, 3, 5; FALSE at 2, 4, 6. */
#define PULSE                                                                                      \
    "DEF T TimeSensor { startTime 1 loop TRUE cycleInterval 2 }\n"                                 \
    "DEF Q BooleanSequencer { key [0 0.5] keyValue [TRUE FALSE] }\n"                               \
    "ROUTE T.fraction_changed TO Q.set_fraction\n"

static void test_utilities(void) {
    const char *toggle = CLASSIC(PULSE "DEF G BooleanToggle { } ROUTE Q.value_changed TO "
                                       "G.set_boolean");
    check_at("toggle", toggle, 0.5, "G.toggle", "0");
    check_at("toggle", toggle, 1.5, "G.toggle", "1");
    check_at("toggle", toggle, 2.75, "G.toggle", "1");
    check_at("toggle", toggle, 3.5, "G.toggle", "0");
    check_at("toggle", toggle, 5.5, "G.toggle", "1");
    const char *filter =
        CLASSIC(PULSE "DEF F BooleanFilter { } DEF A Switch { } ROUTE Q.value_changed TO "
                      "F.set_boolean DEF L TimeTrigger { } ROUTE F.inputNegate TO L.set_boolean");
    check_at("filter", filter, 2.5, "F.inputNegate", "1");
    check_at("filter", filter, 3.5, "F.inputNegate", "0");
    check_at("filter", filter, 3.5, "F.inputTrue", "1");
    const char *step = CLASSIC("DEF T TimeSensor { startTime 1 loop TRUE cycleInterval 2 }\n"
                               "DEF B BooleanTrigger { } DEF N IntegerSequencer { key [0 1 2] "
                               "keyValue [10 20 30] }\nROUTE T.cycleTime TO B.set_triggerTime "
                               "ROUTE B.triggerTrue TO N.next");
    check_at("sequencer, next", step, 1.5, "N.value_changed", "10");
    check_at("sequencer, next", step, 3.5, "N.value_changed", "20");
    check_at("sequencer, next, exactly", step, 5, "N.value_changed", "30");
    check_at("sequencer, next, around", step, 7.5, "N.value_changed", "10");
    const char *back = CLASSIC("DEF T TimeSensor { startTime 1 loop TRUE cycleInterval 2 }\n"
                               "DEF B BooleanTrigger { } DEF N IntegerSequencer { key [0 1 2] "
                               "keyValue [10 20 30] }\nROUTE T.cycleTime TO B.set_triggerTime "
                               "ROUTE B.triggerTrue TO N.previous");
    check_at("sequencer, previous", back, 1.5, "N.value_changed", "30");
    check_at("sequencer, previous", back, 5.5, "N.value_changed", "10");
    check_at("sequencer, previous, around", back, 7.5, "N.value_changed", "30");
    const char *toggler = CLASSIC(PULSE "DEF G Toggler { } ROUTE Q.value_changed TO G.toggle");
    check_at("toggler", toggler, 1.5, "G.notStatus", "0");
    check_at("toggler", toggler, 3.5, "G.status", "0");
    check_at("toggler", toggler, 3.5, "G.off", "1");
}

/* ---- Binding ---- */

static void test_binding(void) {
    const char *text = CLASSIC("DEF V Viewpoint { } DEF W Viewpoint { }\n"
                               "DEF T TimeSensor { startTime 2 cycleInterval 3 }\n"
                               "ROUTE T.isActive TO W.set_bind");
    check_at("the first is bound", text, 1, "V.isBound", "1");
    check_at("bound by an event", text, 3, "W.isBound", "1");
    check_at("bound by an event", text, 3, "V.isBound", "0");
    check_at("bound by an event", text, 3, "W.bindTime", "2");
    check_at("unbound: the one below", text, 6, "V.isBound", "1");
    check_at("unbound: the one below", text, 6, "W.isBound", "0");
    check_at("unbound: the one below", text, 6, "V.bindTime", "5");
}

/* ---- No memory of what was asked before; revisions ---- */

static void test_history(void) {
    plr_diags *diags;
    plr_scene *scene = parse_text(CLASSIC(PULSE "DEF G BooleanToggle { } ROUTE Q.value_changed TO "
                                                "G.set_boolean DEF M Material { } ROUTE "
                                                "T.fraction_changed TO M.transparency"),
                                  "scene", &diags);
    const double times[] = {5.5, 0, 3.5, 1.5, 5.5};
    const char *toggles[] = {"1", "0", "0", "1", "1"},
               *values[] = {"0.25", "0", "0.25", "0.25", "0.25"};
    for (size_t i = 0; i < sizeof times / sizeof *times; i++) {
        plr_scene_set_time(scene, times[i], NULL, diags);
        check_field(scene, "to and fro", "G.toggle", toggles[i]);
        check_field(scene, "to and fro", "M.transparency", values[i]);
    }
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

static void test_revisions(void) {
    plr_diags *diags;
    plr_scene *scene =
        parse_text(CLASSIC("DEF T TimeSensor { startTime 2 cycleInterval 2 } DEF M Material { "
                           "transparency 0.5 } DEF N Material { } ROUTE T.fraction_changed TO "
                           "M.transparency"),
                   "scene", &diags);
    plr_node *m = plr_scene_find(scene, "M"), *n = plr_scene_find(scene, "N");
    uint64_t before = plr_node_revision(m), other = plr_node_revision(n);
    uint64_t whole = plr_scene_revision(scene);
    plr_scene_set_time(scene, 1, NULL, diags);
    CHECK(plr_node_revision(m) == before && plr_scene_revision(scene) == whole);
    plr_scene_set_time(scene, 3.5, NULL, diags);
    CHECK(plr_node_revision(m) > before && plr_scene_revision(scene) > whole);
    before = plr_node_revision(m), whole = plr_scene_revision(scene);
    plr_scene_set_time(scene, 3.5, NULL, diags);
    CHECK(plr_node_revision(m) == before && plr_scene_revision(scene) == whole);
    plr_scene_set_time(scene, 0, NULL, diags);
    CHECK(plr_node_revision(m) > before);
    check_field(scene, "put back", "M.transparency", "0.5");
    CHECK(!plr_node_field(plr_scene_find(scene, "N"), "transparency")->given);
    CHECK(plr_node_revision(n) == other);
    float set = 0.75f;
    plr_node_set(scene, m, "transparency", &set, 1);
    before = plr_node_revision(m);
    plr_scene_set_time(scene, 0, NULL, diags);
    check_field(scene, "what a setter gave stays", "M.transparency", "0.75");
    CHECK(plr_node_revision(m) == before);
    plr_scene_set_time(scene, 3, NULL, diags);
    check_field(scene, "an event is stronger", "M.transparency", "0.5");
    plr_node_set(scene, m, "transparency", &set, 1);
    check_field(scene, "set while an event stands", "M.transparency", "0.75");
    before = plr_node_revision(m);
    plr_node_set(scene, m, "transparency", &set, 1);
    CHECK(plr_node_revision(m) == before);
    plr_scene_set_time(scene, 0, NULL, diags);
    check_field(scene, "and put back to it", "M.transparency", "0.75");
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

static void test_words(void) {
    plr_diags *diags;
    plr_scene *scene = parse_text(CLASSIC("DEF S Script { inputOnly SFTime t } DEF S2 Script { "
                                          "inputOnly SFTime t } DEF T TimeSensor { } ROUTE T.time "
                                          "TO S.t ROUTE T.time TO S2.t"),
                                  "scene", &diags);
    plr_scene_set_time(scene, 1, NULL, diags);
    plr_scene_set_time(scene, 2, NULL, diags);
    check_these_faults("a Script is told once", diags, "3:7 warning not-drawn\n");
    plr_scene_destroy(&scene);
    plr_diags_destroy(&diags);
}

int main(void) {
    test_clocks();
    test_chains();
    test_routes();
    test_utilities();
    test_binding();
    test_history();
    test_revisions();
    test_words();
    return tap_done();
}
