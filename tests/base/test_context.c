/* Memory, log, error records and instruction sets. */
#include "base/context.h"
#include "testing.h"

START_TEST(defaults_are_library_memory_silence_and_one_thread)
{
    context ctx;
    context_init(&ctx);
    ck_assert(ctx.memory != NULL);
    ck_assert(ctx.log == NULL);
    ck_assert_ptr_null(ctx.threads);
    ck_assert_int_eq(ctx.isa, isa_best());
    char *p = memory_resize(&ctx, NULL, 3);
    ck_assert_ptr_nonnull(p);
    memcpy(p, "ab", 3);
    p = memory_resize(&ctx, p, 1000000);
    ck_assert_str_eq(p, "ab");
    ck_assert_ptr_null(memory_resize(&ctx, p, 0));
    memory_free(&ctx, NULL);
    log_write(&ctx, LOG_ERROR, "heard by nobody");
}
END_TEST

START_TEST(arrays_are_zero_and_their_size_cannot_overflow)
{
    failing_memory m;
    context ctx = failing_context(&m, 0);
    unsigned char *p = memory_array(&ctx, 1000, 7);
    ck_assert_ptr_nonnull(p);
    for (int i = 0; i < 7000; i++)
        ck_assert_int_eq(p[i], 0);
    memory_free(&ctx, p);
    ck_assert_int_eq(m.requests, 1);
    ck_assert_ptr_null(memory_array(&ctx, SIZE_MAX / 2, 3));
    ck_assert_int_eq(m.requests, 1);
    void *nothing = memory_array(&ctx, 0, 8); /* NULL would mean "no memory" */
    ck_assert_ptr_nonnull(nothing);
    memory_free(&ctx, nothing);
    ck_assert_int_eq(m.live, 0);
}
END_TEST

START_TEST(failed_allocations_are_null)
{
    failing_memory m;
    context ctx = failing_context(&m, 1);
    ck_assert_ptr_null(memory_array(&ctx, 1, 1));
    ctx = failing_context(&m, 1);
    ck_assert_ptr_null(memory_string(&ctx, "text"));
    ctx = failing_context(&m, 2);
    char *copy = memory_string(&ctx, "text");
    ck_assert_str_eq(copy, "text");
    memory_free(&ctx, copy);
    ck_assert_int_eq(m.live, 0);
}
END_TEST

typedef struct heard {
    int count;
    log_level level;
    char text[4096];
} heard;

static void hear(void *user, log_level level, const char *text)
{
    heard *h = user;
    h->count++;
    h->level = level;
    ck_assert_uint_lt(strlen(text), sizeof h->text);
    memcpy(h->text, text, strlen(text) + 1);
}

START_TEST(log_passes_what_is_grave_enough)
{
    heard h = {0};
    context ctx;
    context_init(&ctx);
    ctx.log = hear;
    ctx.log_user = &h;
    ctx.verbosity = LOG_WARNING;
    log_write(&ctx, LOG_INFO, "%d", 1);
    ck_assert_int_eq(h.count, 0);
    log_write(&ctx, LOG_WARNING, "%s %d", "floe", 7);
    ck_assert_int_eq(h.count, 1);
    ck_assert_int_eq(h.level, LOG_WARNING);
    ck_assert_str_eq(h.text, "floe 7");
}
END_TEST

START_TEST(long_log_texts_are_cut_visibly)
{
    heard h = {0};
    context ctx;
    context_init(&ctx);
    ctx.log = hear;
    ctx.log_user = &h;
    char text[3001];
    memset(text, 'x', 3000);
    text[3000] = '\0';
    log_write(&ctx, LOG_ERROR, "%s", text);
    ck_assert_uint_eq(strlen(h.text), 1023);
    ck_assert_str_eq(h.text + 1020, "...");
    ck_assert_int_eq(h.text[1019], 'x');
}
END_TEST

START_TEST(errors_hold_place_and_message)
{
    fram_error e;
    memset(&e, 'q', sizeof e);
    fram_status status = error_set(&e, FRAM_ERROR_INPUT, "a.yaml", 12, "ice.thickness", "is %g, must be > 0", -1.5);
    ck_assert_int_eq(status, FRAM_ERROR_INPUT);
    ck_assert_int_eq(e.status, FRAM_ERROR_INPUT);
    ck_assert_int_eq(e.line, 12);
    ck_assert_int_eq(e.column, 0);
    ck_assert_str_eq(e.file, "a.yaml");
    ck_assert_str_eq(e.key, "ice.thickness");
    ck_assert_str_eq(e.message, "is -1.5, must be > 0");
    ck_assert_int_eq(error_value(&e, "length", "a positive number", -2), FRAM_ERROR_INPUT);
    ck_assert_str_eq(e.key, "length");
    ck_assert_str_eq(e.file, "");
    ck_assert_str_eq(e.message, "expected a positive number, found -2");
    ck_assert_int_eq(error_memory(&e), FRAM_ERROR_MEMORY);
    ck_assert_int_eq(e.status, FRAM_ERROR_MEMORY);
    ck_assert_str_eq(e.file, "");
    ck_assert_str_eq(e.key, "");
    ck_assert_int_ne(e.message[0], '\0');
    ck_assert_int_eq(error_set(NULL, FRAM_ERROR_IO, "f", 1, "k", "m"), FRAM_ERROR_IO);
}
END_TEST

START_TEST(errors_are_told_in_a_line)
{
    static const struct {
        const char *file, *key;
        int line, column;
        const char *text;
    } cases[] = {{"a.yaml", "ice.thickness", 3, 7, "a.yaml:3:7: ice.thickness: too thin"},
                 {"a.yaml", NULL, 3, 0, "a.yaml:3: too thin"},
                 {"a.yaml", "ice", 0, 7, "a.yaml: ice: too thin"},
                 {NULL, "ice", 0, 0, "ice: too thin"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        fram_error e;
        char text[ERROR_TEXT_SIZE];
        error_set(&e, FRAM_ERROR_INPUT, cases[i].file, cases[i].line, cases[i].key, "too thin");
        e.column = cases[i].column;
        error_text(&e, text);
        ck_assert_str_eq(text, cases[i].text);
    }
}
END_TEST

START_TEST(errors_cut_what_is_too_long)
{
    char text[2000];
    memset(text, 'y', sizeof text);
    text[sizeof text - 1] = '\0';
    fram_error e;
    error_set(&e, FRAM_ERROR_USAGE, text, 0, text, "%s", text);
    ck_assert_uint_eq(strlen(e.file), sizeof e.file - 1);
    ck_assert_uint_eq(strlen(e.key), sizeof e.key - 1);
    ck_assert_uint_eq(strlen(e.message), sizeof e.message - 1);
}
END_TEST

START_TEST(an_error_can_be_wrapped_in_place)
{
    fram_error e;
    error_set(&e, FRAM_ERROR_IO, "hull.stl", 0, "file", "cannot read");
    error_set(&e, FRAM_ERROR_INPUT, e.file, 3, e.key, "vessel: %s", e.message);
    ck_assert_str_eq(e.file, "hull.stl");
    ck_assert_str_eq(e.key, "file");
    ck_assert_str_eq(e.message, "vessel: cannot read");
}
END_TEST

START_TEST(instruction_sets_have_names)
{
    ck_assert_str_eq(isa_name(ISA_BASELINE), "baseline");
    ck_assert_str_eq(isa_name(ISA_AVX2), "avx2");
    ck_assert_str_eq(isa_name(ISA_AVX512), "avx512");
    ck_assert_str_eq(isa_name((isa)99), "unknown");
#ifdef FRAM_KERNELS_X86
    ck_assert(isa_best() >= ISA_AVX2 || !__builtin_cpu_supports("avx2"));
    ck_assert(isa_best() < ISA_AVX512 || __builtin_cpu_supports("avx512f"));
#else
    ck_assert_int_eq(isa_best(), ISA_BASELINE);
#endif
}
END_TEST

TEST_MAIN("context", defaults_are_library_memory_silence_and_one_thread, arrays_are_zero_and_their_size_cannot_overflow,
          failed_allocations_are_null, log_passes_what_is_grave_enough, long_log_texts_are_cut_visibly,
          errors_hold_place_and_message, errors_are_told_in_a_line, errors_cut_what_is_too_long,
          an_error_can_be_wrapped_in_place, instruction_sets_have_names)
