#include "x3d/text.h"

#include <math.h>

static bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/* A decimal number taken apart: mantissa * 10^exponent. */
typedef struct decimal {
    uint64_t mantissa;
    int exponent;
    int digits; /* significant ones in the mantissa, at most 19 */
    bool any;   /* at least one digit was there */
} decimal;

static size_t read_digits(const char *text, size_t length, size_t i, bool fraction,
                          decimal *number) {
    for (; i < length && is_digit(text[i]); i++) {
        number->any = true;
        if (number->digits < 19) {
            number->mantissa = number->mantissa * 10 + (uint64_t)(text[i] - '0');
            number->digits += number->mantissa != 0;
            number->exponent -= fraction && number->exponent > -100000;
        } else {
            number->exponent += !fraction && number->exponent < 100000;
        }
    }
    return i;
}

static size_t read_exponent(const char *text, size_t length, size_t i, decimal *number) {
    size_t at = i + 1;
    bool minus = at < length && text[at] == '-';
    if (at < length && (text[at] == '-' || text[at] == '+'))
        at++;
    if (at >= length || !is_digit(text[at]))
        return i;
    int exponent = 0;
    for (; at < length && is_digit(text[at]); at++)
        if (exponent < 100000)
            exponent = exponent * 10 + (text[at] - '0');
    number->exponent += minus ? -exponent : exponent;
    return at;
}

/* Exact where mantissa and power are exact doubles; else through long double, whose error is far
 * below half a unit of the last place of a float. */
static double scale(const decimal *number) {
    static const double exact[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    int e = number->exponent;
    if (number->mantissa == 0)
        return 0;
    if (number->mantissa <= UINT64_C(1) << 53 && e >= -22 && e <= 22)
        return e < 0 ? (double)number->mantissa / exact[-e] : (double)number->mantissa * exact[e];
    if (e > 400)
        return HUGE_VAL;
    if (e < -400)
        return 0;
    long double power = 1, base = 10;
    for (int left = e < 0 ? -e : e; left; left >>= 1, base *= base)
        if (left & 1)
            power *= base;
    long double value = (long double)number->mantissa;
    return (double)(e < 0 ? value / power : value * power);
}

static bool is_hexadecimal(const char *text, size_t length, size_t i) {
    return i + 2 < length && text[i] == '0' && (text[i + 1] == 'x' || text[i + 1] == 'X');
}

size_t x3d_parse_number(const char *text, size_t length, double *value) {
    size_t i = length && (text[0] == '-' || text[0] == '+');
    if (is_hexadecimal(text, length, i)) {
        int64_t integer;
        size_t used = x3d_parse_integer(text, length, &integer);
        *value = (double)integer;
        return used;
    }
    decimal number = {0};
    i = read_digits(text, length, i, false, &number);
    if (i < length && text[i] == '.')
        i = read_digits(text, length, i + 1, true, &number);
    if (!number.any)
        return 0;
    if (i < length && (text[i] == 'e' || text[i] == 'E'))
        i = read_exponent(text, length, i, &number);
    double magnitude = scale(&number);
    *value = text[0] == '-' ? -magnitude : magnitude;
    return i;
}

static int hexadecimal_digit(char c) {
    if (is_digit(c))
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

size_t x3d_parse_integer(const char *text, size_t length, int64_t *value) {
    const int64_t most = INT64_MAX / 16 - 16;
    bool minus = length && text[0] == '-';
    size_t i = length && (text[0] == '-' || text[0] == '+'), first;
    int64_t magnitude = 0;
    if (is_hexadecimal(text, length, i)) {
        first = i += 2;
        for (int digit; i < length && (digit = hexadecimal_digit(text[i])) >= 0; i++)
            magnitude = magnitude < most ? magnitude * 16 + digit : most;
    } else {
        first = i;
        for (; i < length && is_digit(text[i]); i++)
            magnitude = magnitude < most ? magnitude * 10 + (text[i] - '0') : most;
    }
    *value = minus ? -magnitude : magnitude;
    return i > first ? i : 0;
}
