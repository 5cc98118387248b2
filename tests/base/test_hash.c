/* The state hash and SHA-256. */
#include "base/hash.h"
#include "testing.h"

/* Deterministic bytes without a pattern that a multiplicative hash might like. */
static void bytes_fill(unsigned char *bytes, size_t n)
{
    uint32_t x = 12345;
    for (size_t i = 0; i < n; i++) {
        x = x * 1664525u + 1013904223u;
        bytes[i] = (unsigned char)(x >> 24);
    }
}

START_TEST(hash_depends_on_content_size_and_seed_only)
{
    unsigned char a[208], b[208];
    for (size_t size = 0; size <= 200; size++) {
        bytes_fill(a, sizeof a);
        memset(b, 0xee, sizeof b);
        memcpy(b + 3, a, size); /* another alignment, other neighbours */
        ck_assert_uint_eq(hash_bytes(a, size, 9), hash_bytes(b + 3, size, 9));
        ck_assert_uint_ne(hash_bytes(a, size, 9), hash_bytes(a, size, 10));
        ck_assert_uint_ne(hash_bytes(a, size, 9), hash_bytes(a, size + 1, 9));
    }
    memset(a, 0, sizeof a); /* lengths of zeros differ */
    for (size_t size = 0; size < 200; size++)
        ck_assert_uint_ne(hash_bytes(a, size, 0), hash_bytes(a, size + 1, 0));
    ck_assert_uint_eq(hash_bytes(NULL, 0, 5), hash_bytes(a, 0, 5));
}
END_TEST

START_TEST(every_bit_changes_half_of_the_hash)
{
    enum { SIZE = 77 };
    unsigned char a[SIZE];
    bytes_fill(a, SIZE);
    uint64_t hash = hash_bytes(a, SIZE, 0);
    int changed = 0, least = 64;
    for (int bit = 0; bit < 8 * SIZE; bit++) {
        a[bit / 8] ^= (unsigned char)(1 << bit % 8);
        int now = __builtin_popcountll(hash ^ hash_bytes(a, SIZE, 0));
        a[bit / 8] ^= (unsigned char)(1 << bit % 8);
        changed += now;
        least = now < least ? now : least;
    }
    ck_assert_int_ge(least, 10);
    assert_absolute(changed / (8.0 * SIZE), 32, 0.7); /* 4 / sqrt(616) is one deviation */
}
END_TEST

START_TEST(exchanged_words_are_noticed)
{
    uint64_t words[16];
    bytes_fill((unsigned char *)words, sizeof words);
    uint64_t hash = hash_bytes(words, sizeof words, 0);
    for (int i = 0; i < 16; i++) {
        for (int j = 0; j < i; j++) {
            uint64_t w = words[i];
            words[i] = words[j];
            words[j] = w;
            ck_assert_uint_ne(hash_bytes(words, sizeof words, 0), hash);
            words[j] = words[i];
            words[i] = w;
        }
    }
}
END_TEST

/* Golden state hashes stand on this: a change here is a change of every one of them. */
START_TEST(hash_is_the_same_everywhere)
{
    const unsigned one = 1;
    if (*(const unsigned char *)&one != 1)
        return; /* big-endian words hash to other numbers */
    unsigned char a[100];
    bytes_fill(a, sizeof a);
    ck_assert_uint_eq(hash_bytes(a, 0, 0), 0xd8005c2fdef4b676);
    ck_assert_uint_eq(hash_bytes(a, 5, 1), 0xdeb4e2bf67c1c380);
    ck_assert_uint_eq(hash_bytes(a, 100, 2), 0xded2b7d064d4d50d);
}
END_TEST

/* FIPS 180-2 appendix B and the empty message. */
START_TEST(sha256_known_answers)
{
    char text[SHA256_TEXT_SIZE];
    sha256_text("abc", 3, text);
    ck_assert_str_eq(text, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    sha256_text("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq", 56, text);
    ck_assert_str_eq(text, "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    char *million = malloc(1000000);
    ck_assert_ptr_nonnull(million);
    memset(million, 'a', 1000000);
    sha256_text(million, 1000000, text);
    free(million);
    ck_assert_str_eq(text, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
    sha256_text(NULL, 0, text);
    ck_assert_str_eq(text, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}
END_TEST

TEST_MAIN("hash", hash_depends_on_content_size_and_seed_only, every_bit_changes_half_of_the_hash,
          exchanged_words_are_noticed, hash_is_the_same_everywhere, sha256_known_answers)
