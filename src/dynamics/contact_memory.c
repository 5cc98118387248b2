/* What contacts carry from step to step: found again by name, shared out where names changed, remembered by ascending
   names. */
#include "base/pool.h"
#include "dynamics/solver_rows.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>

/* ---- find ---- */

/* Keys looked at on either side before a search by halves: of a few pairs. */
enum { NEAR_KEYS = 16 };

/* The first row whose key is not below `key`, near `place` or anywhere. */
static int32_t memory_place(const contact_memory_table *memory, uint64_t key, int32_t place)
{
    int32_t low = place > NEAR_KEYS ? place - NEAR_KEYS : 0;
    int32_t high = place + NEAR_KEYS < memory->count ? place + NEAR_KEYS : memory->count;
    if ((low == 0 || memory->key[low - 1] < key) && (high == memory->count || memory->key[high] >= key)) {
        while (place > low && memory->key[place - 1] >= key)
            place--;
        while (place < high && memory->key[place] < key)
            place++;
        return place;
    }
    for (low = 0, high = memory->count; low < high;) {
        int32_t middle = low + (high - low) / 2;
        if (memory->key[middle] < key)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

int32_t contact_memory_find(const contact_memory_table *memory, uint64_t key, int32_t *place)
{
    *place = memory_place(memory, key, *place);
    return *place < memory->count && memory->key[*place] == key ? *place : -1;
}

/* An impulse on body a as one on the body in the lower slot, and back. */
static vec3 turned(const contact *c, vec3 impulse) { return c->a < c->b ? impulse : vec3_neg(impulse); }

vec3 contact_memory_pair(const contact_memory_table *memory, const contact *c)
{
    uint64_t pair = contact_key_pair(c->key);
    vec3 sum = {0, 0, 0};
    for (int32_t k = memory_place(memory, pair, 0); k < memory->count && contact_key_pair(memory->key[k]) == pair; k++)
        sum = vec3_add(sum, memory->on_lower[k]);
    return turned(c, sum);
}

/* ---- recall ---- */

static bool has_key(const contact *contacts, int32_t first, int32_t end, uint64_t key)
{
    for (int32_t i = first; i < end; i++)
        if (contacts[i].key == key)
            return true;
    return false;
}

/* Contacts [first, end) of one pair.  Impulses whose names are gone are shared equally among points without any: where
   corners of two bodies meet, rounding decides which of them names a point, and a pair that pressed in the last step
   must not start from nothing. */
static void recall_pair(const contact_memory_table *memory, const contact *contacts, int32_t first, int32_t end,
                        int32_t *place, vec3 *recalled)
{
    const vec3 none = {0, 0, 0};
    uint64_t pair = contact_key_pair(contacts[first].key);
    *place = memory_place(memory, pair, *place);
    int32_t begin = *place, last = begin, found = 0;
    while (last < memory->count && contact_key_pair(memory->key[last]) == pair)
        last++;
    for (int32_t i = first; i < end; i++) {
        recalled[i] = none;
        for (int32_t k = begin; k < last; k++) {
            if (memory->key[k] != contacts[i].key)
                continue;
            recalled[i] = turned(&contacts[i], memory->on_lower[k]);
            found++;
        }
    }
    *place = last;
    if (found == last - begin || found == end - first)
        return;
    vec3 lost = none;
    for (int32_t k = begin; k < last; k++)
        if (!has_key(contacts, first, end, memory->key[k]))
            lost = vec3_add(lost, memory->on_lower[k]);
    lost = vec3_scale(lost, 1.0 / (end - first - found));
    for (int32_t i = first; i < end; i++) {
        int32_t at = begin;
        while (at < last && memory->key[at] != contacts[i].key)
            at++;
        if (at == last)
            recalled[i] = turned(&contacts[i], lost);
    }
}

void contacts_recall(const contact_memory_table *memory, const contact_array *contacts, int32_t first, int32_t end,
                     vec3 *recalled)
{
    const contact *c = contacts->data;
    int32_t place = first < end ? (int32_t)((int64_t)first * memory->count / contacts->count) : 0;
    /* A pair belongs to the range that it begins in. */
    while (first < end && first > 0 && contact_key_pair(c[first].key) == contact_key_pair(c[first - 1].key))
        first++;
    while (first < end) {
        int32_t next = first + 1;
        while (next < contacts->count && contact_key_pair(c[next].key) == contact_key_pair(c[first].key))
            next++;
        recall_pair(memory, c, first, next, &place, recalled);
        first = next;
    }
}

/* ---- remember ---- */

typedef struct memory_entry {
    uint64_t key;
    int32_t contact;
} memory_entry;

typedef struct memory_work {
    const body_table *bodies;
    const contact_array *contacts;
    memory_entry *entries; /* of each block from the place of its first contact on */
    int32_t *found;        /* by each block */
    contact_memory_table *memory;
} memory_work;
enum { MEMORY_BLOCK = 512 };

/* The contacts of a block that carry something. */
static void find_carriers(void *arg, int32_t block, int32_t thread)
{
    const memory_work *w = arg;
    int32_t first = MEMORY_BLOCK * block, found = 0;
    (void)thread;
    for (int32_t i = first; i < pool_block_end(block, MEMORY_BLOCK, w->contacts->count); i++) {
        const contact *c = &w->contacts->data[i];
        if (c->impulse[0] > 0 && (body_is_dynamic(w->bodies, c->a) || body_is_dynamic(w->bodies, c->b)))
            w->entries[first + found++] = (memory_entry){c->key, i};
    }
    w->found[block] = found;
}

/* Rows of the memory from its entries. */
static void keep_block(void *arg, int32_t block, int32_t thread)
{
    const memory_work *w = arg;
    (void)thread;
    for (int32_t i = MEMORY_BLOCK * block; i < pool_block_end(block, MEMORY_BLOCK, w->memory->count); i++) {
        assert(i == 0 || w->entries[i - 1].key <= w->entries[i].key);
        const contact *c = &w->contacts->data[w->entries[i].contact];
        w->memory->key[i] = w->entries[i].key;
        w->memory->on_lower[i] = turned(c, contact_impulse(c));
    }
}

static int compare_entries(const void *a, const void *b)
{
    const memory_entry *x = a, *y = b;
    if (x->key != y->key)
        return x->key < y->key ? -1 : 1;
    return (x->contact > y->contact) - (x->contact < y->contact);
}

/* Adds an entry to the sorted ones when its place is near their end: points of one pair come in any order. */
static bool insert_near_end(memory_entry *entries, int32_t count, memory_entry e)
{
    enum { MOST_MOVED = 8 };
    int32_t at = count;
    while (at > 0 && compare_entries(&entries[at - 1], &e) > 0)
        if (count - --at > MOST_MOVED)
            return false;
    memmove(entries + at + 1, entries + at, (size_t)(count - at) * sizeof *entries);
    entries[at] = e;
    return true;
}

/* The narrow phase lists pairs by ascending keys, and pairs with a patch follow by ascending keys of their own: the
   tail is merged, after it was sorted if some were in another order (`tail_sorted` of it are not). */
static void sort_entries(memory_entry *entries, int32_t count, int32_t sorted, int32_t tail_sorted, memory_entry *tail)
{
    int32_t left = count - sorted;
    if (left == 0)
        return;
    if (tail_sorted < left)
        qsort(entries + sorted, (size_t)left, sizeof *entries, compare_entries);
    memcpy(tail, entries + sorted, (size_t)left * sizeof *entries);
    for (int32_t i = sorted - 1, to = count - 1; left > 0; to--)
        entries[to] = i >= 0 && compare_entries(&entries[i], &tail[left - 1]) > 0 ? entries[i--] : tail[--left];
}

/* Entries of all blocks together, ascending; returns how many. */
static int32_t join_entries(memory_entry *entries, const int32_t *found, int32_t contacts)
{
    int32_t count = 0, sorted = 0, tail_sorted = 0;
    for (int32_t block = 0; block < pool_blocks(contacts, MEMORY_BLOCK); block++) {
        for (int32_t i = 0; i < found[block]; i++) {
            memory_entry e = entries[MEMORY_BLOCK * block + i]; /* never before the end of those that are joined */
            if (sorted == count && insert_near_end(entries, sorted, e))
                sorted++;
            else if (sorted + tail_sorted == count && insert_near_end(entries + sorted, tail_sorted, e))
                tail_sorted++;
            else
                entries[count] = e;
            count++;
        }
    }
    if (count > 0)
        sort_entries(entries, count, sorted, tail_sorted, entries + contacts);
    return count;
}

fram_status contacts_remember(solver *s, const body_table *bodies, const contact_array *contacts,
                              contact_memory_table *memory, fram_error *error)
{
    int32_t blocks = pool_blocks(contacts->count, MEMORY_BLOCK);
    if (!array_reserve_raw(s->ctx, (void **)&s->entries, &s->entry_capacity, 2 * contacts->count, sizeof *s->entries) ||
        !array_resize(s->ctx, &s->carriers, blocks) ||
        !table_reserve(s->ctx, memory, &contact_memory_table_info, contacts->count))
        return error_memory(error);
    memory_work work = {bodies, contacts, s->entries, s->carriers.data, memory};
    pool_run(s->ctx, find_carriers, &work, blocks);
    memory->count = join_entries(s->entries, s->carriers.data, contacts->count);
    pool_run(s->ctx, keep_block, &work, pool_blocks(memory->count, MEMORY_BLOCK));
    return FRAM_OK;
}
