/* Which known name a misspelt one is nearest to, for messages: one measure and one limit for all of them. */
#ifndef BASE_NAME_SEARCH_H
#define BASE_NAME_SEARCH_H

/* Longer names are near to none. */
enum { NAME_LENGTH_MOST = 80 };

/* The nearest so far of the names that name_try was given: a third of the letters may be wrong, at least one; nearest
   of all is one that differs in small and capital letters only. */
typedef struct name_search {
    const char *wrong, *found; /* NULL: none is near, or several are equally */
    int least;
} name_search;

name_search name_search_begin(const char *wrong);
/* Of equally near names none is found, since any could be meant; `name` must outlive what is made of `found`. */
void name_try(name_search *s, const char *name);

#endif
