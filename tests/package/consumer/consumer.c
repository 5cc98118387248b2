/* The least a user's program does: include the installed headers, link the installed library, ask it something.
   Its own plain names are those of Fram's insides, and must not meet them. */
#include <fram/fram.h>
#include <fram/version.h>
#include <stdio.h>
#include <string.h>

double polygon_area(void);
double polygon_area(void) { return 0; }
int memory_free(void);
int memory_free(void) { return 0; }
int error_set(void);
int error_set(void) { return 0; }

int main(void)
{
    fram_context *context = NULL;
    fram_scenario *scenario = NULL;
    fram_error error;
    if (strcmp(fram_version(), FRAM_VERSION) != 0) {
        fprintf(stderr, "library %s, headers %s\n", fram_version(), FRAM_VERSION);
        return 1;
    }
    if (fram_context_create(NULL, &context, &error) != FRAM_OK)
        return 1;
    /* A file that is not there must be refused by name: the call goes through every room. */
    if (fram_scenario_load(context, "absent.yaml", NULL, 0, &scenario, &error) == FRAM_OK ||
        strstr(error.file, "absent.yaml") == NULL)
        return 1;
    fram_context_destroy(context);
    puts(fram_version());
    return polygon_area() == 0 ? memory_free() + error_set() : 1;
}
