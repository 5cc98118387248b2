/* Hashes: a fast 64-bit one for state, SHA-256 (nettle) for files. */
#ifndef BASE_HASH_H
#define BASE_HASH_H

#include "base/context.h"

/* The same for the same bytes on every machine of one endianness; not safe against an adversary.  About 20 GB/s. */
uint64_t hash_bytes(const void *data, size_t size, uint64_t seed);
/* Lower-case hex SHA-256 of a memory block, 64 characters and a NUL. */
enum { SHA256_TEXT_SIZE = 65 };
void sha256_text(const void *data, size_t size, char out[SHA256_TEXT_SIZE]);

#endif
