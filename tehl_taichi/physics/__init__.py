"""Laws of the lubricant and of the contact: pointwise functions, scalars in, scalar out (arrays work too)."""
