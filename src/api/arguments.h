/* What every function of the public interface looks at first: nothing that a program hands over is undefined.  Numbers
   that cannot be are refused where they are used, by name and range. */
#ifndef API_ARGUMENTS_H
#define API_ARGUMENTS_H

#include "base/context.h"

typedef struct argument {
    const char *name; /* as the header of the function has it */
    const void *pointer;
} argument;

/* FRAM_ERROR_USAGE, with the name as key, for the first that is NULL. */
fram_status arguments_check(const argument *arguments, size_t count, fram_error *error);
#define REFUSE_NULL(error, ...) \
    arguments_check((const argument[]){__VA_ARGS__}, sizeof(const argument[]){__VA_ARGS__} / sizeof(argument), (error))

/* A definition of an older program may be shorter: `filled`, which holds the defaults, becomes the given one as far as
   it goes.  FRAM_ERROR_USAGE for NULL, for a size beyond `known` or under `least`, that of the first version with it.
 */
fram_status definition_take(void *filled, const void *given, size_t known, size_t least, const char *type,
                            fram_error *error);
/* What a default function writes: of the defaults, as much as the program's struct holds, with its own size in it;
   zeros behind them in one that is longer, which is refused when it is handed over.  NULL, or no room for the size:
   nothing. */
void definition_give(void *definition, size_t size, const void *full, size_t known);
/* The public default function of a definition, which `name`_fill fills whole. */
#define DEFINITION_DEFAULT(name, type)                         \
    void(name##_default)(type * definition, size_t size)       \
    {                                                          \
        type full;                                             \
        name##_fill(&full);                                    \
        definition_give(definition, size, &full, sizeof full); \
    }
/* `size` and the member after it: definitions that have only grown at their ends since. */
#define DEFINITION_LEAST (2 * sizeof(size_t))

/* Results.  The program tells how long its struct is, by the macro of the function's name: as long as the library's or,
   when it was built with older headers, shorter.  FRAM_ERROR_USAGE, with the struct's name as key, for a size that no
   version had: without a member, no whole number of words, or longer than the library's, whose last members nobody
   would fill.  result NULL, where that may be: nothing is looked at. */
fram_status result_check(const void *result, size_t size, size_t known, const char *type, fram_error *error);
#define RESULT_CHECK(result, size, type, error) result_check((result), (size), sizeof(type), #type, (error))
/* Gives of what was found as much as the program's struct holds; result may be NULL. */
void result_give(void *result, size_t size, const void *full);
/* Row of the program's list of such structs. */
void *result_row(void *rows, size_t size, int row);

/* FRAM_ERROR_USAGE, with the key, for no folder, or one without a name. */
fram_status folder_check(const char *key, const char *folder, fram_error *error);
/* The row of the name that was given; FRAM_ERROR_USAGE, with the key, tells the names for any other, and for NULL. */
fram_status name_find(const char *key, const char *given, const char *const *names, int count, int *row,
                      fram_error *error);
/* FRAM_ERROR_INPUT, with the name as key, unless the number lies between the bounds, which are in. */
fram_status number_check(const char *name, double value, double least, double most, fram_error *error);
/* The latest time that a caller may ask for [s], far beyond every use. */
#define TIME_MOST 1e12

#endif
