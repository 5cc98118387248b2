/* One piece of work in a thread of its own, beside the caller's: for waiting on the disk, never for results. */
#ifndef BASE_BACKGROUND_H
#define BASE_BACKGROUND_H

#include <pthread.h>
#include <stdbool.h>

/* Starts as {0}. */
typedef struct background {
    pthread_t thread;
    void (*work)(void *user);
    void *user;
    bool threaded;
} background;

/* Begins work(user), which must touch nothing that the caller touches before background_wait, the context's memory and
   log included; done at once when the system gives no thread.  Signals are left to the threads of the host program. */
void background_start(background *b, void (*work)(void *user), void *user);
/* Until it is done. */
void background_wait(background *b);

#endif
