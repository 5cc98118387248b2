#include "model/inputs.h"

#define TABLE_SELF input_table
TABLE_DEFINE(input, INPUT_FIELDS)
#undef TABLE_SELF

int32_t input_find(const input_table *inputs, input_kind kind, int32_t which)
{
    for (int32_t i = 0; i < inputs->count; i++) {
        if (inputs->kind[i] == (int32_t)kind && inputs->which[i] == which)
            return i;
    }
    return -1;
}

int32_t input_row(context *ctx, input_table *inputs, input_kind kind, int32_t which)
{
    int32_t row = input_find(inputs, kind, which);
    if (row >= 0)
        return row;
    row = inputs->count;
    if (!table_resize(ctx, inputs, &input_table_info, row + 1))
        return -1;
    inputs->kind[row] = (int32_t)kind;
    inputs->which[row] = which;
    return row;
}

bool input_tell(context *ctx, input_table *inputs, input_kind kind, int axis, double value)
{
    int32_t row = input_row(ctx, inputs, kind, 0);
    if (row < 0)
        return false;
    vec3 *first = &inputs->first[row], *told = &inputs->second[row];
    *(axis == 0 ? &first->x : axis == 1 ? &first->y : &first->z) = value;
    *(axis == 0 ? &told->x : axis == 1 ? &told->y : &told->z) = 1;
    return true;
}

vec3 input_velocity(const input_table *inputs, input_kind kind, vec3 without)
{
    int32_t row = input_find(inputs, kind, 0);
    if (row < 0)
        return without;
    vec3 told = inputs->first[row], is_told = inputs->second[row];
    return vec3_make(is_told.x != 0 ? told.x : without.x, is_told.y != 0 ? told.y : without.y,
                     is_told.z != 0 ? told.z : without.z);
}

void input_drop(input_table *inputs, input_kind kind)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < inputs->count; i++) {
        if (inputs->kind[i] == (int32_t)kind)
            continue;
        if (kept < i)
            table_move_row(inputs, &input_table_info, kept, i);
        kept++;
    }
    inputs->count = kept;
}
