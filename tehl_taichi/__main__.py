"""`python -m tehl_taichi` is `tehl`."""

from tehl_cli.main import main

main()
