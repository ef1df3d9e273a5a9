"""Safe writing and removing of files: atomic, never through links, nothing that this program did not make.

`files` replaces one file as a whole, `locks` admits one writer per folder, `drafts` builds beside the final name and publishes.
`links` refuses links and special files, `user_files` decides which files a command may replace, `memory_limit` is the memory
left. May import: errors.
"""
