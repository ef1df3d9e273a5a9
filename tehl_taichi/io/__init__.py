"""Scene files, stores, summaries and figures."""
