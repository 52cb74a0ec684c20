/* The words of the command line: read by the one table, options.def. */
#ifndef PLUGRAY_TOOL_OPTIONS_H
#define PLUGRAY_TOOL_OPTIONS_H

#include <plugray/base.h>

/* Exit statuses of every command. */
enum {
    STATUS_FINE = 0,
    STATUS_INPUT = 1,  /* the input has errors */
    STATUS_USAGE = 2,  /* the command line is wrong */
    STATUS_MACHINE = 3 /* the machine lacks something */
};

typedef enum tool_command {
#define COMMAND(id, name, operands, fewest, most, presence, summary) COMMAND_##id,
#define OPTION(commands, id, name, value, given, help)
#include "tools/plugray/options.def"
#undef COMMAND
#undef OPTION
    COMMAND_COUNT
} tool_command;

typedef enum tool_option {
#define COMMAND(id, name, operands, fewest, most, presence, summary)
#define OPTION(commands, id, name, value, given, help) OPTION_##id,
#include "tools/plugray/options.def"
#undef COMMAND
#undef OPTION
    OPTION_COUNT
} tool_option;

/* One option as given. */
typedef struct given_option {
    tool_option option;
    const char *value; /* "" without one */
} given_option;

typedef struct tool_arguments {
    tool_command command;
    const char **operands;
    size_t operand_count;
    given_option *options;
    size_t option_count;
} tool_arguments;

/* Reads argv[2..] as options and operands of the command argv[1]; prints --help and usage errors
 * itself. True: go on with `arguments`; false: end the program with `*status`. */
bool arguments_read(tool_arguments *arguments, int argc, char **argv, int *status);
void arguments_free(tool_arguments *arguments);

/* The value of an option ("" for one that takes none), the last if there are many; NULL if not
 * given. */
const char *option_value(const tool_arguments *arguments, tool_option option);
/* The next of many: *next starts at 0; NULL after the last. */
const char *option_next(const tool_arguments *arguments, tool_option option, size_t *next);
/* Which of the words separated by | in `words` the text is, from 0; -1: none. */
int word_index(const char *words, const char *text);
/* The words an option takes: "auto|egl|osmesa". */
const char *option_words(tool_option option);

/* "plugray render: MESSAGE", and where help is, on standard error. Returns STATUS_USAGE. */
int usage_error(const tool_arguments *arguments, const char *format, ...) PLR_PRINTF(2, 3);

/* An option of one whole number or number within bounds; its default if it is not given. False
 * after a usage error. */
bool option_integer(const tool_arguments *arguments, tool_option option, long minimum, long maximum,
                    long *value);
bool option_number(const tool_arguments *arguments, tool_option option, double above,
                   double maximum, double *value);
/* The same of a number or a fraction, "1/255". */
bool option_fraction(const tool_arguments *arguments, tool_option option, double above,
                     double maximum, double *value);
/* "AxB" or "A,B": two whole numbers from `minimum` to `maximum`. */
bool read_pair(const char *text, char separator, long minimum, long maximum, long pair[2]);

/* All commands and options, tab separated, a row a line: for completions and tests. */
void options_list(void);

#endif
