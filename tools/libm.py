"""Functions of libm whose last bits may differ between machines and versions of the C library.

Not among them, because IEEE 754 fixes every bit: sqrt, fabs, floor, ceil, trunc, round, rint, fmin, fmax, fmod,
remainder, copysign, ldexp, frexp, modf, nextafter.  fma is exact too, but is banned with the rest: it would hide a
contraction that not every processor makes.
"""

_NAMES = """
    sin cos tan sincos asin acos atan atan2 sinh cosh tanh asinh acosh atanh
    exp exp2 exp10 expm1 log log2 log10 log1p pow cbrt hypot erf erfc lgamma tgamma j0 j1 jn y0 y1 yn fma
""".split()

TRANSCENDENTAL = frozenset(name + suffix for name in _NAMES for suffix in ("", "f", "l"))
