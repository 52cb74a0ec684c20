#include "engine/cache.h"

#include <stdlib.h>
#include <string.h>

#include "engine/cache_folder.h"

/* A program in memory; program 0: a free slot. */
typedef struct slot {
    uint8_t key[PLR_SHA256_SIZE];
    GLuint program;
    plr_defaults *defaults;
} slot;

struct plr_cache {
    const plr_gl *gl;
    plr_sha256 driver; /* the beginning of every key */
    plr_cache_folder folder;
    bool on_disk;
    slot *slots; /* open addressing; the size is a power of two, at most half of it is used */
    size_t size, count;
    plr_cache_stats stats;
};

static const size_t folder_limit = (size_t)64 << 20;

/* Changes with everything that a stored program depends on and its texts do not tell. */
static const char key_format[] = "plugray program 1";

/* ---- In memory ---- */

static slot *find(slot *slots, size_t size, const uint8_t key[PLR_SHA256_SIZE]) {
    size_t at;
    memcpy(&at, key, sizeof at); /* the key is a hash: any part of it will do */
    for (at &= size - 1; slots[at].program; at = (at + 1) & (size - 1))
        if (memcmp(slots[at].key, key, PLR_SHA256_SIZE) == 0)
            break;
    return &slots[at];
}

static bool grow(plr_cache *cache) {
    size_t size = cache->size * 2;
    slot *slots = calloc(size, sizeof *slots);
    if (!slots)
        return false;
    for (size_t i = 0; i < cache->size; i++)
        if (cache->slots[i].program)
            *find(slots, size, cache->slots[i].key) = cache->slots[i];
    free(cache->slots);
    cache->slots = slots;
    cache->size = size;
    return true;
}

/* ---- Keys ---- */

/* With its length, so that no two lists of texts give the same bytes. */
static void add_text(plr_sha256 *hash, const char *text) {
    uint64_t length = text ? strlen(text) : UINT64_MAX;
    plr_sha256_add(hash, &length, sizeof length);
    if (text)
        plr_sha256_add(hash, text, (size_t)length);
}

static void start_key(plr_cache *cache) {
    static const GLenum names[] = {GL_VENDOR, GL_RENDERER, GL_VERSION};
    plr_sha256_start(&cache->driver);
    add_text(&cache->driver, key_format);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        add_text(&cache->driver, (const char *)cache->gl->GetString(names[i]));
}

static void make_key(const plr_cache *cache, const char *const texts[PLR_STAGE_COUNT],
                     uint8_t key[PLR_SHA256_SIZE]) {
    plr_sha256 hash = cache->driver;
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++)
        add_text(&hash, texts[stage]);
    plr_sha256_finish(&hash, key);
}

/* ---- Compiling ---- */

static const GLenum shader_kinds[PLR_STAGE_COUNT] = {
    [PLR_VERTEX] = GL_VERTEX_SHADER,
    [PLR_GEOMETRY] = GL_GEOMETRY_SHADER,
    [PLR_FRAGMENT] = GL_FRAGMENT_SHADER,
};

typedef void(APIENTRY *log_getter)(GLuint object, GLsizei size, GLsizei *length, GLchar *log);

/* The messages of a log; a failure without any gets one. */
static void take_log(log_getter get, GLuint object, GLint length, plr_glsl_messages *messages) {
    char *log = length > 0 ? calloc((size_t)length + 1, 1) : NULL;
    if (log)
        get(object, length, NULL, log);
    plr_glsl_parse_log(log, messages);
    free(log);
    if (!messages->count)
        plr_glsl_parse_log("error: the driver refuses this without saying why", messages);
}

static GLuint compile(const plr_gl *gl, GLenum kind, const char *text,
                      plr_glsl_messages *messages) {
    GLuint shader = gl->CreateShader(kind);
    GLint compiled = 0, length = 0;
    gl->ShaderSource(shader, 1, &text, NULL);
    gl->CompileShader(shader);
    gl->GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled)
        return shader;
    gl->GetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
    take_log(gl->GetShaderInfoLog, shader, length, messages);
    gl->DeleteShader(shader);
    return 0;
}

static bool link_program(const plr_gl *gl, GLuint program, plr_glsl_messages *messages) {
    GLint linked = 0, length = 0;
    if (gl->ProgramParameteri)
        gl->ProgramParameteri(program, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
    gl->LinkProgram(program);
    gl->GetProgramiv(program, GL_LINK_STATUS, &linked);
    if (linked)
        return true;
    gl->GetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
    take_log(gl->GetProgramInfoLog, program, length, messages);
    return false;
}

GLuint plr_cache_build(const plr_gl *gl, const char *const texts[PLR_STAGE_COUNT],
                       plr_glsl_messages messages[PLR_STAGE_COUNT], plr_glsl_messages *link) {
    GLuint shaders[PLR_STAGE_COUNT] = {0}, program = gl->CreateProgram();
    bool fine = program != 0;
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++) {
        if (!texts[stage])
            continue;
        shaders[stage] = compile(gl, shader_kinds[stage], texts[stage], &messages[stage]);
        fine = fine && shaders[stage];
        if (program && shaders[stage])
            gl->AttachShader(program, shaders[stage]);
    }
    fine = fine && link_program(gl, program, link);
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++) {
        if (!shaders[stage])
            continue;
        if (program)
            gl->DetachShader(program, shaders[stage]);
        gl->DeleteShader(shaders[stage]);
    }
    if (fine)
        return program;
    gl->DeleteProgram(program);
    return 0;
}

/* ---- On disk ---- */

static GLuint load(plr_cache *cache, const uint8_t key[PLR_SHA256_SIZE]) {
    const plr_gl *gl = cache->gl;
    plr_buffer binary = {0};
    uint32_t format = 0;
    GLuint program = 0;
    if (plr_cache_folder_load(&cache->folder, key, &format, &binary)) {
        GLint linked = 0;
        program = gl->CreateProgram();
        gl->ProgramBinary(program, format, binary.data, (GLsizei)binary.length);
        gl->GetProgramiv(program, GL_LINK_STATUS, &linked);
        if (!linked) { /* of another driver after all */
            gl->DeleteProgram(program);
            gl->GetError();
            program = 0;
            plr_cache_folder_remove(&cache->folder, key);
        }
    }
    plr_buffer_free(&binary);
    return program;
}

static void store(plr_cache *cache, const uint8_t key[PLR_SHA256_SIZE], GLuint program) {
    const plr_gl *gl = cache->gl;
    GLint size = 0;
    GLsizei length = 0;
    GLenum format = 0;
    gl->GetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &size);
    void *binary = size > 0 ? malloc((size_t)size) : NULL;
    if (!binary)
        return;
    gl->GetProgramBinary(program, size, &length, &format, binary);
    if (length > 0)
        plr_cache_folder_store(&cache->folder, key, format, binary, (size_t)length);
    free(binary);
}

static bool has_binaries(const plr_gl *gl) {
    GLint formats = 0;
    if (gl->GetProgramBinary && gl->ProgramBinary)
        gl->GetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    return formats > 0;
}

/* ---- All ---- */

plr_cache *plr_cache_create(const plr_gl *gl, const char *folder) {
    plr_cache *cache = calloc(1, sizeof *cache);
    if (!cache)
        return NULL;
    cache->gl = gl;
    cache->size = 64;
    cache->slots = calloc(cache->size, sizeof *cache->slots);
    if (!cache->slots) {
        free(cache);
        return NULL;
    }
    start_key(cache);
    cache->on_disk =
        folder && has_binaries(gl) && plr_cache_folder_open(&cache->folder, folder, folder_limit);
    return cache;
}

void plr_cache_destroy(plr_cache **cache) {
    plr_cache *c = *cache;
    if (!c)
        return;
    for (size_t i = 0; i < c->size; i++)
        if (c->slots[i].program) {
            c->gl->DeleteProgram(c->slots[i].program);
            plr_defaults_destroy(&c->slots[i].defaults);
        }
    if (c->on_disk)
        plr_cache_folder_close(&c->folder);
    free(c->slots);
    free(c);
    *cache = NULL;
}

/* Makes the program one of the cache's. */
static bool keep(plr_cache *cache, const uint8_t key[PLR_SHA256_SIZE], GLuint program) {
    if (cache->count >= cache->size / 2 && !grow(cache)) {
        cache->gl->DeleteProgram(program);
        return false;
    }
    slot *fresh = find(cache->slots, cache->size, key);
    memcpy(fresh->key, key, PLR_SHA256_SIZE);
    fresh->program = program;
    fresh->defaults = plr_defaults_capture(cache->gl, program);
    cache->count++;
    return true;
}

/* From memory or disk; 0: it is in neither. */
static GLuint find_program(plr_cache *cache, const uint8_t key[PLR_SHA256_SIZE]) {
    const slot *known = find(cache->slots, cache->size, key);
    if (known->program) {
        cache->stats.from_memory++;
        return known->program;
    }
    GLuint program = cache->on_disk ? load(cache, key) : 0;
    if (!program || !keep(cache, key, program))
        return 0;
    cache->stats.from_disk++;
    return program;
}

GLuint plr_cache_find(plr_cache *cache, const char *const texts[PLR_STAGE_COUNT]) {
    uint8_t key[PLR_SHA256_SIZE];
    make_key(cache, texts, key);
    return find_program(cache, key);
}

GLuint plr_cache_adopt(plr_cache *cache, const char *const texts[PLR_STAGE_COUNT], GLuint program) {
    uint8_t key[PLR_SHA256_SIZE];
    make_key(cache, texts, key);
    const slot *known = find(cache->slots, cache->size, key);
    if (known->program) {
        cache->gl->DeleteProgram(program);
        return known->program;
    }
    if (!keep(cache, key, program))
        return 0;
    if (cache->on_disk)
        store(cache, key, program);
    return program;
}

GLuint plr_cache_program(plr_cache *cache, const char *const texts[PLR_STAGE_COUNT],
                         plr_glsl_messages messages[PLR_STAGE_COUNT], plr_glsl_messages *link) {
    uint8_t key[PLR_SHA256_SIZE];
    for (int stage = 0; stage < PLR_STAGE_COUNT; stage++)
        messages[stage] = (plr_glsl_messages){0};
    *link = (plr_glsl_messages){0};
    make_key(cache, texts, key);
    GLuint program = find_program(cache, key);
    if (program || !(program = plr_cache_build(cache->gl, texts, messages, link)))
        return program;
    cache->stats.compiled++;
    if (cache->on_disk)
        store(cache, key, program);
    if (!keep(cache, key, program)) {
        plr_glsl_parse_log("error: no memory", link);
        return 0;
    }
    return program;
}

const plr_defaults *plr_cache_defaults(const plr_cache *cache, GLuint program) {
    for (size_t i = 0; i < cache->size; i++)
        if (cache->slots[i].program == program)
            return cache->slots[i].defaults;
    return NULL;
}

plr_cache_stats plr_cache_get_stats(const plr_cache *cache) {
    return cache->stats;
}
