/* A very small TAP producer: CHECK(...) counts, prints what differed and goes on. */
#ifndef TESTS_TAP_H
#define TESTS_TAP_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int tap_count, tap_failed;

#define TAP_RESULT(ok, ...)                                                                        \
    do {                                                                                           \
        int tap_ok = (ok);                                                                         \
        tap_failed += !tap_ok;                                                                     \
        printf("%s %d - ", tap_ok ? "ok" : "not ok", ++tap_count);                                 \
        printf(__VA_ARGS__);                                                                       \
        printf("\n");                                                                              \
        if (!tap_ok)                                                                               \
            printf("# at %s:%d\n", __FILE__, __LINE__);                                            \
        fflush(stdout);                                                                            \
    } while (0)

#define CHECK(condition) TAP_RESULT((condition) ? 1 : 0, "%s", #condition)

#define CHECK_INT(actual, expected)                                                                \
    do {                                                                                           \
        long long tap_a = (long long)(actual), tap_e = (long long)(expected);                      \
        TAP_RESULT(tap_a == tap_e, "%s is %lld", #actual, tap_e);                                  \
        if (tap_a != tap_e)                                                                        \
            printf("#   it is %lld\n", tap_a);                                                     \
    } while (0)

#define CHECK_STR(actual, expected)                                                                \
    do {                                                                                           \
        const char *tap_a = (actual), *tap_e = (expected);                                         \
        int tap_same = tap_a && strcmp(tap_a, tap_e) == 0;                                         \
        TAP_RESULT(tap_same, "%s", #actual);                                                       \
        if (!tap_same)                                                                             \
            printf("#   expected: %s\n#   actual:   %s\n", tap_e, tap_a ? tap_a : "(null)");       \
    } while (0)

#define CHECK_NEAR(actual, expected, tolerance)                                                    \
    do {                                                                                           \
        double tap_a = (actual), tap_e = (expected), tap_t = (tolerance);                          \
        int tap_near = fabs(tap_a - tap_e) <= tap_t;                                               \
        TAP_RESULT(tap_near, "%s is %g within %g", #actual, tap_e, tap_t);                         \
        if (!tap_near)                                                                             \
            printf("#   it is %.9g, off by %.3g\n", tap_a, tap_a - tap_e);                         \
    } while (0)

/* "ok - name # SKIP why": counted as skipped. */
#define TAP_SKIP(name, why) printf("ok %d - %s # SKIP %s\n", ++tap_count, name, why)

/* The last statement of main. */
static inline int tap_done(void) {
    printf("1..%d\n", tap_count);
    return tap_failed ? 1 : 0;
}

#endif
