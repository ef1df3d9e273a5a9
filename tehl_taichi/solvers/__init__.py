"""Iterate kernels to a tolerance and return a report; nothing here prints."""
