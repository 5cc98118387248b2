/* Books over a whole table, as tests of conservation ask for them. */
#ifndef BOOKS_H
#define BOOKS_H

#include "bodies/body.h"

static inline body_books body_books_of(const body_table *b)
{
    body_books sum = {0};
    for (int32_t i = 0; i < b->count; i++)
        body_books_add(b, i, &sum);
    return sum;
}

#endif
