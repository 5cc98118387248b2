#include "model/scenario_vessel.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

int32_t scenario_vessel_count(const scenario *s) { return s->vessel.present ? 1 : 0; }

vessel_entry scenario_vessel_entry(const scenario *s, int32_t index)
{
    (void)index;
    return (vessel_entry){&s->vessel, "vessel"};
}

void vessel_name_error(const scenario *s, const vessel_entry *entry, fram_error *error)
{
    if (!error)
        return;
    char member[sizeof error->key];
    memcpy(member, error->key, sizeof member);
    snprintf(error->key, sizeof error->key, "%s%s%.100s", entry->path, member[0] ? "." : "", member);
    scenario_locate(s, error);
}

fram_status vessel_fault(const scenario *s, const vessel_entry *entry, const char *member, fram_error *error,
                         const char *format, ...)
{
    char message[sizeof error->message];
    va_list arguments;
    va_start(arguments, format);
    if (vsnprintf(message, sizeof message, format, arguments) < 0)
        message[0] = '\0';
    va_end(arguments);
    fram_status status = error_set(error, FRAM_ERROR_INPUT, NULL, 0, member, "%s", message);
    vessel_name_error(s, entry, error);
    return status;
}
