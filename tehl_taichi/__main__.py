"""`python -m tehl_taichi` is `tehl`."""

from tehl_cli.entry import main

main()
