/* Looking on while a run goes: a page on this machine's loopback address that plays the record as it grows.  Whoever
   knows the address can look on, nobody can do more: it holds a random token, requests for anything but the page and
   the record are refused, and so are those that came by another host name (docs/decisions/0185).  HTTP is
   libmicrohttpd's, which takes its memory from the C library and answers from a thread of its own; this file's part of
   that thread reads the record's file and nothing of the run. */
#ifndef RESULTS_LIVE_VIEW_H
#define RESULTS_LIVE_VIEW_H

#include "base/context.h"

typedef struct live_view live_view;

/* An address is given out, and the page can be opened; there is nothing in it before live_view_begin.  viewer: the page
   without a record.  FRAM_ERROR_UNSUPPORTED in a build without libmicrohttpd. */
fram_status live_view_open(context *ctx, const char *folder, const char *viewer, live_view **view, fram_error *error);
/* "http://127.0.0.1:PORT/TOKEN/" */
const char *live_view_address(const live_view *view);
/* From now on the folder's record is that of this run.  view may be NULL. */
void live_view_begin(live_view *view);
/* The record is whole.  Pages that are open get what they lack, and behind it the loads by mechanism with the peaks
   that the run kept (playback_explained.h), for a few seconds at most; then nothing answers any more.  view may be
   NULL. */
void live_view_end(live_view *view);

#endif
