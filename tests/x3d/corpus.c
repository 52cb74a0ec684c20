/* The seeds of the fuzz targets, once each, in every build. */
#include "tests/fuzz/scene.h"
#include "tests/tap.h"

int main(int count, char **paths) {
    for (int i = 1; i < count; i++) {
        FILE *file = fopen(paths[i], "rb");
        char *text = malloc(1000000);
        size_t length = file ? fread(text, 1, 1000000, file) : 0;
        const char *name = strrchr(paths[i], '/');
        TAP_RESULT(length > 0 && fuzz_scene(text, length) > 0, "%s", name ? name : paths[i]);
        if (file)
            fclose(file);
        free(text);
    }
    return tap_done();
}
