/* Crushing patches on several threads: blocks of pairs joined to the same patches, contacts and errors. */
#include "base/pool.h"
#include "base/random.h"
#include "ice_rig.h"

enum { FLOES = 60 };

/* A heap of tilted plates of several shapes in random places, every two of them a pair. */
static void make_heap(ice_rig *r)
{
    ice_rig_make(r, 0.01);
    random_stream draw = random_begin(28, 0, 0);
    for (int i = 0; i < FLOES; i++)
        ice_rig_plate(r, random_uniform(&draw, 1, 4), random_uniform(&draw, 1, 4), 0.5, MOTION_DYNAMIC);
    for (int i = 0; i < FLOES; i++) {
        vec3 place = {random_uniform(&draw, -8, 8), random_uniform(&draw, -8, 8), random_uniform(&draw, -1, 1)};
        ice_rig_place(r, r->floes.body[i], place, random_uniform(&draw, -0.5, 0.5), random_uniform(&draw, -0.5, 0.5),
                      random_uniform(&draw, -3, 3));
        for (int k = 0; k < i; k++)
            ice_rig_pair(r, r->floes.body[k], r->floes.body[i]);
    }
}

static void assert_same_patches(const ice_rig *a, const ice_rig *b)
{
    ck_assert_int_eq(a->patches.count, b->patches.count);
    for (int32_t i = 0; i < a->patches.count; i++) {
        const crushing_patch *p = &a->patches.data[i], *q = &b->patches.data[i];
        ck_assert(p->floe_body == q->floe_body && p->surface_body == q->surface_body && p->component == q->component);
        ck_assert(p->contact_first == q->contact_first && p->contact_count == q->contact_count);
        assert_bits(p->area, q->area);
        assert_bits(p->pressure, q->pressure);
        assert_vec3_close(p->centre, q->centre, 0);
    }
}

static void assert_same(const ice_rig *a, const ice_rig *b)
{
    assert_same_patches(a, b);
    ck_assert_int_eq(a->contacts.count, b->contacts.count);
    for (int32_t i = 0; i < a->contacts.count; i++) {
        const contact *p = &a->contacts.data[i], *q = &b->contacts.data[i];
        ck_assert(p->a == q->a && p->b == q->b && p->patch == q->patch && p->key == q->key);
        assert_bits(p->depth, q->depth);
        assert_bits(p->impulse_limit, q->impulse_limit);
        assert_vec3_close(p->point, q->point, 0);
        assert_vec3_close(p->normal, q->normal, 0);
    }
    for (int32_t i = 0; i < a->pairs.count; i++)
        assert_bits(a->pairs.clear[i], b->pairs.clear[i]);
}

START_TEST(the_same_on_any_threads)
{
    ice_rig one, many;
    make_heap(&one);
    make_heap(&many);
    many.ctx.threads = pool_create(&many.ctx, 3);
    ck_assert_ptr_nonnull(many.ctx.threads);
    for (int step = 0; step < 3; step++) { /* memory of the step before is used again */
        for (int32_t i = 0; i < one.pairs.count; i++)
            one.pairs.clear[i] = many.pairs.clear[i] = PAIR_HAS_PATCH;
        ice_rig_crush(&one);
        ice_rig_crush(&many);
        ck_assert_int_gt(one.patches.count, 100);
        assert_same(&one, &many);
        for (int i = 0; i < FLOES; i++) {
            one.bodies.position[one.floes.body[i]].x *= 0.9;
            many.bodies.position[many.floes.body[i]].x *= 0.9;
        }
    }
    /* What stands in the arrays already stays before them. */
    fram_error e = {0};
    assert_ok(crushing_contacts(&many.ctx, many.scratch, &many.settings, &many.bodies, &many.shapes, &many.floes, NULL,
                                &many.pairs, &many.patch_pairs, &many.policies, &many.patches, &many.contacts, &e),
              e);
    ck_assert_int_gt(many.patches.count, one.patches.count);
    for (int32_t i = 0; i < many.patches.count; i++)
        ck_assert_int_eq(many.contacts.data[many.patches.data[i].contact_first].patch, i);
    pool_free(&many.ctx, many.ctx.threads);
    many.ctx.threads = NULL;
    ice_rig_free(&one);
    ice_rig_free(&many);
}
END_TEST

/* A fault in a later block is told. */
START_TEST(errors_reach_the_caller)
{
    ice_rig r;
    make_heap(&r);
    r.ctx.threads = pool_create(&r.ctx, 2);
    ck_assert_ptr_nonnull(r.ctx.threads);
    r.bodies.material[r.floes.body[FLOES - 1]] = MATERIAL_WALL;
    r.bodies.material[r.floes.body[FLOES - 2]] = MATERIAL_WALL;
    fram_error e = {0};
    assert_fails(ice_rig_try(&r, &e), e, FRAM_ERROR_USAGE, "neither is a floe");
    pool_free(&r.ctx, r.ctx.threads);
    r.ctx.threads = NULL;
    ice_rig_free(&r);
}
END_TEST

TEST_MAIN("crushing_threads", the_same_on_any_threads, errors_reach_the_caller)
