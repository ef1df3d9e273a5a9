"""Loops over fields, one stencil family per file. Free functions with explicit arguments; no physics of their own."""
