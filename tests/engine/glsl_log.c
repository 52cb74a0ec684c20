/* Reading info logs of several compilers. */
#include "engine/glsl_log.h"

#include "tests/tap.h"

static plr_glsl_messages read_log(const char *log) {
    plr_glsl_messages messages;
    plr_glsl_parse_log(log, &messages);
    return messages;
}

typedef struct expectation {
    plr_severity severity;
    uint32_t line, column;
    const char *text, *word;
} expectation;

static void expect(const char *name, const char *log, size_t count, const expectation *expected) {
    plr_glsl_messages messages = read_log(log);
    printf("# %s\n", name);
    CHECK_INT(messages.count, count);
    for (size_t i = 0; i < count && i < messages.count; i++) {
        const plr_glsl_message *m = &messages.items[i];
        CHECK_INT(m->severity, expected[i].severity);
        CHECK_INT(m->line, expected[i].line);
        CHECK_INT(m->column, expected[i].column);
        CHECK_STR(m->text, expected[i].text);
        if (expected[i].word)
            CHECK_STR(m->word, expected[i].word);
        else
            CHECK(m->word == NULL);
    }
    plr_glsl_messages_free(&messages);
    CHECK(messages.items == NULL && messages.count == 0);
}

static void test_glslang(void) {
    static const expectation places[] = {
        {PLR_ERROR, 4, 0, "'densty' : undeclared identifier", "densty"},
        {PLR_ERROR, 5, 0, "'=' :  cannot convert from ' const 2-component vector of float'", NULL},
        {PLR_ERROR, 6, 0, "'' :  syntax error, unexpected end of file", NULL},
        {PLR_WARNING, 16, 0, "'a__b' : reserved", "a__b"},
        {PLR_ERROR, 0, 0, "version not supported", NULL},
        {PLR_ERROR, 0, 0, "no line", NULL},
    };
    expect("glslang",
           "ERROR: 0:4: 'densty' : undeclared identifier\n"
           "ERROR: 0:5: '=' :  cannot convert from ' const 2-component vector of float'\n"
           "ERROR: 0:6: '' :  syntax error, unexpected end of file\r\n"
           "WARNING: 0:16: 'a__b' : reserved\n"
           "ERROR: version not supported\n"
           "ERROR: 0:?: no line\n"
           "ERROR: 6 compilation errors.  No code generated.\n\n\n",
           6, places);
    static const expectation linking[] = {
        {PLR_ERROR, 0, 0,
         "Linking vertex and fragment stages: Types must match: vertex stage: \" vec3 v\" "
         "fragment stage: \" vec4 v\"",
         NULL},
        {PLR_ERROR, 0, 0, "Linking fragment stage: Missing entry point", NULL},
    };
    expect("glslang, linking",
           "ERROR: Linking vertex and fragment stages: Types must match:\n"
           "    vertex stage: \" vec3 v\"\n"
           "    fragment stage: \" vec4 v\"\n\n"
           "ERROR: Linking fragment stage: Missing entry point\n",
           2, linking);
}

static void test_mesa(void) {
    static const expectation expected[] = {
        {PLR_ERROR, 7, 12, "`densty' undeclared", "densty"},
        {PLR_WARNING, 8, 3, "`x' used uninitialized", "x"},
        {PLR_ERROR, 9, 2,
         "no matching function for call to `foo(vec2)'; candidates are: float foo(float) "
         "float foo(int)",
         "foo"},
        {PLR_ERROR, 10, 4, "syntax error, unexpected '}', expecting ',' or ';'", NULL},
        {PLR_ERROR, 11, 1, "#error stop", NULL},
        {PLR_ERROR, 0, 0, "fragment shader input `v' has no matching output", "v"},
    };
    expect("Mesa",
           "0:7(12): error: `densty' undeclared\n"
           "0:8(3): warning: `x' used uninitialized\n"
           "0:9(2): error: no matching function for call to `foo(vec2)'; candidates are:\n"
           "0:9(2): error:    float foo(float)\n"
           "0:9(2): error:    float foo(int)\n"
           "0:10(4): error: syntax error, unexpected '}', expecting ',' or ';'\n"
           "0:11(1): preprocessor error: #error stop\n"
           "error: fragment shader input `v' has no matching output\n",
           6, expected);
}

static void test_nvidia(void) {
    static const expectation expected[] = {
        {PLR_ERROR, 7, 0, "C1008: undefined variable \"densty\"", "densty"},
        {PLR_WARNING, 8, 0, "C7050: \"x\" might be used before being initialized", "x"},
        {PLR_ERROR, 9, 0, "C0000: syntax error, unexpected '}' at token \"}\"", NULL},
        {PLR_ERROR, 0, 0, "\"v\" not declared as an output from the previous stage", "v"},
    };
    expect("NVIDIA",
           "Fragment info\n"
           "-------------\n"
           "0(7) : error C1008: undefined variable \"densty\"\n"
           "0(8) : warning C7050: \"x\" might be used before being initialized\n"
           "0(9) : error C0000: syntax error, unexpected '}' at token \"}\"\n"
           "error: \"v\" not declared as an output from the previous stage\n",
           4, expected);
}

static void test_odd(void) {
    static const expectation odd[] = {
        {PLR_ERROR, 0, 0, "Something else happened: 12", NULL},
        {PLR_ERROR, UINT32_MAX, 0, "far", NULL},
        {PLR_ERROR, 0, 0, "0:7(", NULL},
        {PLR_ERROR, 0, 0, "0:-3: below", NULL},
        {PLR_ERROR, 3, 0, "'f(' : open", "f"},
    };
    expect("odd lines",
           "Something else happened:\t12\n"
           "ERROR: 0:99999999999999999999: far\n"
           "0:7(\n"
           "ERROR: 0:-3: below\n"
           "ERROR: 0:3: 'f(' : open",
           5, odd);
    expect("nothing", "", 0, NULL);
    expect("no log", NULL, 0, NULL);
    expect("blank", "\n \r\n\t\n----\n", 0, NULL);
}

/* Every prefix of a log is a log: nothing is read past its end (seen by the sanitizers). */
static void test_prefixes(void) {
    static const char log[] = "0:7(12): error: `densty' undeclared\nERROR: 0:4: 'x' : no\n"
                              "0(7) : error C1008: undefined \"y\"\n    more\n";
    size_t most = 0;
    for (size_t length = 0; length < sizeof log; length++) {
        char *copy = malloc(length + 1);
        memcpy(copy, log, length);
        copy[length] = 0;
        plr_glsl_messages messages = read_log(copy);
        most = messages.count > most ? messages.count : most;
        plr_glsl_messages_free(&messages);
        free(copy);
    }
    CHECK_INT(most, 3);
}

static void test_sort(void) {
    plr_glsl_messages messages = read_log("0:9(1): error: a\n0:2(5): error: b\n0:9(1): error: c\n"
                                          "error: d\n0:2(1): error: e\n");
    char order[16] = "";
    plr_glsl_messages_sort(&messages);
    for (size_t i = 0; i < messages.count; i++)
        strcat(order, messages.items[i].text);
    CHECK_STR(order, "dbeac");
    plr_glsl_messages_free(&messages);
}

static void test_many(void) {
    enum {
        COUNT = 20000
    };
    char *log = malloc(COUNT * 32), *at = log;
    for (int i = 0; i < COUNT; i++)
        at += sprintf(at, "ERROR: 0:%d: 'x%d' : no\n", i + 1, i);
    plr_glsl_messages messages = read_log(log);
    CHECK_INT(messages.count, COUNT);
    CHECK_INT(messages.items[COUNT - 1].line, COUNT);
    CHECK_STR(messages.items[COUNT - 1].word, "x19999");
    plr_glsl_messages_free(&messages);
    free(log);
}

int main(void) {
    test_glslang();
    test_mesa();
    test_nvidia();
    test_odd();
    test_prefixes();
    test_sort();
    test_many();
    return tap_done();
}
