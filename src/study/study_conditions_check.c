/* What is looked at in the scenarios of all conditions of a study as it is read: whose figures it tells, by what the
   worst runs are chosen, and that no key is given twice. */
#include "study/study_file.h"

#include "model/scenario_vessel.h"
#include "results/station_results.h"
#include "study/run_row.h"

#include <string.h>

/* The vessel whose figures are told must be there under every condition. */
static fram_status check_vessel(context *ctx, const study *s, int32_t condition, const scenario *one, fram_error *error)
{
    if (!s->vessel || scenario_find_vessel(one, s->vessel) >= 0)
        return FRAM_OK;
    text_buffer there = {0};
    for (int32_t v = 0; v < scenario_vessel_count(one); v++) {
        const char *name = scenario_vessel_entry(one, v).keys->name;
        text_format(ctx, &there, "%s%s", v > 0 ? ", " : "", name[0] ? name : "one without a name");
    }
    fram_status status = error_set(error, FRAM_ERROR_INPUT, s->file, s->vessel_line, "vessel",
                                   "expected the name of a vessel that is present (%.200s), found \"%.40s\"",
                                   there.data ? there.data : "there is none", s->vessel);
    study_place_error(s, condition, error);
    text_free(ctx, &there);
    return status;
}

/* Who is told of where the study names nobody: the first vessel that is present, the same one under all conditions, or
   a condition without a vessel would be compared with one that has another. */
typedef struct first_vessel {
    char *name; /* NULL before the first condition */
    bool everywhere;
} first_vessel;

/* Of a name of this condition and one of the first condition that which is there in both; NULL: neither. */
static fram_status find_common(context *ctx, const study *s, const scenario *one, const char *name, const char *first,
                               const char **out, fram_error *error)
{
    scenario other = {0};
    *out = scenario_find_vessel(one, first) >= 0 ? first : NULL;
    fram_status status = *out ? FRAM_OK : study_scenario(ctx, s, 0, s->seeds.first, &other, error);
    if (!*out && status == FRAM_OK && scenario_find_vessel(&other, name) >= 0)
        *out = name;
    scenario_free(ctx, &other);
    return status;
}

static fram_status take_first(context *ctx, const study *s, int32_t condition, const scenario *one, first_vessel *first,
                              fram_error *error)
{
    if (s->vessel || scenario_vessel_count(one) == 0) {
        first->everywhere = false;
        return FRAM_OK;
    }
    const char *name = scenario_vessel_entry(one, 0).keys->name;
    if (!first->name) {
        first->name = memory_string(ctx, name);
        return first->name ? FRAM_OK : error_memory(error);
    }
    if (strcmp(name, first->name) == 0)
        return FRAM_OK;
    const char *common = NULL;
    fram_status status = find_common(ctx, s, one, name, first->name, &common, error);
    if (status != FRAM_OK)
        return status;
    status = error_set(
        error, FRAM_ERROR_INPUT, s->file, 0, "vessel",
        "the first vessel that is present is \"%.40s\", and \"%.40s\" in condition 1: %s%.40s", name, first->name,
        common ? "name the one whose figures are told, as vessel: "
               : "figures are told of one that is there under all conditions, and the conditions name it "
                 "otherwise",
        common ? common : "");
    study_place_error(s, condition, error);
    return status;
}

/* Whether runs of the scenario have the figure by which the worst are chosen. */
static bool has_worst(const study *s, const scenario *one)
{
    int32_t vessel = s->vessel ? scenario_find_vessel(one, s->vessel) : 0;
    const int figure = s->worst.figure;
    bool of_station = figure >= ROW_offset_mean && figure <= ROW_thruster_power_mean;
    bool of_lines = (figure >= ROW_line_tension_significant && figure <= ROW_lines_broken) ||
                    figure == ROW_line_tension_range_equivalent;
    if (!of_station && !of_lines)
        return true;
    if (!station_has_results(one, vessel))
        return false;
    const scenario_vessel *v = scenario_vessel_entry(one, vessel).keys;
    return of_lines ? v->mooring.lines.count > 0 : figure != ROW_thruster_power_mean || v->thrusters.count > 0;
}

/* Keys of the study in their order: `set`, then what conditions vary. */
static const char *key_at(const study *s, int32_t i)
{
    return i < s->set.count ? s->set.data[i].key : s->keys.data[i - s->set.count];
}

/* Of vessels.a.speed and vessels[0].speed the later one alone would count.  Each value over those of the file has left
   its place in the scenario, as the file would call it, behind those of the file; the seed's is the last. */
static fram_status check_spellings(const study *s, const scenario *one, fram_error *error)
{
    int32_t count = s->set.count + s->keys.count;
    const scenario_place *place = one->places.data + one->places.count - 1 - count;
    for (int32_t i = 0; i < count; i++) {
        for (int32_t k = i + 1; k < count; k++) {
            if (strcmp(place[i].key, place[k].key) != 0)
                continue;
            bool set = k < s->set.count, table = !set && s->table;
            return error_set(error, FRAM_ERROR_INPUT, table ? s->table : s->file,
                             set     ? s->set.data[k].line
                             : table ? 0
                                     : s->keys_line,
                             key_at(s, k), "is the same key as %s: give it once", key_at(s, i));
        }
    }
    return FRAM_OK;
}

fram_status study_conditions_check(context *ctx, study *s, fram_error *error)
{
    fram_status status = FRAM_OK;
    first_vessel first = {.everywhere = true};
    bool worst = false;
    for (int32_t c = 0; c < s->conditions && status == FRAM_OK; c++) {
        scenario one = {0};
        status = study_scenario(ctx, s, c, s->seeds.first, &one, error);
        if (status == FRAM_OK) {
            status = c == 0 ? check_spellings(s, &one, error) : FRAM_OK;
            if (status == FRAM_OK)
                status = check_vessel(ctx, s, c, &one, error);
            if (status == FRAM_OK)
                status = take_first(ctx, s, c, &one, &first, error);
            worst = worst || has_worst(s, &one);
            scenario_free(ctx, &one);
        }
    }
    if (status == FRAM_OK && first.everywhere && first.name && *first.name) {
        s->vessel = first.name;
        first.name = NULL;
    }
    memory_free(ctx, first.name);
    if (status == FRAM_OK && !worst)
        status =
            error_set(error, FRAM_ERROR_INPUT, s->file, s->worst.line, "by",
                      "no run of this study has %s: its vessel keeps no station, or has no mooring or thrusters for "
                      "that; take load_largest",
                      run_figure_name((run_figure)s->worst.figure));
    return status;
}
