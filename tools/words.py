"""The words that a script of tools/ or bench/ takes; --help tells them with what the script says at its head."""

import argparse


def words_of(about):
    """A parser for the script that begins with this text; without words of its own it takes none but --help."""
    return argparse.ArgumentParser(description=about, formatter_class=argparse.RawDescriptionHelpFormatter)
