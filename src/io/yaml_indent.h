/* Where the indentation of a block of YAML goes wrong, for a parser that only notices later, and brackets that are too
   long for one.  One module with yaml_tree, which asks when the parser has refused. */
#ifndef IO_YAML_INDENT_H
#define IO_YAML_INDENT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { YAML_BLAME_SIZE = 200 };

typedef struct yaml_blame {
    int32_t line, column; /* from 1 */
    char message[YAML_BLAME_SIZE];
} yaml_blame;

/* true: this line's indentation fits nothing above it, or a bracket is never closed. */
bool yaml_indent_blame(const char *data, size_t size, yaml_blame *out);
/* true: the lines from where a bracket opens to where the last one is closed have more than `most` bytes. */
bool yaml_indent_brackets(const char *data, size_t size, size_t most, yaml_blame *out);

#endif
