"""Safe writing and removing of files: atomic, never through links, only files of this program.

`files` replaces single files, `locks` admits one writer per folder, `drafts` builds beside the final name and publishes,
`links` refuses links and special files, `user_files` decides which files a command may replace, `memory_limit` finds the
available memory. May import: errors.
"""
