/* Compiled programs: from the compiler, memory and disk; damaged and foreign files; the limit. */
#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <plugray/engine.h>

#include "engine/cache.h"
#include "engine/cache_folder.h"
#include "tests/engine/triangle.h"
#include "tests/tap.h"

static char folder[] = "/tmp/plugray-cache-XXXXXX";
static char deep[256]; /* a folder in it that does not exist yet */

static const char *const triangle[PLR_STAGE_COUNT] = {
    [PLR_VERTEX] = triangle_vertex, [PLR_FRAGMENT] = triangle_fragment};

/* What a cache of its own did for one program, which is drawn with. */
static plr_cache_stats use(const plr_gl *gl, const char *path) {
    static const float color[4] = {0.25f, 2, 3, 1};
    plr_glsl_messages messages[PLR_STAGE_COUNT], link;
    float pixels[TRIANGLE_SIZE * TRIANGLE_SIZE * 4];
    plr_framebuffer framebuffer;
    plr_cache *cache = plr_cache_create(gl, path);
    GLuint program = plr_cache_program(cache, triangle, messages, &link);
    CHECK(program != 0);
    CHECK_INT(plr_cache_program(cache, triangle, messages, &link), program);
    CHECK_INT(plr_cache_get_stats(cache).from_memory, 1);
    CHECK(plr_framebuffer_create(&framebuffer, gl, TRIANGLE_SIZE, TRIANGLE_SIZE, NULL));
    plr_framebuffer_bind(&framebuffer);
    triangle_draw(gl, program, color);
    CHECK(plr_framebuffer_read(&framebuffer, pixels) && triangle_is(pixels, color));
    plr_framebuffer_destroy(&framebuffer);
    plr_cache_stats stats = plr_cache_get_stats(cache);
    plr_cache_destroy(&cache);
    CHECK(cache == NULL && !gl->IsProgram(program));
    return stats;
}

/* The only file of the folder `deep`. */
static const char *only_file(void) {
    static char path[1024];
    size_t count = 0;
    DIR *directory = opendir(deep);
    for (struct dirent *entry; directory && (entry = readdir(directory));)
        if (entry->d_name[0] != '.') {
            snprintf(path, sizeof path, "%s/%s", deep, entry->d_name);
            count++;
        }
    if (directory)
        closedir(directory);
    return count == 1 ? path : NULL;
}

/* Changes one byte of a file; `at` < 0 counts from the end. */
static void damage(const char *path, long at) {
    FILE *file = fopen(path, "r+b");
    fseek(file, at, at < 0 ? SEEK_END : SEEK_SET);
    int c = fgetc(file);
    fseek(file, -1, SEEK_CUR);
    fputc(c ^ 0x40, file);
    fclose(file);
}

static void test_disk(const plr_gl *gl) {
    plr_cache_stats stats = use(gl, deep);
    CHECK_INT(stats.compiled, 1);
    CHECK_INT(stats.from_disk, 0);
    const char *path = only_file();
    CHECK(path != NULL);
    stats = use(gl, deep);
    CHECK_INT(stats.compiled, 0);
    CHECK_INT(stats.from_disk, 1);
    /* The version, the key, the digest, the format, the first and the last byte of the binary. */
    static const long places[] = {7, 8, 40, 72, 76, -1};
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        damage(path, places[i]);
        stats = use(gl, deep);
        CHECK_INT(stats.compiled, 1);
        stats = use(gl, deep);
        CHECK_INT(stats.from_disk, 1);
    }
    static const off_t lengths[] = {0, 5, 76, 100};
    for (size_t i = 0; i < sizeof lengths / sizeof lengths[0]; i++) {
        CHECK(!truncate(path, lengths[i]));
        CHECK_INT(use(gl, deep).compiled, 1);
    }
    CHECK_INT(use(gl, deep).from_disk, 1);
    CHECK(only_file() != NULL);
}

/* A file that is sound for us but not for the driver. */
static void test_driver_refuses(const plr_gl *gl) {
    const char *path = only_file();
    uint8_t key[PLR_SHA256_SIZE];
    for (int i = 0; path && i < PLR_SHA256_SIZE; i++) {
        unsigned value = 0;
        sscanf(strrchr(path, '/') + 1 + 2 * i, "%2x", &value);
        key[i] = (uint8_t)value;
    }
    plr_cache_folder f;
    CHECK(plr_cache_folder_open(&f, deep, 1 << 20));
    plr_cache_folder_store(&f, key, 0x1234, "nonsense", 8);
    plr_cache_folder_close(&f);
    CHECK_INT(use(gl, deep).compiled, 1);
    CHECK_INT(gl->GetError(), GL_NO_ERROR);
    CHECK_INT(use(gl, deep).from_disk, 1);
}

static void test_no_disk(const plr_gl *gl) {
    CHECK_INT(use(gl, NULL).compiled, 1);
    CHECK_INT(use(gl, "/dev/null/none").compiled, 1);
    CHECK_INT(use(gl, "").compiled, 1);
}

static void test_messages(const plr_gl *gl) {
    static const char *const bad[PLR_STAGE_COUNT] = {
        [PLR_VERTEX] = triangle_vertex,
        [PLR_FRAGMENT] = "#version 330 core\nout vec4 c;\nvoid main() {\nc = densty;\n}\n"};
    static const char *const unlinked[PLR_STAGE_COUNT] = {
        [PLR_VERTEX] = "#version 330 core\nout vec3 shade;\n"
                       "void main() { shade = vec3(1.0); gl_Position = vec4(1.0); }\n",
        [PLR_FRAGMENT] = "#version 330 core\nin vec4 shade;\nout vec4 c;\n"
                         "void main() { c = shade; }\n"};
    plr_glsl_messages messages[PLR_STAGE_COUNT], link;
    plr_cache *cache = plr_cache_create(gl, deep);
    CHECK_INT(plr_cache_program(cache, bad, messages, &link), 0);
    CHECK(messages[PLR_FRAGMENT].count >= 1);
    CHECK_INT(messages[PLR_FRAGMENT].items[0].line, 4);
    CHECK_STR(messages[PLR_FRAGMENT].items[0].word, "densty");
    CHECK_INT(messages[PLR_VERTEX].count, 0);
    CHECK_INT(link.count, 0);
    plr_glsl_messages_free(&messages[PLR_FRAGMENT]);
    CHECK_INT(plr_cache_program(cache, unlinked, messages, &link), 0);
    CHECK_INT(messages[PLR_FRAGMENT].count, 0);
    CHECK(link.count >= 1 && strstr(link.items[0].text, "shade") != NULL);
    plr_glsl_messages_free(&link);
    CHECK_INT(plr_cache_get_stats(cache).compiled, 0);
    plr_cache_destroy(&cache);
}

/* More programs than the first table holds; each stays what it is. */
static void test_many(const plr_gl *gl) {
    enum {
        COUNT = 80
    };
    GLuint programs[COUNT];
    bool same = true;
    plr_glsl_messages messages[PLR_STAGE_COUNT], link;
    plr_cache *cache = plr_cache_create(gl, NULL);
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < COUNT; i++) {
            char text[256];
            snprintf(text, sizeof text, "#version 330\nout vec4 c;void main() { c = vec4(%d); }\n",
                     i);
            const char *const texts[PLR_STAGE_COUNT] = {
                [PLR_VERTEX] = triangle_vertex, [PLR_FRAGMENT] = text};
            GLuint program = plr_cache_program(cache, texts, messages, &link);
            same = same && program && (pass == 0 || program == programs[i]);
            programs[i] = program;
        }
    CHECK(same);
    CHECK_INT(plr_cache_get_stats(cache).compiled, COUNT);
    CHECK_INT(plr_cache_get_stats(cache).from_memory, COUNT);
    plr_cache_destroy(&cache);
}

/* ---- The folder, without GL ---- */

static bool has(plr_cache_folder *f, uint8_t number) {
    const uint8_t key[PLR_SHA256_SIZE] = {number};
    plr_buffer binary = {0};
    uint32_t format = 0;
    bool found = plr_cache_folder_load(f, key, &format, &binary);
    found = found && binary.length == 1000 && format == 0x80000000u + number &&
            binary.data[999] == number;
    plr_buffer_free(&binary);
    return found;
}

static void put(plr_cache_folder *f, uint8_t number) {
    const uint8_t key[PLR_SHA256_SIZE] = {number};
    unsigned char data[1000];
    memset(data, number, sizeof data);
    plr_cache_folder_store(f, key, 0x80000000u + number, data, sizeof data);
}

/* Sets when a file was used last, so that the test need not wait. */
static void set_age(const char *path, uint8_t number, time_t seconds) {
    char file[512];
    const struct timespec times[2] = {{seconds, 0}, {seconds, 0}};
    snprintf(file, sizeof file, "%s/%02x%062d.program", path, number, 0);
    CHECK(!utimensat(AT_FDCWD, file, times, 0));
}

static void test_limit(void) {
    char path[256], other[300];
    plr_cache_folder f;
    snprintf(path, sizeof path, "%s/limit", folder);
    CHECK(plr_cache_folder_open(&f, path, 3300)); /* room for three of 1076 bytes */
    snprintf(other, sizeof other, "%s/unrelated", path);
    CHECK_INT(plr_file_write(other, path, sizeof path), 0);
    for (uint8_t i = 1; i <= 3; i++) {
        put(&f, i);
        set_age(path, i, 1000 + i);
    }
    CHECK(has(&f, 1)); /* which makes it the youngest */
    put(&f, 4);
    CHECK(!has(&f, 2));
    CHECK(has(&f, 1) && has(&f, 3) && has(&f, 4));
    plr_cache_folder_close(&f);
    /* Another process finds what is there, and keeps to the limit too. */
    CHECK(plr_cache_folder_open(&f, path, 3300));
    set_age(path, 1, 1000);
    put(&f, 5);
    CHECK(!has(&f, 1));
    CHECK(has(&f, 5) && has(&f, 4) && has(&f, 3));
    /* What is larger than all the room is not kept, and drives nothing out. */
    unsigned char large[4000] = {0};
    const uint8_t key[PLR_SHA256_SIZE] = {9};
    plr_cache_folder_store(&f, key, 1, large, sizeof large);
    CHECK(has(&f, 5) && has(&f, 4) && has(&f, 3));
    for (uint8_t i = 3; i <= 5; i++) {
        const uint8_t old[PLR_SHA256_SIZE] = {i};
        plr_cache_folder_remove(&f, old);
        CHECK(!has(&f, i));
    }
    plr_cache_folder_close(&f);
    CHECK(!unlink(other));
    CHECK(!rmdir(path));
}

static void test_sha256(void) {
    static const struct {
        const char *text;
        int times;
        const char *digest; /* FIPS 180-4 examples, and the million of 'a' */
    } vectors[] = {
        {"", 1, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"},
        {"abc", 1, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"},
        {"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq", 1,
         "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"},
        {"aaaaaaaaaa", 100000, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0"},
    };
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0]; i++) {
        plr_sha256 hash;
        uint8_t digest[PLR_SHA256_SIZE];
        char hex[2 * PLR_SHA256_SIZE + 1];
        plr_sha256_start(&hash);
        for (int j = 0; j < vectors[i].times; j++)
            plr_sha256_add(&hash, vectors[i].text, strlen(vectors[i].text));
        plr_sha256_finish(&hash, digest);
        for (int j = 0; j < PLR_SHA256_SIZE; j++)
            sprintf(hex + 2 * j, "%02x", digest[j]);
        CHECK_STR(hex, vectors[i].digest);
    }
}

int main(void) {
    plr_gl gl;
    if (!mkdtemp(folder))
        return 1;
    snprintf(deep, sizeof deep, "%s/a/b", folder);
    test_sha256();
    test_limit();
    for (int backend = PLR_BACKEND_EGL; backend <= PLR_BACKEND_OSMESA; backend++) {
        plr_context *context = plr_context_create((plr_backend)backend, NULL);
        if (!context || plr_gl_load(&gl, plr_context_get_proc_address, context)) {
            TAP_SKIP("the cache in one kind of context", "no such context");
            continue;
        }
        GLint formats = 0;
        gl.GetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
        test_no_disk(&gl);
        test_messages(&gl);
        test_many(&gl);
        if (formats > 0 && gl.GetProgramBinary) {
            test_disk(&gl);
            test_driver_refuses(&gl);
            unlink(only_file());
        } else {
            TAP_SKIP("programs on disk", "the driver has no program binaries");
        }
        plr_context_destroy(&context);
    }
    rmdir(deep);
    *strrchr(deep, '/') = 0;
    rmdir(deep);
    CHECK(!rmdir(folder));
    return tap_done();
}
