#!/bin/sh
# Print the prefix that runs a program without address randomisation, or nothing where that is not allowed.
# ThreadSanitizer of gcc 12 does not start on kernels that randomise 32 bits of a mapping's address.
if setarch "$(uname -m)" -R true 2>/dev/null; then
    echo "setarch $(uname -m) -R"
fi
