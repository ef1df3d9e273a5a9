"""What is written to disk, by one protocol: every command and every room writes, replaces and removes through here.

Nothing is written through a link or a special file (:mod:`links`), and nothing is replaced or removed that is not ours.
:mod:`files` writes one file as a whole, :mod:`locks` lets one process write below a folder, :mod:`drafts` makes a store or an
output beside its name and publishes it, :mod:`outputs` says which existing files a command may replace.
"""
