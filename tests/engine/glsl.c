/* The front end: messages by line and word, linking, counting, hostile texts, threads. */
#include <pthread.h>
#include <unistd.h>

#include "engine/glsl.h"

#include "tests/tap.h"

static const char *const vertex = "#version 330 core\n"
                                  "out vec3 v;\n"
                                  "void main() { v = vec3(1); gl_Position = vec4(0); }\n";
static const char *const fragment = "#version 330 core\n"
                                    "in vec3 v;\n"
                                    "uniform float gain;\n"
                                    "out vec4 color;\n"
                                    "void main() { color = vec4(v, gain); }\n";

typedef struct checked {
    bool ok;
    plr_glsl_messages messages[PLR_STAGE_COUNT], link;
} checked;

static checked check(const char *vertex_text, const char *fragment_text) {
    const char *const texts[PLR_STAGE_COUNT] = {
        [PLR_VERTEX] = vertex_text, [PLR_FRAGMENT] = fragment_text};
    checked result;
    result.ok = plr_glsl_check(texts, result.messages, &result.link);
    return result;
}

static size_t finish(checked *result) {
    size_t count = result->link.count;
    for (int i = 0; i < PLR_STAGE_COUNT; i++) {
        count += result->messages[i].count;
        plr_glsl_messages_free(&result->messages[i]);
    }
    plr_glsl_messages_free(&result->link);
    return count;
}

static void test_good(void) {
    checked pair = check(vertex, fragment), alone = check(NULL, fragment), none = check(NULL, NULL);
    CHECK(pair.ok);
    CHECK_INT(finish(&pair), 0);
    CHECK(alone.ok);
    CHECK_INT(finish(&alone), 0);
    CHECK(none.ok);
    CHECK_INT(finish(&none), 0);
    checked es = check(NULL, "#version 300 es\nprecision highp float;\nout vec4 c;\n"
                             "void main() { c = vec4(1); }\n");
    CHECK(es.ok);
    finish(&es);
    checked newer = check(NULL, "#version 450 core\nout vec4 c;\nvoid main() { c = vec4(1); }\n");
    CHECK(newer.ok);
    finish(&newer);
}

static void test_errors(void) {
    static const struct {
        uint32_t line;
        const char *word;
    } expected[] = {{4, "densty"}, {5, NULL}, {6, "foo"}, {7, "other"}};
    checked result = check(vertex, "#version 330 core\n"
                                   "out vec4 c;\n"
                                   "void main() {\n"
                                   "    c = vec4(densty);\n"
                                   "    float x = vec2(1);\n"
                                   "    foo(3);\n"
                                   "    other = 1; }\n");
    const plr_glsl_messages *messages = &result.messages[PLR_FRAGMENT];
    CHECK(!result.ok);
    CHECK_INT(messages->count, 4);
    for (size_t i = 0; i < 4 && i < messages->count; i++) {
        const plr_glsl_message *m = &messages->items[i];
        CHECK_INT(m->severity, PLR_ERROR);
        CHECK_INT(m->line, expected[i].line);
        if (expected[i].word)
            CHECK_STR(m->word, expected[i].word);
    }
    CHECK_STR(messages->items[0].text, "'densty' : undeclared identifier");
    CHECK_INT(result.messages[PLR_VERTEX].count, 0);
    CHECK_INT(result.link.count, 0);
    finish(&result);
}

static void test_linking(void) {
    checked types = check(vertex, "#version 330 core\nin vec4 v;\nout vec4 c;\n"
                                  "void main() { c = v; }\n");
    CHECK(!types.ok);
    CHECK_INT(types.messages[PLR_FRAGMENT].count, 0);
    CHECK_INT(types.link.count, 1);
    CHECK(types.link.count && strstr(types.link.items[0].text, "Types must match"));
    finish(&types);
    checked empty = check(NULL, "");
    CHECK(!empty.ok);
    CHECK(empty.link.count == 1 && strstr(empty.link.items[0].text, "entry point"));
    finish(&empty);
}

/* A text that would make a reader recurse deeply: `head`, `count` times `part`, `tail`. */
static char *repeat(const char *head, const char *part, int count, const char *tail) {
    size_t length = strlen(part);
    char *text = malloc(strlen(head) + length * (size_t)count + strlen(tail) + 1);
    if (!text)
        abort();
    char *at = strcpy(text, head) + strlen(head);
    for (int i = 0; i < count; i++, at += length)
        memcpy(at, part, length);
    strcpy(at, tail);
    return text;
}

static void test_hostile(void) {
    static const char main_head[] = "#version 330 core\nout vec4 c;\nvoid main() {\nfloat a = 1.0;";
    static const struct {
        const char *head, *part, *tail;
    } texts[] = {
        {"c = vec4(a\n", "+a", "); }\n"},
        {"a = 1.0\n", ", a = 2.0", "; }\n"},
        {"c = vec4(\n", "(", "\n"},
        {"c = vec4(\n", "- ", "1); }\n"},
        {"c = vec4(\n", "!", "1); }\n"},
        {"\n", "{", "\n"},
        {"\n", "if (a > 0.0) a = 2.0; else ", "; }\n"},
        {"\n#if ", "(", "1\n#endif\n}\n"},
        {"\n#if ", "!", "1\n#endif\n}\n"},
        {"\n#if ", "- ", "1\n#endif\n}\n"},
        {"\n#if 1", " + 1", "\n#endif\n}\n"},
        {"\n", "#if 1\n", "}\n"},
        {"\n#define A +a+a+a+a+a+a+a+a+a+a+a+a+a+a+a+a\nc = vec4(a\n", "A ", "); }\n"},
        {"c = vec4(a\n", ".xxxx", "); }\n"},
        {"c = vec4(a\n", "[0]", "); }\n"},
        {"c = vec4(a\n", "> 0.0 ? 1.0 : a", "); }\n"},
        {"a\n", "= a", "; }\n"},
        {"c = vec4(a\n", "+ max(a, a)", "); }\n"},
        {"c = vec4(a\n", "+ a + a + a + a + a + a + a + a + a + a + a + a + a + max(a, a", "\n"},
        {"c = vec4(a\n", "/**/+/*(*/a//)\n", "); }\n"},
        {"\n/*", "(", "\n"},
        {"\nstruct S ", "{ struct T ", "\n"},
        {"\n", "while (true) ", "; }\n"},
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        char head[512];
        snprintf(head, sizeof head, "%s%s", main_head, texts[i].head);
        char *text = repeat(head, texts[i].part, 40000, texts[i].tail);
        checked result = check(NULL, text);
        printf("# %.*s x 40000: %s\n", (int)strcspn(texts[i].part, "\n"), texts[i].part,
               result.messages[PLR_FRAGMENT].count ? result.messages[PLR_FRAGMENT].items[0].text
                                                   : "fine");
        CHECK(result.ok == (finish(&result) == 0));
        free(text);
    }
    /* What an author may well write is no hostile text. */
    char *sum = repeat(main_head, "a += 1.0; c += vec4(a) * 2.0 + vec4(1.0); ", 20000, "}\n");
    checked fine = check(NULL, sum);
    CHECK(fine.ok);
    finish(&fine);
    free(sum);
    char *array = repeat("#version 330 core\nout vec4 c; const float t[] = float[](1.0", ", 2.0",
                         8191, ");\nvoid main() { c = vec4(t[int(c.x)]); }\n");
    fine = check(NULL, array);
    CHECK(fine.ok);
    finish(&fine);
    free(array);
    char *calls =
        repeat(main_head, "c += max(vec4(a + a), -c.xyzw) * (a - 1.0) + vec4(-1.0, -2.0, a, a);\n",
               5000, "}\n");
    fine = check(NULL, calls);
    CHECK(fine.ok);
    finish(&fine);
    free(calls);
    char *terms = repeat(main_head, "a = a", 1, "");
    char *long_sum = repeat(terms, "+a", 1900, "; c = vec4(a); }\n");
    fine = check(NULL, long_sum);
    CHECK(fine.ok);
    finish(&fine);
    free(terms);
    free(long_sum);
}

static void test_place_of_limit(void) {
    char *text = repeat(
        "#version 330 core\nout vec4 c;\n// ((((\nvoid main() {\nfloat a = 1.0;\nc = vec4(a\n",
        "+\na", 100000, "); }\n");
    checked result = check(NULL, text);
    CHECK(!result.ok);
    CHECK_INT(result.messages[PLR_FRAGMENT].count, 1);
    CHECK(result.messages[PLR_FRAGMENT].items[0].line > 1000);
    CHECK(strstr(result.messages[PLR_FRAGMENT].items[0].text, "more than") != NULL);
    finish(&result);
    free(text);
}

#define SAMPLING                                                                                   \
    "#version 330 core\n"                                                                          \
    "uniform sampler2D ramp;\n"                                                                    \
    "uniform sampler3D voxels;\n"                                                                  \
    "in vec3 p;\n"                                                                                 \
    "out vec4 c;\n"

static void test_counting(void) {
    uint32_t few = 0, more = 0, unused = 0, fetches = 0;
    CHECK(plr_glsl_count(SAMPLING "void main() { c = vec4(p, 1.0); }\n", PLR_FRAGMENT, &few,
                         &fetches));
    CHECK_INT(fetches, 0);
    CHECK(few >= 3 && few < 10); /* load, construct, store, return */
    CHECK(plr_glsl_count(SAMPLING "void main() { c = vec4(0.0);\n"
                                  "for (int i = 0; i < 9; i++)\n"
                                  "    c += texture(ramp, texture(voxels, p * float(i)).xy);\n"
                                  "c += texelFetch(ramp, ivec2(0), 0) + textureLod(voxels, p, 0.0);"
                                  "}\n",
                         PLR_FRAGMENT, &more, &fetches));
    CHECK_INT(fetches, 4);
    CHECK(more > few + 10);
    CHECK(plr_glsl_count(SAMPLING "vec4 f() { return texture(ramp, p.xy) * 3.0; }\n"
                                  "void main() { c = vec4(p, 1.0); }\n",
                         PLR_FRAGMENT, &unused, &fetches));
    CHECK_INT(unused, few);
    CHECK_INT(fetches, 0);
    CHECK(plr_glsl_count(vertex, PLR_VERTEX, &few, &fetches));
    CHECK(!plr_glsl_count(SAMPLING "void main() { c = nothing; }\n", PLR_FRAGMENT, &few, &fetches));
    CHECK_INT(few, 0);
    CHECK(!plr_glsl_count("#version 120\nvoid main() { gl_FragColor = vec4(1.0); }\n", PLR_FRAGMENT,
                          &few, &fetches));
    CHECK(!plr_glsl_count("/* #version 330 */ void main() {}", PLR_FRAGMENT, &few, &fetches));
    CHECK(!plr_glsl_count("", PLR_FRAGMENT, &few, &fetches));
    CHECK(!plr_glsl_count("#version 300 es\nvoid main() {}\n", PLR_FRAGMENT, &few, &fetches));
}

typedef struct fetched {
    char text[512];
} fetched;

static void note_fetch(void *user, uint32_t line, const char *sampler) {
    fetched *f = user;
    size_t length = strlen(f->text);
    snprintf(f->text + length, sizeof f->text - length, "%u %s\n", (unsigned)line,
             sampler ? sampler : "?");
}

/* Functions called twice fetch twice, with the line where the fetch stands. */
static void test_fetches(void) {
    fetched f = {""};
    CHECK(plr_glsl_fetches(SAMPLING "vec4 at(vec3 q) {\n"
                                    "    return texture(voxels, q);\n"
                                    "}\n"
                                    "vec4 unused() { return texture(ramp, p.xy); }\n"
                                    "vec4 of(sampler2D s) { return texelFetch(s, ivec2(0), 0); }\n"
                                    "void main() {\n"
                                    "    c = at(p) + at(-p);\n"
                                    "    c += of(ramp);\n"
                                    "}\n",
                           PLR_FRAGMENT, note_fetch, &f));
    CHECK_STR(f.text, "7 voxels\n7 voxels\n10 ramp\n");
    f.text[0] = 0;
    CHECK(plr_glsl_fetches(SAMPLING "void main() { c = vec4(p, 1.0); }\n", PLR_FRAGMENT, note_fetch,
                           &f));
    CHECK(
        !plr_glsl_fetches(SAMPLING "void main() { c = nothing; }\n", PLR_FRAGMENT, note_fetch, &f));
    CHECK_STR(f.text, "");
}

static void *work(void *user) {
    bool *works = user;
    for (int i = 0; i < 30 && *works; i++) {
        uint32_t instructions, fetches;
        checked good = check(vertex, fragment), bad = check(vertex, "#version 330\nfloat x = y;\n");
        *works = good.ok && !bad.ok && finish(&good) == 0 && finish(&bad) == 1 &&
                 plr_glsl_count(fragment, PLR_FRAGMENT, &instructions, &fetches) && !fetches;
    }
    return NULL;
}

static void test_threads(void) {
    enum {
        COUNT = 4
    };
    pthread_t threads[COUNT];
    bool works[COUNT];
    for (int i = 0; i < COUNT; i++) {
        works[i] = true;
        pthread_create(&threads[i], NULL, work, &works[i]);
    }
    for (int i = 0; i < COUNT; i++) {
        pthread_join(threads[i], NULL);
        CHECK(works[i]);
    }
}

/* The front end prints nothing, whatever it is given: standard output is a file meanwhile. */
static void test_silence(void) {
    FILE *file = tmpfile();
    fflush(stdout);
    int kept = dup(STDOUT_FILENO), kept_error = dup(STDERR_FILENO);
    dup2(fileno(file), STDOUT_FILENO);
    dup2(fileno(file), STDERR_FILENO);
    static const char *const texts[] = {"", "#version 999\nvoid main() {}", "#version 120\nx",
                                        "#version 330\n#error no\n", "#version 300 es\nx"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        uint32_t instructions, fetches;
        checked result = check(NULL, texts[i]);
        finish(&result);
        plr_glsl_count(texts[i], PLR_FRAGMENT, &instructions, &fetches);
    }
    fflush(NULL);
    dup2(kept, STDOUT_FILENO);
    dup2(kept_error, STDERR_FILENO);
    close(kept);
    close(kept_error);
    fseek(file, 0, SEEK_END);
    CHECK_INT(ftell(file), 0);
    fclose(file);
}

int main(void) {
    test_threads(); /* first, so that they meet at making the tables */
    test_good();
    test_errors();
    test_linking();
    test_counting();
    test_fetches();
    test_silence();
    test_place_of_limit();
    test_hostile();
    return tap_done();
}
