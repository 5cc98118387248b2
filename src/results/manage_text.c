/* Results of ice management in a few lines, or as JSON. */
#include "results/manage.h"

#include "base/load_unit.h"
#include "base/number_text.h"

#include <math.h>
#include <stdio.h>

static const char *const words[MANAGE_PLACES] = {"upstream", "behind the icebreakers", "at the vessel"};
static const char *const keys[MANAGE_PLACES] = {"upstream", "behind", "at_vessel"};

/* A column of a table: a dash where there is nothing to tell, as of the floes of a place that had none. */
static void tell_number(context *ctx, const char *format, int width, double value, text_buffer *out)
{
    char number[32] = "-";
    if (!isnan(value))
        snprintf(number, sizeof number, format, value);
    text_format(ctx, out, " %*s", width, number);
}

static void tell_place(context *ctx, const manage_summary *s, int place, text_buffer *out)
{
    bool windows = s->place[place].windows > 0, floes = s->place[place].largest > 0;
    text_format(ctx, out, "%-24s %8.0f", words[place], s->place[place].windows);
    tell_number(ctx, "%.3f", 14, windows ? s->place[place].concentration : (double)NAN, out);
    tell_number(ctx, "%.1f%%", 10, windows ? 100 * s->place[place].managed : (double)NAN, out);
    tell_number(ctx, "%.1f%%", 11, windows ? 100 * s->place[place].sheet : (double)NAN, out);
    tell_number(ctx, "%.3g", 11, floes ? s->place[place].mean : (double)NAN, out);
    tell_number(ctx, "%.3g", 12, floes ? s->place[place].largest : (double)NAN, out);
    text_add(ctx, out, "\n");
}

static void tell_time(context *ctx, const char *name, double least, double median, text_buffer *out)
{
    text_format(ctx, out, "%-46s", name);
    for (int i = 0; i < 2; i++) {
        double t = i ? median : least;
        if (isnan(t))
            text_add(ctx, out, "              -");
        else if (isinf(t))
            text_add(ctx, out, "  none in sight");
        else
            text_format(ctx, out, " %12.4g s", t);
    }
    text_add(ctx, out, "\n");
}

static void tell_loads(context *ctx, const manage_summary *a, text_buffer *out)
{
    if (isnan(a->load_mean))
        text_add(ctx, out, "ice load not known: the run ends before run.transient\n");
    else
        text_format(ctx, out, "ice load %s mean, %s at most\n", load_text_of(a->load_mean, 4).text,
                    load_text_of(a->load_most, 4).text);
    if (!isnan(a->offset_most))
        text_format(ctx, out, "offset %.3g m at most\n", a->offset_most);
    if (!isnan(a->tension_most))
        text_format(ctx, out, "line tension %s at most\n", load_text_of(a->tension_most, 4).text);
    if (!isnan(a->tension_range))
        text_format(ctx, out, "fatigue of line %d: %s, damage-equivalent range of tension\n", (int)a->tension_line,
                    load_text_of(a->tension_range, 4).text);
}

static void tell(context *ctx, const manage_summary *s, const manage_summary *beside, text_buffer *out)
{
    const manage_summary *all[2] = {s, beside};
    for (int k = 0; k < (beside ? 2 : 1); k++) {
        const manage_summary *a = all[k];
        text_format(ctx, out, "%-24s %8s %14s %10s %11s %11s %12s\n", k ? "comparison run" : "this run", "windows",
                    "concentration", "managed", "unbroken", "mean [m]", "largest [m]");
        for (int p = 0; p < MANAGE_PLACES; p++)
            tell_place(ctx, a, p, out);
        tell_loads(ctx, a, out);
    }
    text_format(ctx, out, "managed: floes of at most %.3g m", s->limit);
    if (!isnan(s->largest_time))
        text_format(ctx, out, "; the largest that came, at %.4g s", s->largest_time);
    text_add(ctx, out, "\n");
    if (s->empty > 0 && !isnan(s->first_time))
        text_format(ctx, out, "no ice before the vessel until %.4g s, which the means count: give run.transient %s\n",
                    s->first_time, least_text_of(s->first_time, 4).text);
    tell_time(ctx, "time until the nearest unmanaged ice arrives, least, median", s->alarm_least, s->alarm_median, out);
    tell_time(ctx, "time until the largest unmanaged ice arrives, least, median", s->warning_least, s->warning_median,
              out);
}

static void real(context *ctx, text_buffer *out, const char *name, double value, const char *after)
{
    text_format(ctx, out, "\"%s\": ", name);
    text_real_or_null(ctx, out, value);
    text_add(ctx, out, after);
}

static const json_unit manage_units[] = {{"limit", "m"},
                                         {"mean_size", "m"},
                                         {"largest", "m"},
                                         {"largest_at_time", "s"},
                                         {"first_ice_at_time", "s"},
                                         {"unmanaged_comes_in_least", "s"},
                                         {"unmanaged_comes_in_median", "s"},
                                         {"largest_unmanaged_comes_in_least", "s"},
                                         {"largest_unmanaged_comes_in_median", "s"},
                                         {"load_mean", "N"},
                                         {"load_most", "N"},
                                         {"offset_most", "m"},
                                         {"tension_most", "N"},
                                         {"tension_range_equivalent", "N"}};

static void summary_json(context *ctx, const manage_summary *s, text_buffer *out)
{
    text_add(ctx, out, "{");
    real(ctx, out, "limit", s->limit, ", ");
    for (int p = 0; p < MANAGE_PLACES; p++) {
        text_format(ctx, out, "\"%s\": {", keys[p]);
        real(ctx, out, "windows", s->place[p].windows, ", ");
        real(ctx, out, "concentration", s->place[p].concentration, ", ");
        real(ctx, out, "managed", s->place[p].managed, ", ");
        real(ctx, out, "unbroken", s->place[p].sheet, ", ");
        real(ctx, out, "mean_size", s->place[p].mean, ", ");
        real(ctx, out, "largest", s->place[p].windows > 0 ? s->place[p].largest : (double)NAN, "}, ");
    }
    real(ctx, out, "largest_at_time", s->largest_time, ", ");
    real(ctx, out, "first_ice_at_time", s->first_time, ", ");
    real(ctx, out, "unmanaged_comes_in_least", s->alarm_least, ", ");
    real(ctx, out, "unmanaged_comes_in_median", s->alarm_median, ", ");
    real(ctx, out, "largest_unmanaged_comes_in_least", s->warning_least, ", ");
    real(ctx, out, "largest_unmanaged_comes_in_median", s->warning_median, ", ");
    real(ctx, out, "load_mean", s->load_mean, ", ");
    real(ctx, out, "load_most", s->load_most, ", ");
    real(ctx, out, "offset_most", s->offset_most, ", ");
    real(ctx, out, "tension_most", s->tension_most, ", ");
    real(ctx, out, "tension_range_equivalent", s->tension_range, ", ");
    real(ctx, out, "tension_line", s->tension_line > 0 ? s->tension_line : (double)NAN, "}");
}

fram_status manage_text(context *ctx, const manage_summary *s, const manage_summary *beside, bool json,
                        text_buffer *out, fram_error *error)
{
    if (!json) {
        tell(ctx, s, beside, out);
    } else {
        text_add(ctx, out, "{\"run\": ");
        summary_json(ctx, s, out);
        if (beside) {
            text_add(ctx, out, ", \"beside\": ");
            summary_json(ctx, beside, out);
        }
        text_units(ctx, out, manage_units, (int32_t)(sizeof manage_units / sizeof *manage_units));
        text_add(ctx, out, "}\n");
    }
    return out->failed ? error_memory(error) : FRAM_OK;
}
