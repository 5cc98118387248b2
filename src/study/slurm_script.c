#include "study/slurm_script.h"

#include <stdio.h>
#include <string.h>

/* A text as one word of the shell. */
static void quoted(context *ctx, text_buffer *out, const char *text)
{
    text_add(ctx, out, "'");
    for (const char *c = text; *c; c++)
        text_format(ctx, out, *c == '\'' ? "'\\''" : "%c", *c);
    text_add(ctx, out, "'");
}

/* sbatch divides a directive at blanks and ends it at #: a value that has some, and no quotation marks yet, is put into
   such. */
static void add_option(context *ctx, text_buffer *out, const char *option)
{
    const char *value = strchr(option, '=');
    if (value && strpbrk(value, " \t#") && !strpbrk(value, "\"'\\"))
        text_format(ctx, out, "#SBATCH %.*s\"%s\"\n", (int)(value + 1 - option), option, value + 1);
    else
        text_format(ctx, out, "#SBATCH %s\n", option);
}

void slurm_script_array(const slurm_script_facts *f, char out[SLURM_ARRAY_SIZE])
{
    int used = snprintf(out, SLURM_ARRAY_SIZE, "0-%d", (int)((f->runs - 1) / f->each));
    if (f->options->jobs > 0)
        snprintf(out + used, SLURM_ARRAY_SIZE - (size_t)used, "%%%d", f->options->jobs);
}

/* Whether the option is one word, as it stands: what has quotation marks, or a blank before its value, is so for the
   script, which alone takes that apart. */
static bool is_word(const char *option)
{
    char end = option[strcspn(option, " \t=")];
    return end != ' ' && end != '\t' && !strpbrk(option, "\"'\\");
}

/* Whether it is the option by which sbatch leaves out nodes, by as few letters as it takes. */
static bool is_exclusion(const char *option)
{
    static const char name[] = "--exclude", least[] = "--exclud";
    size_t length = strcspn(option, " \t=");
    return length >= sizeof least - 1 && length < sizeof name && strncmp(option, name, length) == 0;
}

/* What stands in place of an option in an array that has nodes of its own to leave out. */
static bool is_replaced(const slurm_script_facts *f, int option)
{
    return f->exclude && is_exclusion(f->options->options[option]);
}

void slurm_script_exclusion(context *ctx, const slurm_options *options, const char *nodes, text_buffer *out)
{
    text_add(ctx, out, "--exclude=");
    for (int i = 0; i < options->option_count; i++) {
        const char *c = options->options[i];
        if (!is_exclusion(c))
            continue;
        for (c += strcspn(c, " \t="); *c; c++)
            if (!strchr(" \t=\"'\\", *c))
                text_add_bytes(ctx, out, c, 1);
        text_add(ctx, out, ",");
    }
    text_add(ctx, out, nodes);
}

/* Variables of the environment (SBATCH_PARTITION, SBATCH_TIMELIMIT, ...) go before what a script says, and options of
   the command before both: what was asked for stands in the script, for whoever reads it, and here. */
const char **slurm_submission(context *ctx, const slurm_script_facts *f, const char *array, const char *path)
{
    const slurm_options *o = f->options;
    const char **words = memory_array(ctx, (size_t)o->option_count + 11, sizeof *words);
    int count = 0;
    if (!words)
        return NULL;
    words[count++] = "sbatch";
    words[count++] = "--parsable";
    words[count++] = "--array";
    words[count++] = array;
    if (o->partition) {
        words[count++] = "--partition";
        words[count++] = o->partition;
    }
    if (o->time) {
        words[count++] = "--time";
        words[count++] = o->time;
    }
    for (int i = 0; i < o->option_count; i++)
        if (is_word(o->options[i]) && !is_replaced(f, i))
            words[count++] = o->options[i];
    if (f->exclude)
        words[count++] = f->exclude;
    words[count++] = path;
    words[count] = NULL;
    return words;
}

static void directives(context *ctx, const slurm_script_facts *f, text_buffer *out)
{
    char array[SLURM_ARRAY_SIZE];
    slurm_script_array(f, array);
    text_format(ctx, out, "#!/bin/bash\n#SBATCH --job-name=fram-study\n#SBATCH --array=%s\n", array);
    text_add(ctx, out,
             "#SBATCH --ntasks=1\n#SBATCH --cpus-per-task=1\n#SBATCH --requeue\n#SBATCH --output=/dev/null\n");
    if (f->options->partition)
        text_format(ctx, out, "#SBATCH --partition=%s\n", f->options->partition);
    if (f->options->time)
        text_format(ctx, out, "#SBATCH --time=%s\n", f->options->time);
    for (int i = 0; i < f->options->option_count; i++)
        if (!is_replaced(f, i))
            add_option(ctx, out, f->options->options[i]);
    if (f->exclude)
        add_option(ctx, out, f->exclude);
}

void slurm_script(context *ctx, const slurm_script_facts *f, text_buffer *out)
{
    directives(ctx, f, out);
    text_add(ctx, out, "\n# Runs of a study: each task takes the same number of lines of the list.\nfolder=");
    quoted(ctx, out, f->folder);
    text_add(ctx, out, "\nfram=");
    quoted(ctx, out, f->program);
    text_format(ctx, out, "\nlist=$folder/slurm/%d.list\neach=%d\n", (int)f->number, (int)f->each);
    text_add(ctx, out,
             "first=$((SLURM_ARRAY_TASK_ID * each + 1))\n"
             "sed -n \"${first},$((first + each - 1))p\" \"$list\" | while read -r id seed frames; do\n"
             "    run=$folder/runs/$id/$seed record=\n"
             "    # One of the worst, made again with a record.\n"
             "    [ -z \"$frames\" ] || run=$folder/worst/$id-$seed record=\"--set output.frame_interval=$frames\"\n"
             "    # A task that starts again goes on behind what it has done.\n"
             "    [ ! -e \"$run.exit\" ] && [ ! -e \"$run.row\" ] || continue\n"
             "    # Exit code 2: a program of a task that was cancelled still holds the folder.\n"
             "    for try in 1 2 3 4 5; do\n"
             "        # What a limit of time stopped goes on from its checkpoint, to the same end; what cannot, anew.\n"
             "        code=2\n"
             "        if ls \"$run\"/checkpoint-*.fram >/dev/null 2>&1; then\n"
             "            \"$fram\" resume \"$run\" --threads 1 --quiet </dev/null >/dev/null 2>\"$run.log\"\n"
             "            code=$?\n"
             "        fi\n"
             "        if [ \"$code\" = 1 ] || [ \"$code\" = 2 ]; then\n"
             "            \"$fram\" run \"$folder/conditions/$id.yaml\" -o \"$run\" --set \"run.seed=$seed\" "
             "$record --threads 1 --force --quiet \\\n"
             "                </dev/null >/dev/null 2>\"$run.log\"\n"
             "            code=$?\n"
             "        fi\n"
             "        [ \"$code\" = 2 ] && [ \"$try\" != 5 ] || break\n"
             "        sleep 2\n"
             "    done\n"
             "    # As the system's loader ends where a library of the node is too old: 127 where it lacks one.\n"
             "    [ \"$code\" != 1 ] || ! grep -qsF '(required by ' \"$run.log\" || code=127\n"
             "    # Beside the scripts: a task that is killed before it is renamed leaves nothing among the runs.\n"
             "    mark=$folder/slurm/exit-$SLURM_ARRAY_JOB_ID-$SLURM_ARRAY_TASK_ID\n"
             "    echo \"$code${SLURMD_NODENAME:+ $SLURMD_NODENAME}\" >\"$mark\" && mv -f \"$mark\" \"$run.exit\"\n"
             "done\n");
}
