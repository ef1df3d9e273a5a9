"""The `tehl` command. No formula lives here."""
