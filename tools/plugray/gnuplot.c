#include "tools/plugray/gnuplot.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tools/plugray/files.h"
#include "tools/plugray/json.h"

extern char **environ;

enum {
    MAX_OUTPUT = 1 << 26,
    MAX_LOG = 1 << 20
};

static const char log_name[] = "log";

static bool fail(plr_diags *diags, const char *what) {
    plr_diags_add(diags, PLR_CODE_OUTPUT, (plr_place){0}, "%s: %s", what, strerror(errno));
    return false;
}

/* ---- The program ---- */

static bool is_program(const char *path) {
    struct stat status;
    return stat(path, &status) == 0 && S_ISREG(status.st_mode) && access(path, X_OK) == 0;
}

/* Its path by PATH, or NULL. Folders of PATH that are relative are not looked into: the working
 * folder may be anybody's. */
static char *find_program(void) {
    const char *folders = getenv("PATH");
    while (folders && *folders) {
        size_t length = strcspn(folders, ":");
        char *path = *folders == '/' ? text_format("%.*s/gnuplot", (int)length, folders) : NULL;
        if (path && is_program(path))
            return path;
        free(path);
        folders += length + (folders[length] == ':');
    }
    return NULL;
}

static char *need_program(plr_diags *diags) {
    char *program = find_program();
    if (!program)
        plr_diags_add(diags, PLR_CODE_MISSING_PROGRAM, (plr_place){0},
                      "charts are drawn by gnuplot, which is not installed (the Debian package "
                      "gnuplot-nox); a chart that ends in .csv needs none");
    return program;
}

bool gnuplot_find(plr_diags *diags) {
    char *program = need_program(diags);
    free(program);
    return program != NULL;
}

/* ---- Its folder ---- */

bool gnuplot_begin(gnuplot *g, plr_diags *diags) {
    *g = (gnuplot){.program = need_program(diags)};
    if (!g->program)
        return false;
    const char *above = getenv("TMPDIR");
    g->folder = text_format("%s/plugray-XXXXXX", above && *above ? above : "/tmp");
    if (mkdtemp(g->folder))
        return true;
    fail(diags, g->folder);
    free(g->folder);
    g->folder = NULL;
    return false;
}

static char *path_of(gnuplot *g, const char *name) {
    return text_format("%s/%s", g->folder, name);
}

static void note_file(gnuplot *g, const char *name) {
    g->files = memory_array(g->files, g->file_count + 1, sizeof *g->files);
    g->files[g->file_count++] = text_format("%s", name);
}

FILE *gnuplot_file(gnuplot *g, const char *name, plr_diags *diags) {
    char *path = path_of(g, name);
    FILE *file = fopen(path, "w");
    if (file)
        note_file(g, name);
    else
        fail(diags, path);
    free(path);
    return file;
}

void gnuplot_end(gnuplot *g) {
    for (size_t i = 0; i < g->file_count; i++) {
        char *path = path_of(g, g->files[i]);
        unlink(path);
        free(path);
        free(g->files[i]);
    }
    if (g->folder)
        rmdir(g->folder);
    free(g->files);
    free(g->folder);
    free(g->program);
    *g = (gnuplot){0};
}

/* ---- Running ---- */

/* The environment, but with numbers and messages as the script expects them. */
static char **make_environment(void) {
    static char locale[] = "LC_ALL=C";
    size_t count = 0, kept = 0;
    while (environ[count])
        count++;
    char **made = memory_array(NULL, count + 2, sizeof *made);
    for (size_t i = 0; i < count; i++)
        if (strncmp(environ[i], "LC_ALL=", 7) != 0)
            made[kept++] = environ[i];
    made[kept++] = locale;
    made[kept] = NULL;
    return made;
}

/* In the child: nothing here may allocate or lock, as threads of GL may have been at it. */
static void become(const char *program, const char *folder, char *const *words,
                   char *const *environment) {
    int nothing = open("/dev/null", O_RDWR);
    if (nothing < 0 || chdir(folder) != 0)
        _exit(127);
    int log = open(log_name, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (log < 0 || dup2(nothing, 0) < 0 || dup2(log, 1) < 0 || dup2(log, 2) < 0)
        _exit(127);
    execve(program, words, environment);
    _exit(127);
}

static int run(const gnuplot *g, const char *script) {
    char defaults[] = "-d", *name = text_format("%s", script);
    char *words[] = {g->program, defaults, name, NULL};
    char **environment = make_environment();
    pid_t child = fork();
    if (child == 0)
        become(g->program, g->folder, words, environment);
    int status = -1;
    while (child > 0 && waitpid(child, &status, 0) < 0)
        if (errno != EINTR)
            break;
    free(environment);
    free(name);
    return status;
}

static void report_log(gnuplot *g, plr_diags *diags) {
    char *path = path_of(g, log_name);
    size_t length;
    char *text = file_read(path, MAX_LOG, &length, NULL);
    const char *line = text ? text + strspn(text, " \n\r\t\f^") : "";
    plr_diags_add(diags, PLR_CODE_OUTPUT, (plr_place){0}, "gnuplot cannot draw the chart%s%.*s",
                  *line ? ": " : "", (int)strcspn(line, "\n"), line);
    free(text);
    free(path);
}

char *gnuplot_run(gnuplot *g, const char *script, const char *output, size_t *length,
                  plr_diags *diags) {
    note_file(g, log_name);
    note_file(g, output);
    char *path = path_of(g, output), *text = NULL;
    *length = 0;
    if (run(g, script) == 0)
        text = file_read(path, MAX_OUTPUT, length, NULL);
    if (*length == 0) {
        free(text);
        text = NULL;
        report_log(g, diags);
    }
    free(path);
    return text;
}

/* ---- Text ---- */

void gnuplot_string(FILE *out, const char *text) {
    putc('\'', out);
    while (*text) {
        size_t length = utf8_length(text);
        bool plain = length > 1 || (length == 1 && (unsigned char)*text >= ' ' && *text != 127);
        if (plain && *text == '\'')
            putc('\'', out);
        if (plain)
            fwrite(text, 1, length, out);
        else
            putc('?', out);
        text += length ? length : 1;
    }
    putc('\'', out);
}
