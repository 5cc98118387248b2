/* Peaks in words. */
#include "io/record_layout.h"
#include "results/peaks.h"
#include "scratch.h"

#include <unistd.h>

START_TEST(breaks_are_one_or_many)
{
    static const struct {
        int32_t bendings, splits;
        const char *words;
    } cases[] = {{0, 2, "0 breaks in bending and 2 splits"},
                 {1, 0, "1 break in bending and 0 splits"},
                 {7, 1, "7 breaks in bending and 1 split"}};
    context ctx;
    context_init(&ctx);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        text_buffer out = {0};
        peak_tell_breaks(&ctx, &(peak_breaks){.bendings = cases[i].bendings, .splits = cases[i].splits}, &out);
        ck_assert_str_eq(out.data, cases[i].words);
        text_free(&ctx, &out);
    }
}
END_TEST

/* Parts of a sheet that came loose are no breaks, neither as a number nor as the last one. */
START_TEST(parts_that_came_loose_are_no_breaks)
{
    static double time[] = {1, 7, 8, 9, 9.5, 12}, kind[] = {2, 1, 2, 2, 3, 2};
    csv_table_column columns[] = {{.name = "time", .value = {time, 6, 6}}, {.name = "kind", .value = {kind, 6, 6}}};
    run_data d = {.s.run.scale = 30, .fractures = {.columns = {columns, 2, 2}, .rows = 6}};
    peak_breaks b = peak_breaks_before(&d, 10);
    ck_assert_int_eq(b.splits, 1);
    ck_assert_int_eq(b.bendings, 2);
    ck_assert_double_eq(b.last, 9);
    b = peak_breaks_before(&d, nextafter(9, 0));
    ck_assert_double_eq(b.last, nextafter(9, 0)); /* a rounding is no time before */
    d.s.run.scale = 1.2;                          /* a 25th part of that: a fifth of the span, one second */
    b = peak_breaks_before(&d, 9.3);
    ck_assert_int_eq(b.splits, 0);
    ck_assert_int_eq(b.bendings, 1);
    d.s.run.scale = 30;
    kind[1] = kind[2] = kind[3] = 3;
    b = peak_breaks_before(&d, 10);
    ck_assert_int_eq(b.splits + b.bendings, 0);
    ck_assert(isnan(b.last));
}
END_TEST

/* Of a recording that began late nothing is known of the time before. */
START_TEST(breaks_before_a_recording_are_not_known)
{
    static double time[] = {8.4, 8.42}, broke[] = {9}, kind[] = {FRACTURE_SPLIT};
    static peak_detail peak = {.time = 10, .load = 1000, .window = 0.5, .mechanism = {1000}};
    csv_table_column row = {.name = "time", .value = {time, 2, 2}};
    csv_table_column columns[] = {{.name = "time", .value = {broke, 1, 1}}, {.name = "kind", .value = {kind, 1, 1}}};
    run_data d = {.s.run = {.scale = 30, .time_step = 0.02},
                  .note.recorded_from = -1, /* as an earlier version left it */
                  .series = {.columns = {&row, 1, 1}, .rows = 2},
                  .fractures = {.columns = {columns, 2, 2}, .rows = 1}};
    context ctx;
    text_buffer out = {0};
    context_init(&ctx);
    assert_absolute(peak_span_recorded(&d, 10), 1.6, 1e-12);
    ck_assert_double_eq(peak_span_recorded(&d, 13.5), 5);
    peak_sentence(&ctx, &d, &peak, &out);
    ck_assert_msg(strstr(out.data, "1 split in the 1.6 s since the recording began."), "%s", out.data);
    text_free(&ctx, &out);
}
END_TEST

/* Each end of a chain has its words, and only floes are counted before it. */
START_TEST(ends_of_chains)
{
    static const struct {
        chain_end end;
        int links, left_out;
        const char *words;
    } cases[] = {{CHAIN_INERTIA, 3, 0, "behind it 2 more to one that its inertia holds."},
                 {CHAIN_WATER, 3, 0, "behind it 2 more to one that water and weight hold."},
                 {CHAIN_SHEET, 2, 0, "behind it 1 more to fixed ice."},
                 {CHAIN_DRIVEN, 24, 7, "behind it 30 more to driven ice."},
                 {CHAIN_WALL, 3, 0, "behind it 1 more to a wall."},
                 {CHAIN_WALL, 2, 0, "behind it a wall."},
                 {CHAIN_VESSEL, 2, 0, "behind it a vessel."},
                 {CHAIN_LOOP, 4, 0, "behind it 3 more and back to one of them."},
                 {CHAIN_ITSELF, 4, 0, "behind it 2 more and back to the vessel itself."},
                 {CHAIN_LONG, 24, 232, "behind it 255 more and on beyond what is followed."}};
    context ctx;
    context_init(&ctx);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        static peak_detail peak = {.time = 10, .load = 1000, .window = 0.5, .mechanism = {1000}, .floe_count = 1};
        run_data d = {.s.run = {.scale = 30, .time_step = 0.02}, .note.recorded_from = -1};
        text_buffer out = {0};
        peak.floe[0] = (peak_floe){.part = {1000}, .links = (uint8_t)cases[i].links, .end = (uint8_t)cases[i].end};
        peak.floe[0].left_out = (uint16_t)cases[i].left_out;
        peak_sentence(&ctx, &d, &peak, &out);
        ck_assert_msg(strstr(out.data, cases[i].words), "%s, not: %s", cases[i].words, out.data);
        text_free(&ctx, &out);
    }
}
END_TEST

/* Runs of before that was told apart have it as a vessel. */
START_TEST(one_vessel_is_itself)
{
    static peak_detail peak = {.time = 10, .load = 1000, .window = 0.5, .mechanism = {1000}, .floe_count = 1};
    run_data d = {.s.run = {.scale = 30, .time_step = 0.02}, .s.vessel.present = true, .note.recorded_from = -1};
    peak.floe[0] = (peak_floe){.part = {1000}, .links = 4, .end = CHAIN_VESSEL, .end_vessel = -1};
    context ctx;
    context_init(&ctx);
    text_buffer out = {0};
    peak_sentence(&ctx, &d, &peak, &out);
    ck_assert_msg(strstr(out.data, "behind it 2 more and back to the vessel itself."), "%s", out.data);
    ck_assert_int_eq(peak_end(&d, &peak.floe[0]), CHAIN_ITSELF);
    text_free(&ctx, &out);
}
END_TEST

/* By falling load, whatever the order in the file, and no more than a run keeps of a vessel. */
START_TEST(peaks_of_a_file)
{
    char folder[SCRATCH_FOLDER], path[SCRATCH_PATH];
    scratch_folder(folder);
    snprintf(path, sizeof path, "%s/peaks.fram", folder);
    for (int count = PEAKS_KEPT; count <= PEAKS_KEPT + 1; count++) {
        context ctx;
        fram_error error = {0};
        record_writer w;
        peak_list list;
        context_init(&ctx);
        assert_ok(record_create(&ctx, path, &w, &error), error);
        for (int i = 0; i < count; i++) {
            const peak_detail d = {.time = 10 + i, .load = 1000 * (1 + i % 4), .window = 0.5};
            unsigned char room[PEAK_BLOCK_ROOM];
            const record_part part = {room, peak_block_pack(&d, (vec2){0, 0}, room)};
            assert_ok(record_append(&w, BLOCK_PEAK, &part, 1, &error), error);
        }
        assert_ok(record_close(&w, &error), error);
        fram_status status = peak_list_read(&ctx, folder, 0, &list, &error);
        ck_assert_int_eq(status, count > PEAKS_KEPT ? FRAM_ERROR_INPUT : FRAM_OK);
        ck_assert_int_eq(list.count, count > PEAKS_KEPT ? 0 : count);
        for (int32_t i = 1; i < list.count; i++)
            ck_assert_double_ge(list.peak[i - 1]->load, list.peak[i]->load);
        peak_list_free(&ctx, &list);
    }
    ck_assert_int_eq(unlink(path), 0);
    ck_assert_int_eq(rmdir(folder), 0);
}
END_TEST

TEST_MAIN("peaks", breaks_are_one_or_many, parts_that_came_loose_are_no_breaks, breaks_before_a_recording_are_not_known,
          ends_of_chains, one_vessel_is_itself, peaks_of_a_file)
