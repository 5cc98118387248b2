#include "api/arguments.h"

#include <string.h>

fram_status arguments_check(const argument *arguments, size_t count, fram_error *error)
{
    for (size_t i = 0; i < count; i++) {
        if (!arguments[i].pointer)
            return error_set(error, FRAM_ERROR_USAGE, NULL, 0, arguments[i].name, "expected a pointer, found NULL");
    }
    return FRAM_OK;
}

fram_status definition_check(const void *definition, size_t wanted, const char *type, fram_error *error)
{
    size_t size = 0;
    if (definition)
        memcpy(&size, definition, sizeof size);
    if (size == wanted)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_USAGE, NULL, 0, type,
                     "expected a definition that %s_default of this version has filled, found %s", type,
                     definition ? "another size" : "NULL");
}

fram_status number_check(const char *name, double value, double least, double most, fram_error *error)
{
    if (value >= least && value <= most)
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, NULL, 0, name, "expected a number from %g to %g, found %g", least, most,
                     value);
}
