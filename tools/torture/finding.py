"""What a case of the campaign tells: counts, and findings with all that is needed to see them again."""

import collections


class Finding:
    """kind: a few words that are the same for the same fault; words: the call; files: name -> text or bytes to keep."""

    def __init__(self, kind, words=(), told="", files=None):
        self.kind, self.words, self.told, self.files = kind, [str(w) for w in words], told, files or {}


class Case:
    """What one case did."""

    def __init__(self):
        self.counts = collections.Counter()
        self.findings = []

    def found(self, kind, outcome=None, files=None, told=""):
        """Note a finding; outcome: of the call that showed it."""
        words = outcome.words if outcome else ()
        if outcome:
            told = (told + "\n" + outcome.err[-2000:]).strip()
        self.findings.append(Finding(kind, words, told, files))
