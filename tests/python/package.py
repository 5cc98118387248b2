"""What tests of the Python package begin with: the package of the source tree over the library of the build."""

import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from skipping import skip  # noqa: E402  (tests is no package)

SOURCE = pathlib.Path(os.environ.get("FRAM_SOURCE", pathlib.Path(__file__).resolve().parents[2]))
BUILD = pathlib.Path(os.environ.get("FRAM_BUILD", SOURCE / "build/release"))
DEBIAN = "/usr/bin/python3"


def find_package():
    """`fram` can be imported afterwards; the test is skipped where that cannot be."""
    if os.environ.get("FRAM_TEST_SANITIZE"):
        skip("a library under sanitizers is not loaded by a Python without them")
    try:
        import cffi  # noqa: F401
        import numpy  # noqa: F401
    except ImportError as error:
        # Debian's packages are those of Debian's own Python.
        if sys.executable != DEBIAN and os.path.exists(DEBIAN) and not os.environ.get("FRAM_TEST_DEBIAN"):
            os.environ["FRAM_TEST_DEBIAN"] = "1"
            sys.exit(subprocess.run([DEBIAN, *sys.argv], check=False).returncode)
        skip(f"python3-numpy or python3-cffi is not installed ({error})")
    os.environ["FRAM_LIBRARY"] = str(BUILD / "libfram.so")
    os.environ.setdefault("MPLBACKEND", "Agg")
    sys.path.insert(0, str(SOURCE / "bindings/python"))


find_package()
