/* The line of standard error that is drawn over and over where that is a terminal: what is told in it, and what is
   written when it stands there.  Nothing is remembered: what comes next clears the line, drawn or not. */
#include "cli/cli.h"

#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

/* Where nobody tells how wide a terminal is; a single sign of those that are wider tells nothing. */
enum { COLUMNS_ELSE = 80, COLUMNS_LEAST = 2 };

bool terminal_draws(void)
{
    const char *kind = getenv("TERM");
    return isatty(STDERR_FILENO) == 1 && kind && *kind && strcmp(kind, "dumb") != 0;
}

void terminal_clear(void)
{
    if (terminal_draws())
        fputs("\r\033[K", stderr);
}

static int columns_of_terminal(void)
{
    struct winsize size;
    bool told = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return !told ? COLUMNS_ELSE : size.ws_col < COLUMNS_LEAST ? COLUMNS_LEAST : size.ws_col;
}

/* Bytes of a sign and the columns it takes: two from U+3000 on, where the scripts of East Asia stand; what is no UTF-8
   is shown as one sign a byte. */
static size_t sign_bytes(const char *sign, int *columns)
{
    int bytes = utf8_sequence(sign);
    *columns = bytes >= 3 && (unsigned char)*sign >= 0xe3 ? 2 : 1;
    return bytes > 0 ? (size_t)bytes : 1;
}

/* Bytes of a text that fit in so many columns, which are counted down. */
static size_t fitting(const char *text, int *room)
{
    size_t at = 0;
    while (text[at]) {
        int columns;
        size_t bytes = sign_bytes(text + at, &columns);
        if (columns > *room)
            break;
        *room -= columns;
        at += bytes;
    }
    return at;
}

/* Whether the parts up to a rank fit in so many columns. */
static bool parts_fit(const line_part *parts, int count, int rank, int room)
{
    for (int i = 0; i < count; i++) {
        if (parts[i].rank <= rank && parts[i].text[fitting(parts[i].text, &room)])
            return false;
    }
    return true;
}

void terminal_line(const line_part *parts, int count)
{
    bool drawn = terminal_draws();
    int rank = 0, room = columns_of_terminal() - 1; /* a sign in the last column wraps the line */
    for (int i = 0; i < count; i++)
        rank = parts[i].rank > rank ? parts[i].rank : rank;
    while (drawn && rank > 0 && !parts_fit(parts, count, rank, room))
        rank--;
    terminal_clear();
    for (int i = 0; i < count; i++) {
        if (parts[i].rank <= rank)
            tell(stderr, "%.*s", (int)(drawn ? fitting(parts[i].text, &room) : strlen(parts[i].text)), parts[i].text);
    }
    if (!drawn)
        fputc('\n', stderr);
    fflush(stderr);
}
