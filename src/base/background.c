#include "base/background.h"

#include <signal.h>
#include <stddef.h>

static void *run(void *user)
{
    background *b = user;
    b->work(b->user);
    return NULL;
}

void background_start(background *b, void (*work)(void *user), void *user)
{
    sigset_t all, before;
    *b = (background){.work = work, .user = user};
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    b->threaded = pthread_create(&b->thread, NULL, run, b) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (!b->threaded)
        work(user);
}

void background_wait(background *b)
{
    if (b->threaded)
        pthread_join(b->thread, NULL);
    b->threaded = false;
}
