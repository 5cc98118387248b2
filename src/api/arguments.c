#include "api/arguments.h"

#include <stdio.h>
#include <string.h>

fram_status arguments_check(const argument *arguments, size_t count, fram_error *error)
{
    for (size_t i = 0; i < count; i++) {
        if (!arguments[i].pointer)
            return error_set(error, FRAM_ERROR_USAGE, NULL, 0, arguments[i].name, "expected a pointer, found NULL");
    }
    return FRAM_OK;
}

fram_status definition_take(void *filled, const void *given, size_t known, size_t least, const char *type,
                            fram_error *error)
{
    size_t size = 0;
    if (given)
        memcpy(&size, given, sizeof size);
    if (!given || size < least || size > known)
        return error_set(error, FRAM_ERROR_USAGE, NULL, 0, type,
                         "expected a definition that %s_default of this version or an older one has filled, found %s",
                         type, given ? "another size" : "NULL");
    memcpy(filled, given, size);
    return FRAM_OK;
}

void definition_give(void *definition, size_t size, const void *full, size_t known)
{
    if (!definition || size < sizeof size)
        return;
    memset(definition, 0, size);
    memcpy(definition, full, size < known ? size : known);
    memcpy(definition, &size, sizeof size);
}

/* The shortest struct of results that can be meant, and what every size is a multiple of [bytes]. */
enum { RESULT_LEAST = 8, RESULT_WORD = 4 };

fram_status result_check(const void *result, size_t size, size_t known, const char *type, fram_error *error)
{
    if (!result || (size >= RESULT_LEAST && size <= known && size % RESULT_WORD == 0))
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_USAGE, NULL, 0, type,
                     "expected its size in this version, %zu bytes, or in an older one; found %zu", known, size);
}

void result_give(void *result, size_t size, const void *full)
{
    if (result)
        memcpy(result, full, size);
}

void *result_row(void *rows, size_t size, int row) { return (unsigned char *)rows + size * (size_t)row; }

fram_status folder_check(const char *key, const char *folder, fram_error *error)
{
    if (folder && *folder)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_USAGE, NULL, 0, key, "a folder for the results must be named");
}

fram_status name_find(const char *key, const char *given, const char *const *names, int count, int *row,
                      fram_error *error)
{
    char list[200] = "";
    for (int i = 0; i < count; i++) {
        *row = i;
        if (given && strcmp(given, names[i]) == 0)
            return FRAM_OK;
        size_t end = strlen(list);
        snprintf(list + end, sizeof list - end, "%s%s", i == 0 ? "" : i + 1 < count ? ", " : " or ", names[i]);
    }
    return error_set(error, FRAM_ERROR_USAGE, NULL, 0, key, "expected %s", list);
}

fram_status number_check(const char *name, double value, double least, double most, fram_error *error)
{
    if (value >= least && value <= most)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, name, "expected a number from %g to %g, found %g", least, most,
                     value);
}
