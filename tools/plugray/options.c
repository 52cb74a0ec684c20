#include "tools/plugray/options.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum presence {
    PRESENT,
    ONCE = PRESENT,
    MANY,
    LATER
} presence;

typedef struct command_row {
    const char *name, *operands;
    size_t fewest, most;
    presence presence;
    const char *summary;
} command_row;

typedef struct option_row {
    unsigned commands;
    const char *name, *value;
    presence given;
    const char *help;
} option_row;

#define ON(id) (1u << COMMAND_##id)
#define DRAW_COMMANDS (ON(RENDER) | ON(CHART))
#define SCENE_COMMANDS (DRAW_COMMANDS | ON(DUMP) | ON(CHECK) | ON(PLUGS) | ON(INFO))

static const command_row commands[] = {
#define COMMAND(id, name, operands, fewest, most, presence, summary)                               \
    {name, operands, fewest, most, presence, summary},
#define OPTION(commands, id, name, value, given, help)
#include "tools/plugray/options.def"
#undef COMMAND
#undef OPTION
};

static const option_row options[] = {
#define COMMAND(id, name, operands, fewest, most, presence, summary)
#define OPTION(commands, id, name, value, given, help) {commands, name, value, given, help},
#include "tools/plugray/options.def"
#undef COMMAND
#undef OPTION
};

/* ---- Help ---- */

static void print_wrapped(const char *text, int indent) {
    int column = indent;
    for (const char *word = text; *word;) {
        int length = (int)strcspn(word, " ");
        if (column > indent && column + 1 + length > 79) {
            printf("\n%*s", indent, "");
            column = indent;
        } else if (column > indent) {
            putchar(' ');
            column++;
        }
        printf("%.*s", length, word);
        column += length;
        word += length;
        word += strspn(word, " ");
    }
    putchar('\n');
}

static void print_row(const char *name, const char *value, const char *help) {
    int width = printf("  %s%s%s", name, *value ? " " : "", value);
    if (width > 24)
        printf("\n%26s", "");
    else
        printf("%*s", 26 - width, "");
    print_wrapped(help, 26);
}

static void print_help(void) {
    puts("Usage: plugray COMMAND [ARGUMENT...]\n\n"
         "Draws X3D scenes through effects: pieces of GLSL that are joined into one program.\n\n"
         "Commands:");
    for (size_t i = 0; i < COMMAND_COUNT; i++)
        if (commands[i].presence != LATER)
            print_row(commands[i].name, commands[i].operands, commands[i].summary);
    puts("\nOptions:");
    print_row("--help", "", "print this help; after a command, that of the command");
    print_row("--version", "", "print the version");
    puts("\nA SCENE that is - is read from standard input. Exit status: 0 fine, 1 the input has\n"
         "errors, 2 wrong usage, 3 the machine lacks something.");
}

static void print_command_help(tool_command command) {
    printf("Usage: plugray %s %s [OPTION...]\n\nUse it to %s.\n\nOptions:\n",
           commands[command].name, commands[command].operands, commands[command].summary);
    for (size_t i = 0; i < OPTION_COUNT; i++)
        if ((options[i].commands >> command & 1) && options[i].given != LATER)
            print_row(options[i].name, options[i].value, options[i].help);
    print_row("--help", "", "print this help");
}

void options_list(void) {
    for (size_t i = 0; i < COMMAND_COUNT; i++) {
        if (commands[i].presence == LATER)
            continue;
        printf("command\t%s\t%s\t%s\n", commands[i].name, commands[i].operands,
               commands[i].summary);
        for (size_t j = 0; j < OPTION_COUNT; j++)
            if ((options[j].commands >> i & 1) && options[j].given != LATER)
                printf("option\t%s\t%s\t%s\t%s\n", commands[i].name, options[j].name,
                       options[j].value, options[j].help);
    }
}

/* ---- Reading ---- */

static int fail_usage(const char *command, const char *format, va_list rest) PLR_PRINTF(2, 0);
static int fail_usage(const char *command, const char *format, va_list rest) {
    fprintf(stderr, "plugray%s%s: ", *command ? " " : "", command);
    vfprintf(stderr, format, rest);
    fprintf(stderr, "\nTry 'plugray%s%s --help'.\n", *command ? " " : "", command);
    return STATUS_USAGE;
}

int usage_error(const tool_arguments *arguments, const char *format, ...) {
    va_list rest;
    va_start(rest, format);
    int status = fail_usage(commands[arguments->command].name, format, rest);
    va_end(rest);
    return status;
}

static int top_usage_error(const char *format, ...) PLR_PRINTF(1, 2);
static int top_usage_error(const char *format, ...) {
    va_list rest;
    va_start(rest, format);
    int status = fail_usage("", format, rest);
    va_end(rest);
    return status;
}

/* The option of this command that `word` begins with, "-oFILE" and "--size=WxH" included. */
static tool_option find_option(tool_command command, const char *word, const char **attached) {
    *attached = NULL;
    for (size_t i = 0; i < OPTION_COUNT; i++) {
        if (!(options[i].commands >> command & 1))
            continue;
        size_t length = strlen(options[i].name);
        if (strncmp(word, options[i].name, length) != 0)
            continue;
        bool is_long = options[i].name[1] == '-';
        if (!word[length])
            return (tool_option)i;
        if (is_long && word[length] != '=')
            continue;
        *attached = word + length + (is_long ? 1 : 0);
        return (tool_option)i;
    }
    return OPTION_COUNT;
}

/* Reads the option at argv[*at]; moves *at to its last word. */
static bool read_option(tool_arguments *arguments, int argc, char **argv, int *at, int *status) {
    const char *value, *word = argv[*at];
    tool_option found = find_option(arguments->command, word, &value);
    if (found == OPTION_COUNT) {
        *status = usage_error(arguments, "there is no option %s", word);
        return false;
    }
    const option_row *row = &options[found];
    if (row->given == LATER) {
        *status = usage_error(arguments, "%s is not in this version", row->name);
        return false;
    }
    if (!*row->value && value) {
        *status = usage_error(arguments, "%s takes no value", row->name);
        return false;
    }
    const char *next = *at + 1 < argc ? argv[*at + 1] : NULL;
    if (*row->value == '[') { /* an optional value: a word of its own only if it is the one meant */
        size_t length = strlen(row->value) - 2;
        if (!value && next && strlen(next) == length && strncmp(next, row->value + 1, length) == 0)
            value = argv[++*at];
    } else if (*row->value && !value) {
        if (!next) {
            *status = usage_error(arguments, "%s lacks its value %s", row->name, row->value);
            return false;
        }
        value = argv[++*at];
    }
    arguments->options[arguments->option_count++] = (given_option){found, value ? value : ""};
    return true;
}

static bool read_words(tool_arguments *arguments, int argc, char **argv, int *status) {
    bool only_operands = false;
    for (int i = 2; i < argc; i++) {
        const char *word = argv[i];
        if (only_operands || word[0] != '-' || !word[1]) {
            arguments->operands[arguments->operand_count++] = word;
        } else if (strcmp(word, "--") == 0) {
            only_operands = true;
        } else if (strcmp(word, "--help") == 0) {
            print_command_help(arguments->command);
            *status = STATUS_FINE;
            return false;
        } else if (!read_option(arguments, argc, argv, &i, status)) {
            return false;
        }
    }
    const command_row *row = &commands[arguments->command];
    if (arguments->operand_count < row->fewest) {
        *status = usage_error(arguments, "%.*s is missing", (int)strcspn(row->operands, " ."),
                              row->operands);
        return false;
    }
    if (arguments->operand_count > row->most) {
        *status = usage_error(arguments, "there is one word too many: %s",
                              arguments->operands[row->most]);
        return false;
    }
    return true;
}

bool arguments_read(tool_arguments *arguments, int argc, char **argv, int *status) {
    memset(arguments, 0, sizeof *arguments);
    if (argc < 2) {
        *status = top_usage_error("which command?");
        return false;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "--version") == 0) {
        if (argv[1][2] == 'h')
            print_help();
        else
            puts("plugray " PLR_VERSION);
        *status = STATUS_FINE;
        return false;
    }
    size_t found = 0;
    while (found < COMMAND_COUNT && strcmp(commands[found].name, argv[1]) != 0)
        found++;
    if (found == COMMAND_COUNT || commands[found].presence == LATER) {
        *status = found == COMMAND_COUNT ? top_usage_error("there is no command %s", argv[1])
                                         : top_usage_error("%s is not in this version", argv[1]);
        return false;
    }
    arguments->command = (tool_command)found;
    arguments->operands = calloc((size_t)argc, sizeof *arguments->operands);
    arguments->options = calloc((size_t)argc, sizeof *arguments->options);
    if (!arguments->operands || !arguments->options) {
        fputs("plugray: there is not enough memory\n", stderr);
        *status = STATUS_MACHINE;
        return false;
    }
    return read_words(arguments, argc, argv, status);
}

void arguments_free(tool_arguments *arguments) {
    free(arguments->operands);
    free(arguments->options);
}

const char *option_value(const tool_arguments *arguments, tool_option option) {
    for (size_t i = arguments->option_count; i-- > 0;)
        if (arguments->options[i].option == option)
            return arguments->options[i].value;
    return NULL;
}

const char *option_next(const tool_arguments *arguments, tool_option option, size_t *next) {
    while (*next < arguments->option_count) {
        const given_option *given = &arguments->options[(*next)++];
        if (given->option == option)
            return given->value;
    }
    return NULL;
}

const char *option_words(tool_option option) {
    return options[option].value;
}

int word_index(const char *words, const char *text) {
    size_t length = strlen(text);
    for (int index = 0;; index++) {
        size_t end = strcspn(words, "|");
        if (end == length && strncmp(words, text, length) == 0)
            return index;
        if (!words[end])
            return -1;
        words += end + 1;
    }
}

/* A whole number in decimal digits, without sign tricks or blanks. */
static bool read_integer(const char *text, char end, long minimum, long maximum, long *value,
                         const char **rest) {
    char *after;
    if (*text != '-' && (*text < '0' || *text > '9'))
        return false;
    errno = 0;
    *value = strtol(text, &after, 10);
    *rest = after;
    return !errno && after > text && *after == end && *value >= minimum && *value <= maximum;
}

bool read_pair(const char *text, char separator, long minimum, long maximum, long pair[2]) {
    const char *rest;
    return read_integer(text, separator, minimum, maximum, &pair[0], &rest) &&
           read_integer(rest + 1, '\0', minimum, maximum, &pair[1], &rest);
}

bool option_integer(const tool_arguments *arguments, tool_option option, long minimum, long maximum,
                    long *value) {
    const char *rest, *text = option_value(arguments, option);
    if (!text || read_integer(text, '\0', minimum, maximum, value, &rest))
        return true;
    usage_error(arguments, "%s takes a whole number from %ld to %ld, not '%s'",
                options[option].name, minimum, maximum, text);
    return false;
}

bool option_number(const tool_arguments *arguments, tool_option option, double above,
                   double maximum, double *value) {
    const char *text = option_value(arguments, option);
    if (!text)
        return true;
    char *after;
    *value = strtod(text, &after);
    if (after > text && !*after && isfinite(*value) && *value > above && *value <= maximum)
        return true;
    usage_error(arguments, "%s takes a number above %g and at most %g, not '%s'",
                options[option].name, above, maximum, text);
    return false;
}

bool option_fraction(const tool_arguments *arguments, tool_option option, double above,
                     double maximum, double *value) {
    const char *text = option_value(arguments, option);
    if (!text)
        return true;
    char *after;
    double over = strtod(text, &after), under = 1;
    bool read = after > text;
    if (read && *after == '/') {
        const char *second = after + 1;
        under = strtod(second, &after);
        read = after > second;
    }
    *value = over / under;
    if (read && !*after && under > 0 && *value > above && *value <= maximum)
        return true;
    usage_error(arguments, "%s takes a number above %g and at most %g, or a fraction, not '%s'",
                options[option].name, above, maximum, text);
    return false;
}
