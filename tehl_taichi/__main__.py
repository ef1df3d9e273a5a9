"""`python -m tehl_taichi` is `tehl`."""

from tehl_cli.entry import main

if __name__ == "__main__":  # not where it is imported, as tools that look at every module do
    main()
